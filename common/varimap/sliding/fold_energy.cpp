#include "varimap/sliding/fold_energy.h"

#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/unit_area.h"

namespace varimap {

FaceData<RestTriangle> rest_triangles(const TriangleMesh& source) {
    FaceData<RestTriangle> rest(source.face_count());
    for (int f = 0; f < source.face_count(); ++f) {
        if (is_degenerate(source, f)) continue;
        rest[f].area = face_normal(source, f).norm() / 2;
        rest[f].cotangent = corner_cotangents(source, f);
    }
    return rest;
}

}  // namespace varimap
