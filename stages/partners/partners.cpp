#include "stages/partners/partners.h"

#include <array>

#include "varimap/core/parallel.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

struct Around {
    double weighted = 0, within = 0;
};

Around mass_around(int column, const std::vector<double>& mass, double radius, GeodesicBall& ball) {
    Around result;
    ball.grow(column, [&](int v, double d) {
        if (d > radius) return false;
        result.weighted += mass[std::size_t(v)] * (1 - d / radius);
        result.within += mass[std::size_t(v)];
        return true;
    });
    return result;
}

Partner best_partner(const SparseMatrix& plan, int row, double radius, GeodesicBall& ball,
                     std::vector<double>& mass) {
    Partner best;
    double total = 0, most = -1;
    for (SparseMatrix::InnerIterator entry(plan, row); entry; ++entry) {
        mass[std::size_t(entry.col())] = entry.value();
        total += entry.value();
    }
    for (SparseMatrix::InnerIterator entry(plan, row); entry; ++entry) {
        const Around around = mass_around(int(entry.col()), mass, radius, ball);
        if (around.weighted > most) {
            most = around.weighted;
            best = {int(entry.col()), around.within / total};
        }
    }
    for (SparseMatrix::InnerIterator entry(plan, row); entry; ++entry) mass[std::size_t(entry.col())] = 0;
    return best;
}

struct Joined {
    std::vector<std::array<int, 2>> ends;
    double mean_length = 0;
};

Joined edges_of(const Domain& domain) {
    Joined result;
    if (domain.is_surface()) {
        result.ends = find_edges(domain.mesh).vertices;
        for (const auto& [a, b] : result.ends)
            result.mean_length += (domain.mesh.vertex(a) - domain.mesh.vertex(b)).norm();
    }
    for (const DomainEdge& edge : domain.edges) {
        result.ends.push_back({edge.a, edge.b});
        result.mean_length += edge.length;
    }
    result.mean_length /= double(result.ends.size());
    return result;
}

bool is_within(int from, int to, double radius, GeodesicBall& ball) {
    bool found = false;
    ball.grow(from, [&](int v, double d) {
        if (d > radius) return false;
        found = v == to;
        return !found;
    });
    return found;
}

}  // namespace

std::vector<Partner> best_partners(const SparseMatrix& plan, const GeodesicGraph& graph, double radius) {
    std::vector<Partner> partners(std::size_t(plan.rows()));
    parallel_for_each_range(partners.size(), 64, [&](std::size_t begin, std::size_t end) {
        GeodesicBall ball(graph);
        std::vector<double> mass(std::size_t(plan.cols()), 0);
        for (std::size_t i = begin; i < end; ++i)
            partners[i] = best_partner(plan, int(i), radius, ball, mass);
    });
    return partners;
}

double share_apart(const Domain& domain, const std::vector<Partner>& partners, const GeodesicGraph& other,
                   double apart) {
    const Joined edges = edges_of(domain);
    GeodesicBall ball(other);
    int far = 0;
    for (const auto& [a, b] : edges.ends) {
        const int to_a = partners[std::size_t(a)].point, to_b = partners[std::size_t(b)].point;
        far += to_a < 0 || to_b < 0 || !is_within(to_a, to_b, apart * edges.mean_length, ball);
    }
    return double(far) / double(edges.ends.size());
}

}  // namespace varimap
