#include "robot/scene/raycaster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include "common/core/check.h"
#include "robot/scene/primitive_meshes.h"

namespace kiln {
namespace {

constexpr std::size_t kPacket = 16;

/// Embree is fastest, and alike everywhere, with denormals off (its manual). Restores the caller's
/// mode.
class DenormalsOff {
 public:
  DenormalsOff() : before_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~DenormalsOff() { _mm_setcsr(before_); }
  DenormalsOff(const DenormalsOff&) = delete;
  DenormalsOff& operator=(const DenormalsOff&) = delete;

 private:
  unsigned before_;
};

void onEmbreeError(void*, RTCError code, const char* text) {
  checkFailed(__FILE__, __LINE__, "Embree call",
              fmt::format("error {}: {}", static_cast<int>(code), text));
}

}  // namespace

struct Raycaster::Impl {
  struct Instance {
    RTCGeometry geometry = nullptr;
    RTCScene own_scene = nullptr;  // of a mesh; the shared shapes belong to `shapes`
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
    Eigen::Vector3f inverse_scale = Eigen::Vector3f::Ones();
    std::uint32_t material = 0;
  };
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::array<RTCScene, 3> shapes{};  // unit box, cylinder, sphere
  std::vector<Instance> instances;

  RTCScene makeScene(const TriangleMesh& mesh) const;
  Id add(RTCScene shape, bool own, const Eigen::Vector3d& scale, const Eigen::Isometry3d& X,
         std::uint32_t material, std::uint32_t mask);
  void setTransform(Instance& instance, const Eigen::Isometry3d& X) const;
};

RTCScene Raycaster::Impl::makeScene(const TriangleMesh& mesh) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                        RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                        mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    std::copy_n(mesh.vertices[i].data(), 3, v + 3 * i);
  auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                           RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                           mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      t[3 * i + static_cast<std::size_t>(k)] = static_cast<unsigned>(mesh.triangles[i][k]);
  }
  rtcCommitGeometry(geometry);
  RTCScene out = rtcNewScene(device);
  rtcAttachGeometry(out, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(out);
  return out;
}

void Raycaster::Impl::setTransform(Instance& instance, const Eigen::Isometry3d& X) const {
  float m[12];  // column-major 3x4
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r)
      m[3 * c + r] = static_cast<float>(X.linear()(r, c) * instance.scale[c]);
  }
  for (int r = 0; r < 3; ++r) m[9 + r] = static_cast<float>(X.translation()[r]);
  rtcSetGeometryTransform(instance.geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m);
  instance.rotation = X.linear().cast<float>();
}

Raycaster::Id Raycaster::Impl::add(RTCScene shape, bool own, const Eigen::Vector3d& scale,
                                   const Eigen::Isometry3d& X, std::uint32_t material,
                                   std::uint32_t mask) {
  Instance instance;
  instance.geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  instance.own_scene = own ? shape : nullptr;
  instance.scale = scale;
  instance.inverse_scale = scale.cwiseInverse().cast<float>();
  instance.material = material;
  rtcSetGeometryInstancedScene(instance.geometry, shape);
  rtcSetGeometryTimeStepCount(instance.geometry, 1);
  rtcSetGeometryMask(instance.geometry, mask);
  setTransform(instance, X);
  rtcCommitGeometry(instance.geometry);
  const Id id = static_cast<Id>(instances.size());
  rtcAttachGeometryByID(scene, instance.geometry, id);
  instances.push_back(instance);
  return id;
}

Raycaster::Raycaster() : impl_(std::make_unique<Impl>()) {
  // One thread: lockstep runs must not depend on a pool, and the scenes are small.
  impl_->device = rtcNewDevice("threads=1,set_affinity=0");
  KILN_CHECK(impl_->device != nullptr, "Embree gives no device");
  rtcSetDeviceErrorFunction(impl_->device, onEmbreeError, nullptr);
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
  impl_->shapes = {impl_->makeScene(unitBox()), impl_->makeScene(unitCylinder()),
                   impl_->makeScene(unitSphere())};
}

Raycaster::~Raycaster() {
  for (const Impl::Instance& instance : impl_->instances) {
    rtcReleaseGeometry(instance.geometry);
    if (instance.own_scene != nullptr) rtcReleaseScene(instance.own_scene);
  }
  rtcReleaseScene(impl_->scene);
  for (RTCScene shape : impl_->shapes) rtcReleaseScene(shape);
  rtcReleaseDevice(impl_->device);
}

