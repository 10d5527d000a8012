#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace varimap {

/// One direct input of an artifact: the role it played, its kind ("surface", "file", ...) and content hash.
struct InputRecord {
    std::string role;
    std::string kind;
    std::string hash;
};

/// The ASCII header in front of every artifact; `head` shows it. It holds nothing that depends on the
/// machine, the time, the folder or the number of threads, so equal inputs and parameters give equal bytes.
struct Header {
    std::string kind;
    int schema = 0;
    std::string stage;
    std::string version;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<InputRecord> inputs;
    std::uint64_t payload_bytes = 0;
    std::string payload_hash;

    /// Content hash of the input with that role; empty if there is none.
    std::string input_hash(const std::string& role) const;
};

/// Specialised beside each type that stages exchange:
///   static constexpr const char* kind, *stage; static constexpr int schema;
/// Such a type also has, in the same namespace,
///   std::string encode(const T&);  void decode(const std::string& payload, T&);   (cereal portable binary)
template <class T>
struct ArtifactType;

/// What read_artifact returns.
template <class T>
struct Artifact {
    Header header;
    T value;
};

/// Version of varimap that headers record, with a hash of its sources: "0.1.0+1a2b3c4d".
std::string version();
/// 128-bit content hash as 32 hexadecimal digits.
std::string content_hash(const std::string& bytes);
/// Content hash of a whole file. Throws IoError.
std::string file_hash(const std::string& path);
/// The whole file. Throws IoError.
std::string read_file(const std::string& path);
/// Writes to a temporary name in the same folder, flushes to disk, then renames: the path holds either what
/// it held before or all of `bytes`. Throws IoError.
void write_file_atomically(const std::string& path, const std::string& bytes);

/// Reads and checks the header only. Throws ArtifactError (not an artifact, damaged header), IoError.
Header read_header(const std::string& path);
/// Reads header and payload; length, payload hash and end mark are checked before anything is parsed.
std::pair<Header, std::string> read_checked(const std::string& path);
/// As read_checked, and refuses any other kind or schema, naming the stage to rerun.
std::pair<Header, std::string> read_payload(const std::string& path, const std::string& kind, int schema,
                                            const std::string& stage);
/// Fills payload_bytes, payload_hash and version, then writes header, payload and end mark atomically.
void write_payload(const std::string& path, Header header, const std::string& payload);
/// The ASCII header as it is written.
std::string header_text(const Header& header);

/// Throws ArtifactError (damaged, of another kind or schema, or its parts contradict each other), IoError.
template <class T>
Artifact<T> read_artifact(const std::string& path) {
    using Type = ArtifactType<T>;
    auto [header, payload] = read_payload(path, Type::kind, Type::schema, Type::stage);
    Artifact<T> artifact{std::move(header), {}};
    decode(payload, artifact.value);
    return artifact;
}

}  // namespace varimap
