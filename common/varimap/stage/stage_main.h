#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/stage/parameters.h"

namespace varimap {

/// An artifact that a stage has recorded as its input, and reads only where it comes to need it.
class RecordedInput {
  public:
    RecordedInput(std::string path, Header header) : path_(std::move(path)), header_(std::move(header)) {}
    const std::string& path() const { return path_; }
    const Header& header() const { return header_; }
    /// Throws as read_artifact, and IoError where the file is no longer the one that was recorded.
    template <class T>
    T read() const {
        Artifact<T> artifact = read_artifact<T>(path_);
        if (artifact.header.payload_hash != header_.payload_hash)
            throw IoError("'" + path_ + "' changed since this stage began; run again");
        return std::move(artifact.value);
    }

  private:
    std::string path_;
    Header header_;
};

/// One run of one stage: its command line, the artifacts it reads and writes, and what it recorded.
///
///   int main(int argc, char** argv) {
///       EigenParams params;
///       Stage stage("eigen", "Laplacian eigenbasis of a surface");
///       stage.parameters([&](ParameterList& list) { params.describe(list); });
///       const std::string& in = stage.input("surface", "artifact of varimap-preprocess");
///       const std::string& out = stage.output("basis", ArtifactType<Basis>::schema, "artifact to write");
///       return stage.main(argc, argv, [&] {
///           auto surface = stage.read<Surface>("surface", in);
///           stage.write(out, compute_basis(surface.value, params));
///       });
///   }
///
/// Every stage answers --help, --version, --threads N, --config FILE, --parameters (prints those that are not
/// at their defaults), and --if-stale FOLDER: does nothing where the output is whole and was made by this
/// version with these parameters from inputs of the same content, whatever the files' times say. While it
/// works a stage holds a lock on its output (file_lock.h), so runs that share artifacts make each once.
class Stage {
  public:
    Stage(const std::string& name, const std::string& summary);
    ~Stage();

    // Declaration, before main().
    void parameters(const std::function<void(ParameterList&)>& describe);
    /// A required positional file that is read.
    const std::string& input(const std::string& role, const std::string& help);
    /// A required positional that names no file to read.
    const std::string& word(const std::string& role, const std::string& help);
    /// One or more positional files behind the others.
    const std::vector<std::string>& input_list(const std::string& role, const std::string& help);
    /// The same of names that the stage looks at itself: there may be no such files.
    const std::vector<std::string>& word_list(const std::string& role, const std::string& help);
    /// The positional file that is written; at most one per stage. Schema 0: a file that is no artifact, such
    /// as a picture; it gets no side file, and --if-stale needs --stamp for it.
    const std::string& output(const std::string& kind, int schema, const std::string& help);
    /// Files that may be read besides: none where the value is empty.
    const std::string& input_option(const std::string& name, const std::string& help);
    const std::vector<std::string>& input_list_option(const std::string& name, const std::string& help,
                                                      int minimum = 1, int maximum = 1 << 20);
    /// Options that do not belong to the parameters: they do not change an artifact's meaning. --if-stale
    /// looks at flags where there is a stamp.
    const std::string& option(const std::string& name, const std::string& help);
    const bool& flag(const std::string& name, const std::string& help);
    /// A file that is written besides: none where the value is empty. As that of `output` it is refused
    /// before the body where it is an input (UsageError) or cannot be written (IoError).
    const std::string& output_option(const std::string& name, const std::string& help);

    /// Parses, runs `body`, reports; returns the process's exit code. Never throws.
    int main(int argc, char** argv, const std::function<void()>& body);

    // Inside body.
    /// Reads an artifact and records it as a direct input. Refuses (ArtifactError) one whose header says that
    /// it was made from another artifact or file than the rest of what this stage reads.
    template <class T>
    Artifact<T> read(const std::string& role, const std::string& path) {
        auto artifact = read_artifact<T>(path);
        record_input({role, artifact.header.kind, artifact.header.payload_hash});
        require_same_origin(role, artifact.header, path);
        return artifact;
    }
    /// The same of one that may not be needed: it is an input in any case.
    RecordedInput record(const std::string& role, const std::string& path);
    /// Records a foreign file (a mesh, a landmark list) as a direct input, by its content. Call it after
    /// reading: throws IoError where the file has changed since the stage began.
    void record_file(const std::string& role, const std::string& path);
    /// Refuses (ArtifactError) unless `child` was made from the artifact `parent` in that role.
    static void require_lineage(const Header& child, const std::string& child_path, const std::string& role,
                                const Header& parent, const std::string& parent_path);
    template <class T>
    void write(const std::string& path, const T& value) {
        using Type = ArtifactType<T>;
        write_encoded(path, Type::kind, Type::schema, encode(value));
    }
    /// Writes a file that is no artifact, atomically, and notes it for --stamp.
    void write_file(const std::string& path, const std::string& bytes);
    /// The output is no artifact but gets a side file all the same, with the hash of what the stage has found
    /// out; a side file with that hash stays as it is.
    void record_finding(const std::string& hash);
    /// A number for the side file <artifact>.run.json (levels, iterations, ...). Last value wins.
    void record_number(const std::string& name, double value);
    /// Number of threads of this run.
    int threads() const;
    /// Wall seconds, CPU seconds and peak memory in MB of this process so far.
    struct Usage {
        double wall_seconds, cpu_seconds, peak_megabytes;
    };
    Usage usage() const;

  private:
    void record_input(InputRecord record);
    void write_encoded(const std::string& path, const std::string& kind, int schema,
                       const std::string& payload);
    void require_same_origin(const std::string& role, const Header& header, const std::string& path);
    void require_origin(const std::string& role, const std::string& hash, const std::string& path);
    void write_run_file() const;
    void run(const std::function<void()>& body);
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace varimap
