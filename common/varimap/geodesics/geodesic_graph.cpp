#include "varimap/geodesics/geodesic_graph.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "varimap/core/bucket_sort.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

struct HalfEdge {
    int low, high;  ///< the edge's vertices
    int apex;       ///< the face's third vertex
};

std::vector<HalfEdge> half_edges_by_edge(const TriangleMesh& mesh) {
    const auto half_edge = [&](int h) {
        const int f = h / 3, c = h % 3, a = mesh.faces(f, c), b = mesh.faces(f, (c + 1) % 3);
        return HalfEdge{std::min(a, b), std::max(a, b), mesh.faces(f, (c + 2) % 3)};
    };
    return sorted_in_buckets(
               3 * mesh.face_count(), mesh.vertex_count(), half_edge, [](const HalfEdge& e) { return e.low; },
               [](const HalfEdge& a, const HalfEdge& b) {
                   return std::tie(a.high, a.apex) < std::tie(b.high, b.apex);
               })
        .item;
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
    arcs.reserve(2 * edges.size());  // an edge and a diagonal for two half-edges, both ways
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

GeodesicGraph graph_of(const std::vector<Arc>& arcs, int vertices) {
    GeodesicGraph graph;
    auto [offset, sorted] = sorted_in_buckets(
        int(arcs.size()), vertices, [&](int i) -> const Arc& { return arcs[std::size_t(i)]; },
        [](const Arc& a) { return a.from; },
        [](const Arc& a, const Arc& b) { return std::tie(a.to, a.length) < std::tie(b.to, b.length); });
    graph.offset = std::move(offset);
    graph.target.reserve(sorted.size());
    graph.length.reserve(sorted.size());
    for (const Arc& a : sorted) {
        graph.target.push_back(a.to);
        graph.length.push_back(a.length);
    }
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

RowMatrix distances_from_each(const GeodesicGraph& graph, const std::vector<int>& sources) {
    RowMatrix result = RowMatrix::Constant(Eigen::Index(sources.size()), graph.vertex_count(),
                                           std::numeric_limits<double>::infinity());
    parallel_for_each_range(sources.size(), 8, [&](std::size_t begin, std::size_t end) {
        GeodesicBall ball(graph);
        for (std::size_t k = begin; k < end; ++k)
            ball.grow(sources[k], [&](int v, double d) { return result(Eigen::Index(k), v) = d, true; });
    });
    return result;
}

}  // namespace varimap
