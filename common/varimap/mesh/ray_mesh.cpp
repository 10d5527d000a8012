#include "varimap/mesh/ray_mesh.h"

#include <limits>

#include "varimap/mesh/private/embree_scene.h"

namespace varimap {

namespace {

RTCRay make_ray(const Vec3& origin, const Vec3& direction, double reach) {
    RTCRay ray{};
    ray.org_x = float(origin[0]), ray.org_y = float(origin[1]), ray.org_z = float(origin[2]);
    ray.dir_x = float(direction[0]), ray.dir_y = float(direction[1]), ray.dir_z = float(direction[2]);
    ray.tfar = float(reach);
    ray.mask = ~0u;
    return ray;
}

}  // namespace

RayMesh::RayMesh(const TriangleMesh& mesh)
    : scene_(std::make_unique<const EmbreeScene>(mesh, Vec3::Zero(), 1)) {}
RayMesh::~RayMesh() = default;
RayMesh::RayMesh(RayMesh&&) noexcept = default;

SurfacePoint RayMesh::first_hit(const Vec3& origin, const Vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit hit{make_ray(origin, direction, std::numeric_limits<float>::infinity()), {}};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_->get(), &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const double u = hit.hit.u, v = hit.hit.v;
    return {int(hit.hit.primID), Vec3(1 - u - v, u, v)};
}

bool RayMesh::is_blocked(const Vec3& origin, const Vec3& direction, double reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = make_ray(origin, direction, reach);
    rtcOccluded1(scene_->get(), &context, &ray);
    return ray.tfar < 0;
}

}  // namespace varimap
