#include "stages/inspect/contents.h"

#include <fmt/format.h>

#include <map>

#include "varimap/core/error.h"
#include "varimap/results/candidates.h"
#include "varimap/results/choice.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/plan.h"
#include "varimap/results/quality_numbers.h"
#include "varimap/results/surface_map.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/hierarchy.h"
#include "varimap/stage/stamp.h"
#include "varimap/surface/part_region.h"
#include "varimap/surface/surface.h"

namespace varimap {
namespace {

void visit_points(const std::string& name, const PointMap& points, ContentsVisitor& visitor) {
    std::vector<int> faces;
    Points barycentric(points.size(), 3);
    for (const auto& point : points) {
        barycentric.row(Eigen::Index(faces.size())) = point.barycentric.transpose();
        faces.push_back(point.face);
    }
    visitor.array(name + "_face", view(faces));
    visitor.array(name + "_barycentric", view(barycentric));
}

void visit_pairs(const std::string& name, const PointPairs& pairs, ContentsVisitor& visitor) {
    PointMap first, second;
    for (const auto& [a, b] : pairs) first.push_back(a), second.push_back(b);
    visit_points(name + "_A", first, visitor);
    visit_points(name + "_B", second, visitor);
}

void visit(const Surface& surface, ContentsVisitor& visitor) {
    visitor.fact("area", fmt::format("{}", surface_area(surface.mesh)));
    visitor.fact("area of the input", fmt::format("{}", surface_area(surface.input)));
    visitor.fact("total mass", fmt::format("{}", surface.mass.sum()));
    visitor.fact("centre", fmt::format("{} {} {}", surface.centre[0], surface.centre[1], surface.centre[2]));
    visitor.fact("scale", fmt::format("{}", surface.scale));
    visitor.mesh("mesh", surface.mesh);
    visitor.mesh("input", surface.input);
    visitor.array("mass", view(surface.mass));
    visit_points("on_mesh", surface.on_mesh, visitor);
    visitor.array("input_face", view(surface.input_face));
    visit_points("on_input", surface.on_input, visitor);
}

void visit(const Domain& domain, ContentsVisitor& visitor) {
    std::vector<int> ends;
    Eigen::VectorXd lengths(Eigen::Index(domain.edges.size()));
    for (const DomainEdge& edge : domain.edges) {
        lengths[Eigen::Index(ends.size() / 2)] = edge.length;
        ends.push_back(edge.a);
        ends.push_back(edge.b);
    }
    visitor.fact("points", fmt::format("{}", domain.mass.size()));
    visitor.fact("edges", fmt::format("{}", domain.edges.size()));
    visitor.fact("intrinsic coordinates", fmt::format("{}", domain.coordinates.cols()));
    visitor.array("positions", view(domain.mesh.vertices));
    visitor.array("mass", view(domain.mass));
    visitor.array("edge_ends", view(ends));
    visitor.array("edge_lengths", view(lengths));
    visitor.array("coordinates", view(domain.coordinates));
}

void visit(const Basis& basis, ContentsVisitor& visitor) {
    visitor.fact("vertices", fmt::format("{}", basis.functions.rows()));
    visitor.fact("eigenpairs", fmt::format("{}", basis.functions.cols()));
    visitor.array("eigenvalues", view(basis.eigenvalues));
    visitor.array("functions", view(basis.functions));
    visitor.array("residuals", view(basis.residuals));
}

void visit(const Level& level, const std::string& prefix, ContentsVisitor& visitor) {
    visitor.array(prefix + "_samples", view(level.samples));
    visitor.array(prefix + "_cell", view(level.cell));
    visitor.array(prefix + "_mass", view(level.mass));
    visitor.sparse(prefix + "_weights", level.weights);
}

void visit(const Hierarchy& hierarchy, ContentsVisitor& visitor) {
    for (std::size_t i = 0; i < hierarchy.levels.size(); ++i) {
        const Level& level = hierarchy.levels[i];
        const bool diffusion = level.kind == LevelKind::diffusion;
        const std::string name = fmt::format("level_{:02}", i);
        visitor.fact(name, fmt::format("{} samples, {} {}", level.samples.size(),
                                       diffusion ? "diffusion, time" : "Euclidean, sigma", level.scale));
    }
    for (std::size_t i = 0; i < hierarchy.levels.size(); ++i)
        visit(hierarchy.levels[i], fmt::format("level_{:02}", i), visitor);
    visitor.array("shape_descriptors", view(hierarchy.shape.descriptors));
    visitor.array("bending", view(hierarchy.shape.bending));
}

std::string trace_csv(const Trace& trace) {
    std::string text =
        "level,euclidean,iteration,samples_A,samples_B,sinkhorn_iterations,entries,gamma,energy,marginal_"
        "error\n";
    for (const auto& row : trace)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", row.level, row.euclidean, row.iteration,
                            row.samples_A, row.samples_B, row.sinkhorn_iterations, row.entries, row.gamma,
                            row.energy, row.marginal_error);
    return text;
}

std::string candidates_csv(const std::vector<Candidate>& candidates) {
    std::string text =
        "candidate,explored,self_map_A,self_map_B,energy,dirichlet,relief,alignment,stretch,landmarks_missed,"
        "score,"
        "reversed_mass,"
        "moved_mass,mirrored_back,turned_about_axis,turned_by_half,mirror_gain,turn\n";
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& c = candidates[k];
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", k + 1, c.explored,
                        c.self_map_A, c.self_map_B, c.energy, c.dirichlet, c.relief, c.alignment, c.stretch,
                        c.landmarks_missed, c.score, c.reversed_mass, c.moved_mass, int(c.mirrored_back),
                        int(c.turned_about_axis), int(c.turned_by_half), c.mirror_gain, c.turn);
    }
    return text;
}

