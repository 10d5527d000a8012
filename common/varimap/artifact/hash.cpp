#include "varimap/artifact/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace varimap {

struct Hasher::State {
    XXH3_state_t* xxh = XXH3_createState();
    ~State() { XXH3_freeState(xxh); }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
    if (state_->xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_->xxh);
}

Hasher::~Hasher() = default;

void Hasher::add(const char* bytes, std::size_t count) {
    XXH3_128bits_update(state_->xxh, bytes, count);
}

std::string Hasher::hexadecimal() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
    return fmt::format("{:016x}{:016x}", std::uint64_t(hash.high64), std::uint64_t(hash.low64));
}

}  // namespace varimap
