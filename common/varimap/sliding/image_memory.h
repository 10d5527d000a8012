#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Remembers what was found of parts of the source (faces, edges) for as long as their corners' images are
/// where they were when it was found. For judgements that take long and depend on nothing else. Keeps a
/// reference to the map. Threads may ask for different parts at once.
template <class Answer, int corner_count>
class ImageMemory {
  public:
    using Corners = std::array<int, corner_count>;

    ImageMemory(const SlidingMap& map, int part_count) : map_(map), known_(std::size_t(part_count)) {}

    /// judge() of part i, whose corners are these vertices; from memory where it can be.
    template <class Judge>
    const Answer& operator()(int i, const Corners& corners, const Judge& judge) {
        Known& known = known_[std::size_t(i)];
        if (const std::uint64_t place = place_of(corners); known.place != place) known = {place, judge()};
        return known.answer;
    }

  private:
    /// A number for where the images are, never 0; that two places share one is next to impossible.
    std::uint64_t place_of(const Corners& corners) const {
        std::uint64_t mixed = 0;
        const auto mix = [&](std::uint64_t word) {
            mixed = (std::rotl(mixed, 23) ^ word) * 0x9e3779b97f4a7c15u;
            mixed ^= mixed >> 32;
        };
        for (const int v : corners) {
            const SurfacePoint& image = map_.point(v);
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
    std::vector<Known> known_;
};

/// Of faces.
template <class Answer>
class FaceMemory {
  public:
    explicit FaceMemory(const SlidingMap& map) : map_(map), known_(map, map.source().face_count()) {}

    /// judge(f); from memory where it can be.
    template <class Judge>
    const Answer& operator()(int f, const Judge& judge) {
        const auto c = map_.source().faces.row(f);
        return known_(f, {c[0], c[1], c[2]}, [&] { return judge(f); });
    }

  private:
    const SlidingMap& map_;
    ImageMemory<Answer, 3> known_;
};

}  // namespace varimap
