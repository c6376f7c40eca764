#include "robot/planning/arm_motion/arm_collision.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr double kMinStep = 0.004;  // m; shortest stride of the path check
constexpr double kFar_m = 1e3;      // the ground goes on
constexpr int kFlangeLink = 7;      // what is fixed to the flange, after the six links
constexpr int kWristTwo = 5;        // the last link that turns against the flange

/// Neighbours touch by design, along the wrist also the neighbours' neighbours. Asked in one order:
/// false when `first` is the later link.
bool canMeet(int first, int second) {
  const int apart = second - std::max(first, 1);
  return apart > 2 || (apart == 2 && first <= 2);
}

Eigen::Vector3d sizeOf(const BoxConfig& box) {
  return {box.size_m[0], box.size_m[1], box.size_m[2]};
}

}  // namespace

/// Looks for the pair of parts with the least room: the nearest one or, on a way, the one that
/// could be the first to meet.
struct ArmCollision::Query : ArmShapes {
  std::vector<Eigen::AlignedBox3d> bounds;  ///< of the links
  double interest_m = 0.2;
  /// On a way: how far a part that moves with each link can get, m. Two parts come nearer to one
  /// another by the joints between them alone.
  const std::array<double, kFlangeLink + 1>* travel_m = nullptr;
  double clearance_m = 0.0;  ///< on a way
  double least = INFINITY;   ///< m; on a way the share of it that is surely free, negative: blocked
  const std::string* first = nullptr;
  const std::string* second = nullptr;

  [[nodiscard]] bool blocked() const { return travel_m != nullptr && least < 0.0; }
  [[nodiscard]] double rate(double distance_m, int link_a, int link_b) const {
    if (travel_m == nullptr) return distance_m;
    const double way_m = std::abs((*travel_m)[static_cast<std::size_t>(link_a)] -
                                  (*travel_m)[static_cast<std::size_t>(link_b)]);
    return (distance_m - clearance_m) / std::max(way_m, 1e-9);
  }
  /// @param exactly  double(): their distance, m; called only if the bounds allow it to matter.
  template <class Distance>
  void test(const Eigen::AlignedBox3d& bounds_a, int link_a, const std::string& name_a,
            const Eigen::AlignedBox3d& bounds_b, int link_b, const std::string& name_b,
            const Distance& exactly) {
    const double at_least_m = bounds_a.exteriorDistance(bounds_b);
    double found = rate(at_least_m, link_a, link_b);
    if (found >= least) return;
    if (at_least_m < interest_m) found = rate(exactly(), link_a, link_b);
    if (found >= least) return;
    least = found;
    first = &name_a;
    second = &name_b;
  }
  void test(std::size_t i, const ArmShapeConfig& shape, const OrientedBox& box, int box_link) {
    test(bounds[i], shape.link, shape.name, box.bounds, box_link, box.name,
         [&] { return kiln::distance(links[i], box); });
  }
};

ArmCollision::ArmCollision(const RobotGeometry& robot)
    : robot_(robot), X_base_armbase_(robot.X_base_armbase.pose()) {
  setScene({}, {});
  for (const BoxConfig& box : robot.head)
    head_in_flange_.push_back(makeBox(box.center.pose(), sizeOf(box), box.name));
  const std::vector<ArmShapeConfig>& shapes = robot.arm_shapes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (canMeet(shapes[i].link, shapes[k].link)) self_pairs_.push_back({i, k});
  }
  updateReach();
}

/// Chain length beyond each joint plus the farthest point of head, hull or carried body: an upper
/// bound of any lever arm.
void ArmCollision::updateReach() {
  double beyond = 0.0;
  const auto extend = [&](const OrientedBox& box) {
    beyond = std::max(beyond, box.X_frame_box.translation().norm() + box.half.norm());
  };
  for (const OrientedBox& part : head_in_flange_) extend(part);
  if (carried_in_flange_) extend(*carried_in_flange_);
  for (int i = 5; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    for (const ArmShapeConfig& shape : robot_.arm_shapes) {
      const Capsule c = shape.capsule();
      if (shape.link == i + 1)
        beyond = std::max(beyond, std::max(c.a.norm(), c.b.norm()) + c.radius);
    }
    beyond += std::hypot(robot_.arm.a[k], i == 0 ? 0.0 : robot_.arm.d[k]);
    reach_[i] = beyond;
  }
}

void ArmCollision::setScene(const std::vector<BoxConfig>& boxes_map, const Pose2& X_map_base,
                            const ArmScene& more) {
  body_ = scene_ = {};
  const auto may = [&](const std::string& name) {
    return std::find(more.touchable.begin(), more.touchable.end(), name) != more.touchable.end();
  };
  const auto add = [&](Boxes& to, const OrientedBox& box) {
    (may(box.name) ? to.touchable : to.kept_clear_of).push_back(box);
  };
  for (const BoxConfig& box : robot_.body)
    add(body_, makeBox(box.center.pose(), sizeOf(box), box.name));
  const Eigen::Isometry3d X_base_map = toIsometry(inverse(X_map_base));
  for (const BoxConfig& box : boxes_map)
    add(scene_, makeBox(X_base_map * box.center.pose(), sizeOf(box), box.name));
  for (const OrientedBox& box : more.boxes) add(scene_, box);
  ground_touchable_ = may(kGroundName);
}

