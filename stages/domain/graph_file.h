#pragma once

#include <string>

#include "stages/domain/domain_file.h"

namespace varimap {

/// Rows of two point numbers, from 0, and a positive weight, 1 without one. Throws IoError and InputError
/// naming file and line.
DomainFile graph_from_rows(const std::string& path);
/// A symmetric matrix of positive weights (math.nist.gov/MatrixMarket), or its pattern.
DomainFile graph_from_matrix_market(const std::string& path);

}  // namespace varimap
