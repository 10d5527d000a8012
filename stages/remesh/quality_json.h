#pragma once

#include <string>

#include "stages/remesh/map_quality.h"
#include "varimap/results/solved_pair.h"
#include "varimap/results/surface_map.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The part of quality.json that depends on the inputs and parameters alone; finite numbers only. A is the
/// source, B the target; distances are in units of sqrt(area), shares and percentages as named.
///   energy            Eq. (3) at the end; absent if the plan has no trace
///   area_bound        the bound B the plan was solved with
///   mass_ratio        source, target: min and max of transported mass by mass over the plan's samples,
///                     within [1 / sqrt(B), sqrt(B)]
///   landmarks         distance of each landmark's image from its partner
///   landmark_surroundings
///                     of each landmark: distance, radius (definitions: quality.h), of the direction in which
///                     the distance is more times the radius
///   landmark_weight   W of soft landmarks, 1 where they are pinned (cost.h); absent without landmarks
///   landmark_checks   per landmark: distance, energy_fall_percent, contradicted
///                     (definitions: landmark_check.h)
///   exploration       where it chose the map: which candidate was continued, confident, margin, probability,
///                     doubt and decided_by in words, and the candidates: origin, energy, dirichlet_energy,
///                     relief_agreement, alignment, stretch, landmarks_missed, score, reversed_percent,
///                     moved_percent, turn_degrees, mirrored (definitions: candidate.h). Where the first was
///                     continued, probability, confident and doubt are those of the finished map;
///                     confident_when_found: before it was finished
///   source_to_target, target_to_source
///       flipped_count, flipped_area_percent, collapsed_count, area_ratio {p01, p05, p50, p95, p99},
///       within_area_bound, conformal_distortion {as area_ratio}, dirichlet_energy, coverage, and
///       uncovered         of each part: area_percent, vertex of the file     (definitions: quality.h)
///       when_closed       coverage and uncovered with the holes of the surface that is mapped closed;
///                         absent where it has none (map_quality.h)
///       verification      reversed_count, reversed_area_percent, cutting_count, branch_points,
///                         signed_area_ratio; degree between closed surfaces (definitions: verification.h)
///       untangling        flipped_before, flipped_area_percent_before, flipped_after,
///                         flipped_area_percent_after, global_steps, sweeps, parts_tried,
///                         parts_replaced, replaced_area_percent, mirrored_parts, gated_area_percent,
///                         disagreeing_before, disagreeing_after (definitions: untangling.h)
///       twist             of the most twisted tube: degrees, vertex of the file, area_percent; absent where
///                         none is twisted (definitions: twist.h)
///   round_trip        source -> target -> source: mean, p95
///   components        where a surface has several, of source and target, each: vertex of the file,
///                     area_percent, onto (the number of that in the other list, from 0; absent if it
///                     has no image), on_that_percent, taken_percent, has_partner (definitions: components.h)
///   initial_map       where one was given: mean, p50, p95, step (definitions: initial_map.h)
///   source, target    input_vertices, input_faces, vertices (of the preprocessed surface)
///   levels            of each: level, kind, samples_source, samples_target, iterations, energy
std::string quality_json(const MapQuality& quality, const SurfaceMap& map, const Surface& A, const Surface& B,
                         const SolvedPair& pair);

}  // namespace varimap
