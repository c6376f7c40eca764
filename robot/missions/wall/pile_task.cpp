#include "robot/missions/wall/pile_task.h"

#include <cmath>
#include <utility>

#include "common/core/units.h"

namespace kiln {
namespace {

PileAnswer look(const PileDetector::Config& config, const BrickSweep& sweep, const SearchArea& area,
                const PileLayout& layout, const Eigen::Isometry3d& X_map_base) {
  const auto search = PileDetector(config).detect(sweep, area, layout);
  if (!search) return {{}, search.error().message, 0};
  const int candidates = static_cast<int>(search->candidates.size());
  if (search->found.empty()) return {{}, search->why, candidates};
  const PileDetection& pile = search->found.front();
  const Pose2 X_map_pile = projectToGround(X_map_base * pile.X_base_pile);
  const double yaw = projectToGround(X_map_base).yaw_rad;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw).toRotationMatrix();
  return {
      PileAnswer::Found{X_map_pile, turn * pile.covariance * turn.transpose(), pile.second_line},
      "", candidates};
}

}  // namespace

void PileTask::Config::visit(ConfigArchive& a) {
  a.section("detector", detector, "pile in the cloud");
  a.field("margin_m", margin_m, "m", 0, 10, "around where the pile may be");
  a.field("latency_s", latency_s, "s", 0, 5, "modelled latency in lockstep");
}

PileTask::PileTask(const Config& config, const WallSiteMap& site, Executor& executor)
    : config_(config),
      layout_(site.layout()),
      known_m_(site.known_m),
      known_rad_(site.known_deg * kDeg),
      question_(executor, "pile", config.latency_s) {}

void PileTask::begin(std::shared_ptr<const BrickSweep> sweep, const Pose2& X_map_base,
                     const Pose2& X_map_pile) {
  const Eigen::Isometry3d X_base_pile = toIsometry(inverse(X_map_base) * X_map_pile);
  // Where the pile's ends may be when both its place and its direction are wrong.
  const double reach_m = known_m_ + config_.margin_m;
  const double swing_m = 0.5 * layout_.length() * std::sin(known_rad_);
  SearchArea area;
  area.X_base_area = X_base_pile * Eigen::Translation3d(0.5 * layout_.length(),
                                                        0.5 * layout_.line_distance_m, 0.0);
  area.half_x_m = 0.5 * layout_.length() + reach_m;
  area.half_y_m = 0.5 * layout_.line_distance_m + reach_m + swing_m;
  area.x_expected = X_base_pile.linear().col(0);
  question_.ask([config = config_.detector, sweep = std::move(sweep), area, layout = layout_,
                 X = toIsometry(X_map_base)] { return look(config, *sweep, area, layout, X); });
}

}  // namespace kiln
