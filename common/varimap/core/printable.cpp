#include "varimap/core/printable.h"

namespace varimap {

std::string printable(std::string_view text) {
    std::string shown(text.substr(0, 40));
    for (char& c : shown)
        if (c < ' ' || c > '~') c = '?';
    return shown;
}

}  // namespace varimap
