#include "robot/evaluation/bricks/sweep_synthesis.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/frames.h"
#include "common/geom/pose.h"
#include "robot/drivers/velodyne/codec/vlp16_decoder.h"
#include "robot/scene/primitive_meshes.h"

namespace kiln {
namespace {

constexpr double kFiring_s = 2.304e-6;  // VLP-16 manual: one laser after the other
constexpr auto& kElevation_deg = velodyne::Vlp16Decoder::kElevation_deg;

/// Lasers by elevation: the neighbours of one are the next rings.
std::array<std::array<int, 2>, 16> ringNeighbours() {
  std::array<std::array<int, 2>, 16> out{};
  for (std::size_t a = 0; a < 16; ++a) {
    out[a] = {-1, -1};
    for (std::size_t b = 0; b < 16; ++b) {
      if (kElevation_deg[b] == kElevation_deg[a] - 2) out[a][0] = static_cast<int>(b);
      if (kElevation_deg[b] == kElevation_deg[a] + 2) out[a][1] = static_cast<int>(b);
    }
  }
  return out;
}

void addBrick(Raycaster& rays, const TrueBrick& brick, double rounding_m) {
  // A cut at 45 degrees that touches the round edge in its middle.
  const TriangleMesh mesh = cutBox(brick.size_m, (2.0 - M_SQRT2) * rounding_m);
  rays.addMesh(mesh.vertices, mesh.triangles, brick.X_world_brick, 1);
}

}  // namespace

SweepSynthesis::SweepSynthesis(const SweepSensor& sensor, SceneRandom& random)
    : sensor_(sensor), random_(random) {
  std::normal_distribution<double> bias(0.0, sensor.bias_sigma_m);
  for (double& b : bias_m_) b = bias(random);
  std::normal_distribution<double> unit(0.0, 1.0);
  const auto draw = [&](double sigma) {
    return Eigen::Vector3d(sigma * unit(random), sigma * unit(random), sigma * unit(random));
  };
  const Eigen::Vector3d shift = draw(sensor.mount_sigma_m);
  mount_error_ = makePose(shift, draw(sensor.mount_sigma_deg * kDeg));
}

Eigen::Isometry3d SweepSynthesis::X_base_lidar(double t_s) const {
  const double share = std::clamp(t_s / sensor_.sweep_s, 0.0, 1.0);
  const double tilt =
      (sensor_.tilt_from_deg + share * (sensor_.tilt_to_deg - sensor_.tilt_from_deg)) * kDeg;
  return makePose({sensor_.ahead_m, 0.0, sensor_.height_m - sensor_.lever_m}, {0, tilt, 0}) *
         Eigen::Translation3d(0, 0, sensor_.lever_m);
}

Eigen::Vector3f SweepSynthesis::direction(int column, std::size_t laser, double turn,
                                          double tilt) const {
  const double share = static_cast<double>(column) / sensor_.columns +
                       kFiring_s * static_cast<double>(laser) * sensor_.rate_hz;
  const double azimuth = M_PI - 2.0 * M_PI * share + turn;  // clockwise, from the rear
  const double elevation = kElevation_deg[laser] * kDeg + tilt;
  return Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
      .cast<float>();
}

/// Where the next column or ring meets another body, four more rays within the footprint say what
/// the beam straddles; surfaces that are near to each other blur into one range between them.
void SweepSynthesis::mixEdges(const Raycaster& rays, const std::vector<Eigen::Matrix3f>& R,
                              int first_column) {
  static const auto kRings = ringNeighbours();
  static constexpr double kOffsets[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const double spread = sensor_.footprint_mrad * 1e-3 / 3.0;
  const std::size_t columns = R.size();
  std::vector<std::size_t> edges;
  std::vector<Raycaster::Ray> extra;
  for (std::size_t c = 1; c + 1 < columns; ++c) {
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const std::size_t i = c * kLasers + laser;
      if (!hits_[i].valid()) continue;
      const auto differs = [&](std::size_t j) {
        return hits_[j].instance != hits_[i].instance ||
               std::abs(hits_[j].range - hits_[i].range) > 0.05F + 0.02F * hits_[i].range ||
               hits_[j].normal.dot(hits_[i].normal) < 0.9F;
      };
      const auto otherRing = [&](int ring) {
        const std::size_t j = c * kLasers + static_cast<std::size_t>(std::max(0, ring));
        return ring >= 0 && (hits_[j].instance != hits_[i].instance ||
                             hits_[j].normal.dot(hits_[i].normal) < 0.9F);
      };
      if (!differs(i - kLasers) && !differs(i + kLasers) && !otherRing(kRings[laser][0]) &&
          !otherRing(kRings[laser][1]))
        continue;
      edges.push_back(i);
      for (const auto& offset : kOffsets) {
        Raycaster::Ray ray = rays_[i];
        ray.direction = R[c] * direction(first_column + static_cast<int>(c), laser,
                                         spread * offset[0], spread * offset[1]);
        extra.push_back(ray);
      }
    }
  }
  std::vector<Raycaster::Hit> around(extra.size());
  rays.cast(extra, around);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    Raycaster::Hit& hit = hits_[edges[e]];
    float sum = 2.0F * hit.range, weight = 2.0F;
    for (std::size_t k = 0; k < 4; ++k) {
      const Raycaster::Hit& other = around[4 * e + k];
      if (!other.valid() ||
          std::abs(other.range - hit.range) > static_cast<float>(sensor_.mixing_depth_m))
        continue;
      sum += other.range;
      weight += 1.0F;
    }
    hit.range = sum / weight;
  }
}

