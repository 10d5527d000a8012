#include "varimap/mesh_repair/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/cavities.h"
#include "varimap/mesh_repair/duplicate_faces.h"
#include "varimap/mesh_repair/sheets.h"
#include "varimap/mesh_repair/weld.h"

namespace varimap {
namespace {

struct Actions {
    bool weld = false, faces = false, sheets = false, components = false;
};

Actions actions_from(const std::string& words) {
    if (words == "none") return {};
    if (words == "all") return {true, true, true, true};
    Actions actions;
    std::istringstream list(words);
    for (std::string word; std::getline(list, word, ',');) {
        bool* action = word == "weld"         ? &actions.weld
                       : word == "faces"      ? &actions.faces
                       : word == "sheets"     ? &actions.sheets
                       : word == "components" ? &actions.components
                                              : nullptr;
        if (!action)
            throw UsageError("--repair " + words +
                             ": give all, none, or some of weld,faces,sheets,components");
        *action = true;
    }
    return actions;
}

double tolerance(const TriangleMesh& mesh, const RepairOptions& options) {
    return options.weld_tolerance * std::sqrt(surface_area(mesh));
}

/// Most meshes need none, which is found out at the cost of the checks that they would have to pass anyway.
bool needs_repair(const TriangleMesh& file, const RepairOptions& options) {
    try {
        require_manifold(file, "");
    } catch (const InputError&) {
        return true;
    }
    const std::vector<int> welded = welded_vertices(file, tolerance(file, options));
    for (int v = 0; v < file.vertex_count(); ++v)
        if (welded[std::size_t(v)] != v) return true;
    return !file.vertices.allFinite();
}

/// The repair of one mesh: which of its faces are left, and by which numbers they name vertices.
class Repair {
  public:
    Repair(const TriangleMesh& file, const RepairOptions& options, const std::string& path);
    RepairedMesh run();

  private:
    TriangleMesh current() const;
    int keep_faces(const std::vector<char>& keep);
    void drop_not_finite();
    void weld();
    void drop_degenerate();
    void drop_duplicates();
    void separate_sheets();
    void choose_components();
    void require_faces() const;
    RepairedMesh result() const;
    void find_fates(FileLink& link, const Faces& corners) const;

