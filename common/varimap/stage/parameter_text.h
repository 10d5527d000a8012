#pragma once

#include <string>

#include "varimap/stage/parameters.h"

namespace varimap {

/// The values a parameter may have, in words: "a number from 0 to 1", "one of none, both".
std::string allowed_values(const Parameter& parameter);

/// Reads the parameter's value from text, the same in every locale. Throws UsageError (not a value of that
/// type, not finite, out of range, not among the choices).
void assign(const Parameter& parameter, const std::string& text);

/// The same for values that a program has set itself. Throws UsageError.
void require_allowed(const ParameterList& list);

}  // namespace varimap
