#include "varimap/mesh/geodesic_graph.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace varimap {

namespace {

struct HalfEdge {
    int low, high;  ///< the edge's vertices
    int apex;       ///< the face's third vertex
};

std::vector<HalfEdge> half_edges_by_edge(const TriangleMesh& mesh) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * size_t(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) {
            const int a = mesh.faces(f, c), b = mesh.faces(f, (c + 1) % 3);
            edges.push_back({std::min(a, b), std::max(a, b), mesh.faces(f, (c + 2) % 3)});
        }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.apex) < std::tie(b.low, b.high, b.apex);
    });
    return edges;
}

/// Position of `apex` relative to the edge: along it from `low`, and the (positive) height above it.
std::pair<double, double> unfolded(const TriangleMesh& mesh, const HalfEdge& e) {
    const Vec3 along = (mesh.vertex(e.high) - mesh.vertex(e.low)).normalized();
    const Vec3 side = mesh.vertex(e.apex) - mesh.vertex(e.low);
    const double x = side.dot(along);
    return {x, (side - x * along).norm()};
}

/// Length of the straight segment between the two apices of an edge, if it crosses the edge; else negative.
double diagonal_length(const TriangleMesh& mesh, const HalfEdge& e, const HalfEdge& f) {
    const auto [xe, ye] = unfolded(mesh, e);
    const auto [xf, yf] = unfolded(mesh, f);
    if (!(ye + yf > 0)) return -1;
    const double crossing = (xe * yf + xf * ye) / (ye + yf);
    const double edge = (mesh.vertex(e.high) - mesh.vertex(e.low)).norm();
    return crossing > 0 && crossing < edge ? std::hypot(xe - xf, ye + yf) : -1;
}

struct Arc {
    int from, to;
    double length;
};

void connect(int a, int b, double length, std::vector<Arc>& arcs) {
    arcs.push_back({a, b, length});
    arcs.push_back({b, a, length});
}

std::vector<Arc> arcs_of(const TriangleMesh& mesh) {
    std::vector<Arc> arcs;
    const auto edges = half_edges_by_edge(mesh);
    arcs.reserve(2 * edges.size());
    for (size_t i = 0; i < edges.size(); ++i) {
        const HalfEdge& e = edges[i];
        const bool paired = i + 1 < edges.size() && edges[i + 1].low == e.low && edges[i + 1].high == e.high;
        connect(e.low, e.high, (mesh.vertex(e.high) - mesh.vertex(e.low)).norm(), arcs);
        if (!paired) continue;
        const double diagonal = diagonal_length(mesh, e, edges[i + 1]);
        if (diagonal > 0 && e.apex != edges[i + 1].apex) connect(e.apex, edges[i + 1].apex, diagonal, arcs);
        ++i;
    }
    return arcs;
}

std::vector<Arc> arcs_of(const Domain& domain) {
    if (domain.is_surface()) return arcs_of(domain.mesh);
    std::vector<Arc> arcs;
    for (const DomainEdge& edge : domain.edges) connect(edge.a, edge.b, edge.length, arcs);
    return arcs;
}

GeodesicGraph graph_of(std::vector<Arc> arcs, int vertices) {
    GeodesicGraph graph;
    std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) {
        return std::tie(a.from, a.to, a.length) < std::tie(b.from, b.to, b.length);
    });
    graph.offset.assign(vertices + 1, 0);
    for (const Arc& a : arcs) {
        ++graph.offset[a.from + 1];
        graph.target.push_back(a.to);
        graph.length.push_back(a.length);
    }
    for (int v = 0; v < vertices; ++v) graph.offset[v + 1] += graph.offset[v];
    return graph;
}

}  // namespace

GeodesicGraph::GeodesicGraph(const TriangleMesh& mesh)
    : GeodesicGraph(graph_of(arcs_of(mesh), mesh.vertex_count())) {}

GeodesicGraph::GeodesicGraph(const Domain& domain)
    : GeodesicGraph(graph_of(arcs_of(domain), domain.mesh.vertex_count())) {}

void GeodesicBall::reset() {
    for (int v : touched_) distance_[v] = std::numeric_limits<double>::infinity();
    touched_.clear();
    heap_.clear();
}

void GeodesicBall::relax(int vertex, double distance) {
    if (!(distance < distance_[vertex])) return;
    if (std::isinf(distance_[vertex])) touched_.push_back(vertex);
    distance_[vertex] = distance;
    heap_.emplace_back(distance, vertex);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

std::pair<double, int> GeodesicBall::pop() {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const auto top = heap_.back();
    heap_.pop_back();
    return top;
}

}  // namespace varimap
