#pragma once

#include "stages/generate/body.h"

namespace varimap::shapes {

struct IsometricShape {
    const char* kind;
    Body body;
};

/// Shapes to be mapped onto bent copies of themselves, without symmetry, or with one that only orientation,
/// feet, faces or lengths of limbs break: blobs, creatures with limbs anywhere, rings with limbs (genus 1),
/// four-legged animals and persons, by turns. Deterministic.
IsometricShape isometric_shape(unsigned seed);

}  // namespace varimap::shapes
