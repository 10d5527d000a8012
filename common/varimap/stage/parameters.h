#pragma once

#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace varimap {

/// One parameter of a stage: a name, where its value lives, its help text (with the unit) and its range.
struct Parameter {
    std::string name;
    std::variant<double*, int*, bool*, std::string*> value;
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
    const std::vector<Parameter>& all() const { return list_; }
    /// Names and values, in declaration order.
    std::vector<std::pair<std::string, std::string>> resolved() const;

  private:
    std::vector<Parameter> list_;
};

}  // namespace varimap
