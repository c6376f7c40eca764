#include "robot/planning/arm_motion/arm_collision.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace kiln {
namespace {

constexpr std::size_t kUpperArm = 1, kForearm = 2, kHoses = 6;
constexpr std::array<const char*, 8> kLink = {"arm column",        "upper arm",      "forearm",
                                              "wrist 1",           "wrist 2",        "wrist 3",
                                              "hose on upper arm", "hose on forearm"};
constexpr double kHoseRadius_m = 0.013, kHoseGap_m = 0.008;  // its axis, beside the link's surface
constexpr double kMinStep = 0.004;                           // m; shortest stride of the path check
// Capsules of links that can meet; neighbours in the chain always touch.
constexpr std::array<std::array<std::size_t, 2>, 13> kSelfPairs = {{{0, 2},
                                                                    {0, 3},
                                                                    {0, 4},
                                                                    {0, 5},
                                                                    {1, 3},
                                                                    {1, 4},
                                                                    {1, 5},
                                                                    {2, 5},
                                                                    {6, 3},
                                                                    {6, 4},
                                                                    {6, 5},
                                                                    {7, 0},
                                                                    {7, 5}}};
// Wrists 2 and 3 carry the head.
constexpr std::array<std::size_t, 6> kHeadMeets = {0, 1, 2, 3, 6, 7};

Eigen::Vector3d sizeOf(const BoxConfig& box) {
  return {box.size_m[0], box.size_m[1], box.size_m[2]};
}

}  // namespace

const char* ArmShapes::nameOf(std::size_t link) { return kLink[link]; }

struct ArmCollision::Query : ArmShapes {
  double interest_m = 0.2;
  double nearest = INFINITY;
  const char* first = "";
  const char* second = "";

  void offer(double d, const char* a, const char* b) {
    if (d >= nearest) return;
    nearest = d;
    first = a;
    second = b;
  }
  void test(std::size_t link, const OrientedBox& box) {
    const Capsule& c = links[link];
    const double far = (0.5 * (c.a + c.b) - box.X_frame_box.translation()).norm() -
                       0.5 * (c.b - c.a).norm() - c.radius - box.sphere_radius;
    const double bound = std::min(nearest, interest_m);
    offer(far > bound ? far : kiln::distance(c, box), kLink[link], box.name.c_str());
  }
  void test(const OrientedBox& part, const OrientedBox& box) {
    const double far = (part.X_frame_box.translation() - box.X_frame_box.translation()).norm() -
                       part.sphere_radius - box.sphere_radius;
    const double bound = std::min(nearest, interest_m);
    offer(far > bound ? far : separation(part, box), part.name.c_str(), box.name.c_str());
  }
};

ArmCollision::ArmCollision(const RobotGeometry& robot)
    : robot_(robot), X_base_armbase_(robot.X_base_armbase.pose()), radius_(robot.link_radius_m) {
  for (const BoxConfig& box : robot.body) {
    body_.push_back(makeBox(box.center.pose(), sizeOf(box), box.name));
  }
  double head_reach = 0.0;
  for (const BoxConfig& box : robot.head) {
    head_in_flange_.push_back(makeBox(box.center.pose(), sizeOf(box), box.name));
    const OrientedBox& added = head_in_flange_.back();
    head_reach = std::max(head_reach, added.X_frame_box.translation().norm() + added.sphere_radius);
  }
  // Chain length beyond each joint plus head or capsule radius: an upper bound of any lever arm.
  double beyond = std::max(head_reach, radius_.back());
  for (int i = 5; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    beyond += std::hypot(robot.arm.a[k], i == 0 ? 0.0 : robot.arm.d[k]);
    reach_[i] = beyond;
  }
}

void ArmCollision::setScene(const std::vector<BoxConfig>& boxes_map, const Pose2& X_map_base) {
  scene_.clear();
  const Eigen::Isometry3d X_base_map = toIsometry(inverse(X_map_base));
  for (const BoxConfig& box : boxes_map) {
    scene_.push_back(makeBox(X_base_map * box.center.pose(), sizeOf(box), box.name));
  }
}

