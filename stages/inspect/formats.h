#pragma once

#include <string>

#include "stages/inspect/contents.h"

namespace varimap {

/// NumPy's .npy format 1.0: little-endian f8 or i4, the array's own storage order.
std::string to_npy(const ArrayView& array);

/// MatrixMarket coordinate format: indices from 1, row by row; values read back exactly, in any locale.
std::string to_matrix_market(const SparseMatrix& matrix);

/// An .npz that SciPy's load_npz reads.
std::string to_npz(const SparseMatrix& matrix);

}  // namespace varimap