void SweepSynthesis::scan(int number, const Raycaster& rays, const Eigen::Isometry3d& X_world_base,
                          BrickSweep& out) {
  const double turn_s = 1.0 / sensor_.rate_hz, start_s = number * turn_s;
  const int half = static_cast<int>(sensor_.sector_deg / 360.0 * sensor_.columns);
  const int first = sensor_.columns / 2 - half;
  PointCloud cloud;
  cloud.stamp = Stamp{} + fromSeconds(start_s);
  cloud.frame = frames::kLidar;
  PoseTrack believed;  // joints and clock are exact; the mounting is as it was calibrated
  for (int k = 0; k <= 13; ++k) {
    const double t = k * 0.008;
    believed.push(cloud.stamp + fromSeconds(t), X_base_lidar(start_s + t));
  }
  std::vector<Eigen::Matrix3f> R;
  rays_.clear();
  for (int column = first; column < first + 2 * half; ++column) {
    const double t = turn_s * column / sensor_.columns;
    const Eigen::Isometry3d X = X_world_base * X_base_lidar(start_s + t) * mount_error_;
    R.push_back(X.linear().cast<float>());
    for (std::size_t laser = 0; laser < kLasers; ++laser)
      rays_.push_back({X.translation().cast<float>(), R.back() * direction(column, laser, 0.0, 0.0),
                       static_cast<float>(sensor_.max_range_m), 1});
  }
  hits_.resize(rays_.size());
  rays.cast(rays_, hits_);
  mixEdges(rays, R, first);
  std::normal_distribution<double> noise(0.0, sensor_.noise_sigma_m);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (int c = 0; c < 2 * half; ++c) {
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const Raycaster::Hit& hit = hits_[static_cast<std::size_t>(c) * kLasers + laser];
      const double off = bias_m_[laser] + noise(random_);
      const bool lost = chance(random_) < sensor_.dropout;
      const double range = static_cast<double>(hit.range) + off;
      if (!hit.valid() || lost || range < sensor_.min_range_m || range > sensor_.max_range_m)
        continue;
      const Eigen::Vector3f p = static_cast<float>(range) * direction(first + c, laser, 0.0, 0.0);
      cloud.push(p.x(), p.y(), p.z(), 40,
                 static_cast<std::uint8_t>((kElevation_deg[laser] + 15) / 2),
                 static_cast<float>(turn_s * (first + c) / sensor_.columns +
                                    kFiring_s * static_cast<double>(laser)));
    }
  }
  out.add(cloud, believed);
}

BrickSweep SweepSynthesis::sweep(const BrickScene& scene, const Eigen::Isometry3d& X_world_base,
                                 std::span<const ClutterBox> clutter) {
  Raycaster rays;
  rays.addBox({400, 400, 1}, Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.5)), 0);
  for (const TrueBrick& brick : scene.bricks) addBrick(rays, brick, sensor_.rounding_m);
  for (const ClutterBox& box : clutter) rays.addBox(box.size_m, box.X_world_box, 2);
  rays.commit();
  BrickSweep out;
  const int scans = static_cast<int>(sensor_.sweep_s * sensor_.rate_hz);
  for (int k = 0; k < scans; ++k) scan(k, rays, X_world_base, out);
  return out;
}

}  // namespace kiln
