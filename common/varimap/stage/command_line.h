#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "varimap/stage/parameters.h"

namespace varimap {

/// What a stage's command line may hold, and after parse() what it held. Deques keep references valid.
struct CommandLine {
    /// What the text is: a file that is read, or anything else (an output, a folder, a word).
    enum class Use { input, other };
    struct Text {
        std::string name, help;
        Use use;
        std::string value;
    };
    struct TextList {
        std::string name, help;
        Use use;
        int minimum, maximum;
        std::vector<std::string> values;
    };
    struct Flag {
        std::string name, help;
        bool value = false;
    };

    std::string stage, summary;
    ParameterList parameters;
    std::deque<Text> positionals;   ///< required files, in their order on the command line
    std::optional<TextList> files;  ///< one or more files behind them
    std::deque<Text> options;
    std::deque<TextList> list_options;
    std::deque<Flag> flags;
    int threads = 0;
    std::string config;
    bool asks_parameters = false;
    std::string if_stale;  ///< folder that remembers hashes; empty: always run
    std::string stamp;     ///< what the files that are no artifacts were made from
    std::string error_file;
    std::string ran_file;  ///< takes the name of a stage that had something to do

    /// Fills the values. Returns text to print on stdout instead of running (--help, --version,
    /// --parameters, beside which there are only parameters and --config). Names of options may be written
    /// with dashes or underscores. Throws UsageError; IoError where the file of --config cannot be opened;
    /// error_file is known then.
    std::optional<std::string> parse(int argc, char** argv);
    /// The files that are read, with the roles they have in headers: an option's two files are NAME.A and
    /// NAME.B.
    std::vector<std::pair<std::string, std::string>> input_files() const;
};

}  // namespace varimap
