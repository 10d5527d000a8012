#pragma once

#include <optional>
#include <vector>

#include "varimap/sliding/sliding_map.h"
#include "varimap/sliding/target_cells.h"

namespace varimap {

/// Judges whether a repair crushes what it repairs: a limb that is mapped to its own root has fewer faults,
/// but is lost, where the target has its limb for it. What the target has nothing for (a tail on an animal
/// without one) lies crumpled before, in faces that are not small, and has to be crushed by any map that is
/// one to one.
class CrushGuard {
  public:
    /// Keeps a reference.
    explicit CrushGuard(const SlidingMap& map) : map_(map) {}

    /// Share of the faces' area whose image is reversed or hardly has an area.
    double crushed_share(const std::vector<int>& faces) const;
    /// Whether it is not much more than it was.
    bool allows(const std::vector<int>& faces, double share_before) const;
    /// Whether faces that are crushed now had no partner where `kept` were the images of their vertices: all
    /// of that is covered as it was, and not by what is stretched over it. Not if hardly anything is left of
    /// them.
    bool had_no_partner(const std::vector<int>& faces, const PointMap& kept);

  private:
    /// Area of the images of faces, by their own.
    double mean_image(const std::vector<int>& faces) const;
    /// Area of the images that lie in these cells of the target and are far larger than their faces.
    double stretched_over(const std::vector<char>& cells) const;

    const SlidingMap& map_;
    std::optional<TargetCells> cells_;  ///< once they are asked for
};

}  // namespace varimap
