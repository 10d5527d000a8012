#include "stages/domain/point_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "varimap/artifact/artifact.h"
#include "varimap/core/lower_case.h"

namespace varimap {

namespace {

/// A heading without its quotes, in lower case.
std::string plain_heading(std::string_view word) {
    std::string heading;
    for (const char c : word)
        if (c != '"') heading += lower_case(c);
    return heading;
}

/// The columns called x, y and, where there is one, z; none where the first two are not there.
std::vector<std::size_t> columns_of_axes(const std::vector<std::string>& headings) {
    std::vector<std::size_t> columns;
    for (const char* axis : {"x", "y", "z"}) {
        const auto found = std::find(headings.begin(), headings.end(), axis);
        if (found != headings.end()) columns.push_back(std::size_t(found - headings.begin()));
        if (columns.size() < 2 && found == headings.end()) return {};
    }
    return columns;
}

Vec3 point_of_columns(const Rows& rows, const std::vector<std::size_t>& columns) {
    const TextScanner& row = rows.scanner;
    if (row.words().size() != rows.headings.size())
        row.fail(fmt::format("{} values, where the first row names {} columns", row.words().size(),
                             rows.headings.size()));
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < columns.size(); ++k)
        point[Eigen::Index(k)] = finite(row, columns[k], "coordinate");
    return point;
}

}  // namespace

std::string read_rows(const std::string& path) {
    std::string text(without_byte_order_mark(read_file(path), path));
    for (char& c : text)
        if (c == ',' || c == ';') c = ' ';
    return text;
}

bool Rows::next() {
    if (!scanner.next_line()) return false;
    const bool names = first_ && !is_number(scanner.words()[0]);
    first_ = false;
    if (!names) return true;
    for (const std::string_view word : scanner.words()) headings.push_back(plain_heading(word));
    return scanner.next_line();
}

double finite(const TextScanner& row, std::size_t word, const char* what) {
    const double value = row.number(word, what);
    if (!std::isfinite(value)) row.fail(fmt::format("{} {} is not finite", what, value));
    return value;
}

Vec3 point_from(const TextScanner& row, std::size_t first_word) {
    Vec3 point = Vec3::Zero();
    for (std::size_t k = first_word; k < row.words().size() && k < first_word + 3; ++k)
        point[Eigen::Index(k - first_word)] = finite(row, k, "coordinate");
    return point;
}

Points to_points(const std::vector<Vec3>& list) {
    Points points(list.size(), 3);
    for (std::size_t i = 0; i < list.size(); ++i) points.row(Eigen::Index(i)) = list[i].transpose();
    return points;
}

std::vector<Vec3> rows_of_points(const std::string& path) {
    const std::string text = read_rows(path);
    Rows rows(text, path);
    std::vector<Vec3> points;
    std::size_t columns = 0;
    while (rows.next()) {
        if (const auto axes = columns_of_axes(rows.headings); !axes.empty()) {
            points.push_back(point_of_columns(rows, axes));
            continue;
        }
        const std::size_t words = rows.scanner.words().size();
        if (words != 2 && words != 3) rows.scanner.fail("a point needs two or three coordinates");
        if (columns != 0 && words != columns)
            rows.scanner.fail(fmt::format("{} coordinates, where rows before have {}", words, columns));
        columns = words;
        points.push_back(point_from(rows.scanner, 0));
    }
    return points;
}

}  // namespace varimap
