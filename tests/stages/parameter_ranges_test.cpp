#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fixtures/known_pair.h"
#include "stages/diffuse/diffuse.h"
#include "stages/refine/refine.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

/// Of three limbs' landmarks two are exchanged, so that something is reversed and ironed.
const PairContext& context() {
    static const PairContext pair = [] {
        auto known = shapes::figure_pair(1, true, 500);
        std::swap(known.landmarks[0].second, known.landmarks[1].second);
        return known.context();
    }();
    return pair;
}

template <class Value>
void set(const Parameter& parameter, double value) {
    *std::get<Value*>(parameter.value) = Value(value);
}

/// Calls `solve` with each parameter that is a number at either end of its range: it ends with what the next
/// stage reads, or says why not, and at most of these ends with the former.
template <class Params, class Solve>
void try_ends_of_ranges(const Params& usual, const Solve& solve) {
    int tried = 0, solved = 0;
    for (std::size_t i = 0;; ++i)
        for (const bool at_most : {false, true}) {
            Params params = usual;
            ParameterList list;
            params.describe(list);
            if (i == list.all().size()) {
                EXPECT_GT(10 * solved, 9 * tried) << solved << " of " << tried;
                return;
            }
            const Parameter& parameter = list.all()[i];
            const double value = at_most ? parameter.maximum : parameter.minimum;
            if (std::holds_alternative<double*>(parameter.value))
                set<double>(parameter, value);
            else if (std::holds_alternative<int*>(parameter.value))
                set<int>(parameter, value);
            else
                continue;
            SCOPED_TRACE(fmt::format("{} = {}", parameter.name, value));
            ++tried;
            try {
                auto found = solve(params);
                EXPECT_NO_THROW(decode(encode(found), found));
                ++solved;
            } catch (const UsageError&) {
            } catch (const ConvergenceError&) {
            }
        }
}

TEST(ParameterRanges, OfDiffuseEndInAMapOrAReason) {
    DiffuseParams usual;
    usual.check_landmarks = false;
    try_ends_of_ranges(usual, [](const DiffuseParams& params) { return diffuse(context(), params); });
}

TEST(ParameterRanges, OfRefineEndInAMapOrAReason) {
    const Diffusion diffusion = diffuse(context(), {});
    try_ends_of_ranges(RefineParams(),
                       [&](const RefineParams& params) { return refine(context(), diffusion, params); });
}

}  // namespace
}  // namespace varimap
