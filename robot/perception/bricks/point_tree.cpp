#include "robot/perception/bricks/point_tree.h"

#include <algorithm>

namespace kiln {

namespace {
constexpr std::size_t kLeaf = 8;
}

PointTree::PointTree(std::span<const Eigen::Vector3f> points) : axis_(points.size(), 0) {
  nodes_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    nodes_.push_back({points[i], static_cast<std::uint32_t>(i)});
  build(0, nodes_.size());
}

void PointTree::build(std::size_t first, std::size_t last) {
  if (last - first <= kLeaf) return;
  Eigen::Vector3f low = nodes_[first].p, high = low;
  for (std::size_t i = first; i < last; ++i) {
    low = low.cwiseMin(nodes_[i].p);
    high = high.cwiseMax(nodes_[i].p);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [axis](const Node& a, const Node& b) {
    return a.p[axis] < b.p[axis] || (a.p[axis] == b.p[axis] && a.index < b.index);
  });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(first, middle);
  build(middle + 1, last);
}

void PointTree::search(std::size_t first, std::size_t last, const Eigen::Vector3f& p, float& square,
                       std::uint32_t& best) const {
  const auto ask = [&](std::size_t i) {
    const float d = (nodes_[i].p - p).squaredNorm();
    if (d >= square) return;
    square = d;
    best = nodes_[i].index;
  };
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i) ask(i);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const float off = p[axis_[middle]] - nodes_[middle].p[axis_[middle]];
  if (off < 0.0F)
    search(first, middle, p, square, best);
  else
    search(middle + 1, last, p, square, best);
  if (off * off >= square) return;
  ask(middle);
  if (off < 0.0F)
    search(middle + 1, last, p, square, best);
  else
    search(first, middle, p, square, best);
}

std::uint32_t PointTree::nearest(const Eigen::Vector3f& p, float radius_m) const {
  float square = radius_m * radius_m;
  std::uint32_t best = kNone;
  search(0, nodes_.size(), p, square, best);
  return best;
}

}  // namespace kiln
