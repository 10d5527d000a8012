#pragma once

#include <optional>
#include <string>
#include <vector>

#include "varimap/results/candidate.h"

namespace varimap {

/// Whether the surfaces fit better as mirror images of each other: probably one is a left and the other a
/// right one.
bool fits_mirrored(const Candidate& best);

/// Whether a map reverses more of the surfaces than right ones do, about a seventh.
bool reverses_much(const Candidate& candidate);

/// How probable it is that a map of that quality is right at all, if it is the best of those found.
double plausibility(const Candidate& candidate);

/// How sure the choice of the first candidate is among its rivals: those that are not mirrored and give more
/// than 5% of A another image.
struct Confidence {
    double margin = 0;       ///< score of the best rival, less the first's; 10 at most, and without a rival
    double probability = 0;  ///< that the first is right
    bool confident = false;  ///< the probability is at least 0.9
};

/// What the first candidate has become, continued to the end.
struct FinishedQuality {
    double dirichlet = 1;  ///< Dirichlet energy (quality.h), geometric mean of both directions
    double coverage = 1;   ///< the lesser of both directions
    double twist = 0;      ///< degrees, of the most twisted tube (quality/twist.h), the larger of both
    /// One of the surfaces is inside out (surface.h), so that left and right are exchanged unless it is a
    /// mirror image of the other.
    bool inside_out = false;
    /// Components of both lie on others than their partners (quality/components.h).
    bool components_astray = false;
    /// One of the surfaces has many handles, as scans of bones have: its walls tear in any map, whose energy
    /// then tells nothing.
    bool many_handles = false;
};
/// From so many degrees on a tube that is twisted by a map makes it doubtful. Of 153 right maps between
/// people and between animals, both ways, none is found twisted by more than 87.
inline constexpr double doubtful_twist = 120;

Confidence confidence_of(const std::vector<Candidate>& candidates,
                         std::optional<FinishedQuality> finished = {});

/// "right with a probability of 0.91", or "below 0.01" or "above 0.99": a rounded 0 would call it impossible,
/// a rounded 1 certain.
std::string probability_in_words(const Confidence& confidence);

/// Why the choice is not sure, in words; for a choice that is, "".
std::string doubt(const std::vector<Candidate>& candidates, std::optional<FinishedQuality> finished = {});

/// Which cue put the first before its best rival, in words: "relief and stretch", "alignment, against
/// relief", ...; without a rival, "".
std::string decided_by(const std::vector<Candidate>& candidates);

}  // namespace varimap
