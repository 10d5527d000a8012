#include "varimap/artifact/artifact.h"

#include <fstream>

#include "varimap/artifact/file_status.h"
#include "varimap/artifact/header.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

/// Headers are a few hundred bytes; a longer one is a damaged file.
constexpr std::size_t longest_header = 1 << 16;

/// An artifact whose header has been checked; the stream stands at the payload.
struct OpenArtifact {
    Header header;
    std::ifstream stream;
    std::uint64_t bytes_after_header;
};

ArtifactError damaged(const std::string& path, const std::string& what) {
    return ArtifactError("'" + path + "' is damaged: " + what +
                         "; delete it and rerun the stage that wrote it");
}

void read_exactly(std::ifstream& stream, std::string& bytes, const std::string& path) {
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    if (std::size_t(stream.gcount()) != bytes.size()) throw IoError("cannot read '" + path + "' to its end");
}

OpenArtifact open_artifact(const std::string& path) {
    const auto size = std::uint64_t(regular_file_status(path).st_size);
    OpenArtifact artifact{{}, std::ifstream(path, std::ios::binary), 0};
    if (!artifact.stream) throw IoError("cannot open '" + path + "' for reading");
    std::string front(std::min<std::uint64_t>(size, longest_header), '\0');
    read_exactly(artifact.stream, front, path);
    if (!front.starts_with(std::string(magic) + "\n"))
        throw ArtifactError("'" + path +
                            "' is not an artifact of this version of varimap: its first line is not '" +
                            std::string(magic) + "'");
    const auto header_bytes = parse_header(front, artifact.header);
    if (!header_bytes) throw damaged(path, "its header is incomplete or altered");
    artifact.bytes_after_header = size - *header_bytes;
    artifact.stream.seekg(std::streamoff(*header_bytes));
    return artifact;
}

void require_one_word(const std::string& text) {
    if (text.empty() || text.find_first_of(" \n") != std::string::npos)
        throw std::logic_error("'" + text + "' cannot be a name in an artifact's header");
}

void require_one_line(const std::string& text) {
    if (text.find('\n') != std::string::npos) throw std::logic_error("a line break in an artifact's header");
}

void require_writable(const Header& header) {
    require_one_word(header.kind);
    require_one_word(header.stage);
    for (const auto& [name, value] : header.parameters) require_one_word(name), require_one_line(value);
    for (const auto& input : header.inputs)
        require_one_word(input.role), require_one_word(input.kind), require_one_word(input.hash);
}

}  // namespace

Header read_header(const std::string& path) {
    return open_artifact(path).header;
}

std::pair<Header, std::string> read_checked(const std::string& path) {
    OpenArtifact artifact = open_artifact(path);
    Header& header = artifact.header;
    // Compared with the file's own size before anything of the recorded size is allocated.
    if (artifact.bytes_after_header < end_mark.size() ||
        artifact.bytes_after_header - end_mark.size() != header.payload_bytes)
        throw damaged(path, "its length is not the recorded one");
    std::string payload(header.payload_bytes, '\0');
    read_exactly(artifact.stream, payload, path);
    if (content_hash(payload) != header.payload_hash) throw damaged(path, "its payload was altered");
    std::string mark(end_mark.size(), '\0');
    read_exactly(artifact.stream, mark, path);
    if (mark != end_mark) throw damaged(path, "its end mark was altered");
    return {std::move(header), std::move(payload)};
}

std::pair<Header, std::string> read_payload(const std::string& path, const std::string& kind, int schema,
                                            const std::string& stage) {
    auto checked = read_checked(path);
    const Header& header = checked.first;
    if (header.kind != kind)
        throw ArtifactError("'" + path + "' is a " + header.kind + " where a " + kind +
                            " is needed; give the artifact of " + stage);
    if (header.schema != schema)
        throw ArtifactError("'" + path + "' has schema " + std::to_string(header.schema) + " of a " + kind +
                            ", this version reads schema " + std::to_string(schema) + "; rerun " + stage);
    return checked;
}

void write_payload(const std::string& path, Header header, const std::string& payload) {
    require_writable(header);
    header.payload_bytes = payload.size();
    header.payload_hash = content_hash(payload);
    header.version = version();
    std::string bytes = header_text(header);
    if (bytes.size() > longest_header) throw std::logic_error("the header of an artifact is too long");
    bytes.reserve(bytes.size() + payload.size() + end_mark.size());
    bytes += payload;
    bytes += end_mark;
    write_file_atomically(path, bytes);
}

}  // namespace varimap
