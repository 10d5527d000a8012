#include "varimap/stage/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "varimap/core/error.h"
#include "varimap/core/parse_number.h"
#include "varimap/core/printable.h"
#include "varimap/stage/parameter_text.h"

namespace varimap {
namespace {

std::string limit_text(const Parameter& parameter, double limit) {
    if (std::holds_alternative<int*>(parameter.value)) return fmt::format("{}", std::int64_t(limit));
    return fmt::format("{}", limit);
}

struct Assign {
    const Parameter& parameter;
    const std::string& text;
    const char* dashes = "--";  ///< before the name in messages

    [[noreturn]] void refuse() const {
        throw UsageError(fmt::format("{}{}: '{}' is not {}", dashes, parameter.name, printable(text),
                                     allowed_values(parameter)));
    }

    template <class Number>
    void operator()(Number* target) const {
        Number value{};
        // Written so that nan is refused too.
        if (!parse_number(text, value) || !(value >= parameter.minimum && value <= parameter.maximum) ||
            !std::isfinite(double(value)))
            refuse();
        *target = value;
    }
    void operator()(bool* target) const {
        if (text != "true" && text != "false") refuse();
        *target = text == "true";
    }
    void operator()(const EnumTarget& target) const {
        const auto& choices = parameter.choices;
        const auto found = std::find(choices.begin(), choices.end(), text);
        if (found == choices.end()) refuse();
        target.write(int(found - choices.begin()));
    }
    void operator()(std::string* target) const {
        const auto& choices = parameter.choices;
        const bool listed = std::find(choices.begin(), choices.end(), text) != choices.end();
        if ((!choices.empty() && !listed) || text.find('\n') != std::string::npos) refuse();
        *target = text;
    }
};

struct AsText {
    const Parameter& parameter;

    template <class Value>
    std::string operator()(const Value* target) const {
        return fmt::format("{}", *target);
    }
    std::string operator()(const EnumTarget& target) const {
        return parameter.choices[std::size_t(target.read())];
    }
};

}  // namespace

std::string Parameter::text() const {
    return std::visit(AsText{*this}, value);
}

std::vector<std::pair<std::string, std::string>> ParameterList::resolved() const {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto& parameter : list_) pairs.emplace_back(parameter.name, parameter.text());
    return pairs;
}

std::string allowed_values(const Parameter& parameter) {
    if (std::holds_alternative<bool*>(parameter.value)) return "true or false";
    if (!parameter.choices.empty()) return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
    if (std::holds_alternative<std::string*>(parameter.value)) return "one line of text";
    const bool whole = std::holds_alternative<int*>(parameter.value);
    return fmt::format("{} from {} to {}", whole ? "a whole number" : "a number",
                       limit_text(parameter, parameter.minimum), limit_text(parameter, parameter.maximum));
}

void assign(const Parameter& parameter, const std::string& text) {
    std::visit(Assign{parameter, text}, parameter.value);
}

void require_allowed(const ParameterList& list) {
    for (const auto& parameter : list.all())
        std::visit(Assign{parameter, parameter.text(), ""}, parameter.value);
}

}  // namespace varimap
