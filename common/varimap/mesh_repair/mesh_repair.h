#pragma once

#include <array>
#include <string>

#include "varimap/core/enum_names.h"
#include "varimap/mesh_repair/file_link.h"

namespace varimap {

/// Which components of a surface are mapped.
enum class Components : int { all = 0, largest = 1, outer = 2 };

template <>
struct EnumNames<Components> {
    static constexpr std::array names{"all", "largest", "outer"};
};

/// What is repaired; see repaired().
struct RepairOptions {
    std::string repair = "all";
    double weld_tolerance = 0;
    Components components = Components::outer;
    double least_component = 0.01;

    template <class List>
    void describe(List& list) {
        list.add("repair", repair,
                 "what is repaired: all, none, or some of weld,faces,sheets,components; the rest is refused",
                 {});
        list.add("weld_tolerance", weld_tolerance,
                 "boundary vertices as near as this to each other are one; units of sqrt(area); 0: a "
                 "hundredth of the boundary edges there",
                 0, 0.1);
        list.add(
            "components", components,
            "which components are mapped: all that are large enough; outer: of these not the inner walls; "
            "or the largest that is none");
        list.add("least_component", least_component,
                 "components of a smaller share of the area are left out, except the largest", 0, 1);
    }
};

/// How much was repaired.
struct RepairCounts {
    int welded = 0;              ///< vertices that joined a lower one
    int not_finite = 0;          ///< faces with a corner that is not a number
    int degenerate = 0;          ///< faces that name a vertex twice, after welding
    int duplicates = 0;          ///< faces that lie on another one
    int turned = 0;              ///< faces whose orientation was reversed
    int cut_edges = 0;           ///< edges of three or more faces, along which sheets were separated
    int opened_edges = 0;        ///< edges cut where a surface has one side only
    int split_vertices = 0;      ///< vertices that were given to several sheets
    int dropped_components = 0;  ///< components left out, but for inner walls
    double dropped_area = 0;     ///< their share of the area
    int cavities = 0;            ///< inner walls left out (cavities.h)
    double cavity_area = 0;      ///< their share of the area
    int closed_slits = 0;        ///< boundary loops without area closed (holes.h)
    int filled_holes = 0;        ///< boundary loops closed (holes.h)
    int filling_faces = 0;       ///< with so many faces
    int unfilled_holes = 0;      ///< loops that should have been, but could not
    int cut_handles = 0;         ///< handles cut through and tunnels closed (handles.h)
    int bridges = 0;             ///< tubes that join components (bridges.h)

    bool any() const {
        return welded + not_finite + degenerate + duplicates + turned + cut_edges + opened_edges +
                   split_vertices + dropped_components + cavities >
               0;
    }
};

/// A mesh that every room can work on, and the way back to its file.
struct RepairedMesh {
    TriangleMesh mesh;
    FileLink link;
    RepairCounts counts;
};

/// Makes the mesh of a file oriented and manifold, perhaps of several components. By `options.repair`:
///   weld        boundary vertices in the same place, or nearly (weld.h), become one: seams of textures,
///               separate triangles; and components that lie on others one with these. Other vertices inside
///               a surface stay apart
///   faces       faces with a corner that is not finite, that name a vertex twice, or that lie on another one
///               are dropped. Of two back to back, both, where they are a fin on a surface; else one
///   sheets      at edges of three or more faces sheets are separated: where as many faces run one way as the
///               other, the two beside a wedge inside belong together; else the flattest pairs do. Each fan
///               of faces round a vertex gets a vertex of its own. Faces that hang together and are not
///               oriented alike are: closed surfaces outwards, others as most of their area is; one-sided
///               ones are cut open
///   components  those left out by `options.components` and `options.least_component` are dropped
/// A mesh that needs none of this comes back as it is. What is not repaired is refused, as by
/// require_manifold (mesh/manifold.h), by an InputError that names `path` and the first place. Throws
/// InputError where no surface is left, UsageError for unknown words.
RepairedMesh repaired(const TriangleMesh& file, const RepairOptions& options, const std::string& path);

/// Whether the options ask for welding.
bool welds(const RepairOptions& options);

/// The file as it was read.
inline const TriangleMesh& file_of(const RepairedMesh& repaired) {
    return repaired.link.is_identity() ? repaired.mesh : repaired.link.file;
}

/// What was repaired, in words: "3 vertices welded, 1 face that lies on another dropped"; empty if nothing.
std::string in_words(const RepairCounts& counts);

}  // namespace varimap
