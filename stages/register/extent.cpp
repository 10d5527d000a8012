#include "stages/register/extent.h"

#include <fmt/format.h>

#include <limits>

#include "varimap/core/error.h"
#include "varimap/core/indexed.h"

namespace varimap {
namespace {

void leave_out_missing(const Points& points, VertexData<bool>& present) {
    for (int v = 0; v < present.size(); ++v) present[v] = present[v] && points.row(v).allFinite();
}

/// The one of those that are no parts that has the fewest of the template's vertices.
std::size_t scarcest(const std::vector<Points>& specimens, const std::vector<bool>& is_part) {
    std::size_t scarcest = 0;
    Eigen::Index least = std::numeric_limits<Eigen::Index>::max();
    for (std::size_t i = 0; i < specimens.size(); ++i) {
        const Eigen::Index present = specimens[i].rowwise().sum().array().isFinite().count();
        if (!is_part[i] && present < least) least = present, scarcest = i;
    }
    return scarcest;
}

/// The faces all of whose corners are present. `what`: to say if these are too few.
Extent extent_of(const TriangleMesh& first, const VertexData<bool>& present, const std::string& what) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(first.vertex_count());
    std::vector<int> faces;
    for (int f = 0; f < first.face_count(); ++f) {
        const auto corners = first.faces.row(f);
        if (!present[corners[0]] || !present[corners[1]] || !present[corners[2]]) continue;
        faces.push_back(f);
        for (const int v : corners) area[v] += face_normal(first, f).norm() / 6;
    }
    Extent result;
    for (int v = 0; v < first.vertex_count(); ++v)
        if (area[v] > 0) result.vertices.push_back(v);
    if (result.vertices.size() < 3) throw InputError(what);
    result.faces = first.faces(faces, Eigen::all);
    result.weights = area(result.vertices) / area(result.vertices).sum();
    return result;
}

}  // namespace

Extents::Extents(const TriangleMesh& first, const std::vector<Points>& specimens,
                 const std::vector<bool>& is_part, const std::vector<std::string>& names) {
    VertexData<bool> everywhere(first.vertex_count(), true);
    leave_out_missing(first.vertices, everywhere);
    for (std::size_t i = 0; i < specimens.size(); ++i)
        if (!is_part[i]) leave_out_missing(specimens[i], everywhere);
    common_ = extent_of(
        first, everywhere,
        fmt::format(
            "no part of the template is mapped to every specimen; {} has the least of it: leave it out",
            names[scarcest(specimens, is_part)]));
    for (std::size_t i = 0; i < specimens.size(); ++i) {
        if (!is_part[i]) continue;
        VertexData<bool> present = everywhere;
        leave_out_missing(specimens[i], present);
        parts_.emplace(
            i,
            extent_of(first, present,
                      names[i] + " has nothing of what all the specimens that are whole have; leave it out"));
    }
}

const Extent& Extents::of(std::size_t specimen) const {
    const auto found = parts_.find(specimen);
    return found == parts_.end() ? common_ : found->second;
}

}  // namespace varimap
