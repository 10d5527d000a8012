#pragma once

#include "varimap/mesh/serialization.h"
#include "varimap/results/solved_pair.h"

/// What cereal writes of the parts that several artifacts share.
namespace varimap {

template <class Archive>
void serialize(Archive& archive, MeshVertex& vertex) {
    archive(vertex.index);
}

template <class Archive>
void serialize(Archive& archive, TraceRow& row) {
    archive(row.level, row.euclidean, row.iteration, row.samples_A, row.samples_B, row.sinkhorn_iterations,
            row.entries, row.gamma, row.energy, row.marginal_error);
}

template <class Archive>
void serialize(Archive& archive, LandmarkCheck& check) {
    archive(check.distance, check.energy_fall);
}

template <class Archive>
void serialize(Archive& archive, Candidate& c) {
    archive(c.explored, c.self_map_A, c.self_map_B, c.energy, c.dirichlet, c.relief, c.alignment, c.stretch,
            c.landmarks_missed, c.score, c.reversed_mass, c.moved_mass, c.mirrored_back, c.turned_about_axis,
            c.turned_by_half, c.mirror_gain, c.turn);
}

template <class Archive>
void serialize(Archive& archive, SamplePlan& plan) {
    archive(plan.samples_A, plan.samples_B, plan.mass_A, plan.mass_B, plan.transported_A, plan.transported_B,
            plan.area_bound, plan.entries);
}

template <class Archive>
void serialize(Archive& archive, PairRecord& record) {
    archive(record.landmarks, record.landmark_points, record.landmark_weight, record.landmark_checks,
            record.candidates, record.candidate);
}

template <class Archive>
void serialize(Archive& archive, SolvedPair& pair) {
    archive(pair.plan, pair.trace, pair.record);
}

}  // namespace varimap
