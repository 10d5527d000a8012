#include "stages/inspect/lineage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

/// What was made from the same content: a mesh that was coarse enough stays as it is.
bool is_copy(const Header& header) {
    return std::any_of(header.inputs.begin(), header.inputs.end(),
                       [&](const InputRecord& input) { return input.hash == header.payload_hash; });
}

/// Artifacts of one folder by their content hash; among copies, that which was not made from another, or the
/// first name.
struct Neighbours {
    std::map<std::string, std::pair<std::string, Header>> by_hash;

    explicit Neighbours(const std::filesystem::path& folder) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
            if (entry.is_regular_file(ignored)) add(entry.path());
    }

  private:
    void add(const std::filesystem::path& path) {
        try {
            Header header = read_header(path.string());
            auto& [name, known] = by_hash[header.payload_hash];
            const std::string file = path.filename().string();
            const bool copy = is_copy(header);
            if (name.empty() || std::pair(copy, file) < std::pair(is_copy(known), name))
                name = file, known = std::move(header);
        } catch (const Error&) {
            // Folders hold other files too.
        }
    }
};

std::string tree(const Header& header, const Neighbours& neighbours, std::size_t depth) {
    // Deeper than the pipeline is long: the files contradict each other.
    if (depth > 8) return {};
    std::string text;
    for (const auto& input : header.inputs) {
        const auto found = neighbours.by_hash.find(input.hash);
        const bool here = found != neighbours.by_hash.end();
        text += fmt::format("{:{}}{}: {} {}{}\n", "", 2 + 2 * depth, input.role, input.kind, input.hash,
                            here ? " " + found->second.first : "");
        if (here) text += tree(found->second.second, neighbours, depth + 1);
    }
    return text;
}

}  // namespace

std::string lineage(const std::string& path) {
    const auto folder = std::filesystem::path(path).parent_path();
    return tree(read_header(path), Neighbours(folder.empty() ? "." : folder), 0);
}

}  // namespace varimap
