#pragma once

#include "varimap/multilevel/descriptor_terms.h"
#include "varimap/multilevel/ironing.h"
#include "varimap/stage/parameters.h"
#include "varimap/transport/alternating_minimization.h"

namespace varimap {

/// Parameters of every stage that solves for a plan, with exact masses at least.
inline void describe_exact(ParameterList& list, AlternationOptions& o) {
    list.add("tolerance", o.tolerance,
             "a level ends when the energy changes by less than this share (Alg. 1)", 0.0, 1.0);
    list.add("maximum_alternations", o.maximum_alternations, "alternations per level at most", 1, 10000);
    list.add("gamma_divisor", o.gamma_divisor, "gamma = largest instantiated cost / this (Sec. 3.3)", 1.0,
             1e5);
    list.add("annealing_divisor", o.annealing_divisor, "gamma of a level's first solve = largest cost / this",
             1.0, 1e5);
    list.add("marginal_tolerance", o.marginal_tolerance, "L1 error of the row sums at which Sinkhorn stops",
             1e-14, 0.5);
    list.add("sinkhorn_iterations", o.sinkhorn_iterations, "Sinkhorn iterations per solve at most", 1,
             1000000);
    list.add("support_threshold", o.support_threshold,
             "entries below this share of their row's and column's mass do not spread (Sec. 4.3)", 1e-9, 0.5);
    list.add("background_factor", o.background_factor,
             "cost of entries off the support / largest cost (Sec. 4.3)", 1.5, 1e3);
}

/// And of those that may change masses.
inline void describe(ParameterList& list, AlternationOptions& o) {
    describe_exact(list, o);
    list.add(
        "area_bound", o.area_bound,
        "areas change by at most this factor: row and column sums within its root of the masses (Sec. 3.4)",
        1.0, 1e6);
    list.add("area_energy", o.area_energy,
             "energy of changed areas: samples weighted by transported mass, or C' of Sec. 3.4");
    list.add("mass_penalty", o.mass_penalty,
             "how firmly row and column sums are held to the masses within the bound, relative to the "
             "largest cost",
             0.0, 1e6);
}

inline void describe(ParameterList& list, IroningOptions& o) {
    list.add("ironing", o.enabled, "removes reversed patches of the map at the end of each level (Sec. 4.4)");
    list.add("ironing_samples", o.minimum_samples, "levels with fewer samples are not ironed", 1, 1000000);
    list.add("ironing_samples_maximum", o.maximum_samples, "nor are levels with more samples", 1, 100000000);
    list.add("ironing_omega", o.omega, "weight of a reversed sample while it is ironed", 0.0, 1.0);
    list.add("ironing_rounds", o.maximum_rounds, "ironing alternations per level at most", 0, 10000);
    list.add("ironing_patience", o.patience, "rounds without progress after which a level is left", 1, 10000);
    list.add("ironing_tolerance", o.tolerated_mass, "share of the mass that may stay reversed", 0.0, 1.0);
    list.add("reanchoring_mass", o.reanchored_mass,
             "reversed patches of at least this share of the mass are placed anew from their surroundings",
             0.0, 1.0);
    list.add("reflection_mass", o.reflected_mass,
             "a map that reverses more than this share of the mass is reflected", 0.0, 1.0);
}

inline void describe(ParameterList& list, DescriptorWeights& weights) {
    list.add("shape_weight", weights.shape,
             "how strongly places of like bending and shape diameter attract each other (0: not at all)", 0.0,
             100.0);
    list.add("vicinity_weight", weights.vicinity,
             "how strongly landmarks hold the places around them, too (0: only themselves)", 0.0, 1000.0);
}

}  // namespace varimap
