#pragma once

#include <bit>
#include <cstdint>

#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Remembers what was found of faces of the source for as long as their corners' images are where they were
/// when it was found. For judgements that take long and depend on nothing else. Keeps a reference to the map.
/// Threads may ask for different faces at once.
template <class Answer>
class FaceMemory {
  public:
    explicit FaceMemory(const SlidingMap& map) : map_(map), known_(map.source().face_count()) {}

    /// judge(f); from memory where it can be.
    template <class Judge>
    const Answer& operator()(int f, const Judge& judge) {
        Known& known = known_[f];
        if (const std::uint64_t place = place_of(f); known.place != place) known = {place, judge(f)};
        return known.answer;
    }

  private:
    /// A number for where the images are, never 0; that two places share one is next to impossible.
    std::uint64_t place_of(int f) const {
        std::uint64_t mixed = 0;
        const auto mix = [&](std::uint64_t word) {
            mixed = (std::rotl(mixed, 23) ^ word) * 0x9e3779b97f4a7c15u;
            mixed ^= mixed >> 32;
        };
        for (int k = 0; k < 3; ++k) {
            const SurfacePoint& image = map_.point(map_.source().faces(f, k));
            mix(std::uint64_t(image.face));
            for (const double b : image.barycentric) mix(std::bit_cast<std::uint64_t>(b));
        }
        return mixed | 1;
    }

    struct Known {
        std::uint64_t place = 0;
        Answer answer{};
    };
    const SlidingMap& map_;
    FaceData<Known> known_;
};

}  // namespace varimap
