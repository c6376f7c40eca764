#include "robot/sim/lidar_sensor.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/geom/frames.h"

namespace kiln::sim {
namespace {

constexpr int kLasers = 16;
constexpr double kFiring_s = 2.304e-6;  // VLP-16 manual: one laser after the other
// Elevation of laser 0..15 in firing order, degrees (VLP-16 manual).
constexpr std::array<int, kLasers> kElevation = {-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                 -7,  9, -5,  11, -3,  13, -1, 15};

/// Diffuse reflectivity as the sensor reports it, 0 to 100.
float reflectivity(Material m) {
  switch (m) {
    case Material::Floor:
    case Material::Ground:
      return 30;
    case Material::Wall:
      return 60;
    case Material::Furniture:
      return 45;
    case Material::Table:
      return 40;
    case Material::Acrylic:
      return 8;
    case Material::Frame:
      return 25;
    case Material::Plate:
      return 15;
    case Material::Wheel:
    case Material::Hose:
      return 6;
    default:
      return 35;
  }
}

}  // namespace

LidarSensor::LidarSensor(const LidarConfig& config, const RobotGeometry& robot,
                         const TrueRobot& truth, std::uint64_t seed)
    : config_(config),
      robot_(robot),
      X_flange_lidar_(truth.X_flange_lidar),
      random_(seed, "lidar") {
  Random bias(seed, "lidar bias");
  const double turn_rate = 2.0 * M_PI * config.rate_hz;
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    const double elevation = kElevation[laser] * kDeg;
    const double t = kFiring_s * static_cast<double>(laser);
    beams_[laser] = {static_cast<float>(std::cos(elevation)),
                     static_cast<float>(std::sin(elevation)), static_cast<float>(-turn_rate * t),
                     static_cast<float>(t), (kElevation[laser] + 15) / 2};
    bias_m_[laser] = bias.normal(config.bias_sigma_m);
  }
  for (std::size_t a = 0; a < kLasers; ++a) {
    for (std::size_t b = 0; b < kLasers; ++b) {
      if (beams_[b].ring == beams_[a].ring + 1) above_[a] = b;
      if (beams_[b].ring == beams_[a].ring - 1) below_[a] = b;
    }
  }
  for (int column = 0; column < config.columns; ++column) {
    for (const Beam& beam : beams_) table_.push_back(direction(column, beam, 0.0F, 0.0F));
  }
}

Stamp LidarSensor::columnTime(std::int64_t column) const {
  // Whole revolutions in nanoseconds, the rest by share, so that no error adds up.
  const std::int64_t turn_ns = fromSeconds(1.0 / config_.rate_hz).count();
  const std::int64_t turn = column / config_.columns, rest = column % config_.columns;
  return stampFromNanoseconds(turn * turn_ns + rest * turn_ns / config_.columns);
}

Eigen::Isometry3d LidarSensor::X_map_lidar(const SceneState& state) const {
  return state.X_map_base * robot_.X_base_flange(state.q) * X_flange_lidar_;
}

Eigen::Vector3f LidarSensor::direction(std::int64_t column, const Beam& beam, float turn,
                                       float tilt) const {
  const double share = static_cast<double>(column % config_.columns) / config_.columns;
  const float azimuth =
      static_cast<float>(M_PI - 2.0 * M_PI * share) + beam.azimuth_offset_rad + turn;
  const float ce = beam.cos_elevation - tilt * beam.sin_elevation,
              se = beam.sin_elevation + tilt * beam.cos_elevation;
  return {ce * std::cos(azimuth), ce * std::sin(azimuth), se};
}

void LidarSensor::fireColumn(std::int64_t column, const Eigen::Isometry3d& X_map_lidar) {
  const Eigen::Matrix3f R = X_map_lidar.linear().cast<float>();
  const Eigen::Vector3f origin = X_map_lidar.translation().cast<float>();
  columns_.push_back(column);
  rotations_.push_back(R);
  const Eigen::Vector3f* const aim =
      &table_[static_cast<std::size_t>(column % config_.columns) * kLasers];
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    directions_.push_back(aim[laser]);
    const bool acrylic = random_.uniform() < config_.acrylic_return;
    rays_.push_back({origin, R * directions_.back(), static_cast<float>(config_.max_range_m),
                     mask::kLidar | (acrylic ? mask::kAcrylic : 0)});
  }
}

/// One laser in 16 neighbouring columns sees 3 deg of the scene, one column 30 deg: packets of the
/// former are cast in two thirds of the time.
void LidarSensor::castColumns(const RayScene& scene) {
  const std::size_t columns = columns_.size();
  order_.clear();
  packed_rays_.clear();
  for (std::size_t first = 0; first < columns; first += kLasers) {
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      for (std::size_t c = first; c < std::min(columns, first + kLasers); ++c)
        order_.push_back(c * kLasers + laser);
    }
  }
  for (const std::size_t i : order_) packed_rays_.push_back(rays_[i]);
  packed_hits_.resize(order_.size());
  scene.rays().cast(packed_rays_, packed_hits_, true);
  hits_.resize(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) hits_[order_[k]] = packed_hits_[k];
}

