#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "stages/register/answers.h"
#include "stages/register/procrustes.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/mesh/topology.h"
#include "varimap/results/surface_map.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct RegisterParams {
    int components = 5;
    bool scale = true;

    void describe(ParameterList& list) {
        list.add("components", components, "principal components to write", 0, 1000);
        list.add("scale", scale, "bring all specimens to one size before shapes are compared");
    }
};

/// Landmarks by name, on a template.
struct NamedLandmarks {
    std::vector<std::string> names;
    PointMap points;
};

NamedLandmarks read_named_landmarks(const std::string& path, const TriangleMesh& mesh) {
    NamedLandmarks result;
    if (!is_picked_points(path)) {
        for (const int v : read_vertex_list(path, IndexBase::automatic, &mesh)) {
            result.names.push_back(fmt::format("{}", result.names.size() + 1));
            result.points.push_back(point_at_vertex(mesh, v));
        }
        return result;
    }
    std::vector<Vec3> positions;
    for (const PickedPoint& point : read_picked_points(path)) {
        if (!point.defined) continue;
        result.names.push_back(point.name.empty() ? fmt::format("{}", result.names.size() + 1) : point.name);
        positions.push_back(in_axes_of(mesh, point, LandmarkSpace::stated));
    }
    Snapped snapped = snap(positions, mesh);
    int far = 0;
    for (const double distance : snapped.distances) far += distance > far_from_surface;
    if (2 * far > int(positions.size()))
        throw InputError(fmt::format("{}: {} of {} landmarks lie far from the template's surface; {}", path,
                                     far, positions.size(), likely_cause(positions, mesh)));
    result.points = std::move(snapped.points);
    return result;
}

/// The points of another template's landmarks in the first one's order, of which there must be as many.
PointMap in_order_of(const NamedLandmarks& first, NamedLandmarks other, const std::string& path) {
    if (other.names.size() != first.names.size())
        throw InputError(fmt::format("{}: {} landmarks, but the first template has {}", path,
                                     other.names.size(), first.names.size()));
    return std::move(other.points);
}

/// A comma-separated field: in quotes, unless it is plain.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string array_of(const std::vector<Points>& shapes) {
    std::vector<double> numbers;
    for (const Points& shape : shapes)
        numbers.insert(numbers.end(), shape.data(), shape.data() + shape.size());
    return to_npy("<f8", {(long long)(shapes.size()), (long long)(shapes.front().rows()), 3}, numbers);
}

std::string points_csv(const Points& points) {
    std::string text = "vertex,x,y,z\n";
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        text += fmt::format("{},{},{},{}\n", v, points(v, 0), points(v, 1), points(v, 2));
    return text;
}

/// The specimens of a manifest, as `varimap register` writes it.
struct Registration {
    TriangleMesh first;  ///< the template
    NamedLandmarks landmarks;
    std::vector<std::string> names;
    std::vector<Points> points;
    std::vector<Space> spaces;  ///< what the specimens' files say of their axes
    std::vector<TransferredLandmarks> transferred;
};

