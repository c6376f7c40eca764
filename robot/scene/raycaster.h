#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace kiln {

/// Rays against instanced boxes, cylinders, spheres and meshes, on Embree in packets of 16
/// (simulation.md section 2). One piece of code for the simulated sensors and for perception's
/// model clouds.
///
/// Each instance has a material number (the caller's meaning) and a mask; a ray meets only
/// instances whose mask shares a bit with its own. So "blocks infrared but lets LiDAR through" is a
/// bit that some rays leave out. Confined to one thread; separate Raycasters are independent.
class Raycaster {
 public:
  using Id = std::uint32_t;
  struct Ray {
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
    Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  ///< unit length: then ranges are metres
    float max_range = 1e30F;
    std::uint32_t mask = 0xffffffffU;
  };
  struct Hit {
    static constexpr Id kNone = 0xffffffffU;
    float range = -1.0F;  ///< metres along the ray; < 0: nothing was met
    Id instance = kNone;
    std::uint32_t material = 0;
    Eigen::Vector3f normal =
        Eigen::Vector3f::Zero();  ///< unit, in the scene frame, against the ray
    [[nodiscard]] bool valid() const { return instance != kNone; }
  };

  Raycaster();
  ~Raycaster();
  Raycaster(const Raycaster&) = delete;
  Raycaster& operator=(const Raycaster&) = delete;

  /// @param size_m full lengths. Pose: of the box centre.
  Id addBox(const Eigen::Vector3d& size_m, const Eigen::Isometry3d& X_scene_box,
            std::uint32_t material, std::uint32_t mask = 1);
  /// Closed, along Z of its pose, centred.
  Id addCylinder(double radius_m, double length_m, const Eigen::Isometry3d& X_scene_cylinder,
                 std::uint32_t material, std::uint32_t mask = 1);
  Id addSphere(double radius_m, const Eigen::Vector3d& p_scene, std::uint32_t material,
               std::uint32_t mask = 1);
  /// Triangles index `vertices_m`; both sides are met. @pre indices in range.
  Id addMesh(std::span<const Eigen::Vector3f> vertices_m,
             std::span<const Eigen::Vector3i> triangles, const Eigen::Isometry3d& X_scene_mesh,
             std::uint32_t material, std::uint32_t mask = 1);

  void setPose(Id id, const Eigen::Isometry3d& X_scene_instance);
  void setMask(Id id, std::uint32_t mask);  ///< 0: invisible to every ray
  /// Takes over all changes since the last commit; about 0.1 ms for 100 instances. @pre before any
  /// cast.
  void commit();

  /// Nearest hits. @param coherent neighbours in `rays` point nearly the same way (camera tiles):
  /// faster.
  /// @pre hits.size() == rays.size().
  void cast(std::span<const Ray> rays, std::span<Hit> hits, bool coherent = false) const;
  /// Whether anything is met within max_range. @pre blocked.size() == rays.size().
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
