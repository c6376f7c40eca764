#include "robot/perception/bricks/pile_detector.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/units.h"
#include "common/geom/pose.h"
#include "robot/perception/bricks/point_clusters.h"
#include "robot/perception/bricks/surface_leaves.h"

namespace kiln {
namespace {

constexpr double kStackSigma_m = 0.03;  // of the line's ends and front: stacks are off by 5 cm
constexpr double kHidden_m = 0.1;       // how much of a line's end may be out of sight unnoticed

/// One line of the pile by its layout: its stacks' length and how high it is.
struct Line {
  double length_m = 0.0;
  int layers = 0;
};

Line lineOf(const PileLayout& layout, int number) {
  Line line{layout.lineLength(number), 0};
  for (const PileStack& stack : layout.stacks)
    if (stack.line == number) line.layers = std::max(line.layers, stack.bricks);
  return line;
}

Eigen::Isometry3d levelFrame(const GroundFit& ground) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = frameFromXAndUp(Eigen::Vector3d::UnitX(), ground.n);
  X.translation() = Eigen::Vector3d(0, 0, ground.d_m / ground.n.z());
  return X;
}

/// The line of bricks behind a visible front: its outline is only as deep as what is seen of it.
Eigen::Vector2d middleOf(const PileCandidate& line, const Eigen::Vector2d& sensor) {
  const Eigen::Vector2d across(-std::sin(line.yaw_rad), std::cos(line.yaw_rad));
  const Eigen::Vector2d centre = line.p_base.head<2>();
  const double away = across.dot(centre - sensor) > 0.0 ? 1.0 : -1.0;
  const double front = away * across.dot(centre) - 0.5 * line.width_m;
  return centre +
         across * away *
             (front + 0.5 * std::max(kBrickSide_m, line.width_m) - away * across.dot(centre));
}

}  // namespace

void PileDetector::Config::visit(ConfigArchive& a) {
  a.field("leaf_m", leaf_m, "m", 0.01, 0.2, "thinning");
  a.field("gap_m", gap_m, "m", 0.05, 2, "stacks nearer to each other are one cluster");
  a.field("min_points", min_points, "", 5, 10000, "fewer leaves: ignored");
  a.field("length_tolerance_m", length_tolerance_m, "m", 0.05, 3, "of the front line");
  a.field("max_width_m", max_width_m, "m", 0.2, 5, "of the front line");
  a.field("min_height_m", min_height_m, "m", 0.1, 5, "lower: not the pile");
  a.field("max_height_m", max_height_m, "m", 0.2, 5, "higher: not the pile");
  a.field("line_tolerance_m", line_tolerance_m, "m", 0.05, 2, "of line 2 behind line 1");
  a.field("line_tolerance_deg", line_tolerance_deg, "deg", 1, 45, "of line 2 against line 1");
  a.section("ground", ground, "the plane that all stands on");
}

std::string PileDetector::whyNot(const PileCandidate& c, double length_m, int layers) const {
  const double height = layers * kBrickSide_m;
  if (c.height_m < std::min(config_.min_height_m, 0.8 * height))
    return fmt::format("too low: {:.2f} m, {:.2f} m expected", c.height_m, height);
  if (c.height_m > std::max(config_.max_height_m, 1.25 * height))
    return fmt::format("too high: {:.2f} m, {:.2f} m expected", c.height_m, height);
  if (c.length_m < length_m - config_.length_tolerance_m)
    return fmt::format("too short: {:.2f} m, {:.2f} m expected", c.length_m, length_m);
  if (c.length_m > length_m + config_.length_tolerance_m)
    return fmt::format("too long: {:.2f} m, {:.2f} m expected", c.length_m, length_m);
  if (c.width_m > config_.max_width_m)
    return fmt::format("too wide: {:.2f} m, {:.2f} m allowed", c.width_m, config_.max_width_m);
  return {};
}

