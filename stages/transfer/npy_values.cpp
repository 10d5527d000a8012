#include "stages/transfer/values.h"
#include "varimap/mesh/io/npy_array.h"

namespace varimap {

ValueFile parse_npy_values(std::string_view bytes, const std::string& path) {
    const NpyArray array = parse_npy(bytes, path);
    const auto write = [type = array.type, flat = array.flat](const std::vector<ValueTable>& tables,
                                                              const TriangleMesh&) {
        return to_npy(NpyArray{type, flat, tables[0].values});
    };
    return {{ValueTable{Place::vertex, array.values}}, write};
}

}  // namespace varimap
