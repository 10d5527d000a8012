#pragma once

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "varimap/core/enum_names.h"

namespace varimap {

/// Where an enumeration lives: reads and writes the number of its value among the parameter's choices.
struct EnumTarget {
    std::function<int()> read;
    std::function<void(int)> write;
};

/// One parameter of a stage: a name, where its value lives, its help text (with the unit) and its range.
struct Parameter {
    std::string name;
    std::variant<double*, int*, bool*, std::string*, EnumTarget> value;
    std::string help;
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices;

    /// The value as text that reads back to the same value, the same in every locale.
    std::string text() const;
};

/// A stage's parameters. Options, help, ranges and the artifact header all derive from this list, which
/// every parameter struct fills in its describe(ParameterList&).
class ParameterList {
  public:
    void add(std::string name, double& value, std::string help, double minimum, double maximum) {
        list_.push_back({std::move(name), &value, std::move(help), minimum, maximum, {}});
    }
    void add(std::string name, int& value, std::string help, int minimum, int maximum) {
        list_.push_back({std::move(name), &value, std::move(help), double(minimum), double(maximum), {}});
    }
    void add(std::string name, bool& value, std::string help) {
        list_.push_back({std::move(name), &value, std::move(help), 0, 1, {}});
    }
    void add(std::string name, std::string& value, std::string help, std::vector<std::string> choices) {
        list_.push_back({std::move(name), &value, std::move(help), 0, 0, std::move(choices)});
    }
    /// An enumeration by its names (core/enum_names.h).
    template <class Enum>
    requires std::is_enum_v<Enum>
    void add(std::string name, Enum& value, std::string help) {
        const EnumTarget target{[&value] { return int(value); }, [&value](int i) { value = Enum(i); }};
        list_.push_back({std::move(name), target, std::move(help), 0, 0, names_of<Enum>()});
    }
    const std::vector<Parameter>& all() const { return list_; }
    /// Names and values, in declaration order.
    std::vector<std::pair<std::string, std::string>> resolved() const;

  private:
    std::vector<Parameter> list_;
};

}  // namespace varimap
