#include "stages/remesh/quality_json.h"

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace varimap {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Quantiles& q) {
    return {{"p01", q.p01}, {"p05", q.p05}, {"p50", q.p50}, {"p95", q.p95}, {"p99", q.p99}};
}

Json to_json(const Verification& found) {
    Json json = {{"reversed_count", found.reversed_faces.size()},
                 {"reversed_area_percent", found.reversed_area_percent},
                 {"cutting_count", found.cutting_count},
                 {"branch_points", found.branch_vertices.size()},
                 {"signed_area_ratio", found.signed_area_ratio}};
    if (found.degree) json["degree"] = *found.degree;
    return json;
}

Json to_json(const UntanglingReport& report) {
    return {{"flipped_before", report.flipped_before},
            {"flipped_area_percent_before", report.flipped_area_percent_before},
            {"flipped_after", report.flipped_after},
            {"flipped_area_percent_after", report.flipped_area_percent_after},
            {"global_steps", report.global_steps},
            {"sweeps", report.sweeps},
            {"parts_tried", report.parts_tried},
            {"parts_replaced", report.parts_replaced},
            {"replaced_area_percent", report.replaced_area_percent},
            {"mirrored_parts", report.mirrored_parts},
            {"gated_area_percent", report.gated_area_percent},
            {"disagreeing_before", report.disagreeing_before},
            {"disagreeing_after", report.disagreeing_after}};
}

/// `link`: to the target's file.
Json to_json(const std::vector<UncoveredPart>& parts, const FileLink& link) {
    Json list = Json::array();
    for (const UncoveredPart& part : parts)
        list.push_back({{"area_percent", 100 * part.share}, {"vertex", number_in_file(part.vertex, link)}});
    return list;
}

/// `onto`: the surface that the direction leads to.
Json to_json(const MeasuredDirection& quality, const UntanglingReport& untangling, const Surface& onto) {
    const Distortion& distortion = quality.distortion;
    Json json = {{"flipped_count", distortion.flipped_count},
                 {"flipped_area_percent", distortion.flipped_area_percent},
                 {"collapsed_count", distortion.collapsed_count},
                 {"area_ratio", to_json(distortion.area_ratio)},
                 {"within_area_bound", quality.within_area_bound},
                 {"conformal_distortion", to_json(distortion.conformal_distortion)},
                 {"dirichlet_energy", distortion.dirichlet_energy},
                 {"coverage", quality.coverage.share},
                 {"uncovered", to_json(quality.coverage.parts, onto.link)},
                 {"verification", to_json(quality.verification)},
                 {"untangling", to_json(untangling)}};
    if (const Twist& twist = quality.twist; twist.vertex >= 0)
        json["twist"] = {
            {"degrees", twist.degrees}, {"vertex", twist.vertex}, {"area_percent", 100 * twist.area}};
    if (quality.when_closed)
        json["when_closed"] = {{"coverage", quality.when_closed->share},
                               {"uncovered", to_json(quality.when_closed->parts, onto.link)}};
    return json;
}

Json to_json(const InitialMapQuality& q) {
    return {{"mean", q.mean}, {"p50", q.p50}, {"p95", q.p95}, {"step", q.step}};
}

/// Extremes of the transported masses in units of the surface's own.
Json mass_ratios(const Eigen::VectorXd& transported, const Eigen::VectorXd& mass) {
    const Eigen::ArrayXd ratio = transported.array() / mass.array();
    return {{"min", ratio.minCoeff()}, {"max", ratio.maxCoeff()}};
}

Json sizes(const Surface& surface) {
    const TriangleMesh& file = file_of(surface);
    return {{"input_vertices", file.vertex_count()},
            {"input_faces", file.face_count()},
            {"vertices", surface.mesh.vertex_count()}};
}

Json levels(const Trace& trace) {
    Json list = Json::array();
    for (const TraceRow& row : trace) {
        if (list.empty() || list.back()["level"] != row.level)
            list.push_back({{"level", row.level},
                            {"kind", row.euclidean ? "euclidean" : "diffusion"},
                            {"samples_source", row.samples_A},
                            {"samples_target", row.samples_B},
                            {"iterations", 0},
                            {"energy", 0.0}});
        Json& level = list.back();
        level["iterations"] = level["iterations"].get<int>() + 1;
        level["energy"] = row.energy;
    }
    return list;
}

