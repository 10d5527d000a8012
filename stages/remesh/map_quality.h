#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stages/remesh/initial_map.h"
#include "varimap/quality/components.h"
#include "varimap/quality/quality.h"
#include "varimap/quality/twist.h"
#include "varimap/results/choice.h"
#include "varimap/results/solved_pair.h"
#include "varimap/results/surface_map.h"
#include "varimap/surface/surface.h"
#include "varimap/verification/verification.h"

namespace varimap {

/// How good one direction of a map is, measured on the inputs. Faces that a repair added to the source do not
/// count; nor, in distortion and verification, do triangles with an image on one that it added to the target.
struct MeasuredDirection {
    Distortion distortion;
    double within_area_bound = 0;  ///< share_within_area_bound (quality.h), of the plan's bound
    Coverage coverage;
    /// The same of what the target has in its file, with the source's holes closed (holes.h): those that were
    /// filled, and those that are open, unless a loop is sqrt(area) long or more, as the rim of a sheet is.
    /// None where the source has no such holes, or several components, which tubes join.
    std::optional<Coverage> when_closed;
    Verification verification;
    Twist twist;  ///< its vertex by the number in the file

    /// What the map can be blamed for: what the source's holes lack it cannot reach.
    const Coverage& reached() const { return when_closed ? *when_closed : coverage; }
};

/// What becomes of landmarks (landmarks_on_inputs); lists have one entry per landmark, in order.
struct LandmarkQuality {
    std::vector<double> residuals;  ///< landmark_residuals (quality.h) of A to B
    /// Of the direction in which they are more times the radius off.
    std::vector<LandmarkSurroundings> surroundings;
    /// exchanged_landmarks (quality.h) of either direction, as indices; ascending, none twice.
    std::vector<std::pair<int, int>> exchanged;
};

/// How far off a landmark's surroundings are, in units of their radius; 0 where there are none.
double times_radius(const LandmarkSurroundings& around);

/// How sure exploration's choice of a candidate is.
struct ChoiceQuality {
    Confidence when_found;  ///< before the map was finished
    Confidence finished;    ///< the same unless the first candidate was continued
    std::string doubt;      ///< why the latter is not sure (candidate.h)
};

/// How good a map between two surfaces is.
struct MapQuality {
    MeasuredDirection A_to_B, B_to_A;
    FinishedQuality in_the_end;                    ///< of both directions together
    RoundTrip round_trip;                          ///< A to B to A
    ComponentImages components;                    ///< their vertices by the numbers in the files
    LandmarkQuality landmarks;                     ///< empty without landmarks
    std::optional<ChoiceQuality> choice;           ///< where exploration chose the map
    std::optional<InitialMapQuality> initial_map;  ///< where one was given
    /// Of half its input's area, faces are no rounder than this: thinness (thin_faces.h).
    double median_thinness_A = 0, median_thinness_B = 0;
};

/// `map` between the files of A and B; `pair`: what it was made from, `initial_map`: what it was begun from,
/// between the files too, or empty. The same for any number of threads.
MapQuality measure_quality(const SurfaceMap& map, const Surface& A, const Surface& B, const SolvedPair& pair,
                           const PointMap& initial_map = {});

}  // namespace varimap
