#pragma once

#include <string>
#include <vector>

#include "stages/generate/params.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Two generated surfaces and what is known of the map between them.
struct GeneratedPair {
    std::string kind;
    TriangleMesh source, target;
    struct TruePair {
        double squared_distance;  ///< of the target's vertex from the true image, in the target's units
        int source, target;       ///< vertices
    };
    std::vector<TruePair> truth;  ///< those nearest to a vertex first
};

/// What `family` may be: "isometric", "any", "assembly", shapes::family_names() and shapes::merged_names(),
/// which see.
std::vector<std::string> generated_families();

/// A pair of that family; the target is scaled, turned, moved and renumbered. "isometric": a shape at rest
/// and the same one bent, differently tessellated. "assembly": two of a kind whose parts touch, each a
/// component of its own (assembly.h). Of merged_names: a body, and one grown
/// together with itself. Otherwise two members, each posed; both of genus 0;
/// of "any" the family and its parameters are drawn by the seed, and `kind` tells which it is.
/// Deterministic. Throws UsageError for an unknown family, and for parameters that the family has not.
GeneratedPair generate(const std::string& family, unsigned seed, const GenerateParams& params);

/// Members of one family and the same points on all of them.
struct GeneratedCollection {
    std::string kind;
    std::vector<TriangleMesh> meshes;
    std::vector<std::vector<int>> vertices;  ///< per member; row by row those at the same place of the body
};

/// `params.members` members of one of shapes::family_names(), scaled, turned, moved and renumbered. The
/// points are spread over the first; those that another has not are left out, and each is taken to the
/// nearest vertex. Deterministic. Throws UsageError as `generate` does.
GeneratedCollection generate_collection(const std::string& family, unsigned seed,
                                        const GenerateParams& params);

/// Writes KIND_000.ply and KIND_000.txt (vertices, row by row as those of the others) for each member into
/// the folder, which must be there (IoError).
void write_collection(const GeneratedCollection& collection, const std::string& folder);

/// Writes source.ply, target.ply, source.txt and target.txt (true pairs of vertices, row by row) and
/// landmarks.txt (six of them, far from each other) into the folder, which must be there (IoError).
void write_pair(const GeneratedPair& pair, const std::string& folder);

}  // namespace varimap