Json to_json(const std::vector<Candidate>& candidates) {
    Json list = Json::array();
    for (const Candidate& c : candidates)
        list.push_back({{"origin", origin(c)},
                        {"energy", c.energy},
                        {"dirichlet_energy", c.dirichlet},
                        {"relief_agreement", c.relief},
                        {"alignment", c.alignment},
                        {"stretch", c.stretch},
                        {"landmarks_missed", c.landmarks_missed},
                        {"score", c.score},
                        {"reversed_percent", 100 * c.reversed_mass},
                        {"moved_percent", 100 * c.moved_mass},
                        {"turn_degrees", c.turn},
                        {"mirrored", is_mirrored(c)}});
    return list;
}

Json to_json(const ChoiceQuality& choice, const PairRecord& record) {
    return {{"continued", record.candidate},
            {"confident", choice.finished.confident},
            {"confident_when_found", choice.when_found.confident},
            {"margin", choice.finished.margin},
            {"probability", choice.finished.probability},
            {"doubt", choice.doubt},
            {"decided_by", decided_by(record.candidates)},
            {"candidates", to_json(record.candidates)}};
}

Json to_json(const std::vector<LandmarkCheck>& checks) {
    const int contradicted = contradicted_landmark(checks);
    Json list = Json::array();
    for (const LandmarkCheck& check : checks)
        list.push_back({{"distance", check.distance},
                        {"energy_fall_percent", 100 * check.energy_fall},
                        {"contradicted", int(list.size()) == contradicted}});
    return list;
}

Json to_json(const std::vector<LandmarkSurroundings>& surroundings) {
    Json list = Json::array();
    for (const LandmarkSurroundings& around : surroundings)
        list.push_back({{"distance", around.distance}, {"radius", around.radius}});
    return list;
}

Json to_json(const std::vector<ComponentImage>& components) {
    Json list = Json::array();
    for (const ComponentImage& one : components) {
        list.push_back({{"vertex", one.vertex},
                        {"area_percent", 100 * one.area},
                        {"on_that_percent", 100 * one.on_that},
                        {"taken_percent", 100 * one.taken},
                        {"has_partner", one.has_partner()}});
        if (one.onto >= 0) list.back()["onto"] = one.onto;
    }
    return list;
}

/// JSON has no infinities: members that are not finite are left out rather than written as null. In lists,
/// where one stands for a landmark, they are null.
void remove_not_finite(Json& json) {
    if (!json.is_structured()) return;
    for (auto member = json.begin(); member != json.end();) {
        remove_not_finite(*member);
        const bool keep =
            json.is_array() || !member->is_number_float() || std::isfinite(member->get<double>());
        member = keep ? std::next(member) : json.erase(member);
    }
}

}  // namespace

std::string quality_json(const MapQuality& quality, const SurfaceMap& map, const Surface& A, const Surface& B,
                         const SolvedPair& pair) {
    const SamplePlan& plan = pair.plan;
    const PairRecord& record = pair.record;
    Json json;
    if (!pair.trace.empty()) json["energy"] = pair.trace.back().energy;
    json["area_bound"] = plan.area_bound;
    json["mass_ratio"] = {{"source", mass_ratios(plan.transported_A, plan.mass_A)},
                          {"target", mass_ratios(plan.transported_B, plan.mass_B)}};
    const LandmarkQuality& landmarks = quality.landmarks;
    json["landmarks"] = landmarks.residuals;
    if (!landmarks.surroundings.empty()) json["landmark_surroundings"] = to_json(landmarks.surroundings);
    if (!record.landmarks.empty()) json["landmark_weight"] = record.landmark_weight;
    if (!record.landmark_checks.empty()) json["landmark_checks"] = to_json(record.landmark_checks);
    json["source_to_target"] = to_json(quality.A_to_B, map.untangling.A_to_B, B);
    json["target_to_source"] = to_json(quality.B_to_A, map.untangling.B_to_A, A);
    if (quality.choice) json["exploration"] = to_json(*quality.choice, record);
    json["round_trip"] = {{"mean", quality.round_trip.mean}, {"p95", quality.round_trip.p95}};
    if (const ComponentImages& components = quality.components; components.are_several())
        json["components"] = {{"source", to_json(components.of_source)},
                              {"target", to_json(components.of_target)}};
    if (quality.initial_map) json["initial_map"] = to_json(*quality.initial_map);
    json["source"] = sizes(A);
    json["target"] = sizes(B);
    json["levels"] = levels(pair.trace);
    remove_not_finite(json);
    return json.dump(2);
}

}  // namespace varimap
