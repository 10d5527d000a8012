#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/multilevel/pair_context.h"
#include "varimap/results/candidates.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

/// A surface, or another domain as SurfaceData holds it.
Artifact<Surface> read_surface_or_domain(Stage& stage, const std::string& role, const std::string& path);

/// The six per-surface (or per-domain) artifacts a solving stage reads, as its positional arguments, with
/// their lineage checked.
class PairInputs {
  public:
    /// `kind`: what their roles begin with, behind the side: "" or "sketch.".
    explicit PairInputs(Stage& stage, const std::string& kind = "");
    SurfaceData read_A(Stage& stage) { return read(stage, "A", A_); }
    SurfaceData read_B(Stage& stage) { return read(stage, "B", B_); }
    /// Refuses a plan that was made from other hierarchies than those read.
    void require_same(const Header& plan, const std::string& plan_path) const;
    /// Payload hash of the surface of which that of a side ("A" or "B") is a sketch.
    std::string sketched(const std::string& side) const;
    /// Refuses a surface of which that of a side is no sketch.
    void require_sketched(const std::string& side, const Header& surface, const std::string& path) const;
    /// Refuses candidates that were found on sketches of other surfaces than those read, or with another
    /// basis or hierarchy of these.
    void require_sketches(const Artifact<Candidates>& candidates, const std::string& path) const;
    /// Whether both sides are the same files, or files of the same content.
    bool are_same() const;
    /// Refuses self-maps of another surface than that of the side ("A" or "B").
    void require_self_maps(const Header& self_maps, const std::string& path, const std::string& side) const;

  private:
    struct Paths {
        const std::string &surface, &basis, &hierarchy;
    };
    static Paths declare(Stage& stage, const std::string& role);
    SurfaceData read(Stage& stage, const std::string& side, const Paths& paths);
    struct Headers {
        Header surface, basis, hierarchy;
    };
    const Paths& paths(const std::string& side) const { return side == "A" ? A_ : B_; }
    std::string kind_;
    Paths A_, B_;
    std::map<std::string, Headers> headers_;  ///< by side
};

/// Landmarks whose vertices have their files' numbers as those of the inputs. Throws InputError for a vertex
/// that is not on the surface.
Landmarks on_inputs(Landmarks landmarks, const Surface& A, const Surface& B);
/// Reads landmarks (vertex_list.h) and records their files as inputs, and how many one surface lacks.
Landmarks read_landmarks(Stage& stage, const std::vector<std::string>& files, const Surface& A,
                         const Surface& B, const LandmarkReading& reading);
/// A map from elsewhere, between the FILES of the surfaces (map_file.h), as what a map may begin from: both
/// ways the same pairs. Throws InputError where no vertex that is mapped has an image.
Correspondences correspondences_of(const PointMap& map, const Surface& A, const Surface& B);
/// The pair to solve for. Where landmarks are points (`points` is not empty), the vertices that stand for
/// them take their places, in space and in the eigenbasis.
PairContext pair_context(SurfaceData A, SurfaceData B, const VertexPairs<MeshVertex>& landmarks,
                         const PointPairs& points, double landmark_weight);
/// The same with landmarks of the inputs; throws as to_mesh_vertices.
PairContext pair_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight);
/// The pair to look for a map on, of sketches, which are too coarse to hold any number of landmarks apart:
/// of more than `few_landmarks` those beyond a hundred, and those that find no vertex of their own, are left
/// out, so that the rest has other rows. Throws as to_mesh_vertices.
PairContext sketch_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight);

}  // namespace varimap
