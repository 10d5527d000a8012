#pragma once

#include "varimap/stage/parameters.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

struct RelaxParams {
    UntanglingOptions untangling;
    bool keep_area_bound = true;

    void describe(ParameterList& list) {
        UntanglingOptions& o = untangling;
        list.add("untangle", o.enabled, "removes reversed triangles and relaxes the map towards an isometry");
        list.add("relaxation_steps", o.global_steps, "global relaxation steps, each of two times", 0, 1000);
        list.add("area_weight", o.area_weight, "weight of areas against angles in the relaxation", 1e-3, 1e3);
        list.add("robustness", o.robustness,
                 "excess energy at which a triangle counts half in the relaxation; 0: all count fully", 0,
                 1e6);
        list.add("relief_weight", o.relief_weight,
                 "weight of like relief of both surfaces against the isometry in the relaxation", 0, 1e3);
        list.add(
            "inverse_weight", o.inverse_weight,
            "weight of both directions' being each other's inverse against the isometry in the relaxation", 0,
            1e6);
        list.add("boundary_weight", o.boundary_weight,
                 "weight of boundaries' going to boundaries against the isometry in the relaxation", 0, 1e6);
        list.add(
            "settling_steps", o.settling_steps,
            "relaxation steps at the end, in which both directions become each other's inverse and keep the "
            "area bound",
            0, 1000);
        list.add("keep_area_bound", keep_area_bound, "keeps areas of the map within the plan's area bound");
        list.add("fold_sweeps", o.fold_sweeps, "sweeps that remove folds, per patch size", 0, 100'000);
        list.add("replace_parts", o.replace_parts,
                 "maps strained parts (mirrored, twisted, crumpled) anew (Sec. 4.4)");
        list.add("strain", o.parts.strain.excess, "mean excess energy from which on a part is strained", 1e-3,
                 1e3);
        list.add("align_normals", o.align_normals, "turns triangles that cut through thin features");
        list.add("mirror_area", o.gate.area,
                 "share of the area from which on a mirrored part is left as it is, with a warning", 0, 1);
    }
};

}  // namespace varimap
