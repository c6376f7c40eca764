#include "robot/perception/marker/marker_detector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace kiln {
namespace {

cv::Mat inVolume(const cv::Mat& hsv, const HsvVolume& v) {
  cv::Mat mask;
  const int s = v.saturation_min, b = v.value_min;
  if (v.hue_min <= v.hue_max) {
    cv::inRange(hsv, cv::Scalar(v.hue_min, s, b), cv::Scalar(v.hue_max, 255, 255), mask);
    return mask;
  }
  cv::Mat upper;
  cv::inRange(hsv, cv::Scalar(v.hue_min, s, b), cv::Scalar(179, 255, 255), upper);
  cv::inRange(hsv, cv::Scalar(0, s, b), cv::Scalar(v.hue_max, 255, 255), mask);
  return mask | upper;
}

/// The yellow volume, purer where yellow is so common that it must be the ground.
HsvVolume yellowAbove(const cv::Mat& hsv, const MarkerDetector::Config& config) {
  HsvVolume out = config.yellow;
  const cv::Mat mask = inVolume(hsv, config.yellow);
  if (cv::countNonZero(mask) < config.ground_share * static_cast<double>(mask.total())) return out;
  std::array<int, 256> count{};
  int all = 0;
  for (int v = 0; v < hsv.rows; v += 2)
    for (int u = 0; u < hsv.cols; u += 2)
      if (mask.at<std::uint8_t>(v, u) != 0) {
        ++count[hsv.at<cv::Vec3b>(v, u)[1]];
        ++all;
      }
  int below = 0, median = 0;
  while (median < 255 && below + count[static_cast<std::size_t>(median)] <= all / 2)
    below += count[static_cast<std::size_t>(median++)];
  constexpr int kPurest = 150;  // the marker's own yellow is purer than this
  out.saturation_min =
      std::max(out.saturation_min, std::min(median + config.ground_margin, kPurest));
  return out;
}

/// Where at least `share` of the window around a pixel is of `colour`.
cv::Mat vicinity(const cv::Mat& colour, int half_px, double share) {
  cv::Mat density;
  const int side = 2 * half_px + 1;
  cv::boxFilter(colour, density, CV_16U, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return density >= share * side * side;
}

std::vector<cv::Point2f> corners(const cv::Mat& mask, const MarkerDetector::Config& config) {
  cv::Mat smooth;
  cv::GaussianBlur(mask, smooth, {5, 5}, 1.0);
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(smooth, found, config.max_corners, config.corner_quality,
                          config.corner_distance_px, cv::noArray(), 3);
  return found;
}

/// Corners of `a` with one of `b` nearby; each corner of `b` answers for one.
std::vector<cv::Point2f> agreeing(const std::vector<cv::Point2f>& a,
                                  const std::vector<cv::Point2f>& b, double within_px,
                                  const cv::Size& size) {
  cv::Mat near = cv::Mat::zeros(size, CV_8U);
  const int radius = static_cast<int>(std::ceil(within_px));
  for (const cv::Point2f& p : b) cv::circle(near, cv::Point(p), radius, 255, cv::FILLED);
  std::vector<cv::Point2f> out;
  for (const cv::Point2f& p : a)
    if (near.at<std::uint8_t>(cv::Point(p)) != 0) out.push_back(p);
  return out;
}

std::vector<Eigen::Vector2f> thinned(const cv::Mat& mask, const cv::Point& origin,
                                     std::size_t most) {
  std::vector<cv::Point> all;
  cv::findNonZero(mask, all);
  std::vector<Eigen::Vector2f> out;
  const std::size_t stride = all.size() / std::max<std::size_t>(1, most) + 1;
  for (std::size_t i = 0; i < all.size(); i += stride)
    out.emplace_back(static_cast<float>(all[i].x + origin.x),
                     static_cast<float>(all[i].y + origin.y));
  return out;
}

/// The outline of a cluster's closed mask, where the smoothed mask is at half its height; nothing
/// within 3 px of the picture's edge.
std::vector<OutlinePoint> outlineOf(const cv::Mat& filled, const cv::Point& origin,
                                    const cv::Size& picture) {
  cv::Mat smooth, du, dv;
  filled.convertTo(smooth, CV_32F, 1.0 / 255.0);
  cv::GaussianBlur(smooth, smooth, {7, 7}, 1.2);
  cv::Sobel(smooth, du, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, dv, CV_32F, 0, 1, 3, 0.125);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(filled, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<OutlinePoint> out;
  constexpr int kBorder_px = 3;
  for (const auto& contour : contours)
    for (const cv::Point& p : contour) {
      const cv::Point at = p + origin;
      if (at.x < kBorder_px || at.y < kBorder_px || at.x >= picture.width - kBorder_px ||
          at.y >= picture.height - kBorder_px)
        continue;
      const Eigen::Vector2f slope(du.at<float>(p), dv.at<float>(p));
      const float steepness = slope.norm();
      if (steepness < 0.1F) continue;
      const float step = std::clamp((smooth.at<float>(p) - 0.5F) / steepness, -1.5F, 1.5F);
      const Eigen::Vector2f outward = -slope / steepness;
      out.push_back(
          {Eigen::Vector2f(static_cast<float>(at.x), static_cast<float>(at.y)) + step * outward,
           outward});
    }
  return out;
}

std::string whyNone(const MarkerCluster& c, int most_votes, const MarkerDetector::Config& config) {
  const double share = static_cast<double>(std::min(c.yellow, c.magenta)) / std::max(1, c.pixels);
  if (share < config.min_colour_share)
    return fmt::format("{} is only {:.0f} % of it, at least {:.0f} % are needed",
                       c.yellow < c.magenta ? "yellow" : "magenta", 100.0 * share,
                       100.0 * config.min_colour_share);
  if (c.votes < config.min_votes)
    return fmt::format("{} corners are in both masks, at least {} are needed", c.votes,
                       config.min_votes);
  if (c.votes < config.min_vote_share * most_votes)
    return fmt::format("{} votes against {} of the winner", c.votes, most_votes);
  return {};
}

}  // namespace

void HsvVolume::visit(ConfigArchive& a) {
  a.field("hue_min", hue_min, "2 deg", 0, 179, "hue in OpenCV's numbers; above hue_max: through 0");
  a.field("hue_max", hue_max, "2 deg", 0, 179, "hue in OpenCV's numbers");
  a.field("saturation_min", saturation_min, "", 0, 255, "paler is not this colour");
  a.field("value_min", value_min, "", 0, 255, "darker is not this colour");
}

void MarkerDetector::Config::visit(ConfigArchive& a) {
  a.section("yellow", yellow, "the marker's yellow, and what both colours blend to far away");
  a.section("magenta", magenta, "the marker's magenta");
  a.field("adapt", adapt, "colours in shadow too, and a yellow purer than the ground's");
  a.section("yellow_shade", yellow_shade, "the marker's yellow in shadow");
  a.section("magenta_shade", magenta_shade, "the marker's magenta in shadow");
  a.field("ground_share", ground_share, "", 0, 1, "of the picture in yellow: it is the ground");
  a.field("ground_margin", ground_margin, "", 0, 255, "saturation above the ground's median");
  a.field("vicinity_px", vicinity_px, "px", 1, 100, "half a window that must hold both colours");
  a.field("vicinity_share", vicinity_share, "", 0, 1, "of that window, of the other colour");
  a.field("max_corners", max_corners, "", 10, 5000, "of each mask");
  a.field("corner_quality", corner_quality, "", 0.001, 1, "of the strongest corner");
  a.field("corner_distance_px", corner_distance_px, "px", 1, 50, "between corners of a mask");
  a.field("agree_px", agree_px, "px", 0.5, 20, "a corner of one mask to one of the other");
  a.field("closing_px", closing_px, "px", 1, 51, "gaps of the fused mask that are closed");
  a.field("min_pixels", min_pixels, "px", 1, 100000, "smaller clusters are not listed");
  a.field("min_votes", min_votes, "", 1, 1000, "corners in both masks that make a candidate");
  a.field("min_vote_share", min_vote_share, "", 0, 1, "of the winner's votes");
  a.field("min_colour_share", min_colour_share, "", 0, 0.5, "of each colour in a candidate");
  a.field("max_pixels", max_pixels, "px", 100, 100000, "kept of a candidate");
}

MarkerView MarkerDetector::detect(const RgbImage& image) const {
  MarkerView view;
  view.stamp = image.stamp;
  view.width = image.width;
  view.height = image.height;
  if (image.width < 16 || image.height < 16 ||
      image.data.size() !=
          3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    view.refused =
        fmt::format("picture has {} bytes for {} x {} pixels of 3; check the camera's format",
                    image.data.size(), image.width, image.height);
    return view;
  }
  const cv::Size size(image.width, image.height);
  const cv::Mat rgb(size, CV_8UC3, const_cast<std::uint8_t*>(image.data.data()));
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV);
  cv::Mat yellow = inVolume(hsv, config_.adapt ? yellowAbove(hsv, config_) : config_.yellow);
  cv::Mat magenta = inVolume(hsv, config_.magenta);
  if (config_.adapt) {
    magenta |= inVolume(hsv, config_.magenta_shade);
    yellow |= inVolume(hsv, config_.yellow_shade) & ~magenta;
  }
  const cv::Mat near_yellow =
      yellow & vicinity(magenta & 1, config_.vicinity_px, config_.vicinity_share);
  const cv::Mat near_magenta =
      magenta & vicinity(yellow & 1, config_.vicinity_px, config_.vicinity_share);
  const cv::Mat bits = (yellow & MarkerView::kYellow) | (magenta & MarkerView::kMagenta) |
                       (near_yellow & MarkerView::kNearYellow) |
                       (near_magenta & MarkerView::kNearMagenta);
  view.mask.assign(bits.data, bits.data + bits.total());

  const cv::Mat fused = near_yellow | near_magenta;
  cv::Mat closed, labels, stats, centres;
  const cv::Mat kernel =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {config_.closing_px, config_.closing_px});
  cv::morphologyEx(fused, closed, cv::MORPH_CLOSE, kernel);
  const int count = cv::connectedComponentsWithStats(closed, labels, stats, centres, 8, CV_32S);
  std::vector<int> votes(static_cast<std::size_t>(count), 0);
  const auto shared = agreeing(corners(near_yellow, config_), corners(near_magenta, config_),
                               config_.agree_px, size);
  std::vector<int> voted;
  for (const cv::Point2f& p : shared) {
    const int label = labels.at<int>(cv::Point(p));
    voted.push_back(label);
    if (label > 0) ++votes[static_cast<std::size_t>(label)];
  }

