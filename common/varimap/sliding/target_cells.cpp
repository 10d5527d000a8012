#include "varimap/sliding/target_cells.h"

#include "varimap/mesh/mass.h"

namespace varimap {

TargetCells::TargetCells(const SlidingMap& map, const GeodesicGraph& target_graph, double radius)
    : faces_(map.target().faces), cell_of_vertex_(target_graph.vertex_count(), -1) {
    const Eigen::VectorXd area = voronoi_masses(map.target());
    GeodesicBall ball(target_graph);
    for (int seed = 0; seed < target_graph.vertex_count(); ++seed) {
        if (cell_of_vertex_[seed] >= 0) continue;
        const int cell = int(area_.size());
        area_.push_back(0);
        ball.grow({seed}, [&](int v, double distance) {
            if (distance > radius) return false;
            if (cell_of_vertex_[v] < 0) {
                cell_of_vertex_[v] = cell;
                area_.back() += area[v];
            }
            return true;
        });
    }
}

std::vector<char> TargetCells::occupied(const PointMap& points) const {
    std::vector<char> occupied(area_.size(), 0);
    for (const SurfacePoint& point : points)
        for (int k = 0; k < 3; ++k)
            if (point.face >= 0) occupied[std::size_t(cell_of_vertex_[faces_(point.face, k)])] = 1;
    return occupied;
}

bool TargetCells::lies_in(const SurfacePoint& point, const std::vector<char>& marked) const {
    for (int k = 0; k < 3; ++k)
        if (point.face >= 0 && marked[std::size_t(cell_of_vertex_[faces_(point.face, k)])]) return true;
    return false;
}

double TargetCells::area(const std::vector<char>& marked) const {
    return lost_area(marked, std::vector<char>(marked.size(), 0));
}

double usual_cell_radius(const SlidingMap& map) {
    return 2 * equilateral_edge(map.source());
}

double TargetCells::lost_area(const std::vector<char>& before, const std::vector<char>& after) const {
    double sum = 0;
    for (std::size_t c = 0; c < area_.size(); ++c)
        if (before[c] && !after[c]) sum += area_[c];
    return sum;
}

}  // namespace varimap