void visit_confidence(const std::vector<Candidate>& candidates, ContentsVisitor& visitor) {
    if (candidates.empty()) return;
    const Confidence confidence = confidence_of(candidates);
    visitor.fact("confidence",
                 fmt::format("{}: {}, margin {:.2f}", confidence.confident ? "sure" : "not sure",
                             probability_in_words(confidence), confidence.margin));
}

void visit_candidates(const std::vector<Candidate>& candidates, ContentsVisitor& visitor) {
    for (std::size_t k = 0; k < candidates.size(); ++k)
        visitor.fact(fmt::format("candidate {}", k + 1),
                     fmt::format("{}; {}", origin(candidates[k]), relation(candidates[k])));
    if (!candidates.empty()) visitor.text("candidates.csv", candidates_csv(candidates));
}

void visit(const Candidates& candidates, ContentsVisitor& visitor) {
    visitor.fact("found on sketches of", candidates.sketched_A + " and " + candidates.sketched_B);
    visit_candidates(candidates.list, visitor);
    // Of the maps of a surface onto itself none is the right one.
    if (candidates.sketched_A.empty() || candidates.sketched_A != candidates.sketched_B)
        visit_confidence(candidates.list, visitor);
    for (std::size_t k = 0; k < candidates.maps.size(); ++k) {
        PointPairs from_B = candidates.maps[k].from_B;
        for (auto& [point, image] : from_B) std::swap(point, image);
        visit_pairs(fmt::format("map_{:02}_from_A", k + 1), candidates.maps[k].from_A, visitor);
        visit_pairs(fmt::format("map_{:02}_from_B", k + 1), from_B, visitor);
    }
    visitor.fact("previews", fmt::format("{}", candidates.previews.size()));
    for (std::size_t k = 0; k < candidates.previews.size(); ++k)
        visit_points(fmt::format("preview_{:02}", k + 1), candidates.previews[k], visitor);
    const TellingVertex& told = candidates.telling;
    if (!told.images.empty())
        visitor.fact("told apart by", fmt::format("vertex {} of A's file, at {} of B's", told.source,
                                                  fmt::join(told.images, ", ")));
}

std::string range_of_ratios(const Eigen::VectorXd& transported, const Eigen::VectorXd& mass) {
    const Eigen::ArrayXd ratio = transported.array() / mass.array();
    return ratio.size() > 0 ? fmt::format("from {:.6g} to {:.6g}", ratio.minCoeff(), ratio.maxCoeff())
                            : "none";
}

void visit_plan(const SamplePlan& plan, ContentsVisitor& visitor) {
    visitor.fact("area bound", fmt::format("{}", plan.area_bound));
    visitor.fact("transported / mass, A", range_of_ratios(plan.transported_A, plan.mass_A));
    visitor.fact("transported / mass, B", range_of_ratios(plan.transported_B, plan.mass_B));
    visitor.fact("total of the entries", fmt::format("{}", plan.entries.sum()));
    visitor.sparse("plan", plan.entries);
    visitor.array("samples_A", view(plan.samples_A));
    visitor.array("samples_B", view(plan.samples_B));
    visitor.array("mass_A", view(plan.mass_A));
    visitor.array("mass_B", view(plan.mass_B));
    visitor.array("transported_A", view(plan.transported_A));
    visitor.array("transported_B", view(plan.transported_B));
}

void visit_record(const PairRecord& record, ContentsVisitor& visitor) {
    std::vector<int> landmarks_A, landmarks_B;
    for (const auto& [a, b] : record.landmarks)
        landmarks_A.push_back(a.index), landmarks_B.push_back(b.index);
    visitor.fact("landmarks", fmt::format("{}", record.landmarks.size()));
    visitor.fact("landmarks given as points", fmt::format("{}", record.landmark_points.size()));
    visitor.fact("landmark weight", fmt::format("{}", record.landmark_weight));
    if (record.candidate > 0) visitor.fact("continues candidate", fmt::format("{}", record.candidate));
    visit_candidates(record.candidates, visitor);
    visit_confidence(record.candidates, visitor);
    visitor.array("landmarks_A", view(landmarks_A));
    visitor.array("landmarks_B", view(landmarks_B));
    visit_pairs("landmark_points", record.landmark_points, visitor);
}

