#include "varimap/map_repair/crush_guard.h"

#include <algorithm>

namespace varimap {

namespace {

/// A face is crushed whose image has less than this share of its area, and a repair may crush this share of
/// the faces that it moves. A limb that faults at its root cut off is a spot in a chart, and may come to lie
/// beside that of the target's limb, or the rim may not enclose the target's limb at all: it is mapped to its
/// root then, and has fewer faults than before. Of 616 repairs of 10 pairs, 12 crush .38 to .72, all others
/// less than .15 (all but one, of a limb that was crushed already, less than .06). What the image as a whole
/// loses in area, or what strain it gains, tells less: both change much where tangles are unfolded.
constexpr double crushed = 0.1;
constexpr double may_crush = 0.1;
/// What had no partner may be crushed: at most this share of where it lay is covered by faces that are
/// stretched over it then. With this, and the start from faces' own shapes (charted_part.h), 137 faces of 34
/// pairs of animals and people end reversed, and 25 branch points are left, instead of 265 and 47 (of as many
/// others, on which it was chosen, 85 and 20 instead of 207 and 41), with the same errors.
constexpr double stretched = 4;
constexpr double may_stretch = 0.2;
/// Of a crushed part's area that is left at least: of what becomes smaller and smaller, 1e-9 in the end,
/// verification finds what rounding leaves of it reversed.
constexpr double least_image = 0.02;

}  // namespace

double CrushGuard::crushed_share(const std::vector<int>& faces) const {
    double crushed_area = 0, area = 0;
    for (const int f : faces) {
        if (!map_.is_mapped(f)) continue;
        area += map_.rest(f).area;
        if (map_.image_triangle(f).D < crushed) crushed_area += map_.rest(f).area;
    }
    return area > 0 ? crushed_area / area : 0;
}

bool CrushGuard::allows(const std::vector<int>& faces, double share_before) const {
    return crushed_share(faces) <= share_before + may_crush;
}

bool CrushGuard::had_no_partner(const std::vector<int>& part, const PointMap& kept) {
    if (mean_image(part) < least_image) return false;
    if (!cells_) cells_.emplace(map_, GeodesicGraph(map_.target()), usual_cell_radius(map_));
    const std::vector<char> lain_in = cells_->occupied(kept);
    const std::vector<char> occupied = cells_->occupied(map_.points());
    return cells_->lost_area(lain_in, occupied) == 0 &&
           stretched_over(lain_in) <= may_stretch * cells_->area(lain_in);
}

double CrushGuard::mean_image(const std::vector<int>& faces) const {
    double image = 0, area = 0;
    for (const int f : faces) {
        if (!map_.is_mapped(f)) continue;
        area += map_.rest(f).area;
        image += map_.rest(f).area * std::max(map_.image_triangle(f).D, 0.);
    }
    return area > 0 ? image / area : 0;
}

double CrushGuard::stretched_over(const std::vector<char>& cells) const {
    double area = 0;
    for (int f = 0; f < map_.source().face_count(); ++f) {
        if (!map_.is_mapped(f)) continue;
        const double D = map_.image_triangle(f).D;
        for (int k = 0; k < 3 && D > stretched; ++k)
            if (cells_->lies_in(map_.point(map_.source().faces(f, k)), cells))
                area += D * map_.rest(f).area / 3;
    }
    return area;
}

}  // namespace varimap
