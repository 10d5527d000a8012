#include <algorithm>
#include <filesystem>

#include "stages/render/render.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/map_stage/map_inputs.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/candidates.h"
#include "varimap/results/map_table.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// Per vertex of the repaired mesh.
Eigen::VectorXd read_masses(const std::string& path, const RepairedMesh& mesh) {
    const Eigen::VectorXd masses = read_csv_masses(path, file_of(mesh).vertex_count());
    return mesh.link.is_identity() ? masses : masses(mesh.link.origin);
}

/// Landmarks of the files, on the repaired meshes.
PointPairs read_landmarks_on(const std::vector<std::string>& files, const RepairedMesh& A,
                             const RepairedMesh& B, const LandmarkReading& reading) {
    if (files.empty()) return {};
    const Landmarks landmarks = read_landmarks(files, file_of(A), file_of(B), reading);
    PointMap on_A, on_B;
    for (const auto& [a, b] : as_points(landmarks, file_of(A), file_of(B)))
        on_A.push_back(a), on_B.push_back(b);
    on_A = from_file(on_A, {}, A.link), on_B = from_file(on_B, {}, B.link);
    PointPairs pairs;
    for (std::size_t i = 0; i < on_A.size(); ++i)
        if (on_A[i].face >= 0 && on_B[i].face >= 0) pairs.emplace_back(on_A[i], on_B[i]);
    return pairs;
}

/// Of the repaired mesh; -1 where the file's vertex has none there.
int vertex_on(const RepairedMesh& mesh, int vertex_of_file) {
    return mesh.link.is_identity() ? vertex_of_file : mesh.link.vertex[std::size_t(vertex_of_file)];
}

/// The first candidates, which there are previews of, beside the picture. `rough`: a copy, since the stamp is
/// to hold the parameters that were asked for.
void write_candidates(Stage& stage, const std::string& picture, Candidates candidates, const RepairedMesh& A,
                      const RepairedMesh& B, RenderParams rough) {
    const std::string beside = (std::filesystem::path(picture).parent_path() / "candidates.png").string();
    rough.samples = std::min(rough.samples, 2);  // rough maps need no smooth picture
    for (PointMap& preview : candidates.previews) preview = from_file(preview, B.link, A.link);
    TellingVertex& told = candidates.telling;
    if (!told.images.empty()) told.source = vertex_on(A, told.source);
    for (int& image : told.images) image = vertex_on(B, image);
    stage.write_file(beside, to_png(render_candidates(A.mesh, B.mesh, candidates.previews, told, rough)));
    log("the first candidates to {}", beside);
}

}  // namespace

int main(int argc, char** argv) {
    RenderParams params;
    Stage stage("render", "Picture of a map: the source's colours carried to the target, from two sides");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const MapInputs inputs(stage);
    const auto& masses =
        stage.input_list_option("distortion",
                                "source_masses.csv and target_masses.csv of varimap-remesh: shows changes "
                                "of mass, area and angle instead of colours",
                                2, 2);
    const auto& candidates_in =
        stage.input_option("candidates",
                           "of varimap-explore: where its choice was not sure, the first "
                           "three also go to candidates.png beside the picture");
    const auto& landmarks = stage.input_list_option(
        "landmarks", "what the map was made with, to mark it: a file of pairs, or two lists", 1, 2);
    const auto& out = stage.output("picture", 0, "PNG to write");
    return stage.main(argc, argv, [&] {
        if (!masses.empty() && (params.flips || !landmarks.empty()))
            throw UsageError("--distortion shows changes of mass, area and angle: no flips and no landmarks");
        const auto& [source, target, there, back] = inputs.files();
        const RepairedMesh A = repaired(read_mesh(source), params.repair, source),
                           B = repaired(read_mesh(target), params.repair, target);
        PointMap A_to_B = read_csv_map(there), B_to_A = read_csv_map(back);
        require_fit(A_to_B, there, file_of(A), source, file_of(B), target);
        require_fit(B_to_A, back, file_of(B), target, file_of(A), source);
        A_to_B = from_file(A_to_B, A.link, B.link);
        B_to_A = from_file(B_to_A, B.link, A.link);
        Candidates candidates;
        if (!candidates_in.empty()) candidates = stage.read<Candidates>("candidates", candidates_in).value;
        require_previews(candidates, file_of(A), file_of(B));
        const Image image = masses.empty()
                                ? render(A.mesh, B.mesh, A_to_B, B_to_A, params,
                                         read_landmarks_on(landmarks, A, B, params.landmark_reading))
                                : render_distortion(A.mesh, B.mesh, A_to_B, B_to_A, read_masses(masses[0], A),
                                                    read_masses(masses[1], B), params);
        stage.write_file(out, to_png(image));
        log("{} x {} pixels to {}", image.width, image.height, out);
        if (!candidates.previews.empty()) write_candidates(stage, out, std::move(candidates), A, B, params);
    });
}
