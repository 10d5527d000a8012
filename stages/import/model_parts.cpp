#include "stages/import/model_parts.h"

namespace varimap {
namespace {

int byte_at(std::string_view bytes, std::size_t at) {
    return static_cast<unsigned char>(bytes[at]);
}

}  // namespace

int model_parts_in_3mf(std::string_view zip) {
    // What stands in front of each name in the archive's list of files.
    constexpr std::string_view entry = "PK\x01\x02";
    constexpr std::size_t size_of_name = 28, name_of_file = 46;
    int count = 0;
    for (std::size_t at = zip.find(entry); at != zip.npos; at = zip.find(entry, at + 1)) {
        if (zip.size() - at < name_of_file) break;
        const int size = byte_at(zip, at + size_of_name) + 256 * byte_at(zip, at + size_of_name + 1);
        const std::string_view name = zip.substr(at + name_of_file, std::size_t(size));
        count += name.starts_with("3D/") && name.ends_with(".model");
    }
    return count;
}

}  // namespace varimap
