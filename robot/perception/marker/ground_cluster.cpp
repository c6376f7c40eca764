#include "robot/perception/marker/ground_cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/core/check.h"

namespace kiln::marker {
namespace {

constexpr float kMost_m = 50.0F;

Eigen::Vector2d vector(const cv::Point2f& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

GroundRectangle rectangleAround(const GroundCluster& cluster,
                                std::span<const Eigen::Vector2f> points) {
  std::vector<cv::Point2f> own;
  own.reserve(cluster.points.size());
  // About the first point: single precision far from the origin would cost millimetres.
  const Eigen::Vector2f origin = points[cluster.points.front()];
  for (const std::size_t i : cluster.points)
    own.emplace_back(points[i].x() - origin.x(), points[i].y() - origin.y());
  const cv::RotatedRect box = cv::minAreaRect(own);
  std::array<cv::Point2f, 4> corners;
  box.points(corners.data());
  GroundRectangle out;
  for (std::size_t i = 0; i < 4; ++i) out.corners[i] = origin.cast<double>() + vector(corners[i]);
  const Eigen::Vector2d a = out.corners[1] - out.corners[0], b = out.corners[3] - out.corners[0];
  if (a.x() * b.y() - a.y() * b.x() < 0.0) std::swap(out.corners[1], out.corners[3]);
  out.long_m = static_cast<double>(std::max(box.size.width, box.size.height));
  out.short_m = static_cast<double>(std::min(box.size.width, box.size.height));
  return out;
}

}  // namespace

std::vector<GroundCluster> clusterGround(std::span<const Eigen::Vector2f> points,
                                         const GroundClusterConfig& config) {
  const auto cell = static_cast<float>(config.cell_m);
  std::vector<std::size_t> used;
  Eigen::AlignedBox2f box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    if (!used.empty() && (points[i] - points[used.front()]).norm() > kMost_m) continue;
    used.push_back(i);
    box.extend(points[i]);
  }
  if (used.empty()) return {};
  const auto reach = static_cast<int>(std::ceil(config.gap_m / config.cell_m));
  const Eigen::Vector2i size = ((box.max() - box.min()) / cell).cast<int>();
  cv::Mat hits = cv::Mat::zeros(size.y() + 1 + 2 * reach, size.x() + 1 + 2 * reach, CV_32S);
  const auto at = [&](std::size_t i) {
    const Eigen::Vector2i c = ((points[i] - box.min()) / cell).cast<int>();
    return cv::Point(c.x() + reach, c.y() + reach);
  };
  for (const std::size_t i : used) ++hits.at<int>(at(i));
  const cv::Mat filled = hits >= config.min_hits;
  cv::Mat joined, labels;
  cv::dilate(filled, joined,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {reach / 2 * 2 + 1, reach / 2 * 2 + 1}));
  const int count = cv::connectedComponents(joined, labels, 8, CV_32S);
  std::vector<GroundCluster> out(static_cast<std::size_t>(count));
  for (const std::size_t i : used) {
    const cv::Point c = at(i);
    if (filled.at<std::uint8_t>(c) == 0) continue;
    GroundCluster& own = out[static_cast<std::size_t>(labels.at<int>(c))];
    own.points.push_back(i);
    int& hit = hits.at<int>(c);
    if (hit > 0) own.area_m2 += config.cell_m * config.cell_m;
    hit = 0;
  }
  std::erase_if(out, [](const GroundCluster& c) { return c.points.empty(); });
  std::stable_sort(out.begin(), out.end(), [](const GroundCluster& a, const GroundCluster& b) {
    return a.area_m2 > b.area_m2;
  });
  for (GroundCluster& cluster : out) cluster.rectangle = rectangleAround(cluster, points);
  return out;
}

LCorner findLCorner(const GroundCluster& cluster, std::span<const Eigen::Vector2f> points) {
  KILN_CHECK(!cluster.points.empty());
  std::array<double, 4> nearest;
  nearest.fill(std::numeric_limits<double>::infinity());
  const auto& corners = cluster.rectangle.corners;
  for (const std::size_t i : cluster.points)
    for (std::size_t k = 0; k < 4; ++k)
      nearest[k] = std::min(nearest[k], (points[i].cast<double>() - corners[k]).norm());
  const auto farthest = static_cast<std::size_t>(
      std::distance(nearest.begin(), std::max_element(nearest.begin(), nearest.end())));
  LCorner out;
  out.empty_m = nearest[farthest];
  for (std::size_t k = 0; k < 4; ++k)
    if (k != farthest) out.next_m = std::max(out.next_m, nearest[k]);
  // Corners are counter-clockwise: the one after the L's corner lies along X, the one before it
  // along Y. The direction of X is taken from both legs.
  const Eigen::Vector2d corner = corners[(farthest + 2) % 4];
  const Eigen::Vector2d x = (corners[(farthest + 3) % 4] - corner).normalized();
  out.X_ground_wall = {corner.x(), corner.y(), std::atan2(x.y(), x.x())};
  return out;
}

}  // namespace kiln::marker
