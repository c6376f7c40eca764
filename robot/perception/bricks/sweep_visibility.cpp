#include "robot/perception/bricks/sweep_visibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/check.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr double kTrusted = 0.7, kReserve = 1.5;

}  // namespace

void SweepVisibility::Config::visit(ConfigArchive& a) {
  a.field("spacing_m", spacing_m, "m", 0.01, 0.2, "lattice on the faces");
  a.field("rate_hz", rate_hz, "1/s", 1, 40, "revolutions of the LiDAR");
  a.field("columns", columns, "", 100, 10000, "of a revolution");
  a.field("half_fov_deg", half_fov_deg, "deg", 1, 60, "above and below the LiDAR's horizon");
  a.field("laser_spacing_deg", laser_spacing_deg, "deg", 0.1, 10, "between neighbours");
  a.field("max_range_m", max_range_m, "m", 1, 100, "beyond it nothing counts");
}

SweepVisibility::SweepVisibility(const Config& config, std::vector<ModelBrick> bricks)
    : config_(config), model_({config.spacing_m, ModelCloudGenerator::Config{}.min_cosine}) {
  world_.bricks = std::move(bricks);
  // The lattice is the generator's own; a look from anywhere tells its sizes.
  world_.sensors = {Eigen::Vector3d::Zero()};
  const ModelCloud cloud = model_.generate(world_);
  for (std::size_t b = 0; b < world_.bricks.size(); ++b) {
    first_.push_back(areas_m2_.size());
    const Eigen::Vector3d size = brickSize(world_.bricks[b].kind);
    for (int f = 0; f < 6; ++f) {
      const FaceGrid& grid = cloud.lattice[b][static_cast<std::size_t>(f)];
      const double face_m2 = size.prod() / size[f / 2];
      areas_m2_.insert(areas_m2_.end(), grid.visible.size(), face_m2 / (grid.nu * grid.nv));
    }
  }
  first_.push_back(areas_m2_.size());
}

double SweepVisibility::returnsOn(const ModelPoint& point, double area_m2,
                                  const PlannedSweep& sweep) const {
  const Eigen::Vector3d p = point.p.cast<double>(), n = point.n.cast<double>();
  const double beam_rad2 = 2.0 * M_PI / config_.columns * config_.laser_spacing_deg * kDeg;
  double sum = 0.0;
  for (const Eigen::Isometry3d& X : sweep.X_world_lidar) {
    const Eigen::Vector3d d = X.inverse() * p;
    const double range = d.norm();
    if (range > config_.max_range_m || range < 1e-6) continue;
    const double elevation = std::asin(d.z() / range);
    if (std::abs(elevation) > config_.half_fov_deg * kDeg) continue;
    const double cosine = std::max(0.0, (X.translation() - p).dot(n) / range);
    sum += area_m2 * cosine / (range * range * beam_rad2 * std::cos(elevation));
  }
  return sum * sweep.duration_s * config_.rate_hz / static_cast<double>(sweep.X_world_lidar.size());
}

std::vector<float> SweepVisibility::returnsOf(const PlannedSweep& sweep) {
  KILN_CHECK(!sweep.X_world_lidar.empty(), "no pose of the LiDAR");
  world_.sensors = {sweep.X_world_lidar[sweep.X_world_lidar.size() / 2].translation()};
  const ModelCloud cloud = model_.generate(world_);
  std::vector<float> out(areas_m2_.size(), 0.0F);
  // Points stand in the order of the lattice: brick, face, cell.
  std::size_t next = 0, piece = 0;
  for (std::size_t b = 0; b < world_.bricks.size(); ++b)
    for (const FaceGrid& face : cloud.lattice[b])
      for (const std::uint8_t visible : face.visible) {
        if (visible != 0)
          out[piece] = static_cast<float>(returnsOn(cloud.points[next++], areas_m2_[piece], sweep));
        ++piece;
      }
  return out;
}

std::vector<double> SweepVisibility::cellsFound(std::span<const float> returns) const {
  KILN_CHECK(returns.size() == areas_m2_.size(), returns.size(), areas_m2_.size());
  std::vector<double> out;
  for (std::size_t b = 0; b + 1 < first_.size(); ++b) {
    double cells = 0.0;
    for (std::size_t i = first_[b]; i < first_[b + 1]; ++i) {
      const double in_piece = areas_m2_[i] / (kCell_m * kCell_m);
      cells += in_piece * (1.0 - std::exp(-static_cast<double>(returns[i]) / in_piece));
    }
    out.push_back(cells);
  }
  return out;
}

double cellsNeeded(const BrickPoseEstimator::Config& config) {
  return kReserve * kTrusted * 2.0 * config.min_expected;
}

}  // namespace kiln
