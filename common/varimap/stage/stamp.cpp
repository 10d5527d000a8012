#include "varimap/stage/stamp.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "varimap/core/error.h"

namespace varimap {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> sorted_texts(const std::vector<InputRecord>& inputs) {
    std::vector<std::string> texts;
    for (const auto& input : inputs) texts.push_back(input.role + " " + input.kind + " " + input.hash);
    std::sort(texts.begin(), texts.end());
    return texts;
}

bool is_plain_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

std::string beside(const std::string& stamp, const std::string& name) {
    return (fs::path(stamp).parent_path() / name).string();
}

}  // namespace

bool would_be_written(const Header& now, const Header& then) {
    return now.kind == then.kind && now.schema == then.schema && now.stage == then.stage &&
           now.version == then.version && now.parameters == then.parameters &&
           sorted_texts(now.inputs) == sorted_texts(then.inputs);
}

Stamp read_stamp(const std::string& path) {
    auto [header, listing] = read_payload(path, stamp_kind, stamp_schema, "the stage");
    Stamp stamp{std::move(header), {}};
    std::istringstream lines(listing);
    for (std::string hash, name; std::getline(lines, hash, ' ') && std::getline(lines, name);) {
        if (!is_plain_name(name)) throw ArtifactError("'" + path + "' lists a file of another folder");
        stamp.files.push_back({hash, name});
    }
    return stamp;
}

std::vector<std::string> paths_of_stamp(const std::string& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return {};
    std::vector<std::string> paths;
    try {
        for (const auto& file : read_stamp(path).files) paths.push_back(beside(path, file.name));
    } catch (const Error&) {
        return {};
    }
    return paths;
}

void write_stamp(const std::string& path, Header header, const std::vector<std::string>& files) {
    std::string listing;
    std::vector<std::string> names;
    for (const auto& file : files) {
        names.push_back(fs::path(file).filename().string());
        if (!fs::equivalent(file, beside(path, names.back())) || names.back().find('\n') != std::string::npos)
            throw UsageError("--stamp '" + path + "': '" + file + "' is not in its folder");
        listing += file_hash(file) + " " + names.back() + "\n";
    }
    for (const auto& former : paths_of_stamp(path))
        if (std::find(names.begin(), names.end(), fs::path(former).filename().string()) == names.end())
            fs::remove(former);
    write_payload(path, std::move(header), listing);
}

}  // namespace varimap
