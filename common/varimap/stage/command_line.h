#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "varimap/stage/parameters.h"

namespace varimap {

/// What a stage's command line may hold, and after parse() what it held. Deques keep references valid.
struct CommandLine {
    struct Text {
        std::string name, help, value;
    };
    struct TextList {
        std::string name, help;
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
    bool asks_stale = false;
    std::vector<std::string> stale;

    /// Fills the values. Returns text to print on stdout instead of running (--help, --version).
    /// Throws UsageError; IoError where the file of --config cannot be opened.
    std::optional<std::string> parse(int argc, char** argv);
};

}  // namespace varimap
