#pragma once

#include <array>

#include "varimap/core/enum_names.h"
#include "varimap/stage/parameters.h"

namespace varimap {

/// Where the picture shows the two domains.
enum class Layout : int {
    beside = 0,    ///< each in a panel of its own, partners in the same colour
    together = 1,  ///< in one panel, with lines to the centres of the images (Fig. 2)
};
template <>
struct EnumNames<Layout> {
    static constexpr std::array names{"beside", "together"};
};

struct PartnersParams {
    double radius = 0.05;
    double apart = 3;
    Layout layout = Layout::beside;

    void describe(ParameterList& list) {
        list.add("radius", radius,
                 "mass counts as going to a place if it lands within this distance (units of sqrt(area) of a "
                 "sphere as large)",
                 1e-6, 1.0);
        list.add("apart", apart, "an edge's ends land apart beyond this many mean lengths of edges", 1.0,
                 1000.0);
        list.add("layout", layout, "of the picture: beside each other, or together, with lines");
    }
};

}  // namespace varimap
