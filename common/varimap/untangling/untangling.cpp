#include "varimap/untangling/untangling.h"

#include <tbb/parallel_invoke.h>

#include <optional>
#include <vector>

#include "varimap/core/log.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/relaxation/relief_agreement.h"
#include "varimap/untangling/rounds.h"
#include "varimap/untangling/untangled_direction.h"

namespace varimap {

namespace {

/// What belongs to the one direction and to the other.
template <class T>
struct OfEach {
    T there, back;
};

/// Calls body for both, side by side, with what the other's images are before, and with what belongs to it.
template <class T, class Body>
void with_each_other(UntangledDirection& there, UntangledDirection& back, const OfEach<T>& own,
                     const Body& body) {
    const PointMap A_to_B = there.points(), B_to_A = back.points();
    tbb::parallel_invoke([&] { body(there, B_to_A, own.there); }, [&] { body(back, A_to_B, own.back); });
}
template <class Body>
void with_each_other(UntangledDirection& there, UntangledDirection& back, const Body& body) {
    with_each_other(there, back, OfEach<int>{},
                    [&](UntangledDirection& map, const PointMap& inverse, int) { body(map, inverse); });
}

void relax(UntangledDirection& there, UntangledDirection& back) {
    while (!there.is_relaxed() || !back.is_relaxed())
        with_each_other(there, back,
                        [](UntangledDirection& map, const PointMap& inverse) { map.relax(inverse); });
}

/// A round of both directions, which draw each other towards their inverses.
void run(UntangledDirection& there, UntangledDirection& back, const Round& round) {
    tbb::parallel_invoke([&] { there.start_relaxation(round); }, [&] { back.start_relaxation(round); });
    relax(there, back);
    tbb::parallel_invoke([&] { there.end_relaxation(round); }, [&] { back.end_relaxation(round); });
}

void weigh_relief(UntangledDirection& there, UntangledDirection& back) {
    const double agreement = (there.relief_correlation() + back.relief_correlation()) / 2;
    const double trust = trust_in_relief(agreement, there.are_sheets());
    there.trust_relief(trust);
    back.trust_relief(trust);
    if (trust < 1)
        log("reliefs agree by {:.2f} before the map is relaxed: they count by {:.2f}", agreement, trust);
}

/// As their surroundings have them, then as the other direction does; as a whole where that is much better.
void replace_strained_parts(UntangledDirection& there, UntangledDirection& back) {
    with_each_other(there, back,
                    [](UntangledDirection& map, const PointMap& inverse) { map.replace_parts(inverse); });
    with_each_other(there, back, OfEach<bool>{there.is_much_worse_than(back), back.is_much_worse_than(there)},
                    [](UntangledDirection& map, const PointMap& inverse, bool is_much_worse) {
                        map.reconcile(inverse, is_much_worse);
                    });
}

/// The last round.
void settle(UntangledDirection& there, UntangledDirection& back) {
    tbb::parallel_invoke([&] { there.start_settling(); }, [&] { back.start_settling(); });
    while (!there.is_settled() || !back.is_settled())
        with_each_other(there, back,
                        [](UntangledDirection& map, const PointMap& inverse) { map.settle(inverse); });
    tbb::parallel_invoke([&] { there.end_settling(); }, [&] { back.end_settling(); });
}

/// A tangle of one direction may be none of the other: an inverse without faults is a better start for it
/// than charts, which must not crush what was crushed there.
void adopt_from_each_other(UntangledDirection& there, UntangledDirection& back) {
    struct Adoption {
        bool may_be, upright;
    };
    const OfEach<Adoption> adoption{{there.may_adopt(back), !back.has_mirrored_parts()},
                                    {back.may_adopt(there), !there.has_mirrored_parts()}};
    if (!adoption.there.may_be && !adoption.back.may_be) return;
    with_each_other(there, back, adoption,
                    [](UntangledDirection& map, const PointMap& inverse, const Adoption& own) {
                        if (own.may_be) map.adopt(inverse, own.upright);
                    });
}

/// Without new faults.
void settle_again(UntangledDirection& there, UntangledDirection& back) {
    tbb::parallel_invoke([&] { there.start_settling_again(); }, [&] { back.start_settling_again(); });
    if (there.is_relaxed() && back.is_relaxed()) return;
    there.guard([&] { back.guard([&] { relax(there, back); }); });
    there.end_settling_again();
    back.end_settling_again();
}

void repair_faults(UntangledDirection& there, UntangledDirection& back) {
    with_each_other(there, back,
                    [](UntangledDirection& map, const PointMap& inverse) { map.repair(inverse); });
    settle_again(there, back);
    // By the other direction as it has come out: often only one of them was tangled.
    if (there.is_repaired_again() || back.is_repaired_again())
        with_each_other(there, back,
                        [](UntangledDirection& map, const PointMap& inverse) { map.repair_again(inverse); });
    with_each_other(there, back,
                    [](UntangledDirection& map, const PointMap& inverse) { map.recover(inverse); });
    adopt_from_each_other(there, back);
    tbb::parallel_invoke([&] { there.restore_bound(); }, [&] { back.restore_bound(); });
}

UntanglingReports left_as_they_are(const MapPair& maps, const TriangleMesh& A, const TriangleMesh& B) {
    UntanglingReports reports;
    tbb::parallel_invoke([&] { reports.A_to_B = untouched(measure_distortion(maps.A_to_B, A, B)); },
                         [&] { reports.B_to_A = untouched(measure_distortion(maps.B_to_A, B, A)); });
    return reports;
}

}  // namespace

UntanglingReports untangle(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                           const PinnedPair& pinned, const UntanglingOptions& options) {
    if (!options.enabled) return left_as_they_are(maps, A, B);
    std::vector<ReliefPair> reliefs;
    if (options.relief_weight > 0 && options.global_steps > 0)
        reliefs = relief_pairs(unit_area(A), unit_area(B), options.opposed);
    std::optional<UntangledDirection> A_to_B, B_to_A;
    tbb::parallel_invoke(
        [&] { A_to_B.emplace(maps.A_to_B, A, B, pinned.A, pinned.points, options, reliefs); },
        [&] {
            B_to_A.emplace(maps.B_to_A, B, A, pinned.B, swapped(pinned.points), options, swapped(reliefs));
        });
    UntangledDirection &there = *A_to_B, &back = *B_to_A;
    if (options.weigh_relief && there.has_relief()) weigh_relief(there, back);
    if (options.local_sweeps == 0) run(there, back, relaxation_rounds[0]);
    replace_strained_parts(there, back);
    run(there, back, relaxation_rounds[1]);
    if (options.settling_steps > 0) settle(there, back);
    repair_faults(there, back);
    UntanglingReports reports;
    tbb::parallel_invoke([&] { reports.A_to_B = there.finish(); }, [&] { reports.B_to_A = back.finish(); });
    return reports;
}

}  // namespace varimap
