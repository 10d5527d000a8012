#pragma once

#include <string>

namespace varimap {

/// What exploration says of one map, which it has finished at low resolution.
struct Candidate {
    int explored = 0;          ///< which of the maps found, from 1; 0: that which landmarks lead to
    int self_map_A = 0;        ///< the self-map of A that goes before it (from 1), or 0
    int self_map_B = 0;        ///< the self-map of B that follows it, or 0
    double energy = 0;         ///< Eq. (3) of the plan on all vertices
    double dirichlet = 1;      ///< Dirichlet energy (quality.h), geometric mean of both directions
    double relief = 0;         ///< how well relief agrees, a correlation (stages/explore/shape_agreement.h)
    double alignment = 0;      ///< how well patches can be laid onto their images, 1 at best (the same)
    double stretch = 0;        ///< how much distances along the surfaces change, 0 at best (the same)
    int landmarks_missed = 0;  ///< landmarks all around which it is elsewhere, so that it meets them alone
    double score = 0;          ///< score_of
    double reversed_mass = 0;  ///< share of the surfaces that the map reverses
    double moved_mass = 0;     ///< share of A with another image than the best candidate gives it
    /// Found between A and the mirror image of B, and mirrored back by a map of one of them onto its own
    /// mirror image, which the number of its self-map counts.
    bool mirrored_back = false;
    bool turned_about_axis = false;  ///< and then turned about an axis of one of the surfaces
    bool turned_by_half = false;  ///< and then by a half about a principal axis of B, however unlike that is
    /// Its score on sketches, less that of the best map between A and the mirror image of B, if that is
    /// better; 0 where it was not looked for.
    double mirror_gain = 0;
    double turn = 0;  ///< degrees of the best rotation of A from those parts to what has their images
};

/// 120 stretch - 25 alignment - 20 relief + 3 log dirichlet, and more: minus the logarithm of how probable a
/// map is, up to a constant, so that of two candidates that with a score less by 3 is 20 times as probable.
/// None of these cues tells the right map from a wrong one everywhere: of bodies turned front to back
/// distances say little and alignment much; of limbs exchanged, often the converse. Strain counts where
/// symmetry makes the others alike, and landmarks are on the wrong side. The plan's energy tells no more than
/// these. The weights are half of those fitted (stages/explore/README.md), for pairs that are unlike the
/// fitted ones. And 5 for each landmark that it misses, where these are several: one may be wrong, but hardly
/// several of them.
double score_of(const Candidate& candidate);
/// Its five terms.
struct ScoreParts {
    double stretch, alignment, relief, strain, landmarks;
};
ScoreParts score_parts(const Candidate& candidate);

/// Logarithm of the Dirichlet energy, 0 at least.
double strain(const Candidate& candidate);

/// A mirrored map is no answer, however small its energy.
bool is_mirrored(const Candidate& candidate);

/// "80% of the surface elsewhere, turned by 170 degrees": what a candidate is to the best one.
std::string relation(const Candidate& candidate);

/// "map 1, then self-map 2 of the target": where a candidate comes from.
std::string origin(const Candidate& candidate);

}  // namespace varimap
