#include "varimap/artifact/header.h"

#include <optional>

#include "varimap/artifact/artifact.h"
#include "varimap/core/parse_number.h"

namespace varimap {
namespace {

/// Takes the text up to the next `end` off the front of `rest`; nothing where there is no `end`.
std::optional<std::string_view> take(std::string_view& rest, char end) {
    const auto position = rest.find(end);
    if (position == std::string_view::npos) return std::nullopt;
    const auto front = rest.substr(0, position);
    rest.remove_prefix(position + 1);
    return front;
}

bool parse_parameter(std::string_view rest, Header& header) {
    const auto name = take(rest, ' ');
    if (name) header.parameters.emplace_back(*name, rest);
    return name.has_value();
}

bool parse_input(std::string_view rest, Header& header) {
    const auto role = take(rest, ' ');
    const auto kind = take(rest, ' ');
    if (kind) header.inputs.push_back({std::string(*role), std::string(*kind), std::string(rest)});
    return kind.has_value();
}

bool parse_payload(std::string_view rest, Header& header) {
    const auto bytes = take(rest, ' ');
    header.payload_hash = rest;
    return bytes && parse_number(*bytes, header.payload_bytes);
}

/// One line `KEY REST`. False where it is none of a header's lines.
bool parse_line(std::string_view line, Header& header) {
    const auto key = take(line, ' ');
    if (!key) return false;
    if (*key == "kind") return header.kind = line, true;
    if (*key == "schema") return parse_number(line, header.schema);
    if (*key == "stage") return header.stage = line, true;
    if (*key == "version") return header.version = line, true;
    if (*key == "parameter") return parse_parameter(line, header);
    if (*key == "input") return parse_input(line, header);
    return *key == "payload" && parse_payload(line, header);
}

std::string body_text(const Header& header) {
    std::string text = std::string(magic) + "\n";
    text += "kind " + header.kind + "\n";
    text += "schema " + std::to_string(header.schema) + "\n";
    text += "stage " + header.stage + "\n";
    text += "version " + header.version + "\n";
    for (const auto& [name, value] : header.parameters) text += "parameter " + name + " " + value + "\n";
    for (const auto& input : header.inputs)
        text += "input " + input.role + " " + input.kind + " " + input.hash + "\n";
    text += "payload " + std::to_string(header.payload_bytes) + " " + header.payload_hash + "\n";
    return text;
}

}  // namespace

std::string Header::input_hash(const std::string& role) const {
    for (const auto& input : inputs)
        if (input.role == role) return input.hash;
    return {};
}

std::string header_text(const Header& header) {
    const std::string body = body_text(header);
    return body + "header " + content_hash(body) + "\n";
}

std::optional<std::size_t> parse_header(std::string_view bytes, Header& header) {
    std::string_view rest = bytes;
    if (take(rest, '\n') != magic) return std::nullopt;
    for (auto line = take(rest, '\n'); line; line = take(rest, '\n')) {
        if (line->starts_with("header ")) {
            const std::size_t size = bytes.size() - rest.size();
            // Writing it again and comparing refuses every line that was altered, added, lost or moved.
            if (header_text(header) != bytes.substr(0, size)) return std::nullopt;
            return size;
        }
        if (!parse_line(*line, header)) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace varimap