/// Where a neighbouring column or laser meets another surface, four more rays within the footprint
/// say what the beam straddles; surfaces within mixing_depth_m blur into one range between them (a
/// mixed pixel).
void LidarSensor::mixEdges(const RayScene& scene) {
  const std::size_t columns = columns_.size();
  const float spread = static_cast<float>(config_.footprint_mrad * 1e-3 / 3.0);
  static constexpr float kOffsets[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  std::vector<std::size_t> edges;
  std::vector<Raycaster::Ray> extra;
  for (std::size_t c = 1; c + 1 < columns; ++c) {
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const std::size_t i = c * kLasers + laser;
      if (!hits_[i].valid()) continue;
      const float jump = 0.05F + 0.02F * hits_[i].range;
      const auto differs = [&](std::size_t j) {
        return !hits_[j].valid() || std::fabs(hits_[j].range - hits_[i].range) > jump;
      };
      // The next laser is 2 deg away: on the same plane its range differs too, by a known share.
      const auto leavesPlane = [&](std::size_t other) {
        const std::size_t j = c * kLasers + other;
        if (!hits_[j].valid()) return true;
        const float here = hits_[i].normal.dot(rays_[i].direction),
                    there = hits_[i].normal.dot(rays_[j].direction);
        return there * here <= 0.0F ||
               std::fabs(hits_[j].range - hits_[i].range * here / there) > jump;
      };
      const bool edge = differs(i - kLasers) || differs(i + kLasers) ||
                        (above_[laser] && leavesPlane(*above_[laser])) ||
                        (below_[laser] && leavesPlane(*below_[laser]));
      if (!edge) continue;
      edges.push_back(i);
      for (const auto& offset : kOffsets) {
        Raycaster::Ray ray = rays_[i];
        ray.direction = rotations_[c] * direction(columns_[c], beams_[laser], spread * offset[0],
                                                  spread * offset[1]);
        extra.push_back(ray);
      }
    }
  }
  std::vector<Raycaster::Hit> around(extra.size());
  scene.rays().cast(extra, around);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    Raycaster::Hit& hit = hits_[edges[e]];
    float sum = 2.0F * hit.range, weight = 2.0F;
    for (std::size_t k = 0; k < 4; ++k) {
      const Raycaster::Hit& other = around[4 * e + k];
      if (!other.valid() || std::fabs(other.range - hit.range) > config_.mixing_depth_m) continue;
      sum += other.range;
      weight += 1.0F;
    }
    hit.range = sum / weight;
  }
}

void LidarSensor::emitPoints() {
  const Stamp start = scan_->stamp;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const double column_s = toSeconds(columnTime(columns_[c]) - start);
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const std::size_t i = c * kLasers + laser;
      const double noise = random_.normal(config_.noise_sigma_m);
      const bool lost = random_.uniform() < config_.dropout;
      if (!hits_[i].valid() || lost) continue;
      const double range = hits_[i].range + bias_m_[laser] + noise;
      if (range < config_.min_range_m || range > config_.max_range_m) continue;
      const Eigen::Vector3f p = static_cast<float>(range) * directions_[i];
      const float facing = std::fabs(hits_[i].normal.dot(rays_[i].direction));
      const float shade = reflectivity(RayScene::material(hits_[i])) * (0.3F + 0.7F * facing);
      scan_->push(p.x(), p.y(), p.z(), static_cast<std::uint8_t>(std::clamp(shade, 0.0F, 100.0F)),
                  static_cast<std::uint8_t>(beams_[laser].ring),
                  static_cast<float>(column_s) + beams_[laser].time_offset_s);
    }
  }
}

PointCloudPtr LidarSensor::advance(const SceneState& before, const SceneState& after,
                                   const RayScene& scene) {
  if (!running_) {  // from the next whole revolution on
    const std::int64_t turn_ns = fromSeconds(1.0 / config_.rate_hz).count();
    next_column_ = (toNanoseconds(before.stamp) / turn_ns + 1) * config_.columns;
    running_ = true;
    scan_.reset();
  }
  rays_.clear();
  directions_.clear();
  columns_.clear();
  rotations_.clear();
  const Eigen::Isometry3d X0 = X_map_lidar(before), X1 = X_map_lidar(after);
  const double span = std::max(1e-9, toSeconds(after.stamp - before.stamp));
  PointCloudPtr done;
  const auto flush = [&] {
    if (columns_.empty()) return;
    castColumns(scene);
    mixEdges(scene);
    emitPoints();
    rays_.clear();
    directions_.clear();
    columns_.clear();
    rotations_.clear();
  };
  for (Stamp t = columnTime(next_column_); t <= after.stamp; t = columnTime(++next_column_)) {
    if (next_column_ % config_.columns == 0) {
      flush();
      if (scan_) done = scan_;
      scan_ = std::make_shared<PointCloud>();
      scan_->stamp = t;
      scan_->seq = ++seq_;
      scan_->frame = frames::kLidar;
      scan_->reserve(static_cast<std::size_t>(config_.columns) * kLasers);
    }
    fireColumn(next_column_,
               interpolate(X0, X1, std::clamp(toSeconds(t - before.stamp) / span, 0.0, 1.0)));
  }
  flush();
  return done;
}

}  // namespace kiln::sim
