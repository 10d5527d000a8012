#pragma once

#include <random>
#include <string>
#include <vector>

namespace varimap::fuzz {

/// Makes hostile inputs from good ones: words, lines and numbers of texts are exchanged, repeated, lost and
/// replaced by extreme ones; fields of binary files likewise.
class Mutator {
  public:
    Mutator(const std::vector<std::string>& seeds, const std::vector<std::string>& dictionary)
        : seeds_(seeds), dictionary_(dictionary) {}

    /// The same for the same number, of at most `longest` bytes.
    std::string operator()(std::uint64_t number);
    static constexpr std::size_t longest = 1 << 16;

  private:
    void edit(std::string& bytes);
    void edit_word(std::string& bytes);
    void edit_line(std::string& bytes);
    void edit_field(std::string& bytes);
    void edit_stretch(std::string& bytes);
    std::size_t below(std::size_t count) { return count == 0 ? 0 : std::size_t(random_() % count); }
    std::string word();

    const std::vector<std::string>& seeds_;
    const std::vector<std::string>& dictionary_;
    std::mt19937_64 random_;
};

}  // namespace varimap::fuzz
