#pragma once

#include <string>
#include <vector>

#include "varimap/stage/parameters.h"

namespace varimap {

/// One line of a configuration file: an entry, or the head of a section where the name is empty.
struct ConfigLine {
    int number = 0;  ///< from 1
    std::string section, name, value;
};

/// Reads the TOML of parameter files: `[SECTION]`, `NAME = VALUE`, comments behind #; a value is a number,
/// true, false or a string in quotes without escapes. `path` is for messages. Throws UsageError naming the
/// file and the line for anything else, and for what is given twice.
std::vector<ConfigLine> parse_config(const std::string& text, const std::string& path);

/// Gives the parameters the values that the file at `path` has for them, in the section named after the stage
/// or in none. One file serves all stages: the sections of others do not count. Throws UsageError (a section
/// that is no stage's, an entry that is no parameter, a value it may not have: with file, line and the
/// nearest known name), IoError.
void assign_config(const std::string& path, const std::string& stage, const ParameterList& parameters);

/// All that is named varimap-NAME.
const std::vector<std::string>& stage_names();

}  // namespace varimap
