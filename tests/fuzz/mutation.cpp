#include "fuzz/mutation.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace varimap::fuzz {
namespace {

const std::vector<std::string> number_words{"0",
                                            "-0",
                                            "-1",
                                            "1",
                                            "2",
                                            "3",
                                            "0.5",
                                            "1e308",
                                            "-1e308",
                                            "1e155",
                                            "1e60",
                                            "1e-320",
                                            "1e999",
                                            "nan",
                                            "inf",
                                            "-inf",
                                            "2147483647",
                                            "2147483648",
                                            "4294967295",
                                            "9223372036854775807",
                                            "-9223372036854775808",
                                            "18446744073709551616",
                                            "+1",
                                            "1.",
                                            ".",
                                            "0x10",
                                            "1e",
                                            "--1",
                                            "65536",
                                            "1000000000"};

const std::vector<std::int64_t> integers{0,
                                         1,
                                         -1,
                                         2,
                                         3,
                                         127,
                                         255,
                                         256,
                                         32767,
                                         65535,
                                         2147483647,
                                         2147483648,
                                         4294967295,
                                         std::int64_t(1) << 40,
                                         std::numeric_limits<std::int64_t>::max(),
                                         std::numeric_limits<std::int64_t>::min()};

const std::vector<double> reals{0,
                                -0.,
                                1,
                                -1,
                                .5,
                                1e308,
                                -1e308,
                                1e155,
                                1e-155,
                                1e-310,
                                1e10,
                                std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()};

/// Writes the first `count` bytes of a value, in either order.
template <class T>
void put(std::string& bytes, std::size_t at, T value, std::size_t count, bool reversed) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof raw);
    if (reversed) std::reverse(raw, raw + count);
    for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) bytes[at + i] = raw[i];
}

struct Stretch {
    std::size_t begin, end;
};

/// The stretch around `at` that the separators bound.
Stretch around(const std::string& bytes, std::size_t at, const char* separators) {
    const std::size_t before = at == 0 ? std::string::npos : bytes.find_last_of(separators, at - 1);
    return {before == std::string::npos ? 0 : before + 1,
            std::min(bytes.find_first_of(separators, at), bytes.size())};
}

}  // namespace

std::string Mutator::word() {
    const std::size_t which = below(3);
    if (which == 0 && !dictionary_.empty()) return dictionary_[below(dictionary_.size())];
    if (which == 1) return std::to_string(int(below(300)) - 20);
    return number_words[below(number_words.size())];
}

void Mutator::edit_word(std::string& bytes) {
    const Stretch at = around(bytes, below(bytes.size()), " \t\r\n,\"=:[]{}<>");
    switch (below(4)) {
        case 0:
            bytes.erase(at.begin, at.end - at.begin);
            break;
        case 1:
            bytes.insert(at.begin, word() + " ");
            break;
        default:
            bytes.replace(at.begin, at.end - at.begin, word());
    }
}

void Mutator::edit_line(std::string& bytes) {
    const Stretch from = around(bytes, below(bytes.size()), "\n"),
                  to = around(bytes, below(bytes.size()), "\n");
    const std::string line = bytes.substr(from.begin, from.end - from.begin);
    switch (below(4)) {
        case 0:
            bytes.erase(from.begin, from.end - from.begin + 1);
            break;
        case 1:
            bytes.insert(to.begin, line + "\n");
            break;
        case 2:
            bytes.replace(to.begin, to.end - to.begin, line);
            break;
        default:
            for (std::size_t i = below(200); i > 0 && bytes.size() < longest; --i)
                bytes.insert(to.begin, line + "\n");
    }
}

/// Fields of binary files stand anywhere.
void Mutator::edit_field(std::string& bytes) {
    const std::size_t at = below(bytes.size()), width = std::size_t(1) << below(4);
    const bool reversed = below(4) == 0;
    switch (below(5)) {
        case 0:
            put(bytes, at, integers[below(integers.size())], width, reversed);
            break;
        case 1:
            put(bytes, at, reals[below(reals.size())], 8, reversed);
            break;
        case 2:
            put(bytes, at, float(reals[below(reals.size())]), 4, reversed);
            break;
        case 3:
            put(bytes, at, std::int64_t(below(300)) - 20, width, reversed);
            break;
        default:
            if (at < bytes.size()) bytes[at] = char(bytes[at] ^ (1 << below(8)));
    }
}

void Mutator::edit_stretch(std::string& bytes) {
    const std::size_t from = below(bytes.size()), count = below(1 + below(256));
    const std::string& other = seeds_[below(seeds_.size())];
    const std::size_t there = below(other.size());
    switch (below(5)) {
        case 0:
            bytes.erase(from, count);
            break;
        case 1:
            bytes.insert(below(bytes.size()), bytes.substr(from, count));
            break;
        case 2:
            bytes.resize(from);
            break;
        case 3:
            bytes.replace(from, count, other.substr(there, count));
            break;
        default:
            bytes = bytes.substr(0, from) + other.substr(there);
    }
}

void Mutator::edit(std::string& bytes) {
    switch (below(8)) {
        case 0:
        case 1:
        case 2:
            return edit_word(bytes);
        case 3:
            return edit_line(bytes);
        case 4:
            return edit_stretch(bytes);
        default:
            return edit_field(bytes);
    }
}

std::string Mutator::operator()(std::uint64_t number) {
    random_.seed(number);
    std::string bytes = seeds_[below(seeds_.size())];
    for (std::size_t edits = 1 + below(1 + below(8)); edits > 0; --edits) edit(bytes);
    bytes.resize(std::min(bytes.size(), longest));
    return bytes;
}

}  // namespace varimap::fuzz
