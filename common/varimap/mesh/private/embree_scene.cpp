#include "varimap/mesh/private/embree_scene.h"

#include <algorithm>
#include <cstddef>
#include <new>

#include "varimap/core/error.h"

namespace varimap {

namespace {

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, int triples) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(T), std::size_t(triples));
    if (!buffer && triples > 0) throw std::bad_alloc();
    return static_cast<T*>(buffer);
}

}  // namespace

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, const Vec3& centre, double scale)
    : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw Error(ExitCode::internal, "Embree cannot start on this processor");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no gaps along edges
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices =
        new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
        for (int i = 0; i < 3; ++i) vertices[3 * v + i] = float((mesh.vertices(v, i) - centre[i]) * scale);
    auto* faces = new_buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.face_count());
    std::copy(mesh.faces.data(), mesh.faces.data() + mesh.faces.size(), faces);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

}  // namespace varimap
