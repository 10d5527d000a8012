#pragma once

#include "varimap/spectral/eigenbasis.h"
#include "varimap/stage/parameters.h"

namespace varimap {

inline void describe(ParameterList& list, EigenSolverOptions& o) {
    list.add("count", o.count, "eigenpairs (the paper's M); 300 resolves thin parts better", 10, 2000);
    list.add("shift", o.shift, "shift of the inverse iteration, below the spectrum [1/area]", -1e3, -1e-9);
    list.add("tolerance", o.tolerance, "relative accuracy of the eigenvalues", 1e-14, 1e-3);
    list.add("maximum_residual", o.maximum_residual, "eigenpairs with larger relative residuals are refused",
             1e-14, 1.0);
}

}  // namespace varimap