std::string text_of(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

Answer read_answer(const Json& entry, const std::string& specimen, const TriangleMesh& first) {
    Answer answer{read_correspondence(
                      {text_of(entry, "template"), specimen, text_of(entry, "there"), text_of(entry, "back")},
                      false, UnplacedFaces::collapse),
                  {}};
    const std::string from_first = text_of(entry, "from_first");
    if (!from_first.empty()) {
        answer.from_first = read_csv_map(from_first);
        if (int(answer.from_first.size()) != first.vertex_count() ||
            !are_points(answer.from_first, answer.map.from.face_count()))
            throw InputError(from_first + ": not a map from the template to " + answer.map.from_file);
    } else if (answer.map.from.vertex_count() != first.vertex_count()) {
        throw InputError(answer.map.from_file + ": not the template");
    }
    return answer;
}

/// The first template's landmarks on another.
PointMap carried(PointMap points, const TriangleMesh& first, const Answer& answer) {
    const PointCarrier carry(first, answer.from_first, answer.map.from);
    for (SurfacePoint& point : points) point = carry(point);
    return points;
}

Registration read_registration(const std::string& path) {
    Registration result;
    try {
        const Json manifest = Json::parse(read_file(path));
        result.first = read_mesh(text_of(manifest, "template"));
        const std::string landmarks = text_of(manifest, "landmarks");
        if (!landmarks.empty()) result.landmarks = read_named_landmarks(landmarks, result.first);
        for (const Json& specimen : manifest.at("specimens")) {
            std::vector<Answer> answers;
            std::vector<PointMap> on_templates;
            for (const Json& entry : specimen.at("answers")) {
                answers.push_back(read_answer(entry, text_of(specimen, "mesh"), result.first));
                if (landmarks.empty()) continue;
                const Answer& answer = answers.back();
                const std::string own = text_of(entry, "landmarks");
                if (answer.from_first.empty())
                    on_templates.push_back(result.landmarks.points);
                else if (!own.empty())
                    on_templates.push_back(
                        in_order_of(result.landmarks, read_named_landmarks(own, answer.map.from), own));
                else
                    on_templates.push_back(carried(result.landmarks.points, result.first, answer));
            }
            if (answers.empty()) throw InputError(path + ": " + text_of(specimen, "name") + ": no answers");
            log("{}: {} answers", text_of(specimen, "name"), answers.size());
            result.names.push_back(text_of(specimen, "name"));
            result.points.push_back(corresponding_points(answers));
            result.spaces.push_back(answers.front().map.to.space);
            if (!landmarks.empty()) result.transferred.push_back(transfer_landmarks(answers, on_templates));
        }
    } catch (const nlohmann::json::exception& error) {
        throw InputError(path + ": not a manifest of varimap register: " + error.what());
    }
    if (result.points.empty()) throw InputError(path + ": no specimens");
    return result;
}

/// The vertices that all specimens have, and faces of these: shapes are compared on them.
struct Common {
    std::vector<int> vertices;
    Faces faces;              ///< of the template, by its vertex numbers
    Eigen::VectorXd weights;  ///< areas on the template, of sum 1

    Points of(const Points& points) const { return points(vertices, Eigen::all); }
};

Common common_part(const Registration& all) {
    std::vector<bool> present(std::size_t(all.first.vertex_count()), true);
    for (std::size_t v = 0; v < present.size(); ++v) {
        present[v] = all.first.vertices.row(Eigen::Index(v)).allFinite();
        for (const Points& points : all.points)
            present[v] = present[v] && points.row(Eigen::Index(v)).allFinite();
    }
    Eigen::VectorXd area = Eigen::VectorXd::Zero(all.first.vertex_count());
    std::vector<int> faces;
    for (int f = 0; f < all.first.face_count(); ++f) {
        const auto corners = all.first.faces.row(f);
        if (!present[std::size_t(corners[0])] || !present[std::size_t(corners[1])] ||
            !present[std::size_t(corners[2])])
            continue;
        faces.push_back(f);
        for (const int v : corners) area[v] += face_normal(all.first, f).norm() / 6;
    }
    Common result;
    for (int v = 0; v < all.first.vertex_count(); ++v)
        if (area[v] > 0) result.vertices.push_back(v);
    if (result.vertices.size() < 3) throw InputError("no part of the template is mapped to every specimen");
    result.faces = all.first.faces(faces, Eigen::all);
    result.weights = area(result.vertices) / area(result.vertices).sum();
    return result;
}

/// Points of the common vertices back in the template's numbering; the others, which no face uses, at the
/// first.
Points on_template(const Common& common, const Points& points, int vertices) {
    Points all = points.row(0).replicate(vertices, 1);
    all(common.vertices, Eigen::all) = points;
    return all;
}

class Folder {
  public:
    Folder(Stage& stage, const std::string& path) : stage_(stage), path_(path) {
        std::error_code failure;
        fs::create_directories(path_ / "specimens", failure);
        if (failure) throw IoError("cannot make the folder '" + path + "': " + failure.message());
    }
    void write(const std::string& name, const std::string& bytes) const {
        stage_.write_file((path_ / name).string(), bytes);
    }

  private:
    Stage& stage_;
    fs::path path_;
};

void write_landmarks(const Folder& folder, const Registration& all) {
    std::string csv = "specimen,landmark,x,y,z,confidence,round_trip,spread\n";
    std::vector<Points> positions;
    for (std::size_t i = 0; i < all.transferred.size(); ++i) {
        const TransferredLandmarks& found = all.transferred[i];
        positions.push_back(found.positions);
        for (Eigen::Index k = 0; k < found.positions.rows(); ++k)
            csv += fmt::format("{},{},{},{},{},{:.4f},{:.6f},{:.6f}\n", field(all.names[i]),
                               field(all.landmarks.names[std::size_t(k)]), found.positions(k, 0),
                               found.positions(k, 1), found.positions(k, 2), found.confidence[k],
                               found.round_trip[k], found.spread[k]);
    }
    folder.write("landmarks.csv", csv);
    folder.write("landmarks.npy", array_of(positions));
}

void write_points(const Folder& folder, const Registration& all, const Common& common) {
    folder.write("points.npy", array_of(all.points));
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        folder.write("specimens/" + all.names[i] + ".csv", points_csv(all.points[i]));
        folder.write("specimens/" + all.names[i] + ".ply",
                     to_ply({on_template(common, common.of(all.points[i]), all.first.vertex_count()),
                             common.faces, all.spaces[i]},
                            PlyFormat::ascii));
    }
}

