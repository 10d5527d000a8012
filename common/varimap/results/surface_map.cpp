#include "varimap/results/surface_map.h"

#include <cmath>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/core/error.h"
#include "varimap/results/checks.h"

namespace varimap {

/// A point map as two arrays, the form in which artifacts hold it.
struct PackedPointMap {
    Eigen::VectorXi faces;
    Points barycentric;
};

template <class Archive>
void serialize(Archive& archive, PackedPointMap& map) {
    archive(map.faces, map.barycentric);
}

namespace {

PackedPointMap pack(const PointMap& map) {
    const auto n = Eigen::Index(map.size());
    PackedPointMap packed{Eigen::VectorXi(n), Points(n, 3)};
    for (Eigen::Index i = 0; i < n; ++i) {
        packed.faces[i] = map[std::size_t(i)].face;
        packed.barycentric.row(i) = map[std::size_t(i)].barycentric.transpose();
    }
    return packed;
}

PointMap unpack(const PackedPointMap& packed) {
    if (packed.faces.size() != packed.barycentric.rows())
        throw ArtifactError("a map artifact has arrays of unequal length; rerun varimap-relax");
    PointMap map(std::size_t(packed.faces.size()));
    for (std::size_t i = 0; i < map.size(); ++i)
        map[i] = {packed.faces[Eigen::Index(i)], packed.barycentric.row(Eigen::Index(i)).transpose()};
    return map;
}

}  // namespace

template <class Archive>
void serialize(Archive& archive, UntanglingReport& r) {
    archive(r.flipped_before, r.flipped_after, r.flipped_area_percent_before, r.flipped_area_percent_after,
            r.global_steps, r.sweeps, r.parts_tried, r.parts_replaced, r.replaced_area_percent,
            r.mirrored_parts, r.gated_area_percent, r.disagreeing_before, r.disagreeing_after);
}

/// SurfaceMap as it is archived.
struct PackedSurfaceMap {
    PackedPointMap A_to_B, B_to_A;
    UntanglingReports untangling;
};

template <class Archive>
void serialize(Archive& archive, PackedSurfaceMap& map) {
    archive(map.A_to_B, map.B_to_A, map.untangling.A_to_B, map.untangling.B_to_A);
}

namespace {

bool is_finite(const UntanglingReport& report) {
    return std::isfinite(report.flipped_area_percent_before) &&
           std::isfinite(report.flipped_area_percent_after) && std::isfinite(report.replaced_area_percent) &&
           std::isfinite(report.gated_area_percent);
}

}  // namespace

std::string encode(const SurfaceMap& map) {
    return cereal_encode(PackedSurfaceMap{pack(map.A_to_B), pack(map.B_to_A), map.untangling});
}

void decode(const std::string& payload, SurfaceMap& map) {
    PackedSurfaceMap packed;
    cereal_decode(payload, packed);
    map = {unpack(packed.A_to_B), unpack(packed.B_to_A), packed.untangling};
    require<SurfaceMap>(are_points(map.A_to_B) && are_points(map.B_to_A), "points");
    require<SurfaceMap>(is_finite(map.untangling.A_to_B) && is_finite(map.untangling.B_to_A),
                        "untangling reports");
}

void require_surfaces(const SurfaceMap& map, const Surface& A, const Surface& B) {
    const TriangleMesh &file_A = file_of(A), &file_B = file_of(B);
    if (!is_map_between(map.A_to_B, file_A, file_B) || !is_map_between(map.B_to_A, file_B, file_A))
        throw ArtifactError("the map is not one between these surfaces; rerun varimap-relax");
}

}  // namespace varimap
