#pragma once

namespace varimap {

/// What untangling (untangling.h) did to one direction; counts and areas by the test of quality.h (n . m <=
/// 0, collapsed included). Before: on the mesh that the method runs on; after: on the input.
struct UntanglingReport {
    int flipped_before = 0, flipped_after = 0;
    double flipped_area_percent_before = 0, flipped_area_percent_after = 0;
    int global_steps = 0;                     ///< of relaxation, those that were taken
    int sweeps = 0;                           ///< of fold removal
    int parts_tried = 0, parts_replaced = 0;  ///< see part_replacement.h
    double replaced_area_percent = 0;         ///< share of the source's area, counted as often as replaced
    int mirrored_parts = 0;                   ///< left as they are
    double gated_area_percent = 0;            ///< their share of the source's area
    int disagreeing_before = 0,
        disagreeing_after = 0;  ///< faces that cut through a feature (normal_agreement.h)
};

/// Of both directions.
struct UntanglingReports {
    UntanglingReport A_to_B, B_to_A;
};

}  // namespace varimap
