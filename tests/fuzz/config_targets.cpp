#include <fmt/format.h>

#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "varimap/core/error.h"
#include "varimap/stage/command_line.h"

namespace varimap::fuzz {
namespace {

struct Values {
    double weight = 1;
    int count = 3;
    bool on = true;
    std::string word = "zero";

    void describe(ParameterList& list) {
        list.add("weight", weight, "a number", 0., 10.);
        list.add("count", count, "a whole number", 1, 100);
        list.add("on", on, "a flag");
        list.add("word", word, "one of two", {"zero", "one"});
    }
    void require_in_range() const {
        if (!(weight >= 0 && weight <= 10) || count < 1 || count > 100 || (word != "zero" && word != "one"))
            throw std::logic_error("a value is out of range");
    }
};

void parse_arguments(std::vector<std::string> arguments) {
    Values values;
    CommandLine line;
    line.stage = "eigen";
    values.describe(line.parameters);
    std::vector<char*> argv{const_cast<char*>("varimap-eigen")};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    line.parse(int(arguments.size()) + 1, argv.data());
    values.require_in_range();
}

void read_config(const std::string& bytes) {
    const ScratchFile file(bytes, ".toml");
    parse_arguments({"--config", file.path()});
}

void read_parameter(const std::string& bytes) {
    // No argument can hold a zero byte.
    const std::string text = bytes.substr(0, bytes.find('\0'));
    for (const char* name : {"weight", "count", "on", "word"}) {
        try {
            parse_arguments({fmt::format("--{}={}", name, text)});
        } catch (const Error&) {
        }
    }
    parse_arguments({text});
}

}  // namespace

std::vector<Target> config_targets() {
    return {
        {"config",
         {"weight = 2.5\n[eigen]\ncount = 7\non = false\nword = \"one\"\n[refine]\ncount = 9\n# comment\n",
          "[eigen]\nweight=[1, 2]\n[[eigen]]\ncount=1\n"},
         {"[eigen]", "[refine]", "[", "]", "=", "\"", "'", "#", "count", "weight", "on", "true", "a.b=1"},
         read_config},
        {"parameter",
         {"2.5", "7", "true", "one", "--weight=3"},
         {"false", "zero", "--count", "--", "-"},
         read_parameter}};
}

}  // namespace varimap::fuzz
