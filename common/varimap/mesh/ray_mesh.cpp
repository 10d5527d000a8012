#include "varimap/mesh/ray_mesh.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

#include "varimap/core/error.h"

namespace varimap {

struct RayMesh::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~State() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void build(const TriangleMesh& mesh);
};

void RayMesh::State::build(const TriangleMesh& mesh) {
    device = rtcNewDevice(nullptr);
    if (!device) throw Error(ExitCode::internal, "Embree cannot start on this processor");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no gaps along edges
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), size_t(mesh.vertex_count())));
    auto* faces =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       3 * sizeof(unsigned), size_t(mesh.face_count())));
    for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i) vertices[i] = float(mesh.vertices.data()[i]);
    std::copy(mesh.faces.data(), mesh.faces.data() + mesh.faces.size(), faces);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
}

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

RayMesh::RayMesh(const TriangleMesh& mesh) : state_(std::make_unique<State>()) {
    state_->build(mesh);
}
RayMesh::~RayMesh() = default;
RayMesh::RayMesh(RayMesh&&) noexcept = default;

SurfacePoint RayMesh::first_hit(const Vec3& origin, const Vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit hit{make_ray(origin, direction, std::numeric_limits<float>::infinity()), {}};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const double u = hit.hit.u, v = hit.hit.v;
    return {int(hit.hit.primID), Vec3(1 - u - v, u, v)};
}

bool RayMesh::is_blocked(const Vec3& origin, const Vec3& direction, double reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = make_ray(origin, direction, reach);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

}  // namespace varimap
