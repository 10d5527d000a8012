#include "varimap/surface/domain.h"

#include <algorithm>
#include <cmath>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/artifact/consistency.h"
#include "varimap/mesh/disjoint_sets.h"
#include "varimap/surface/surface.h"

namespace varimap {

namespace {

bool is_moderate(double value) {
    return value >= 1 / largest_ratio && value <= largest_ratio;
}

bool are_moderate(const RowMatrix& values) {
    return values.allFinite() && (values.size() == 0 || values.cwiseAbs().maxCoeff() <= largest_ratio);
}

void require_complete(const Domain& domain) {
    const Points& points = domain.mesh.vertices;
    const auto count = points.rows();
    require<Domain>(count > 0 && are_moderate(points), "points");
    require<Domain>(domain.mass.size() == count && are_masses(domain.mass), "masses");
    for (const DomainEdge& edge : domain.edges) {
        require<Domain>(0 <= edge.a && edge.a < edge.b && edge.b < count, "edges");
        require<Domain>(is_moderate(edge.length), "lengths");
        require<Domain>(is_moderate(edge.conductance), "conductances");
    }
    require<Domain>(Eigen::Index(domain.edges.size()) >= count - 1, "edges");
    const std::vector<int> part = components(int(count), domain.edges);
    require<Domain>(std::all_of(part.begin(), part.end(), [](int p) { return p == 0; }), "edges");
    const RowMatrix& x = domain.coordinates;
    require<Domain>(x.size() == 0 || (x.rows() == count && are_moderate(x)), "coordinates");
}

}  // namespace

template <class Archive>
void serialize(Archive& archive, DomainEdge& edge) {
    archive(edge.a, edge.b, edge.length, edge.conductance);
}

template <class Archive>
void serialize(Archive& archive, Domain& domain) {
    archive(domain.mesh.vertices, domain.mass, domain.edges, domain.coordinates);
}

std::string encode(const Domain& domain) {
    return cereal_encode(domain);
}

void decode(const std::string& payload, Domain& domain) {
    cereal_decode(payload, domain);
    require_complete(domain);
}

template <>
Artifact<Domain> read_artifact<Domain>(const std::string& path) {
    using Type = ArtifactType<Domain>;
    if (read_header(path).kind != Type::kind) {
        Artifact<Surface> surface = read_artifact<Surface>(path);
        return {std::move(surface.header), std::move(surface.value)};
    }
    auto [header, payload] = read_payload(path, Type::kind, Type::schema, Type::stage);
    Artifact<Domain> artifact{std::move(header), {}};
    decode(payload, artifact.value);
    return artifact;
}

std::vector<int> components(int points, const std::vector<DomainEdge>& edges) {
    DisjointSets sets(points);
    for (const DomainEdge& edge : edges) sets.join(edge.a, edge.b);
    std::vector<int> number(std::size_t(points), -1), part(static_cast<std::size_t>(points));
    int count = 0;
    for (int i = 0; i < points; ++i) {
        int& own = number[std::size_t(sets.lowest(i))];
        if (own < 0) own = count++;
        part[std::size_t(i)] = own;
    }
    return part;
}

}  // namespace varimap
