#include "benchmarks/example.h"

#include <cmath>
#include <map>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"

namespace varimap::benchmarks {

namespace {

Example make_example(int vertices) {
    const int around = int(std::lround(std::sqrt(vertices / 2.0)));
    const SurfaceData data =
        shapes::surface_data(shapes::unit_surface(shapes::tube(2 * around, around, true)), 30);
    const RowMatrix points = data.surface.mesh.vertices;
    const LevelSide side = make_level_side(data.hierarchy.levels.back(), points, data.surface.mass,
                                           data.hierarchy.options.truncation);
    std::vector<std::vector<int>> identity;
    for (int v = 0; v < data.surface.mesh.vertex_count(); ++v) identity.push_back({v});
    const RowMatrix centres = side.side.averaging.P * points;
    Example example{{side, side, {}},
                    GeodesicGraph(data.surface.mesh),
                    data.surface.mesh,
                    {centres, centres},
                    enlarged(identity, side.side.weights, side.side.weights),
                    {}};
    example.cost = CostFactors(side.side, side.side, example.centres).on(example.support);
    return example;
}

}  // namespace

const Example& example(int vertices) {
    static std::map<int, Example> examples;
    auto found = examples.find(vertices);
    if (found == examples.end()) found = examples.emplace(vertices, make_example(vertices)).first;
    return found->second;
}

void at_sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(5000)->Arg(20000)->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace varimap::benchmarks