void ArmCollision::setCarried(const std::optional<OrientedBox>& X_flange_box) {
  carried_in_flange_ = X_flange_box;
  updateReach();
}

void ArmCollision::testBoxes(Query& query, const Boxes& boxes, bool of_base) const {
  testBoxes(query, boxes.kept_clear_of, of_base, false);
  testBoxes(query, boxes.touchable, of_base, true);
}

void ArmCollision::testBoxes(Query& query, const std::vector<OrientedBox>& boxes, bool of_base,
                             bool touchable) const {
  for (const OrientedBox& box : boxes) {
    if (query.blocked()) return;
    for (std::size_t i = 0; i < query.links.size(); ++i)
      if (!of_base || !standsStill(i)) query.test(i, robot_.arm_shapes[i], box, 0);
    if (touchable) continue;
    for (const OrientedBox& part : query.head) {
      query.test(part.bounds, kFlangeLink, part.name, box.bounds, 0, box.name,
                 [&] { return kiln::distance(part, box); });
    }
  }
}

void ArmCollision::testSelf(Query& query) const {
  const std::vector<ArmShapeConfig>& shapes = robot_.arm_shapes;
  for (const auto& [a, b] : self_pairs_) {
    if (query.blocked()) return;
    query.test(query.bounds[a], shapes[a].link, shapes[a].name, query.bounds[b], shapes[b].link,
               shapes[b].name,
               [&, a = a, b = b] { return kiln::distance(query.links[a], query.links[b]); });
  }
  for (std::size_t k = 0; k < query.head.size(); ++k) {
    // The head is built so that it clears the wrist at any angle; a carried body is not.
    const bool carried = k >= head_in_flange_.size();
    for (std::size_t i = 0; i < query.links.size(); ++i)
      if (canMeet(shapes[i].link, kFlangeLink) || (carried && shapes[i].link == kWristTwo))
        query.test(i, shapes[i], query.head[k], kFlangeLink);
  }
}

void ArmCollision::testGround(Query& query) const {
  static const std::string kGround = kGroundName;
  const Eigen::AlignedBox3d ground(Eigen::Vector3d::Constant(-kFar_m),
                                   Eigen::Vector3d(kFar_m, kFar_m, 0.0));
  const auto test = [&](const Eigen::AlignedBox3d& bounds, int link, const std::string& name) {
    query.test(bounds, link, name, ground, 0, kGround, [&] { return bounds.min().z(); });
  };
  for (std::size_t i = 0; i < query.links.size(); ++i)
    if (!standsStill(i)) test(query.bounds[i], robot_.arm_shapes[i].link, nameOf(i));
  if (ground_touchable_) return;
  for (const OrientedBox& part : query.head) test(part.bounds, kFlangeLink, part.name);
}

ArmShapes ArmCollision::shapesAt(const Vector6d& q) const {
  ArmShapes out{robot_.armCapsules(q, X_base_armbase_), {}};
  const Eigen::Isometry3d X_base_flange = X_base_armbase_ * robot_.arm.forward(q);
  for (const OrientedBox& part : head_in_flange_) {
    out.head.push_back(makeBox(X_base_flange * part.X_frame_box, 2.0 * part.half, part.name));
  }
  if (const auto& part = carried_in_flange_)
    out.head.push_back(makeBox(X_base_flange * part->X_frame_box, 2.0 * part->half, part->name));
  return out;
}

void ArmCollision::evaluate(Query& query, const Vector6d& q) const {
  static_cast<ArmShapes&>(query) = shapesAt(q);
  for (const Capsule& link : query.links) query.bounds.push_back(boundsOf(link));
  testGround(query);
  testBoxes(query, body_, true);
  testSelf(query);
  testBoxes(query, scene_, false);
}

Clearance ArmCollision::clearance(const Vector6d& q, double interest_m) const {
  Query query;
  query.interest_m = interest_m;
  evaluate(query, q);
  return {query.least, query.first == nullptr
                           ? "nothing near"
                           : fmt::format("{} to {}", *query.first, *query.second)};
}

double ArmCollision::distance(const Vector6d& q, double interest_m) const {
  Query query;
  query.interest_m = interest_m;
  evaluate(query, q);
  return query.least;
}

double ArmCollision::motionBound(const Vector6d& dq) const { return reach_.dot(dq.cwiseAbs()); }

bool ArmCollision::pathIsFree(const Vector6d& q_from, const Vector6d& q_to,
                              double clearance_m) const {
  const Vector6d way = (q_to - q_from).cwiseAbs();
  std::array<double, kFlangeLink + 1> travel_m{};
  for (int i = 0; i < 6; ++i)
    travel_m[static_cast<std::size_t>(i) + 1] =
        travel_m[static_cast<std::size_t>(i)] + reach_[i] * way[i];
  travel_m[kFlangeLink] = travel_m[kFlangeLink - 1];
  const double least_stride = kMinStep / std::max(motionBound(way), 1e-9);
  double s = 0.0;
  while (true) {
    Query query;
    query.travel_m = &travel_m;
    query.clearance_m = clearance_m;
    evaluate(query, q_from + s * (q_to - q_from));
    if (query.blocked()) return false;
    if (s >= 1.0) return true;
    s = std::min(1.0, s + std::max(query.least, least_stride));
  }
}

}  // namespace kiln
