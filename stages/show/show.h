#pragma once

#include <string>

#include "varimap/results/diffusion.h"
#include "varimap/spectral/hierarchy.h"

namespace varimap {

// Pictures as SVG of what artifacts hold.

/// The three weights among which Sec. 3.2 chooses (Fig. 4), of one point at one diffusion time: K,
/// K / sqrt(K K), and Eq. (7), each relative to its largest value. Dots: where it is above one half. The
/// labels say how far from the point the maximum and the centre of mass of that neighbourhood lie, in units
/// of sqrt(area).
std::string show_weights(const Domain& domain, const Basis& basis, int point, double time);

/// The samples of the last diffusion level (Fig. 6).
std::string show_samples(const Domain& domain, const Hierarchy& hierarchy);

/// The entries of a plan's row (Fig. 7): the sample of A in whose cell the point lies, and on B the samples
/// to which its row has entries, larger for more mass.
std::string show_row(const Domain& A, const Domain& B, const SamplePlan& plan, int point);

/// A's mesh as wires, its vertices at their centres near B (Fig. 11), and how far B's vertices are from the
/// nearest of them in the mean, in units of sqrt(area).
std::string show_centres(const Domain& A, const Domain& B, const Points& centres);

/// A mesh as wires (Fig. 5, 19).
std::string show_wires(const TriangleMesh& mesh);

}  // namespace varimap
