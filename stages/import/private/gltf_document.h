#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace varimap {

/// A file of glTF 2: its JSON, and the bytes of its buffers one after the other. The JSON's bufferViews name
/// these as their one buffer; URIs of images are names of files, their escapes decoded.
struct GltfDocument {
    nlohmann::json json;
    std::string bytes;
};

/// Reads .gltf with what it names, or .glb. None where the file is of glTF 1. Throws InputError that does not
/// name the file, also where it requires an extension that is not understood, and nlohmann::json::exception.
std::optional<GltfDocument> read_gltf(const std::string& path);

/// The numbers of an accessor, one element after the other, integers made what they stand for. Throws
/// InputError and nlohmann::json::exception.
std::vector<double> accessor_numbers(const GltfDocument& document, std::size_t accessor);

/// Adds an accessor of floats, 1 to 4 or, of matrices, 16 of them an element, and returns its number.
std::size_t append_accessor(GltfDocument& document, const std::vector<double>& numbers,
                            std::size_t components);

std::string to_glb(const GltfDocument& document);

}  // namespace varimap
