#pragma once

#include <array>
#include <vector>

#include "stages/generate/random.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap::shapes {

/// A closed surface in a box: its walls, the ellipsoid in it, or the cylinder along an axis, y or z.
struct AssemblyPart {
    enum class Form : int { along_y, along_z, box, ball };
    Form form;
    Vec3 low, high;
};

/// What is put together of parts that touch and share no vertex, as in models of game engines: z points up.
struct Assembly {
    const char* kind;
    std::vector<AssemblyPart> parts;
};

/// Two of a kind (chairs without and with arms, tables with a shelf and a box on them, cars, robots, by
/// turns), whose parts are partners in their order. `variation`: how much proportions differ, 1 as between
/// pieces of furniture. Deterministic.
std::array<Assembly, 2> assemblies(unsigned seed, double variation, Random& random);

/// One component for each part, divided into squares so that it has about so many vertices in all.
TriangleMesh assembled(const Assembly& assembly, int vertices);

/// Where vertices of assembled(from, ...) belong on another one of its kind.
Points partners(const TriangleMesh& mesh, const Assembly& from, const Assembly& to);

}  // namespace varimap::shapes
