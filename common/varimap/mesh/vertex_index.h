#pragma once

#include <compare>
#include <utility>
#include <vector>

namespace varimap {

/// A vertex of a surface's input, from 0: a row of Surface::input. Where nothing was repaired, that is the
/// number users have for it; where something was, file_link.h leads there.
struct InputVertex {
    int index = -1;
    friend auto operator<=>(const InputVertex&, const InputVertex&) = default;
};

/// A vertex of a preprocessed surface: a row of Surface::mesh.
struct MeshVertex {
    int index = -1;
    friend auto operator<=>(const MeshVertex&, const MeshVertex&) = default;
};

/// Vertices of the source and of the target that belong together: landmarks.
template <class Vertex>
using VertexPairs = std::vector<std::pair<Vertex, Vertex>>;

}  // namespace varimap