    const TriangleMesh& file_;
    const RepairOptions& options_;
    const std::string& path_;
    Faces faces_;              ///< by origin_, not turned
    std::vector<int> number_;  ///< per face: that of the file
    std::vector<char> turned_;
    std::vector<int> welded_;     ///< per vertex of the file: the one it is one with
    std::vector<int> origin_;     ///< per vertex that faces_ may name: that of the file
    std::vector<char> left_out_;  ///< per vertex of the file: on a component that is not mapped
    RepairCounts counts_;
};

Repair::Repair(const TriangleMesh& file, const RepairOptions& options, const std::string& path)
    : file_(file),
      options_(options),
      path_(path),
      faces_(file.faces),
      number_(all_indices(file.face_count())),
      turned_(std::size_t(file.face_count()), 0),
      welded_(all_indices(file.vertex_count())),
      origin_(welded_),
      left_out_(std::size_t(file.vertex_count()), 0) {}

/// By the vertices that faces_ names.
TriangleMesh Repair::current() const {
    return {file_.vertices(origin_, Eigen::all), faces_, file_.space};
}

/// Returns how many were dropped.
int Repair::keep_faces(const std::vector<char>& keep) {
    std::vector<int> left, number;
    std::vector<char> turned;
    for (int f = 0; f < int(keep.size()); ++f) {
        if (!keep[std::size_t(f)]) continue;
        left.push_back(f);
        number.push_back(number_[std::size_t(f)]);
        turned.push_back(turned_[std::size_t(f)]);
    }
    if (left.size() == keep.size()) return 0;
    faces_ = faces_(left, Eigen::all).eval();
    number_ = std::move(number);
    turned_ = std::move(turned);
    return int(keep.size() - left.size());
}

void Repair::require_faces() const {
    if (faces_.rows() == 0)
        throw InputError(path_ +
                         ": no surface is left: all faces are degenerate, or have corners that are not "
                         "numbers");
}

void Repair::drop_not_finite() {
    std::vector<char> keep;
    for (int f = 0; f < int(faces_.rows()); ++f)
        keep.push_back(file_.vertices(faces_.row(f), Eigen::all).allFinite());
    counts_.not_finite = keep_faces(keep);
    require_faces();
}

void Repair::drop_degenerate() {
    std::vector<char> keep;
    for (int f = 0; f < int(faces_.rows()); ++f) keep.push_back(!repeats_vertex(faces_, f));
    counts_.degenerate += keep_faces(keep);
    require_faces();
}

void Repair::drop_duplicates() {
    counts_.duplicates += keep_faces(without_duplicates(current()));
    require_faces();
}

void Repair::weld() {
    const TriangleMesh mesh = current();
    welded_ = welded_vertices(mesh, tolerance(mesh, options_));
    for (int v = 0; v < int(welded_.size()); ++v) counts_.welded += welded_[std::size_t(v)] != v;
    faces_ = faces_.unaryExpr([&](int v) { return welded_[std::size_t(v)]; }).eval();
}

void Repair::separate_sheets() {
    const Sheets sheets = find_sheets(current());
    std::vector<int> copies(origin_.size(), 0);
    for (const int v : sheets.origin) ++copies[std::size_t(v)];
    counts_.split_vertices = int(std::count_if(copies.begin(), copies.end(), [](int n) { return n > 1; }));
    counts_.cut_edges = sheets.cut_edges;
    counts_.opened_edges = sheets.opened_edges;
    counts_.turned = int(std::count(sheets.turned.begin(), sheets.turned.end(), 1));
    if (counts_.split_vertices + counts_.cut_edges + counts_.opened_edges + counts_.turned == 0) return;
    faces_ = sheets.faces;
    turned_ = sheets.turned;
    origin_ = sheets.origin;
}

/// The largest component that is no inner wall, and of the others those that are asked for.
void Repair::choose_components() {
    const TriangleMesh mesh = current();
    const ConnectedComponents components = connected_components(mesh);
    if (components.count < 2) return;
    const std::vector<double> area = components.areas(mesh);
    const double total = std::accumulate(area.begin(), area.end(), 0.);
    std::vector<char> chosen;
    for (const double a : area) chosen.push_back(a >= options_.least_component * total);
    std::vector<char> cavity(area.size(), 0);
    if (options_.components != Components::all) cavity = find_cavities(mesh, components, chosen);
    std::size_t largest = 0;
    for (std::size_t c = 1; c < area.size(); ++c)
        if (cavity[c] < cavity[largest] || (cavity[c] == cavity[largest] && area[c] > area[largest]))
            largest = c;
    for (std::size_t c = 0; c < area.size(); ++c) {
        chosen[c] = c == largest || (options_.components != Components::largest && chosen[c] && !cavity[c]);
        if (chosen[c]) continue;
        ++(cavity[c] ? counts_.cavities : counts_.dropped_components);
        if (total > 0) (cavity[c] ? counts_.cavity_area : counts_.dropped_area) += area[c] / total;
    }
    std::vector<char> keep;
    for (int f = 0; f < mesh.face_count(); ++f) {
        keep.push_back(chosen[std::size_t(components.of_face[std::size_t(f)])]);
        if (keep.back()) continue;
        for (const int v : file_.faces.row(number_[std::size_t(f)])) left_out_[std::size_t(v)] = 1;
    }
    keep_faces(keep);
}

/// Of each vertex of the file: the first of its own corners decides; without any, that of its twins.
void Repair::find_fates(FileLink& link, const Faces& corners) const {
    const std::size_t count = welded_.size();
    link.vertex.assign(count, -1);
    link.fate.assign(count, VertexFate::unused);
    for (const int v : file_.faces.reshaped()) link.fate[std::size_t(v)] = VertexFate::faces_dropped;
    for (std::size_t v = 0; v < count; ++v) {
        if (!file_.vertex(int(v)).allFinite()) link.fate[v] = VertexFate::not_finite;
        if (left_out_[v]) link.fate[v] = VertexFate::component_dropped;
    }
    std::vector<int> of_welded(count, -1);
    for (int i = int(link.origin.size()) - 1; i >= 0; --i)
        of_welded[std::size_t(link.origin[std::size_t(i)])] = i;
    for (int f = 0; f < int(corners.rows()); ++f)
        for (int c = 0; c < 3; ++c) {
            const auto v = std::size_t(file_.faces(number_[std::size_t(f)], c));
            const bool first = link.vertex[v] < 0;
            if (first) link.vertex[v] = corners(f, c);
            const auto usual = welded_[v] == int(v) ? VertexFate::kept : VertexFate::welded;
            if (first) link.fate[v] = usual;
            if (link.vertex[v] != corners(f, c)) link.fate[v] = VertexFate::split;
        }
    for (std::size_t v = 0; v < count; ++v) {
        const int twin = of_welded[std::size_t(welded_[v])];
        if (link.vertex[v] >= 0 || twin < 0) continue;
        link.vertex[v] = twin;
        link.fate[v] = VertexFate::welded;
    }
}

RepairedMesh Repair::result() const {
    if (!counts_.any() && file_.vertices.allFinite()) return {file_, {}, counts_};
    RepairedMesh result;
    result.counts = counts_;
    FileLink& link = result.link;
    const UsedVertices used = used_vertices(faces_, int(origin_.size()));
    for (const int v : used.vertex) link.origin.push_back(origin_[std::size_t(v)]);
    result.mesh = {file_.vertices(link.origin, Eigen::all), used.faces, file_.space};
    for (int f = 0; f < result.mesh.face_count(); ++f)
        if (turned_[std::size_t(f)]) std::swap(result.mesh.faces(f, 1), result.mesh.faces(f, 2));
    link.file = file_;
    link.face = number_;
    link.turned = turned_;
    find_fates(link, used.faces);
    return result;
}

RepairedMesh Repair::run() {
    const Actions actions = actions_from(options_.repair);
    require_corners(file_, path_);
    if (actions.faces) {
        drop_not_finite();
        drop_degenerate();
    }
    require_plain_faces(current(), path_);
    require_size(current(), path_);
    if (actions.faces) drop_duplicates();  // a loose triangle that is there twice has no boundary to weld
    if (actions.weld) {
        weld();
        drop_degenerate();
        if (actions.faces) drop_duplicates();
    }
    if (actions.sheets) separate_sheets();
    if (actions.components) choose_components();
    RepairedMesh repaired = result();
    require_sheets(repaired.mesh, path_);
    if (!actions.components) require_connected(repaired.mesh, path_);
    return repaired;
}

}  // namespace

RepairedMesh repaired(const TriangleMesh& file, const RepairOptions& options, const std::string& path) {
    actions_from(options.repair);  // unknown words are refused in any case
    if (!needs_repair(file, options)) return {file, {}, {}};
    return Repair(file, options, path).run();
}

bool welds(const RepairOptions& options) {
    return actions_from(options.repair).weld;
}

std::string in_words(const RepairCounts& counts) {
    std::string text;
    const auto add = [&](int count, const char* one, const char* several) {
        if (count == 0) return;
        if (!text.empty()) text += ", ";
        text += counted(count, one, several);
    };
    add(counts.welded, "vertex welded", "vertices welded");
    add(counts.not_finite, "face with a corner that is not a number dropped",
        "faces with corners that are not numbers dropped");
    add(counts.degenerate, "degenerate face dropped", "degenerate faces dropped");
    add(counts.duplicates, "face that lies on another dropped", "faces that lie on others dropped");
    add(counts.turned, "face turned", "faces turned");
    add(counts.cut_edges, "edge cut", "edges cut");
    add(counts.opened_edges,
        "edge cut because the surface has one side only, like a Moebius strip, and tears there",
        "edges cut because the surface has one side only, like a Moebius strip, and tears there");
    add(counts.split_vertices, "vertex split", "vertices split");
    add(counts.dropped_components, "component left out", "components left out");
    add(counts.cavities, "inner wall left out (--components all keeps it)",
        "inner walls left out (--components all keeps them)");
    add(counts.closed_slits, "slit closed", "slits closed");
    add(counts.filled_holes, "hole filled", "holes filled");
    add(counts.unfilled_holes, "hole left open, which cannot be filled without new vertices",
        "holes left open, which cannot be filled without new vertices");
    add(counts.cut_handles, "small handle or tunnel closed", "small handles and tunnels closed");
    add(counts.bridges, "component joined to the rest by a thin bridge",
        "components joined to the rest by thin bridges");
    return text;
}

}  // namespace varimap