  std::vector<int> order;
  for (int label = 1; label < count; ++label)
    if (stats.at<int>(label, cv::CC_STAT_AREA) >= config_.min_pixels) order.push_back(label);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return votes[static_cast<std::size_t>(a)] > votes[static_cast<std::size_t>(b)];
  });
  std::vector<int> index(static_cast<std::size_t>(count), -1);
  for (const int label : order) {
    const cv::Rect box(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    const cv::Mat own = labels(box) == label;
    const cv::Mat pixels = own & fused(box);
    MarkerCluster cluster;
    cluster.votes = votes[static_cast<std::size_t>(label)];
    cluster.pixels = cv::countNonZero(pixels);
    cluster.yellow = cv::countNonZero(pixels & near_yellow(box));
    cluster.magenta = cv::countNonZero(pixels & near_magenta(box));
    cluster.box = {Eigen::Vector2i(box.x, box.y),
                   Eigen::Vector2i(box.x + box.width - 1, box.y + box.height - 1)};
    cluster.refused = whyNone(cluster, votes[static_cast<std::size_t>(order.front())], config_);
    if (cluster.refused.empty()) {
      cluster.mask_pixels = thinned(pixels, box.tl(), static_cast<std::size_t>(config_.max_pixels));
      cv::Mat padded;
      cv::copyMakeBorder(own, padded, 4, 4, 4, 4, cv::BORDER_CONSTANT, 0);
      cluster.outline = outlineOf(padded, box.tl() - cv::Point(4, 4), size);
      if (view.winner < 0) view.winner = static_cast<int>(view.clusters.size());
    }
    index[static_cast<std::size_t>(label)] = static_cast<int>(view.clusters.size());
    view.clusters.push_back(std::move(cluster));
  }
  for (std::size_t i = 0; i < shared.size(); ++i)
    view.votes.push_back({{shared[i].x, shared[i].y}, index[static_cast<std::size_t>(voted[i])]});
  return view;
}

}  // namespace kiln
