#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "varimap/mesh/topology.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Millionths of a unit of length: sums of them are exact.
using Length = std::int64_t;

/// A closed path of edges that meets no vertex twice.
struct Cycle {
    Length length = 0;
    std::vector<int> vertices;

    auto operator<=>(const Cycle&) const = default;
};

/// Short closed paths around vertices of one mesh.
class ShortCycles {
  public:
    /// Keeps references. `unit`: that of length.
    ShortCycles(const TriangleMesh& mesh, const Edges& edges, double unit);

    /// Those that a shortest path tree around `seed` closes, within `radius` of it, and that bound no disc
    /// there; at most `longest` long.
    std::vector<Cycle> around(int seed, Length radius, Length longest);
    /// The vertices that were reached last, and how far they are from the seed.
    const std::vector<std::pair<int, Length>>& reached() const { return reached_; }

  private:
    static constexpr Length nowhere = -1;

    void grow(int seed, Length radius);
    int other_end(int edge, int vertex) const;
    bool is_reached(int vertex) const { return distance_[std::size_t(vertex)] != nowhere; }
    int region_face(int half_edge) const;
    void collect_edges();
    std::vector<int> closing_edges();
    Cycle closed_by(int edge) const;
    void forget();

    const TriangleMesh& mesh_;
    const Edges& edges_;
    std::vector<Length> edge_length_;
    Adjacency vertex_edges_;
    std::vector<Length> distance_;  ///< per vertex; tentative while the tree grows
    std::vector<int> up_;           ///< per vertex: the edge towards the seed
    std::vector<int> face_number_;  ///< per face: among those of the region, from 1; 0: none
    std::vector<std::pair<int, Length>> reached_;
    std::vector<int> region_edges_, region_faces_;
};

}  // namespace varimap
