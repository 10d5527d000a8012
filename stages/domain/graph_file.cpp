#include "stages/domain/graph_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "stages/domain/point_rows.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {

namespace {

constexpr long long most_points = 10'000'000;

/// Edges, each once. Loops, as on a matrix's diagonal, say nothing.
class EdgeCollector {
  public:
    void add(const TextScanner& row, int a, int b, double weight) {
        if (!(weight > 0))
            row.fail(fmt::format("the weight {} is not positive; a graph needs positive weights", weight));
        if (a == b) return;
        const auto [known, is_new] = weight_.emplace(std::minmax(a, b), weight);
        if (!is_new && known->second != weight)
            row.fail(fmt::format("the edge has weight {} here and {} before", weight, known->second));
    }
    std::vector<DomainEdge> edges() const {
        std::vector<DomainEdge> result;
        for (const auto& [ends, weight] : weight_)
            result.push_back(edge_between(ends.first, ends.second, weight));
        return result;
    }

  private:
    std::map<std::pair<int, int>, double> weight_;
};

int point_number(const TextScanner& row, std::size_t word, long long first, long long last) {
    const long long number = row.integer(word, "point number");
    if (number < first || number > last)
        row.fail(fmt::format("there is no point {}; they are numbered from {} to {}", number, first, last));
    return int(number - first);
}

using Entries = std::set<std::pair<int, int>>;

void require_both_halves(const Entries& entries, const std::string& path) {
    for (const auto& [row, column] : entries)
        if (entries.count({column, row}) == 0)
            throw InputError(
                fmt::format("{}: a general matrix with an entry at {} {} (from 1), but none at {} {}; a "
                            "graph needs equal "
                            "halves, or 'symmetric' in the first line where one half stands for both",
                            path, row + 1, column + 1, column + 1, row + 1));
}

/// What a file says before its entries.
struct MatrixMarketHead {
    bool pattern = false;  ///< entries without values
    bool general = false;  ///< both halves are given
    long long points = 0, entries = 0;
};

bool next_row(TextScanner& row) {
    while (row.next_line())
        if (row.words()[0][0] != '%') return true;
    return false;
}

MatrixMarketHead read_head(TextScanner& row) {
    if (!row.next_line() || row.words()[0] != "%%MatrixMarket" || row.words().size() != 5 ||
        row.words()[1] != "matrix" || row.words()[2] != "coordinate")
        row.fail("a graph needs the first line '%%MatrixMarket matrix coordinate real symmetric'");
    MatrixMarketHead head;
    head.pattern = row.words()[3] == "pattern";
    if (!head.pattern && row.words()[3] != "real" && row.words()[3] != "integer")
        row.fail("entries of a graph are real, integer or pattern");
    head.general = row.words()[4] == "general";
    if (row.words()[4] != "symmetric" && !head.general)
        row.fail("the matrix of a graph is symmetric, or general with equal halves");
    if (!next_row(row) || row.words().size() != 3)
        row.fail("the numbers of rows, columns and entries are missing");
    head.points = row.integer(0, "number of rows");
    head.entries = row.integer(2, "number of entries");
    if (head.points != row.integer(1, "number of columns")) row.fail("the matrix of a graph is square");
    if (head.points < 1 || head.points > most_points)
        row.fail(fmt::format("{} points are none or too many", head.points));
    return head;
}

}  // namespace

DomainFile graph_from_rows(const std::string& path) {
    const std::string text = read_rows(path);
    Rows rows(text, path);
    EdgeCollector edges;
    int count = 0;
    while (rows.next()) {
        const TextScanner& row = rows.scanner;
        if (row.words().size() != 2 && row.words().size() != 3)
            row.fail("an edge needs two point numbers, and may have a weight");
        const int a = point_number(row, 0, 0, most_points), b = point_number(row, 1, 0, most_points);
        edges.add(row, a, b, row.words().size() == 3 ? finite(row, 2, "weight") : 1);
        count = std::max({count, a + 1, b + 1});
    }
    return {DomainKind::graph, count, {}, edges.edges(), false};
}

/// Not Eigen's unsupported MarketIO: it goes on after lines it cannot read, whose values it makes up.
DomainFile graph_from_matrix_market(const std::string& path) {
    const std::string bytes = read_file(path);
    TextScanner row(bytes, path, LineStyle::plain);
    const MatrixMarketHead head = read_head(row);
    EdgeCollector edges;
    Entries given;
    long long read = 0;
    for (; next_row(row); ++read) {
        if (row.words().size() != (head.pattern ? 2 : 3)) row.fail("an entry needs row, column and value");
        const int a = point_number(row, 0, 1, head.points), b = point_number(row, 1, 1, head.points);
        if (a != b) edges.add(row, a, b, head.pattern ? 1 : finite(row, 2, "weight"));
        if (head.general) given.emplace(a, b);
    }
    if (read != head.entries)
        row.fail(fmt::format("{} entries, where its head promises {}", read, head.entries));
    require_both_halves(given, path);
    return {DomainKind::graph, int(head.points), {}, edges.edges(), false};
}

}  // namespace varimap
