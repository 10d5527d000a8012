#include "varimap/parts/part_replacement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "varimap/core/timing.h"
#include "varimap/mesh/mass.h"
#include "varimap/parts/continuation.h"
#include "varimap/parts/continuation_scale.h"
#include "varimap/sliding/inverse_map.h"

namespace varimap {

namespace {

constexpr double largest_part = 0.45;  ///< share of the area; more has no surroundings to continue from
/// Area of the widened part / area of the strained one: where a limb is turned, the strain spreads along it.
/// Widened by 10, too, 13 pairs end with the same errors and folds, for a fifth more time. By 2.5 alone a
/// mirrored cap stays.
constexpr std::array<double, 2> widenings{1.6, 4};
/// Of the energy to beat: where no proposal comes as near, a part is not widened further. Measured on six
/// pairs: of 27 parts for which a wider one was mapped anew, 26 had come within 1.35.
constexpr double within_reach = 1.4;
/// Of the other direction, which may be wrong where a part is to be mapped anew.
constexpr double doubt = 0.1;
constexpr double noticeable = 0.03;  ///< difference of scales

}  // namespace

PartReplacement::PartReplacement(SlidingMap& map, const VertexData<bool>& fixed,
                                 const PartReplacementOptions& options,
                                 const std::vector<SoftConstraint>& landmarks)
    : map_(map),
      options_(options),
      edges_(find_edges(map.source())),
      source_graph_(map.source()),
      target_graph_(map.target()),
      cells_(map, target_graph_, usual_cell_radius(map)),
      context_{map, fixed, cells_, {}, landmarks, options.rules, count_used_vertices(map.source())},
      rejected_(map.source().face_count()) {}

double PartReplacement::try_part(const OpenPart& part, const Proposals& proposals) {
    PartTrial trial(context_, part);
    trial.set_standard();
    for (const Proposal& propose : proposals(part.open)) {
        visits_ += double(std::count(part.open.begin(), part.open.end(), 1));
        if (!trial.run(propose)) continue;
        ++report_.replaced;
        report_.area_percent += 100 * part.area;
        return 0;
    }
    return trial.nearest();
}

bool PartReplacement::replace_part(const std::vector<int>& part, const Proposals& proposals) {
    double tried = 0;
    for (const double widening : widenings) {
        const OpenPart open(map_, widened(map_, edges_, part, widening * area_of(map_, part)),
                            context_.fixed);
        if (open.area > largest_part) return false;
        if (open.area <= tried) continue;  // what it cuts off made it as large before
        tried = open.area;
        const double nearest = try_part(open, proposals);
        if (nearest == 0) return true;
        if (nearest > within_reach) return false;
    }
    return false;
}

void PartReplacement::replace_parts(const Proposals& proposals) {
    const double most_visits = options_.most_visits * context_.vertices;
    visits_ = 0;
    for (int round = 0; round < options_.rounds; ++round) {
        bool changed = false;
        for (const auto& part : strained_parts(map_, edges_, rejected_, options_.strain)) {
            if (visits_ > most_visits) return;
            ++report_.tried;
            const bool replaced = replace_part(part, proposals);
            for (const int f : part) rejected_[f] = !replaced;
            changed = changed || replaced;
        }
        if (!changed) return;
    }
}

void PartReplacement::judge_by(const PointMap& back, double weight) {
    context_.constraints = inverse_constraints(map_, back, weight);
    context_.constraints.insert(context_.constraints.end(), context_.landmarks.begin(),
                                context_.landmarks.end());
}

void PartReplacement::continue_surroundings(const PointMap& back) {
    const Timer timer("parts, in all");
    judge_by(back, doubt * options_.inverse_weight);
    const auto at_scale = [&](double scale) {
        return [&, scale](const VertexData<bool>& open) { continue_map(map_, open, scale); };
    };
    replace_parts([&](const VertexData<bool>& part) {
        const double scale = continuation_scale(map_, part, source_graph_, target_graph_);
        std::vector<Proposal> proposals;
        if (std::abs(scale - 1) > noticeable) proposals.push_back(at_scale(scale));
        proposals.push_back(at_scale(1));
        return proposals;
    });
}

void PartReplacement::adopt_inverse(const PointMap& back, bool whole) {
    const Timer timer("parts, in all");
    judge_by(back, options_.inverse_weight);
    context_.rules.untwist = false;
    InverseMap inverse_of_back(map_, back);
    const auto invert = [&](const VertexData<bool>& open) { inverse_of_back.place(map_, open); };
    const Proposals inverse = [&](const VertexData<bool>&) { return std::vector<Proposal>{invert}; };
    std::fill(rejected_.begin(), rejected_.end(), 0);
    if (whole) try_part(OpenPart(map_, FaceData<bool>(rejected_.size(), true), context_.fixed), inverse);
    replace_parts(inverse);
}

}  // namespace varimap
