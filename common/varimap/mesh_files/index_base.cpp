#include "varimap/mesh_files/index_base.h"

#include "varimap/core/error.h"

namespace varimap {

IndexBase index_base_from(const std::string& text) {
    if (text == "0") return IndexBase::zero;
    if (text == "1") return IndexBase::one;
    if (text == "auto" || text.empty()) return IndexBase::automatic;
    throw UsageError("index base '" + text + "': use 0, 1 or auto");
}

}  // namespace varimap
