#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// What stands between the commas of a line, without blanks around it. As RFC 4180 says, a field in quotes
/// may hold commas, and quotes as two of them. None where a quote has no end, or more than a comma behind it.
std::optional<std::vector<std::string>> csv_fields(std::string_view line);

}  // namespace varimap
