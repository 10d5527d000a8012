#pragma once

#include <string>

#include "varimap/artifact/artifact.h"

namespace varimap {

/// The part of quality.json that depends on the inputs and parameters alone: the artifact of varimap-remesh.
struct QualityNumbers {
    std::string json;  ///< an object
};

template <>
struct ArtifactType<QualityNumbers> {
    static constexpr const char* kind = "quality";
    static constexpr const char* stage = "varimap-remesh";
    static constexpr int schema = 1;
};
/// The text itself.
std::string encode(const QualityNumbers& numbers);
/// Throws ArtifactError unless it is a JSON object.
void decode(const std::string& payload, QualityNumbers& numbers);

}  // namespace varimap
