#pragma once

#include <array>
#include <mutex>
#include <vector>

#include "varimap/core/parallel.h"
#include "varimap/mesh/topology.h"
#include "varimap/sliding/image_memory.h"
#include "varimap/sliding/laid_out.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// How a map's faces lie along the target (laid_out.h), whatever their straight images cut through. Keeps in
/// mind what it has seen for as long as the images stay where they are, since a face may lie over thousands.
/// Keeps a reference. Threads may ask about different faces at once, but not about vertices.
class AlongTarget {
  public:
    explicit AlongTarget(const SlidingMap& map);

    /// 1 where a face is upright, -1 where it is reversed, between where it lies around a bend; NaN where it
    /// is torn or has no area, 1 where it is not mapped.
    double sense(int f) { return lie(f).sense; }
    /// Or may be, for another judge.
    bool is_reversed(int f) { return !(sense(f) > 0.05); }
    /// How many times the images of the faces around a vertex go around its own: 1 where the map is one to
    /// one, 2 at a branch point, where two sheets of the map hang together though no face need be reversed.
    /// Less on a boundary, and NaN where a face is torn.
    double winding_number(int v);
    bool is_branch_point(int v) { return winding_number(v) > 1.5; }

    /// Those of `faces` that are reversed, and the faces around branch points at their corners; ascending.
    std::vector<int> faulty_among(const std::vector<int>& faces);
    /// Of all faces.
    std::vector<int> faulty_faces();

    struct Faults {
        int reversed = 0, branch_points = 0;
        bool more_than(const Faults& other) const {
            return reversed > other.reversed || branch_points > other.branch_points;
        }
    };
    /// Reversed faces around a vertex; branch points among it and its neighbours.
    Faults faults_around(int v);

    /// Whether the images of a face's corners lie around one vertex of the target with faces that the normal
    /// of its straight image all agrees with: nothing is in doubt then.
    bool lies_within_a_star(int f, const Vec3& normal) const;

    const SharedEdges& source_edges() const { return source_edges_; }
    const SharedEdges& target_edges() const { return target_edges_; }

  private:
    static constexpr std::size_t locks = 256;

    const Lie& lie(int f);
    Lie look_at(int f);
    /// From corner k of a face to the next.
    SeenSide side(int f, int k);
    /// Faces looked at for the path between the ends of an edge of the source.
    int farthest(const std::array<int, 2>& ends) const;

    const SlidingMap& map_;
    Adjacency target_faces_;  ///< per vertex of the target
    SharedEdges source_edges_, target_edges_;
    LogMap log_map_;
    ImageMemory<SeenSide, 2> known_edges_;
    std::array<std::mutex, locks> edge_lock_;  ///< each for many edges: faces side by side ask for the same
    FaceMemory<Lie> known_faces_;
};

/// Those of `faces` of which `holds(face)` is true, in their order. For what takes long to tell: several are
/// asked about at a time.
template <class Predicate>
std::vector<int> faces_where(const std::vector<int>& faces, const Predicate& holds) {
    std::vector<char> marks(faces.size(), 0);
    parallel_for_each_index(faces.size(), std::size_t(64),
                            [&](std::size_t i) { marks[i] = holds(faces[i]); });
    std::vector<int> found;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (marks[i]) found.push_back(faces[i]);
    return found;
}

}  // namespace varimap
