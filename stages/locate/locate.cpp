#include "stages/locate/locate.h"

#include <utility>

#include "stages/locate/covered.h"
#include "stages/locate/search.h"
#include "stages/locate/sides.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/input_locator.h"

namespace varimap {

namespace {

/// Images on a whole's sketch carried to its surface, by way of the inputs.
class Carrier {
  public:
    Carrier(const PlacedPart& placed, const Sides& sketch, const Sides& surface)
        : placed_(placed),
          sketch_(sketch),
          surface_(surface),
          on_sketch_(sketch.part),
          closest_(surface.whole.mesh) {}

    PointMap images() const {
        PointMap images;
        for (const SurfacePoint& on_input : surface_.part.on_input) {
            const SurfacePoint at = on_sketch_(on_input);
            Vec3 place = Vec3::Zero(), normal = Vec3::Zero();
            for (int c = 0; c < 3; ++c) {
                const SurfacePoint& image = placed_.images[std::size_t(sketch_.part.mesh.faces(at.face, c))];
                place += at.barycentric[c] * position(sketch_.whole.mesh, image);
                normal += at.barycentric[c] * face_normal(sketch_.whole.mesh, image.face).normalized();
            }
            images.push_back(closest_(on_surface(place), normal).point);
        }
        return images;
    }

  private:
    /// From the coordinates of the sketch's mesh to those of the surface's.
    Vec3 on_surface(const Vec3& x) const {
        const Vec3 on_input = x / sketch_.whole.scale + sketch_.whole.centre;
        return (on_input - surface_.whole.centre) * surface_.whole.scale;
    }

    const PlacedPart& placed_;
    const Sides &sketch_, &surface_;
    MeshLocator on_sketch_;
    ClosestPoint closest_;
};

/// Landmarks stand on the region later.
void add_landmarks(const Sides& sides, FaceData<char>& region) {
    for (const int v : sides.landmarks_whole) region[sides.whole.on_input[std::size_t(v)].face] = 1;
}

double area_of(const TriangleMesh& mesh, const std::vector<int>& faces) {
    return surface_area({mesh.vertices, mesh.faces(faces, Eigen::all)});
}

}  // namespace

Place locate(const PairContext& sketches, const Surface& A, const Surface& B,
             const VertexPairs<MeshVertex>& landmarks, const LocateParams& params) {
    constexpr int fewest = 3;
    if (int(landmarks.size()) < fewest)
        throw UsageError("a part is placed by three landmarks or more: give --landmarks");
    const Sides sketch(sketches.A().surface, sketches.B().surface, sketches.landmarks(), params.part);
    const Sides surface(A, B, landmarks, params.part);
    const PartSize size = surface.size();
    log("the part has {:.1f}% of the whole's area; lengths of the whole are {:.3g} times its own",
        100 * size.share, size.scale);
    const PlacedPart rough = find_place(sketches, sketch, size.share, params);
    const PlacedPart placed =
        place(Carrier(rough, sketch, surface).images(), surface, size.share, params.placing);
    FaceData<char> covered = covered_faces(placed.images, surface.part.mesh, surface.whole);
    add_landmarks(surface, covered);
    PartRegion region = tidy_region(surface.whole.input, std::move(covered));
    const double area = area_of(surface.whole.input, region.faces);
    return {std::move(region), area / surface_area(surface.whole.input), size.scale, placed.strain};
}

}  // namespace varimap
