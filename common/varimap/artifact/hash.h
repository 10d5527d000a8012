#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace varimap {

/// Incremental content hash (XXH3, 128 bits).
class Hasher {
  public:
    Hasher();
    ~Hasher();
    void add(const char* bytes, std::size_t count);
    /// 32 hexadecimal digits, the same on every machine.
    std::string hexadecimal() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace varimap
