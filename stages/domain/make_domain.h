#pragma once

#include <string>

#include "stages/domain/domain_file.h"

namespace varimap {

/// The domain that a file describes, ready for the method. A graph may have been given positions, for ambient
/// distances and for pictures. Throws InputError where it is of several parts, naming the file `path`;
/// UsageError for ambient distances without positions.
Domain make_domain(const DomainFile& file, const DomainParams& params, const std::string& path);

}  // namespace varimap
