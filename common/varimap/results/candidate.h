#pragma once

#include <string>
#include <vector>

namespace varimap {

/// What exploration says of one map.
struct Candidate {
    double diffusion_energy = 0;   ///< Eq. (3) on the last diffusion level, marginals exact
    double euclidean_energy = 0;   ///< Eq. (3) on the first Euclidean level, marginals exact
    double bending_agreement = 0;  ///< correlation of how far places and images stand out of the surface
    double score = 0;          ///< weighted log of both less the agreement; .01 more is about 1% more energy
    double reversed_mass = 0;  ///< share of the surfaces that the map reverses, on the last diffusion level
    double moved_mass = 0;     ///< share of A with another image than the best candidate gives it
    double turn = 0;  ///< degrees of the best rotation of A from those parts to what has their images
};

/// A mirrored map is no answer, however small its energy.
bool is_mirrored(const Candidate& candidate);

/// How sure the choice of the first candidate is among its rivals: those that are not mirrored and give more
/// than 5% of A another image.
struct Confidence {
    double margin = 0;         ///< score of the best rival, less the first's; 1 without a rival
    bool levels_agree = true;  ///< the first has a smaller energy than each rival on both levels
    bool confident = true;     ///< levels agree, and the margin is at least 0.015
};
Confidence confidence_of(const std::vector<Candidate>& candidates);

/// "turned by 170 degrees, 80% elsewhere": what a candidate is to the best one.
std::string relation(const Candidate& candidate);

}  // namespace varimap
