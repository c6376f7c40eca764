#include "robot/localization/mapping/map_builder.h"

#include <algorithm>
#include <cmath>

#include "common/core/log.h"
#include "common/core/units.h"

namespace kiln {
namespace {

constexpr int kMinKeyframes = 3;
constexpr int kMaxEdges = 2000;  // of a scan, for posts

/// Covariance of a registration, given in map about the base, as one of an edge: in the frame of
/// the edge's first node.
Eigen::Matrix<double, 6, 6> inFrame(const Eigen::Matrix<double, 6, 6>& in_map,
                                    const Eigen::Isometry3d& X_map_from) {
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = X_map_from.linear().transpose();
  return turn * in_map * turn.transpose();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

void MapBuilder::Config::visit(ConfigArchive& a) {
  a.field("keyframe_distance_m", keyframe_distance_m, "m", 0.05, 10, "driven between keyframes");
  a.field("keyframe_turn_deg", keyframe_turn_deg, "deg", 1, 180, "or turned");
  a.field("max_keyframes", max_keyframes, "", 3, 5000, "more scans are left out");
  a.field("odometry_sigma_m", odometry_sigma_m, "m", 0.001, 1, "1-sigma of a step");
  a.field("odometry_sigma_per_m", odometry_sigma_per_m, "m/m", 0, 1, "and of each metre");
  a.field("odometry_sigma_deg", odometry_sigma_deg, "deg", 0.01, 45, "yaw of a step");
  a.field("odometry_tilt_sigma_deg", odometry_tilt_sigma_deg, "deg", 0.01, 45, "roll and pitch");
  a.field("loop_distance_m", loop_distance_m, "m", 0.1, 10, "nearer keyframes are one place");
  a.field("loop_gap", loop_gap, "", 3, 1000, "keyframes between the two visits");
  a.field("loop_neighbours", loop_neighbours, "", 0, 20, "make the local map of the first visit");
  a.field("polish_rounds", polish_rounds, "", 0, 10, "each scan against all the others");
  a.field("overlap_m", overlap_m, "m", 0, 10, "of the two maps, each side of the doorway");
  a.section("working", working, "map while building");
  a.section("shipped", shipped, "map of each segment");
  a.section("matcher", matcher, "scan against map");
}

MapBuilder::MapBuilder(Config config, const ArenaMap& arena)
    : config_(std::move(config)), arena_(arena), X_map_base_near_(toIsometry(arena.start.pose())) {}

void MapBuilder::startRun(const Pose2& X_map_base_near) {
  X_map_base_near_ = toIsometry(X_map_base_near);
  new_run_ = true;
}

bool MapBuilder::isFarFromLast(const Pose2& X_odom_base) const {
  const Pose2 step = inverse(keyframes_.back().X_odom_base) * X_odom_base;
  return std::hypot(step.x_m, step.y_m) >= config_.keyframe_distance_m ||
         std::abs(step.yaw_rad) >= config_.keyframe_turn_deg * kDeg;
}

Result<bool> MapBuilder::addScan(PointCloud scan_base, const Pose2& X_odom_base,
                                 const Eigen::Vector3d& p_base_sensor) {
  ++report_.scans;
  if (!new_run_ && !isFarFromLast(X_odom_base)) return false;
  if (static_cast<int>(keyframes_.size()) >= config_.max_keyframes) return false;
  Keyframe keyframe{std::move(scan_base), X_odom_base, p_base_sensor, new_run_};
  if (keyframes_.empty()) {
    if (keyframe.scan_base.size() < static_cast<std::size_t>(config_.matcher.min_patches))
      return makeError(ErrorCode::Degenerate, "the first scan has only {} points",
                       keyframe.scan_base.size());
    accept(std::move(keyframe), X_map_base_near_);
    return true;
  }
  const ScanMatcher matcher(config_.matcher, working_);
  const Eigen::Isometry3d predicted =
      new_run_ ? X_map_base_near_
               : poses_.back() * toIsometry(inverse(keyframes_.back().X_odom_base) * X_odom_base);
  const auto match = new_run_
                         ? matcher.search(keyframe.scan_base, predicted, keyframe.p_base_sensor)
                         : matcher.match(keyframe.scan_base, predicted, keyframe.p_base_sensor);
  if (!match) {
    ++report_.refused;
    return tl::make_unexpected(match.error());
  }
  const int node = static_cast<int>(keyframes_.size());
  if (!keyframe.first_of_run) addOdometryEdge(keyframe);
  const Eigen::Isometry3d& X_map_last = poses_.back();
  edges_.push_back({node - 1, node, EdgeKind::Registration,
                    X_map_last.inverse() * match->X_map_base,
                    inFrame(match->covariance, X_map_last)});
  accept(std::move(keyframe), match->X_map_base);
  return true;
}

void MapBuilder::addOdometryEdge(const Keyframe& keyframe) {
  const Pose2 step = inverse(keyframes_.back().X_odom_base) * keyframe.X_odom_base;
  const double distance = std::hypot(step.x_m, step.y_m);
  const double along = config_.odometry_sigma_m + config_.odometry_sigma_per_m * distance;
  const double tilt = config_.odometry_tilt_sigma_deg * kDeg,
               yaw = config_.odometry_sigma_deg * kDeg;
  PoseEdge edge;
  edge.to = static_cast<int>(keyframes_.size());
  edge.from = edge.to - 1;
  edge.kind = EdgeKind::Odometry;
  edge.X_from_to = toIsometry(step);
  edge.covariance.diagonal() << along * along, along * along, along * along, tilt * tilt,
      tilt * tilt, yaw * yaw;
  edges_.push_back(edge);
}

void MapBuilder::accept(Keyframe keyframe, const Eigen::Isometry3d& X_map_base) {
  if (keyframes_.empty())
    working_ = std::make_shared<SurfelMap>(config_.working, X_map_base.translation());
  inserted_.push_back(
      working_->insert(pointsInMap(keyframe, X_map_base), X_map_base * keyframe.p_base_sensor));
  working_->refresh();
  keyframes_.push_back(std::move(keyframe));
  poses_.push_back(X_map_base);
  new_run_ = false;
}

std::shared_ptr<SurfelMap> MapBuilder::mapOf(const std::vector<int>& nodes,
                                             const SurfelMap::Config& config,
                                             const Eigen::Vector3d& p_map_center) const {
  auto map = std::make_shared<SurfelMap>(config, p_map_center);
  PostCollector posts;
  for (const int node : nodes) {
    const auto n = static_cast<std::size_t>(node);
    const Keyframe& keyframe = keyframes_[n];
    map->insert(pointsInMap(keyframe, poses_[n]), poses_[n] * keyframe.p_base_sensor);
    posts.add(findEdges(keyframe.scan_base, keyframe.p_base_sensor, kMaxEdges), poses_[n]);
  }
  map->setPosts(posts.posts());
  map->forgetScans();
  map->refresh();
  return map;
}

void MapBuilder::closeLoops() {
  int last_closed = -config_.loop_gap;
  for (int node = config_.loop_gap; node < static_cast<int>(poses_.size()); ++node) {
    if (node - last_closed < config_.loop_neighbours + 1) continue;
    int best = -1;
    double best_m = config_.loop_distance_m;
    for (int old = 0; old + config_.loop_gap <= node; ++old) {
      const double away = (poses_[static_cast<std::size_t>(old)].translation() -
                           poses_[static_cast<std::size_t>(node)].translation())
                              .norm();
      if (away < best_m) {
        best_m = away;
        best = old;
      }
    }
    if (best < 0) continue;
    closeLoop(best, node);
    last_closed = node;
  }
}

/// Registers a keyframe with a small map of the earlier visit alone: what lies in between may have
/// drifted.
void MapBuilder::closeLoop(int old_node, int new_node) {
  std::vector<int> around;
  for (int i = std::max(0, old_node - config_.loop_neighbours);
       i <= std::min(new_node - 1, old_node + config_.loop_neighbours); ++i)
    around.push_back(i);
  const auto o = static_cast<std::size_t>(old_node), n = static_cast<std::size_t>(new_node);
  const ScanMatcher matcher(config_.matcher,
                            mapOf(around, config_.working, poses_[o].translation()));
  const auto match = matcher.match(keyframes_[n].scan_base, poses_[n], keyframes_[n].p_base_sensor);
  if (!match || match->observable_directions < 6) return;
  edges_.push_back({old_node, new_node, EdgeKind::Loop, poses_[o].inverse() * match->X_map_base,
                    inFrame(match->covariance, poses_[o])});
  ++report_.loops;
}

/// Each keyframe against all the others: taken out, registered, put back.
void MapBuilder::polish() {
  working_ = std::make_shared<SurfelMap>(config_.working, poses_.front().translation());
  PostCollector posts;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    inserted_[i] = working_->insert(pointsInMap(keyframes_[i], poses_[i]),
                                    poses_[i] * keyframes_[i].p_base_sensor);
    posts.add(findEdges(keyframes_[i].scan_base, keyframes_[i].p_base_sensor, kMaxEdges),
              poses_[i]);
  }
  working_->setPosts(posts.posts());
  std::vector<double> overlaps, residuals;
  for (int round = 0; round < std::max(1, config_.polish_rounds); ++round) {
    overlaps.clear();
    residuals.clear();
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (!working_->remove(inserted_[i])) continue;
      working_->refresh();
      const auto match =
          ScanMatcher(config_.matcher, working_)
              .match(keyframes_[i].scan_base, poses_[i], keyframes_[i].p_base_sensor);
      if (match) {
        overlaps.push_back(match->inlier_fraction);
        residuals.push_back(match->rms_m);
        if (config_.polish_rounds > 0) poses_[i] = match->X_map_base;
      }
      inserted_[i] = working_->insert(pointsInMap(keyframes_[i], poses_[i]),
                                      poses_[i] * keyframes_[i].p_base_sensor);
    }
  }
  working_->refresh();
  report_.overlap_median = median(overlaps);
  report_.overlap_min =
      overlaps.empty() ? 0.0 : *std::min_element(overlaps.begin(), overlaps.end());
  report_.rms_median_m = median(residuals);
}

Result<BuiltMap> MapBuilder::build() {
  if (static_cast<int>(keyframes_.size()) < kMinKeyframes) {
    return makeError(ErrorCode::Degenerate,
                     "a map needs at least {} keyframes, the recording gave {}; drive farther",
                     kMinKeyframes, keyframes_.size());
  }
  closeLoops();
  report_.loop_before = residualOf(poses_, edges_, EdgeKind::Loop);
  auto solved = solvePoseGraph(poses_, edges_);
  if (!solved) return tl::make_unexpected(solved.error());
  poses_ = std::move(solved->poses);
  report_.initial_cost = solved->initial_cost;
  report_.final_cost = solved->final_cost;
  report_.odometry = residualOf(poses_, edges_, EdgeKind::Odometry);
  report_.registration = residualOf(poses_, edges_, EdgeKind::Registration);
  report_.loop = residualOf(poses_, edges_, EdgeKind::Loop);
  polish();
  report_.keyframes = static_cast<int>(keyframes_.size());
  for (std::size_t i = 1; i < poses_.size(); ++i)
    report_.path_m += (poses_[i].translation() - poses_[i - 1].translation()).norm();
  BuiltMap out;
  if (auto anchored = anchor(report_); !anchored) return tl::make_unexpected(anchored.error());
  out.map = segments(report_);
  out.poses = poses_;
  for (const Keyframe& keyframe : keyframes_) out.stamps.push_back(keyframe.scan_base.stamp);
  out.report = report_;
  return out;
}

}  // namespace kiln