Result<PileSearch> PileDetector::detect(const BrickSweep& sweep, const SearchArea& area,
                                        const PileLayout& layout) const {
  const Line front = lineOf(layout, 1), behind = lineOf(layout, 2);
  if (front.layers == 0)
    return makeError(ErrorCode::InvalidInput, "the pile's layout has no stack in line 1");
  const Eigen::Isometry3f X_area_base = area.X_base_area.inverse().cast<float>();
  std::vector<Eigen::Vector3f> inside;
  Eigen::Vector3f sensor = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const Eigen::Vector3f p = X_area_base * sweep.points[i];
    if (std::abs(p.x()) > static_cast<float>(area.half_x_m) ||
        std::abs(p.y()) > static_cast<float>(area.half_y_m))
      continue;
    inside.push_back(sweep.points[i]);
    sensor += (sweep.origins[i] - sensor) / static_cast<float>(inside.size());
  }
  if (static_cast<int>(inside.size()) < config_.min_points)
    return makeError(ErrorCode::Degenerate,
                     "nothing to see in the search area: {} points, {} needed", inside.size(),
                     config_.min_points);
  const std::vector<SurfacePoint> leaves = thin(inside, config_.leaf_m);
  const auto ground = fitGround(leaves, config_.ground);
  if (!ground) return tl::make_unexpected(ground.error());
  const Eigen::Isometry3d X_base_level = levelFrame(*ground);
  const Eigen::Isometry3f X_level_base = X_base_level.inverse().cast<float>();
  std::vector<Eigen::Vector3f> above;
  for (const SurfacePoint& leaf : leaves) {
    const Eigen::Vector3f p = X_level_base * leaf.p;
    if (p.z() > static_cast<float>(2.0 * config_.ground.above_ground_m)) above.push_back(p);
  }

  PileSearch out;
  std::vector<PileCandidate> second;  // may be line 2
  std::vector<Eigen::Matrix2d> scatter;
  for (const auto& cluster : clusterPoints(above, 0.5 * config_.gap_m)) {
    if (static_cast<int>(cluster.size()) < config_.min_points) continue;
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t i : cluster) points.push_back(above[i]);
    const GroundOutline outline = outlineOf(points);
    PileCandidate c;
    c.p_base = {outline.centre.x(), outline.centre.y(), 0.0};  // in level for now
    c.yaw_rad = outline.yaw_rad;
    c.length_m = outline.length_m;
    c.width_m = outline.width_m;
    c.height_m = outline.high_m;
    c.points = static_cast<int>(cluster.size());
    c.refused = whyNot(c, front.length_m, front.layers);
    if (behind.layers > 0 && whyNot(c, behind.length_m, behind.layers).empty()) second.push_back(c);
    out.candidates.push_back(c);
  }
  std::stable_sort(
      out.candidates.begin(), out.candidates.end(),
      [](const PileCandidate& a, const PileCandidate& b) { return a.points > b.points; });

  const Eigen::Vector2d p_level_sensor = (X_level_base * sensor).head<2>().cast<double>();
  const Eigen::Vector2d expected =
      (X_base_level.linear().transpose() * area.x_expected).head<2>().normalized();
  struct Choice {
    std::size_t index = 0;
    bool pair = false, reversed = false;
    double misfit = 1e9;
  };
  std::optional<Choice> best;
  for (std::size_t i = 0; i < out.candidates.size(); ++i) {
    const PileCandidate& c = out.candidates[i];
    if (!c.refused.empty()) continue;
    const Eigen::Vector2d x(std::cos(c.yaw_rad), std::sin(c.yaw_rad)), y(-x.y(), x.x());
    Choice choice{i, false, x.dot(expected) < 0.0, std::abs(c.length_m - front.length_m)};
    for (const PileCandidate& other : second) {
      const Eigen::Vector2d d = (other.p_base - c.p_base).head<2>();
      const double turn = std::abs(std::remainder(other.yaw_rad - c.yaw_rad, M_PI));
      if (std::abs(std::abs(y.dot(d)) - layout.line_distance_m) > config_.line_tolerance_m ||
          turn > config_.line_tolerance_deg * kDeg || std::abs(x.dot(d)) > 1.0)
        continue;
      choice.pair = true;
      choice.reversed = y.dot(d) < 0.0;
      choice.misfit -= 1.0;  // two lines as the layout has them: surer than one
    }
    if (!best || choice.misfit < best->misfit) best = choice;
  }
  // In the frame that the caller knows.
  const auto toBase = [&](PileCandidate& c) {
    c.p_base = X_base_level * c.p_base;
    const Eigen::Vector3d x =
        X_base_level.linear() * Eigen::Vector3d(std::cos(c.yaw_rad), std::sin(c.yaw_rad), 0);
    c.yaw_rad = std::atan2(x.y(), x.x());
  };
  if (best) {
    const PileCandidate& c = out.candidates[best->index];
    const double yaw = wrapAngle(c.yaw_rad + (best->reversed ? M_PI : 0.0));
    const Eigen::Vector2d x(std::cos(yaw), std::sin(yaw)), middle = middleOf(c, p_level_sensor);
    PileDetection found;
    const Eigen::Vector2d origin = middle - 0.5 * front.length_m * x;
    found.X_base_pile = X_base_level * makePose({origin.x(), origin.y(), 0}, {0, 0, yaw});
    found.second_line = best->pair;
    found.ground = *ground;
    // Ends and front are known as well as the stacks stand; an end may be out of sight.
    const double along =
                     kStackSigma_m + 0.5 * std::abs(c.length_m - front.length_m) + 0.5 * kHidden_m,
                 yaw_sigma = 2.0 * kStackSigma_m / front.length_m + 0.01;
    Eigen::Matrix2d R;
    R << x.x(), -x.y(), x.y(), x.x();
    const double lever = 0.5 * front.length_m;
    Eigen::Matrix2d own;
    own << along * along, 0.0, 0.0, kStackSigma_m * kStackSigma_m + std::pow(lever * yaw_sigma, 2);
    found.covariance.setZero();
    found.covariance.topLeftCorner<2, 2>() = R * own * R.transpose();
    const Eigen::Vector2d cross = R * Eigen::Vector2d(0.0, -lever * yaw_sigma * yaw_sigma);
    found.covariance.topRightCorner<2, 1>() = cross;
    found.covariance.bottomLeftCorner<1, 2>() = cross.transpose();
    found.covariance(2, 2) = yaw_sigma * yaw_sigma;
    out.found.push_back(found);
    for (std::size_t i = 0; i < out.candidates.size(); ++i)
      if (i != best->index && out.candidates[i].refused.empty())
        out.candidates[i].refused = "another one fits better";
  } else {
    out.why = out.candidates.empty()
                  ? "nothing stands in the search area"
                  : fmt::format("none of {} clusters in the search area has the pile's size",
                                out.candidates.size());
  }
  for (PileCandidate& c : out.candidates) toBase(c);
  return out;
}

}  // namespace kiln
