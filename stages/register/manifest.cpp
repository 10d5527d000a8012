#include "stages/register/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

TemplateLandmarks read_template_landmarks(const std::string& path, const TriangleMesh& mesh,
                                          const LandmarkReading& reading) {
    TemplateLandmarks result;
    for (const auto& [name, point] : read_placed_landmarks(path, mesh, reading)) {
        result.add_name(name);
        result.points.push_back(point);
    }
    return result;
}

Answer read_answer(const Json& entry, const std::string& specimen, const TriangleMesh& first) {
    Answer answer{read_correspondence(
                      {text_of(entry, "template"), specimen, text_of(entry, "there"), text_of(entry, "back")},
                      false, UnplacedFaces::collapse),
                  {},
                  entry.value("probability", 1.)};
    const std::string from_first = text_of(entry, "from_first");
    if (!from_first.empty()) {
        answer.from_first = read_csv_map(from_first);
        if (!is_map_between(answer.from_first, first, answer.map.from))
            throw InputError(from_first + ": not a map from the template to " + answer.map.from_file);
    } else if (answer.map.from.vertex_count() != first.vertex_count()) {
        throw InputError(answer.map.from_file + ": not the template");
    }
    return answer;
}

/// The first template's landmarks where the map leads that the answer has from there.
PointMap carried_landmarks(PointMap points, const TriangleMesh& first, const Answer& answer) {
    const PointCarrier carry(first, answer.from_first, answer.map.from);
    for (SurfacePoint& point : points) point = carry(point);
    return points;
}

/// The points of a further template's landmarks in the order of the first one's: by their names, or row by
/// row where a file lacks some.
PointMap in_order_of(const TemplateLandmarks& first, TemplateLandmarks own, const std::string& own_file) {
    if (own.names.size() != first.names.size())
        throw InputError(fmt::format("{}: {} landmarks, but the first template has {}", own_file,
                                     own.names.size(), first.names.size()));
    if (!first.named || !own.named || own.names == first.names) return std::move(own.points);
    PointMap points;
    for (const std::string& name : first.names) {
        const auto found = std::ranges::find(own.names, name);
        if (found == own.names.end() || std::ranges::count(own.names, name) > 1)
            throw InputError(
                fmt::format("{}: '{}', a landmark of the first template, is {}; give the same "
                            "names in both files, each once",
                            own_file, excerpt(name), found == own.names.end() ? "not there" : "there twice"));
        points.push_back(own.points[std::size_t(found - own.names.begin())]);
    }
    return points;
}

/// The first template's landmarks on the template of an answer: by a file of its own where it has one.
PointMap landmarks_on_template_of(const Answer& answer, const std::string& own_file, const Registration& all,
                                  const LandmarkReading& reading) {
    if (answer.from_first.empty()) return all.landmarks->points;
    if (own_file.empty()) return carried_landmarks(all.landmarks->points, all.first, answer);
    return in_order_of(*all.landmarks, read_template_landmarks(own_file, answer.map.from, reading), own_file);
}

/// `path`: of the manifest. The meshes and maps of a specimen are let go before the next one's are read.
void add_specimen(const Json& specimen, const std::string& path, const LandmarkReading& reading,
                  Registration& all) {
    const std::string name = text_of(specimen, "name");
    std::vector<Answer> answers;
    std::vector<PointMap> landmarks;  // on the template of each answer
    for (const Json& entry : specimen.at("answers")) {
        answers.push_back(read_answer(entry, text_of(specimen, "mesh"), all.first));
        if (all.landmarks)
            landmarks.push_back(
                landmarks_on_template_of(answers.back(), text_of(entry, "landmarks"), all, reading));
    }
    if (answers.empty()) throw InputError(path + ": " + name + ": no answers");
    log("{}: {} answers", name, answers.size());
    all.names.push_back(name);
    all.is_part.push_back(specimen.value("part", false));
    all.is_mirrored.push_back(specimen.value("mirrored", false));
    all.spaces.push_back(answers.front().map.to.space);
    all.points.push_back(corresponding_points(answers));
    if (all.landmarks) all.transferred.push_back(transfer_landmarks(answers, landmarks));
}

/// Further templates that cannot be read are no reason to make no maps of the first.
std::optional<TriangleMesh> mesh_if_readable(const std::string& path) {
    try {
        return read_mesh(path);
    } catch (const InputError&) {
        return {};
    }
}

/// `read` of the manifest, whatever of it is not there or something else.
template <class Read>
void with_manifest(const std::string& path, const Read& read) {
    try {
        read(Json::parse(read_file(path)));
    } catch (const nlohmann::json::exception& error) {
        throw InputError(path + ": not a manifest of varimap register: " + error.what());
    }
}

}  // namespace

void TemplateLandmarks::add_name(const std::string& name) {
    named = named && !name.empty();
    names.push_back(name.empty() ? std::to_string(names.size() + 1) : name);
}

Points Registration::shape(std::size_t specimen) const {
    Points shape = points[specimen];
    if (is_mirrored[specimen]) shape.col(0) *= -1;
    return shape;
}

Registration read_registration(const std::string& path, const LandmarkReading& reading) {
    Registration all;
    with_manifest(path, [&](const Json& manifest) {
        all.first = read_mesh(text_of(manifest, "template"));
        const std::string landmarks = text_of(manifest, "landmarks");
        if (!landmarks.empty()) all.landmarks = read_template_landmarks(landmarks, all.first, reading);
        for (const Json& specimen : manifest.at("specimens")) add_specimen(specimen, path, reading, all);
    });
    if (all.names.empty()) throw InputError(path + ": no specimens");
    return all;
}

void check_landmarks(const std::string& path, const LandmarkReading& reading) {
    with_manifest(path, [&](const Json& manifest) {
        std::optional<TemplateLandmarks> first;
        for (const Json& entry : manifest.at("templates")) {
            const std::string file = text_of(entry, "landmarks"), mesh = text_of(entry, "template");
            if (!first)
                first = read_template_landmarks(file, read_mesh(mesh), reading);
            else if (const auto further = mesh_if_readable(mesh))
                in_order_of(*first, read_template_landmarks(file, *further, reading), file);
        }
    });
}

}  // namespace varimap
