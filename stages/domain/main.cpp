#include <fmt/format.h>

#include "stages/domain/make_domain.h"
#include "varimap/core/log.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

void add_positions(const std::string& path, DomainFile& graph, Stage& stage) {
    if (graph.kind != DomainKind::graph)
        throw UsageError("--positions are for graphs; points and polylines have theirs");
    graph.positions = read_positions(path);
    stage.record_file("positions", path);
    if (graph.positions.rows() != graph.count)
        throw InputError(
            fmt::format("{}: {} positions for {} points", path, graph.positions.rows(), graph.count));
}

}  // namespace

int main(int argc, char** argv) {
    DomainParams params;
    Stage stage("domain", "A point set, curve or weighted graph, ready to be mapped as a surface is");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& in =
        stage.input("points", "rows of coordinates, OBJ with lines, rows of edges, MatrixMarket, or a mesh");
    const std::string& positions_in =
        stage.input_option("positions", "coordinates of a graph's points, row by row");
    const std::string& out =
        stage.output(ArtifactType<Domain>::kind, ArtifactType<Domain>::schema, "domain to write");
    return stage.main(argc, argv, [&] {
        DomainFile file = read_domain_file(in, params.kind);
        stage.record_file("points", in);
        if (!positions_in.empty()) add_positions(positions_in, file, stage);
        const Domain domain = make_domain(file, params, in);
        log("{} points, {} edges, {} intrinsic coordinates", domain.mass.size(), domain.edges.size(),
            domain.coordinates.cols());
        stage.record_number("points", double(domain.mass.size()));
        stage.record_number("edges", double(domain.edges.size()));
        stage.write(out, domain);
    });
}
