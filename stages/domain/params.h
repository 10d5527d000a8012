#pragma once

#include <array>

#include "varimap/core/enum_names.h"
#include "varimap/stage/parameters.h"

namespace varimap {

/// What a file holds.
enum class DomainKind : int { automatic = 0, points = 1, polyline = 2, graph = 3 };
template <>
struct EnumNames<DomainKind> {
    static constexpr std::array names{"auto", "points", "polyline", "graph"};
};

/// Along what distances are measured.
enum class Distances : int {
    intrinsic = 0,  ///< along the domain's own edges
    ambient = 1,    ///< in space
};
template <>
struct EnumNames<Distances> {
    static constexpr std::array names{"intrinsic", "ambient"};
};

/// What the weight of a graph's edge says.
enum class EdgeWeights : int {
    similarity = 0,  ///< its length is 1 / weight
    length = 1,
};
template <>
struct EnumNames<EdgeWeights> {
    static constexpr std::array names{"similarity", "length"};
};

struct DomainParams {
    DomainKind kind = DomainKind::automatic;
    Distances distances = Distances::intrinsic;
    EdgeWeights weights = EdgeWeights::similarity;
    int neighbours = 8;
    int dimensions = 16;

    void describe(ParameterList& list) {
        list.add(
            "kind", kind,
            "what the file holds; auto: a graph in .mtx and .edges, polylines in .obj, points in others");
        list.add("distances", distances,
                 "intrinsic: along the curve, the graph, or from neighbour to neighbour; ambient: in space");
        list.add("weights", weights, "of a list of edges: similarity (length 1 / weight), or length");
        list.add("neighbours", neighbours, "points joined to each point (points; polylines in space)", 1,
                 1000);
        list.add("dimensions", dimensions, "of intrinsic coordinates at most", 1, 64);
    }
};

}  // namespace varimap