void ArmCollision::testScene(Query& query) const {
  for (const OrientedBox& box : scene_) {
    for (std::size_t link = 0; link < query.links.size(); ++link) query.test(link, box);
    for (const OrientedBox& part : query.head) query.test(part, box);
  }
}

void ArmCollision::testBody(Query& query) const {
  for (const OrientedBox& box : body_) {
    // The column stands on the deck.
    for (std::size_t link = 1; link < query.links.size(); ++link) query.test(link, box);
    for (const OrientedBox& part : query.head) query.test(part, box);
  }
}

void ArmCollision::testSelf(Query& query) const {
  for (const auto& [a, b] : kSelfPairs) {
    query.offer(kiln::distance(query.links[a], query.links[b]), kLink[a], kLink[b]);
  }
  for (const OrientedBox& part : query.head) {
    for (const std::size_t link : kHeadMeets) query.test(link, part);
  }
}

void ArmCollision::testGround(Query& query) const {
  for (std::size_t link = 1; link < query.links.size(); ++link) {
    const Capsule& c = query.links[link];
    query.offer(std::min(c.a.z(), c.b.z()) - c.radius, kLink[link], "ground");
  }
  for (const OrientedBox& part : query.head) {
    const Eigen::Vector3d down = part.X_frame_box.linear().row(2).transpose();
    query.offer(part.X_frame_box.translation().z() - down.cwiseAbs().dot(part.half),
                part.name.c_str(), "ground");
  }
}

ArmShapes ArmCollision::shapesAt(const Vector6d& q) const {
  ArmShapes out;
  const auto frames = robot_.arm.frames(q);
  Eigen::Vector3d from = X_base_armbase_.translation();
  for (std::size_t i = 0; i < 6; ++i) {
    const Eigen::Vector3d to = X_base_armbase_ * frames[i].translation();
    out.links[i] = {from, to, radius_[i]};
    from = to;
  }
  for (const std::size_t link : {kUpperArm, kForearm}) {
    const Eigen::Vector3d beside =
        (radius_[link] + kHoseGap_m) * (X_base_armbase_.linear() * frames[link].linear().col(2));
    const Capsule& c = out.links[link];
    out.links[kHoses + link - kUpperArm] = {c.a + beside, c.b + beside, kHoseRadius_m};
  }
  const Eigen::Isometry3d X_base_flange = X_base_armbase_ * frames[5];
  for (const OrientedBox& part : head_in_flange_) {
    out.head.push_back(part);
    out.head.back().X_frame_box = X_base_flange * part.X_frame_box;
  }
  return out;
}

ArmCollision::Query ArmCollision::evaluate(const Vector6d& q, double interest_m) const {
  Query query;
  static_cast<ArmShapes&>(query) = shapesAt(q);
  query.interest_m = interest_m;
  testBody(query);
  testSelf(query);
  testGround(query);
  testScene(query);
  return query;
}

Clearance ArmCollision::clearance(const Vector6d& q, double interest_m) const {
  const Query query = evaluate(q, interest_m);
  return {query.nearest, fmt::format("{} to {}", query.first, query.second)};
}

double ArmCollision::distance(const Vector6d& q, double interest_m) const {
  return evaluate(q, interest_m).nearest;
}

double ArmCollision::motionBound(const Vector6d& dq) const { return reach_.dot(dq.cwiseAbs()); }

bool ArmCollision::pathIsFree(const Vector6d& q_from, const Vector6d& q_to,
                              double clearance_m) const {
  const double length = motionBound(q_to - q_from);
  double s = 0.0;
  while (true) {
    const double room = distance(q_from + s * (q_to - q_from)) - clearance_m;
    if (room < 0.0) return false;
    if (s >= 1.0) return true;
    s = std::min(1.0, s + std::max(room, kMinStep) / std::max(length, 1e-9));
  }
}

}  // namespace kiln
