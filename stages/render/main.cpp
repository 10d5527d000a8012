#include <algorithm>
#include <filesystem>

#include "stages/render/render.h"
#include "varimap/artifact/artifact.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/results/candidates.h"
#include "varimap/results/surface_map.h"
#include "varimap/stage/stage_main.h"

int main(int argc, char** argv) {
    using namespace varimap;
    RenderParams params;
    Stage stage("render", "Picture of a map: the source's colours carried to the target, from two sides");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& source = stage.input("source-mesh", "mesh the map starts from");
    const auto& target = stage.input("target-mesh", "mesh the map leads to");
    const auto& there = stage.input("source-to-target", "CSV of varimap-remesh");
    const auto& back = stage.input("target-to-source", "CSV of varimap-remesh");
    const auto& masses =
        stage.input_list_option("distortion",
                                "source_masses.csv and target_masses.csv of varimap-remesh: shows changes "
                                "of mass, area and angle instead of colours",
                                2, 2);
    const auto& candidates_in =
        stage.input_option("candidates",
                           "of varimap-explore: where its choice was not sure, the first "
                           "three also go to candidates.png beside the picture");
    const auto& out = stage.output("picture", 0, "PNG to write");
    return stage.main(argc, argv, [&] {
        const TriangleMesh A = read_mesh(source), B = read_mesh(target);
        const PointMap A_to_B = read_csv_map(there), B_to_A = read_csv_map(back);
        Candidates candidates;
        if (!candidates_in.empty()) candidates = stage.read<Candidates>("candidates", candidates_in).value;
        require_previews(candidates, A, B);
        const Image image =
            masses.empty()
                ? render(A, B, A_to_B, B_to_A, params)
                : render_distortion(A, B, A_to_B, B_to_A, read_csv_masses(masses[0], A.vertex_count()),
                                    read_csv_masses(masses[1], B.vertex_count()), params);
        stage.write_file(out, to_png(image));
        log("{} x {} pixels to {}", image.width, image.height, out);
        if (candidates.previews.empty()) return;
        const std::string beside = (std::filesystem::path(out).parent_path() / "candidates.png").string();
        params.samples = std::min(params.samples, 2);  // rough maps need no smooth picture
        stage.write_file(beside, to_png(render_candidates(A, B, candidates.previews, params)));
        log("the first candidates to {}", beside);
    });
}
