#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "stages/domain/params.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// What a file says of a domain.
struct DomainFile {
    DomainKind kind = DomainKind::points;  ///< never automatic
    int count = 0;                         ///< points
    Points positions;               ///< of points and polylines; graphs have none or get theirs elsewhere
    std::vector<DomainEdge> edges;  ///< with their lengths, or with weights in the place of lengths
    bool measured = false;          ///< these are lengths
};

constexpr int least_points = 4;

inline DomainEdge edge_between(int a, int b, double length = 0) {
    return {std::min(a, b), std::max(a, b), length, 0};
}

/// Reads points (rows of two or three coordinates, parted by blanks or commas), a polyline (the same, in
/// order; closed where the last is the first; or the v and l lines of an OBJ), or a graph (rows of two point
/// numbers, from 0, and a weight; MatrixMarket; or the edges of a mesh). A first row of names is passed over.
/// Throws IoError, and InputError naming file and line: what is no number, not finite, a weight that is not
/// positive, two edges between the same points that differ, two points at the same place, fewer than four
/// points.
DomainFile read_domain_file(const std::string& path, DomainKind kind);

/// Rows of two or three coordinates, no two the same.
Points read_positions(const std::string& path);

}  // namespace varimap