Raycaster::Id Raycaster::addBox(const Eigen::Vector3d& size, const Eigen::Isometry3d& X,
                                std::uint32_t material, std::uint32_t mask) {
  return impl_->add(impl_->shapes[0], false, size, X, material, mask);
}

Raycaster::Id Raycaster::addCylinder(double radius, double length, const Eigen::Isometry3d& X,
                                     std::uint32_t material, std::uint32_t mask) {
  return impl_->add(impl_->shapes[1], false, {radius, radius, length}, X, material, mask);
}

Raycaster::Id Raycaster::addSphere(double radius, const Eigen::Vector3d& p, std::uint32_t material,
                                   std::uint32_t mask) {
  return impl_->add(impl_->shapes[2], false, Eigen::Vector3d::Constant(radius),
                    Eigen::Isometry3d(Eigen::Translation3d(p)), material, mask);
}

Raycaster::Id Raycaster::addMesh(std::span<const Eigen::Vector3f> vertices,
                                 std::span<const Eigen::Vector3i> triangles,
                                 const Eigen::Isometry3d& X, std::uint32_t material,
                                 std::uint32_t mask) {
  TriangleMesh mesh;
  mesh.vertices.assign(vertices.begin(), vertices.end());
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    KILN_CHECK(t.minCoeff() >= 0 && t.maxCoeff() < static_cast<int>(vertices.size()),
               "triangle index", t.maxCoeff());
  }
  return impl_->add(impl_->makeScene(mesh), true, Eigen::Vector3d::Ones(), X, material, mask);
}

void Raycaster::setPose(Id id, const Eigen::Isometry3d& X) {
  impl_->setTransform(impl_->instances[id], X);
  rtcCommitGeometry(impl_->instances[id].geometry);
}

void Raycaster::setMask(Id id, std::uint32_t mask) {
  rtcSetGeometryMask(impl_->instances[id].geometry, mask);
  rtcCommitGeometry(impl_->instances[id].geometry);
}

void Raycaster::commit() {
  const DenormalsOff mode;
  rtcCommitScene(impl_->scene);
}

namespace {

void fillRays(std::span<const Raycaster::Ray> rays, RTCRay16& packet, int* valid) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    const Raycaster::Ray& ray = rays[std::min(i, rays.size() - 1)];
    packet.org_x[i] = ray.origin.x();
    packet.org_y[i] = ray.origin.y();
    packet.org_z[i] = ray.origin.z();
    packet.dir_x[i] = ray.direction.x();
    packet.dir_y[i] = ray.direction.y();
    packet.dir_z[i] = ray.direction.z();
    packet.tnear[i] = 0.0F;
    packet.tfar[i] = ray.max_range;
    packet.time[i] = 0.0F;
    packet.mask[i] = ray.mask;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
}

}  // namespace

void Raycaster::cast(std::span<const Ray> rays, std::span<Hit> hits, bool coherent) const {
  KILN_CHECK(rays.size() == hits.size(), rays.size(), hits.size());
  const DenormalsOff mode;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t n = std::min(kPacket, rays.size() - first);
    RTCRayHit16 packet;
    alignas(64) int valid[kPacket];
    fillRays(rays.subspan(first, n), packet.ray, valid);
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(valid, impl_->scene, &context, &packet);
    for (std::size_t i = 0; i < n; ++i) {
      Hit& hit = hits[first + i];
      hit = Hit{};
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const Impl::Instance& instance = impl_->instances[packet.hit.instID[0][i]];
      hit.range = packet.ray.tfar[i];
      hit.instance = packet.hit.instID[0][i];
      hit.material = instance.material;
      // Embree gives the normal in the shape's own, unscaled frame.
      const Eigen::Vector3f local(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
      hit.normal = (instance.rotation * local.cwiseProduct(instance.inverse_scale)).normalized();
      if (hit.normal.dot(rays[first + i].direction) > 0.0F) hit.normal = -hit.normal;
    }
  }
}

void Raycaster::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  KILN_CHECK(rays.size() == blocked.size(), rays.size(), blocked.size());
  const DenormalsOff mode;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t n = std::min(kPacket, rays.size() - first);
    RTCRay16 packet;
    alignas(64) int valid[kPacket];
    fillRays(rays.subspan(first, n), packet, valid);
    rtcOccluded16(valid, impl_->scene, &context, &packet);
    for (std::size_t i = 0; i < n; ++i) blocked[first + i] = packet.tfar[i] < 0.0F ? 1 : 0;
  }
}

}  // namespace kiln