void write_shapes(const Folder& folder, const Registration& all, const Common& common,
                  const RegisterParams& params) {
    std::vector<Points> shapes;
    for (const Points& points : all.points) shapes.push_back(common.of(points));
    const Alignment alignment =
        procrustes(shapes, common.of(all.first.vertices), common.weights, params.scale);
    const Components components = principal_components(alignment, common.weights, params.components);
    const std::vector<bool> odd = outliers(alignment.distances);
    const auto mesh = [&](const Points& points) {
        return to_ply({on_template(common, points, all.first.vertex_count()), common.faces, all.first.space},
                      PlyFormat::ascii);
    };
    std::vector<Points> aligned;
    for (const Points& shape : alignment.shapes) {
        Points whole =
            Points::Constant(all.first.vertex_count(), 3, std::numeric_limits<double>::quiet_NaN());
        whole(common.vertices, Eigen::all) = shape;
        aligned.push_back(std::move(whole));
    }
    folder.write("aligned.npy", array_of(aligned));
    folder.write("mean.ply", mesh(alignment.mean));
    std::string specimens = "specimen,size,distance,outlier", variance = "component,variance,share\n";
    const Eigen::Index count = components.variance.size();
    for (Eigen::Index k = 0; k < count; ++k) {
        specimens += fmt::format(",pc{}", k + 1);
        const double share =
            components.total_variance > 0 ? components.variance[k] / components.total_variance : 0;
        variance += fmt::format("{},{},{}\n", k + 1, components.variance[k], share);
        const Points two = 2 * components.displacement[std::size_t(k)];
        folder.write(fmt::format("component_{}_minus.ply", k + 1), mesh(alignment.mean - two));
        folder.write(fmt::format("component_{}_plus.ply", k + 1), mesh(alignment.mean + two));
    }
    specimens += "\n";
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        specimens += fmt::format("{},{},{},{}", field(all.names[i]), alignment.sizes[i],
                                 alignment.distances[i], odd[i] ? "yes" : "no");
        for (Eigen::Index k = 0; k < count; ++k)
            specimens += fmt::format(",{}", components.scores(Eigen::Index(i), k));
        specimens += "\n";
        if (odd[i])
            warn("{} is an outlier: {:.4g} from the mean shape", all.names[i], alignment.distances[i]);
    }
    folder.write("specimens.csv", specimens);
    folder.write("components.csv", variance);
    // The meshes of the shapes have the same vertices and faces: pictures show one as a map onto the other.
    PointMap identity(std::size_t(all.first.vertex_count()));
    for (int f = 0; f < int(common.faces.rows()); ++f)
        for (int corner = 0; corner < 3; ++corner)
            identity[std::size_t(common.faces(f, corner))] = {f, Vec3::Unit(corner)};
    folder.write("identity.csv", to_csv(identity));
}

}  // namespace

int main(int argc, char** argv) {
    RegisterParams params;
    Stage stage("register", "Corresponding points of specimens, their mean shape and principal components");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& manifest =
        stage.input("manifest", "JSON of varimap register: templates, specimens and their maps");
    const auto& out = stage.option("out", "folder for the results");
    return stage.main(argc, argv, [&] {
        if (out.empty()) throw UsageError("say where the results go: --out FOLDER");
        const Registration all = read_registration(manifest);
        const Common common = common_part(all);
        const Folder folder(stage, out);
        write_points(folder, all, common);
        if (!all.transferred.empty()) write_landmarks(folder, all);
        write_shapes(folder, all, common, params);
        log("{} specimens, {} of {} vertices in all of them", all.names.size(), common.vertices.size(),
            all.first.vertex_count());
    });
}
