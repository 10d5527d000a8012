#include "varimap/stage/known_hashes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "varimap/artifact/file_status.h"
#include "varimap/artifact/header.h"
#include "varimap/core/lower_case.h"

namespace varimap {
namespace {

/// Longer than the steps of any file system's clock (FAT: 2 s).
constexpr std::int64_t seconds_at_rest = 3;

FileState state_of(const struct stat& status) {
    return {fmt::format("{} {} {}.{:09} {}.{:09}", status.st_size, status.st_ino, status.st_mtim.tv_sec,
                        status.st_mtim.tv_nsec, status.st_ctim.tv_sec, status.st_ctim.tv_nsec)};
}

bool is_at_rest(const struct stat& status, std::time_t now) {
    return std::max(status.st_mtim.tv_sec, status.st_ctim.tv_sec) + seconds_at_rest <= now;
}

bool is_artifact(const std::string& path) {
    std::string front(magic.size(), '\0');
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool same =
        file >= 0 && ::read(file, front.data(), front.size()) == ssize_t(front.size()) && front == magic;
    if (file >= 0) ::close(file);
    return same;
}

/// Role aside.
InputRecord read_and_hash(const std::string& path) {
    if (!is_artifact(path)) return {"", kind_of_file(path), file_hash(path)};
    const Header header = read_checked(path).first;
    return {"", header.kind, header.payload_hash};
}

std::string memory_file(const std::string& folder, const std::string& path) {
    return folder + "/" + content_hash(std::filesystem::absolute(path).lexically_normal().string());
}

/// "STATE|KIND|HASH|" and its own hash, which tells a line that was cut.
std::string memory_line(const FileState& state, const InputRecord& record) {
    const std::string line = state.text + "|" + record.kind + "|" + record.hash + "|";
    return line + content_hash(line) + "\n";
}

std::optional<InputRecord> remembered(const std::string& file, const FileState& state) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return {};
    const std::string text = read_file(file);
    std::istringstream stream(text);
    std::string state_text;
    InputRecord record;
    std::getline(stream, state_text, '|'), std::getline(stream, record.kind, '|');
    std::getline(stream, record.hash, '|');
    const bool valid = state_text == state.text && text == memory_line(state, record);
    return valid ? std::optional(record) : std::nullopt;
}

/// One short write and no temporary file: a line that was cut by a kill is seen as such, and forgotten.
void remember(const std::string& file, const std::string& line) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) return;  // then it is read again next time
    if (::write(descriptor, line.data(), line.size()) != ssize_t(line.size())) ::unlink(file.c_str());
    ::close(descriptor);
}

}  // namespace

FileState file_state(const std::string& path) {
    return state_of(regular_file_status(path));
}

std::string kind_of_file(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    ending.erase(0, 1);
    const bool plain =
        !ending.empty() && ending.size() <= 8 &&
        std::all_of(ending.begin(), ending.end(), [](unsigned char c) { return std::isalnum(c); });
    if (!plain) return "file";
    return lower_case(ending);
}

InputRecord KnownHashes::identify(const std::string& role, const std::string& path) const {
    const struct stat status = regular_file_status(path);
    const FileState state = state_of(status);
    InputRecord record;
    if (folder_.empty()) {
        record = read_and_hash(path);
    } else {
        const std::string file = memory_file(folder_, path);
        if (const auto known = remembered(file, state)) {
            record = *known;
        } else {
            record = read_and_hash(path);
            if (is_at_rest(status, now_()) && file_state(path) == state)
                remember(file, memory_line(state, record));
        }
    }
    record.role = role;
    return record;
}

}  // namespace varimap