void visit_solved(const SolvedPair& pair, ContentsVisitor& visitor) {
    visit_record(pair.record, visitor);
    visit_plan(pair.plan, visitor);
    visitor.text("trace.csv", trace_csv(pair.trace));
}

void visit(const Diffusion& diffusion, ContentsVisitor& visitor) {
    visit_solved(diffusion, visitor);
    visitor.array("image_vertex_A", view(diffusion.image_vertex_A));
    visitor.array("image_vertex_B", view(diffusion.image_vertex_B));
}

void visit(const Plan& plan, ContentsVisitor& visitor) {
    visit_solved(plan, visitor);
    visitor.array("centre_A", view(plan.centre_A));
    visitor.array("centre_B", view(plan.centre_B));
}

std::string share_mapped(const PointMap& map) {
    std::size_t mapped = 0;
    for (const auto& point : map) mapped += point.face >= 0;
    return fmt::format("{} of {} vertices have an image", mapped, map.size());
}

void visit_untangling(const std::string& name, const UntanglingReport& report, ContentsVisitor& visitor) {
    visitor.fact(name + ", reversed triangles before and after untangling",
                 fmt::format("{}, {}", report.flipped_before, report.flipped_after));
    visitor.fact(name + ", strained parts tried and mapped anew",
                 fmt::format("{}, {}", report.parts_tried, report.parts_replaced));
    visitor.fact(name + ", mirrored parts", fmt::format("{}", report.mirrored_parts));
}

void visit(const SurfaceMap& map, ContentsVisitor& visitor) {
    visitor.fact("A_to_B", share_mapped(map.A_to_B));
    visitor.fact("B_to_A", share_mapped(map.B_to_A));
    visit_untangling("A_to_B", map.untangling.A_to_B, visitor);
    visit_untangling("B_to_A", map.untangling.B_to_A, visitor);
    visit_points("A_to_B", map.A_to_B, visitor);
    visit_points("B_to_A", map.B_to_A, visitor);
}

void visit(const PartRegion& region, ContentsVisitor& visitor) {
    visitor.fact("the part",
                 fmt::format("{} of {} faces of the whole", region.faces.size(), region.face_count));
    visitor.fact("the part is", region.part_is_source ? "the source" : "the target");
    visitor.fact("placed", share_mapped(region.placed));
    visitor.fact("strain", fmt::format("{:.3f}", region.strain));
    visitor.array("faces", view(region.faces));
    visit_points("placed", region.placed, visitor);
}

void visit(const QualityNumbers& quality, ContentsVisitor& visitor) {
    visitor.text("quality.json", quality.json);
}

void visit(const Stamp& stamp, ContentsVisitor& visitor) {
    visitor.fact("for --if-stale", "what these files beside it were made from; by their content's hash");
    for (const StampedFile& file : stamp.files) visitor.fact(file.name, file.hash);
}

struct Kind {
    int schema;
    const char* stage;
    void (*show)(const std::string& payload, ContentsVisitor& visitor);
};

template <class T>
void show(const std::string& payload, ContentsVisitor& visitor) {
    T value;
    decode(payload, value);
    visit(value, visitor);
}

template <class T>
std::pair<const std::string, Kind> kind_of() {
    using Type = ArtifactType<T>;
    return {Type::kind, {Type::schema, Type::stage, &show<T>}};
}

const std::map<std::string, Kind>& kinds() {
    static const std::map<std::string, Kind> table{
        kind_of<Surface>(),        kind_of<Domain>(),    kind_of<Basis>(), kind_of<Hierarchy>(),
        kind_of<Candidates>(),     kind_of<Diffusion>(), kind_of<Plan>(),  kind_of<SurfaceMap>(),
        kind_of<QualityNumbers>(), kind_of<PartRegion>()};
    return table;
}

}  // namespace

Eigen::Index ArrayView::size() const {
    Eigen::Index product = 1;
    for (const auto extent : shape) product *= extent;
    return product;
}

void visit_artifact(const std::string& path, ContentsVisitor& visitor) {
    const std::string kind = read_header(path).kind;
    if (kind == stamp_kind) return visit(read_stamp(path), visitor);
    const auto found = kinds().find(kind);
    if (found == kinds().end())
        throw ArtifactError("'" + path + "' is a " + kind + ", which this version of varimap does not know");
    const Kind& entry = found->second;
    entry.show(read_payload(path, kind, entry.schema, entry.stage).second, visitor);
}

}  // namespace varimap
