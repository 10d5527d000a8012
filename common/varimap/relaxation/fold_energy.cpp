#include "varimap/relaxation/fold_energy.h"

#include <cmath>

#include "varimap/quality/image_mesh.h"

namespace varimap {

FaceData<RestTriangle> rest_triangles(const TriangleMesh& source) {
    FaceData<RestTriangle> rest(source.face_count());
    for (int f = 0; f < source.face_count(); ++f) {
        if (is_degenerate(source, f)) continue;
        const double twice = face_normal(source, f).norm();
        rest[f].area = twice / 2;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = source.vertex(source.faces(f, k));
            const Vec3 a = source.vertex(source.faces(f, (k + 1) % 3)) - p;
            const Vec3 b = source.vertex(source.faces(f, (k + 2) % 3)) - p;
            rest[f].cotangent[k] = a.dot(b) / twice;
        }
    }
    return rest;
}

}  // namespace varimap
