#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace kiln {

/// Nearest neighbours among fixed points: a balanced k-d tree in one array. Thread-safe once built.
class PointTree {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  explicit PointTree(std::span<const Eigen::Vector3f> points);
  /// Index (into the points given) of the nearest one within `radius_m`; kNone: there is none.
  [[nodiscard]] std::uint32_t nearest(const Eigen::Vector3f& p, float radius_m) const;

 private:
  struct Node {
    Eigen::Vector3f p;
    std::uint32_t index;
  };
  void build(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, const Eigen::Vector3f& p, float& square,
              std::uint32_t& best) const;

  std::vector<Node> nodes_;
  std::vector<std::uint8_t> axis_;  ///< of the node in the middle of its range
};

}  // namespace kiln
