#include "stages/remesh/quality_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "varimap/core/log.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/quality/quality.h"
#include "varimap/verification/verification.h"

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

Json direction(const PointMap& map, const TriangleMesh& source, const Surface& onto, double area_bound) {
    const TriangleMesh& target = onto.input;
    const Distortion distortion = measure_distortion(map, source, target);
    const Coverage coverage = measure_coverage(map, source, target);
    return {{"flipped_count", distortion.flipped_count},
            {"flipped_area_percent", distortion.flipped_area_percent},
            {"collapsed_count", distortion.collapsed_count},
            {"area_ratio", to_json(distortion.area_ratio)},
            {"within_area_bound", share_within_area_bound(map, source, target, area_bound)},
            {"conformal_distortion", to_json(distortion.conformal_distortion)},
            {"dirichlet_energy", distortion.dirichlet_energy},
            {"coverage", coverage.share},
            {"uncovered", to_json(coverage.parts, onto.link)},
            {"verification", to_json(verify_map(map, source, target))}};
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

Json to_json(const std::vector<Candidate>& candidates, int continued, const InTheEnd& finished) {
    const auto of_first = continued == 1 ? std::optional(finished) : std::nullopt;
    const Confidence confidence = confidence_of(candidates, of_first);
    const bool confident_when_found = confidence_of(candidates).confident;
    if (confident_when_found && !confidence.confident)
        warn("the map is less sure than its candidate was ({}): look at the picture, {}or give landmarks",
             doubt(candidates, of_first), candidates.size() > 1 ? "try --candidate 2, " : "");
    Json list = Json::array();
    for (const Candidate& c : candidates)
        list.push_back({{"origin", origin(c)},
                        {"energy", c.energy},
                        {"dirichlet_energy", c.dirichlet},
                        {"relief_agreement", c.relief},
                        {"alignment", c.alignment},
                        {"stretch", c.stretch},
                        {"score", c.score},
                        {"reversed_percent", 100 * c.reversed_mass},
                        {"moved_percent", 100 * c.moved_mass},
                        {"turn_degrees", c.turn},
                        {"mirrored", is_mirrored(c)}});
    return {{"continued", continued},
            {"confident", confidence.confident},
            {"confident_when_found", confident_when_found},
            {"margin", confidence.margin},
            {"probability", confidence.probability},
            {"doubt", doubt(candidates, of_first)},
            {"decided_by", decided_by(candidates)},
            {"candidates", list}};
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

/// JSON has no infinities: members that are not finite are left out rather than written as null.
void remove_not_finite(Json& json) {
    if (!json.is_structured()) return;
    for (auto member = json.begin(); member != json.end();) {
        remove_not_finite(*member);
        const bool keep = !member->is_number_float() || std::isfinite(member->get<double>());
        member = keep ? std::next(member) : json.erase(member);
    }
}

/// Geometric mean of the directions.
double dirichlet_of_both(const Json& quality) {
    const double there = quality["source_to_target"]["dirichlet_energy"],
                 back = quality["target_to_source"]["dirichlet_energy"];
    return std::sqrt(there * back);
}

InTheEnd in_the_end(const Json& quality) {
    const double there = quality["source_to_target"]["coverage"],
                 back = quality["target_to_source"]["coverage"];
    return {dirichlet_of_both(quality), std::min(there, back)};
}

/// Of half its area a mesh's faces are no rounder than this: height over the longest side, by that side.
double median_thinness(const TriangleMesh& mesh) {
    std::vector<double> heights, areas;
    for (int f = 0; f < mesh.face_count(); ++f) {
        heights.push_back(thinness(mesh, f));
        areas.push_back(face_normal(mesh, f).norm() / 2);
    }
    return weighted_quantile(heights, areas, 0.5);
}

/// Distortion is measured on the input's faces: one much longer than high is sheared by the least shift of a
/// corner along it. Says so where such faces have half of a surface's area or more; else empty.
std::string slivers_in_words(const Surface& A, const Surface& B) {
    constexpr double sliver = 0.05;
    const bool source = median_thinness(A.input) < sliver, target = median_thinness(B.input) < sliver;
    if (!source && !target) return "";
    return fmt::format(
        "The likely cause: most of the area of {} lies on slivers (faces of a height below {} of their "
        "length), which the least shift shears; mesh {} with rounder faces",
        source && target ? "both surfaces" : (source ? "the source" : "the target"), sliver,
        source && target ? "them" : "it");
}

/// Whether it does. Good maps of whole surfaces have less than .5% reversed and more than 95% covered, those
/// of skulls with their insides 87%. The upper half of a person on a whole one has 8% reversed.
bool warn_of_tears(const Json& direction, const char* which, const std::string& slivers) {
    constexpr double much_reversed = 2, little_covered = 0.8;
    const double reversed = direction["verification"]["reversed_area_percent"],
                 covered = direction["coverage"];
    if (reversed <= much_reversed && covered >= little_covered) return false;
    warn("{}: the map tears: {:.1f}% of the area is reversed, {:.1f}% of the other surface covered. {}",
         which, reversed, 100 * covered,
         !slivers.empty() ? slivers
                          : "Is one a part of the other, or do they have different parts? Look at the "
                            "picture, give landmarks");
    return true;
}

/// Right maps between whole surfaces of the known pairs have 1.32 at most, four-legged animals of other
/// species among them; of halves that were closed with a lid on wholes, which may not tear, 2.1 to 2.5.
/// Skulls with their insides have 2.3, and tear.
void warn_of_strain(double dirichlet, const std::string& slivers) {
    constexpr double strained = 1.6;
    if (dirichlet > strained)
        warn("the map is strained more than right maps are (a Dirichlet energy of {:.2f}). {}", dirichlet,
             !slivers.empty() ? slivers
                              : "Is one surface a part of the other, or is this the wrong map? Look at the "
                                "picture");
}

/// Times the radius of a landmark's surroundings on the source.
double times_radius(const LandmarkSurroundings& around) {
    return around.radius > 0 ? around.distance / around.radius : 0;
}

struct SurroundingsOfBoth {
    std::vector<LandmarkSurroundings> worse;     ///< of each landmark, where they are farther off
    std::vector<std::pair<int, int>> exchanged;  ///< landmarks that look so in either direction
};

SurroundingsOfBoth surroundings_of_both(const PointMap& A_to_B, const PointMap& B_to_A,
                                        const PointPairs& landmarks, const Surface& A, const Surface& B) {
    const PointPairs from_B = swapped(landmarks);
    const auto there = landmark_surroundings(A_to_B, landmarks, A.input, B.input),
               back = landmark_surroundings(B_to_A, from_B, B.input, A.input);
    SurroundingsOfBoth both{there, exchanged_landmarks(there, landmarks, B.input)};
    for (std::size_t k = 0; k < there.size(); ++k)
        if (times_radius(back[k]) > times_radius(there[k])) both.worse[k] = back[k];
    for (const auto& pair : exchanged_landmarks(back, from_B, A.input)) both.exchanged.push_back(pair);
    std::sort(both.exchanged.begin(), both.exchanged.end());
    both.exchanged.erase(std::unique(both.exchanged.begin(), both.exchanged.end()), both.exchanged.end());
    return both;
}

Json to_json(const std::vector<LandmarkSurroundings>& surroundings) {
    Json list = Json::array();
    for (const LandmarkSurroundings& around : surroundings)
        list.push_back({{"distance", around.distance}, {"radius", around.radius}});
    return list;
}

/// Landmarks that a warning is about, as it counts them from 1.
struct NamedLandmarks {
    std::vector<int> numbers;
    double farthest = 0;  ///< of them; sqrt(area)

    void add(int number, double distance) {
        numbers.push_back(number);
        farthest = std::max(farthest, distance);
    }
    bool is_one() const { return numbers.size() == 1; }
};

/// The first few, and how many more there are.
std::string list_in_words(std::vector<std::string> names) {
    constexpr std::size_t most = 10;
    if (names.size() > most) {
        const std::size_t more = names.size() - most;
        names.resize(most);
        names.push_back(fmt::format("{} more", more));
    }
    const std::string last = names.back();
    names.pop_back();
    return names.empty() ? last : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

/// "landmark 3", "landmarks 3, 4 and 9".
std::string in_words(const NamedLandmarks& landmarks) {
    std::vector<std::string> names;
    for (const int number : landmarks.numbers) names.push_back(std::to_string(number));
    return (landmarks.is_one() ? "landmark " : "landmarks ") + list_in_words(std::move(names));
}

void warn_of_missed(const NamedLandmarks& missed) {
    if (missed.is_one())
        warn(
            "{} is not met: its image is off by {:.2f} sqrt(area). Is it right? Look at the picture, and at "
            "the landmarks around it",
            in_words(missed), missed.farthest);
    else if (!missed.numbers.empty())
        warn(
            "{} are not met: their images are off by up to {:.2f} sqrt(area). Are they right? Look at the "
            "picture, and at the landmarks around them",
            in_words(missed), missed.farthest);
}

void warn_of_spikes(const NamedLandmarks& spikes) {
    if (spikes.is_one())
        warn(
            "around {} the map is elsewhere: it is met alone, and its surroundings are off by {:.2f} "
            "sqrt(area). Is it right? Look at the picture; if it is, give more landmarks there, or "
            "--landmark-vicinity 4",
            in_words(spikes), spikes.farthest);
    else if (!spikes.numbers.empty())
        warn(
            "around {} the map is elsewhere: they are met alone, and their surroundings are off by up to "
            "{:.2f} sqrt(area). Are they right? Look at the picture; if they are, give more landmarks there, "
            "or --landmark-vicinity 4",
            in_words(spikes), spikes.farthest);
}

void warn_of_exchanged(const std::vector<std::pair<int, int>>& exchanged) {
    if (exchanged.empty()) return;
    const char* joined = exchanged.size() == 1 ? "and" : "with";
    std::vector<std::string> names;
    for (const auto& [i, j] : exchanged) names.push_back(fmt::format("{} {} {}", i + 1, joined, j + 1));
    warn("landmarks {} look exchanged: each one's surroundings go to the other's partner",
         list_in_words(std::move(names)));
}

/// A row too many or too few in one of two lists puts all behind it off. Where the lists are shifted, some
/// may look exchanged by chance; that some were exchanged is no sign of a shift.
void warn_of_shift(const std::vector<char>& is_off, const std::vector<char>& is_exchanged) {
    constexpr int least = 4;
    int count = 0;
    std::size_t first = is_off.size();
    while (first > 0 && (is_off[first - 1] || is_exchanged[first - 1]))
        if (!is_exchanged[--first]) ++count;
    if (count >= least)
        warn("all landmarks from {} on, to the last one, are off: is the list one row off?", first + 1);
}

/// Pinned landmarks that the map does not meet, or meets with a spike. Those between vertices are drawn, not
/// held: by .01 they are off at most where nothing contradicts them. Of the 142 right landmarks of the
/// known pairs 101 are within the radius, and all but 7 within 4 times; these 7, on animals of other species,
/// are parts that the map takes elsewhere.
void warn_of_landmarks(const std::vector<double>& residuals, const SurroundingsOfBoth& surroundings) {
    constexpr double missed = 0.02, elsewhere = 0.02, times = 4;
    std::vector<char> is_exchanged(residuals.size(), 0), is_off(residuals.size(), 0);
    for (const auto& [i, j] : surroundings.exchanged)
        is_exchanged[std::size_t(i)] = is_exchanged[std::size_t(j)] = 1;
    NamedLandmarks not_met, spikes;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        const LandmarkSurroundings& around = surroundings.worse[k];
        const bool is_missed = residuals[k] > missed;
        const bool is_spike =
            !is_missed && !is_exchanged[k] && around.distance > elsewhere && times_radius(around) > times;
        if (is_missed) not_met.add(int(k) + 1, residuals[k]);
        if (is_spike) spikes.add(int(k) + 1, around.distance);
        is_off[k] = is_missed || is_spike;
    }
    warn_of_missed(not_met);
    warn_of_exchanged(surroundings.exchanged);
    warn_of_spikes(spikes);
    warn_of_shift(is_off, is_exchanged);
}

}  // namespace

std::string quality_json(const SurfaceMap& map, const Surface& A, const Surface& B, const SolvedPair& pair) {
    const PointMap A_to_B = from_file(map.A_to_B, A, B), B_to_A = from_file(map.B_to_A, B, A);
    const SamplePlan& plan = pair.plan;
    const PairRecord& record = pair.record;
    Json quality;
    if (!pair.trace.empty()) quality["energy"] = pair.trace.back().energy;
    quality["area_bound"] = plan.area_bound;
    quality["mass_ratio"] = {{"source", mass_ratios(plan.transported_A, plan.mass_A)},
                             {"target", mass_ratios(plan.transported_B, plan.mass_B)}};
    const PointPairs landmarks = landmarks_on_inputs(record, A, B);
    const std::vector<double> residuals = landmark_residuals(A_to_B, landmarks, A.input, B.input);
    quality["landmarks"] = residuals;
    if (!landmarks.empty()) {
        const auto surroundings = surroundings_of_both(A_to_B, B_to_A, landmarks, A, B);
        quality["landmark_surroundings"] = to_json(surroundings.worse);
        if (record.pins_landmarks()) warn_of_landmarks(residuals, surroundings);
    }
    if (!record.landmarks.empty()) quality["landmark_weight"] = record.landmark_weight;
    if (!record.landmark_checks.empty()) quality["landmark_checks"] = to_json(record.landmark_checks);
    quality["source_to_target"] = direction(A_to_B, without_added_faces(A), B, plan.area_bound);
    quality["target_to_source"] = direction(B_to_A, without_added_faces(B), A, plan.area_bound);
    if (!record.candidates.empty())
        quality["exploration"] = to_json(record.candidates, record.candidate, in_the_end(quality));
    quality["source_to_target"]["untangling"] = to_json(map.untangling.A_to_B);
    quality["target_to_source"]["untangling"] = to_json(map.untangling.B_to_A);
    const std::string slivers = slivers_in_words(A, B);
    const bool tears_there = warn_of_tears(quality["source_to_target"], "source to target", slivers),
               tears_back = warn_of_tears(quality["target_to_source"], "target to source", slivers);
    if (!tears_there && !tears_back) warn_of_strain(dirichlet_of_both(quality), slivers);
    const RoundTrip round_trip = measure_round_trip(A_to_B, B_to_A, A.input, B.input);
    quality["round_trip"] = {{"mean", round_trip.mean}, {"p95", round_trip.p95}};
    quality["source"] = sizes(A);
    quality["target"] = sizes(B);
    quality["levels"] = levels(pair.trace);
    remove_not_finite(quality);
    return quality.dump(2);
}

}  // namespace varimap
