#include "varimap/results/quality_numbers.h"

#include <nlohmann/json.hpp>

#include "varimap/results/checks.h"

namespace varimap {

std::string encode(const QualityNumbers& numbers) {
    return numbers.json;
}

void decode(const std::string& payload, QualityNumbers& numbers) {
    require<QualityNumbers>(nlohmann::json::parse(payload, nullptr, false).is_object(), "JSON");
    numbers.json = payload;
}

}  // namespace varimap
