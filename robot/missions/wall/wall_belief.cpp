#include "robot/missions/wall/wall_belief.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace kiln {
namespace {

using nlohmann::json;
constexpr double kFarthest_m = 1000.0;
constexpr int kMostLooks = 1000;

json toJson(const std::optional<FoundFrame>& frame) {
  if (!frame) return nullptr;
  json covariance = json::array();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) covariance.push_back(frame->covariance(i, j));
  const Pose2& X = frame->X_map_frame;
  return {{"x_m", X.x_m}, {"y_m", X.y_m}, {"yaw_rad", X.yaw_rad}, {"covariance", covariance}};
}

json toJson(const Eigen::Isometry3d& X) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Quaterniond q(X.linear());
  return {{"xyz_m", {p.x(), p.y(), p.z()}}, {"wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}

json toJson(const PileBrick& brick) {
  return {{"kind", brickShape(brick.kind).name},
          {"state", toString(brick.state)},
          {"pose", toJson(brick.X_map_brick)},
          {"confidence", brick.confidence},
          {"taken", brick.taken},
          {"along_m", brick.along_m}};
}

json toJson(const std::optional<HeldBrick>& held) {
  if (!held) return nullptr;
  return {{"name", held->name},
          {"kind", brickShape(held->kind).name},
          {"in_tool", toJson(held->X_tool_brick)},
          {"weighed_kg", held->weighed_kg}};
}

/// Throws json::exception. Error: no such kind.
Result<BrickKind> kindFrom(const json& saved) {
  const std::string name = saved.at("kind").get<std::string>();
  const auto* known = std::find_if(kBrickShapes.begin(), kBrickShapes.end(),
                                   [&](const BrickShape& shape) { return shape.name == name; });
  if (known == kBrickShapes.end())
    return makeError(ErrorCode::InvalidInput, "there are no bricks '{}'", name);
  return known->kind;
}

/// Throws json::exception. Error: no pose, or too far away.
Result<Eigen::Isometry3d> poseFrom(const json& saved) {
  const json &p = saved.at("xyz_m"), &q = saved.at("wxyz");
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.translation() =
      Eigen::Vector3d(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  const Eigen::Quaterniond turn(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
                                q.at(3).get<double>());
  constexpr double kUnit = 1e-3;
  if (!(out.translation().norm() < kFarthest_m && std::abs(turn.norm() - 1.0) < kUnit))
    return makeError(ErrorCode::InvalidInput, "a brick's pose is out of range");
  out.linear() = turn.normalized().toRotationMatrix();
  return out;
}

/// Throws json::exception.
Result<std::optional<HeldBrick>> heldFrom(const json& saved) {
  if (saved.is_null()) return std::optional<HeldBrick>();
  const auto kind = kindFrom(saved);
  if (!kind) return tl::make_unexpected(kind.error());
  const auto X = poseFrom(saved.at("in_tool"));
  if (!X) return tl::make_unexpected(X.error());
  HeldBrick out{saved.at("name").get<std::string>(), *kind, *X,
                saved.at("weighed_kg").get<double>()};
  if (!std::isfinite(out.weighed_kg))
    return makeError(ErrorCode::InvalidInput, "the held brick has no weight");
  return std::optional(std::move(out));
}

/// Throws json::exception.
Result<PileBrick> brickFrom(const json& saved) {
  PileBrick out;
  const auto kind = kindFrom(saved);
  if (!kind) return tl::make_unexpected(kind.error());
  out.kind = *kind;
  const std::string state = saved.at("state").get<std::string>();
  bool found = false;
  for (int i = 0; i <= static_cast<int>(BrickState::Excluded); ++i)
    if (toString(static_cast<BrickState>(i)) == state) {
      out.state = static_cast<BrickState>(i);
      found = true;
    }
  if (!found) return makeError(ErrorCode::InvalidInput, "a brick is '{}'", state);
  const auto X = poseFrom(saved.at("pose"));
  if (!X) return tl::make_unexpected(X.error());
  out.X_map_brick = *X;
  out.confidence = saved.at("confidence").get<double>();
  if (!(out.confidence >= 0.0 && out.confidence <= 1.0))
    return makeError(ErrorCode::InvalidInput, "a brick's confidence is {}", out.confidence);
  out.taken = saved.at("taken").get<bool>();
  out.along_m = saved.at("along_m").get<double>();
  if (!(out.along_m > 0.0 && out.along_m < kFarthest_m))
    return makeError(ErrorCode::InvalidInput, "a brick is known to {} m", out.along_m);
  return out;
}

/// Throws json::exception.
Result<std::optional<FoundFrame>> frameFrom(const json& saved, const char* name) {
  const json& node = saved.at(name);
  if (node.is_null()) return std::optional<FoundFrame>();
  FoundFrame out;
  out.X_map_frame = {node.at("x_m").get<double>(), node.at("y_m").get<double>(),
                     node.at("yaw_rad").get<double>()};
  const json& covariance = node.at("covariance");
  for (std::size_t k = 0; k < 9; ++k)
    out.covariance(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)) =
        covariance.at(k).get<double>();
  const Pose2& X = out.X_map_frame;
  // A NaN fails each of these.
  const bool ok = std::abs(X.x_m) < kFarthest_m && std::abs(X.y_m) < kFarthest_m &&
                  std::abs(X.yaw_rad) < 10.0 && out.covariance.allFinite() &&
                  out.covariance.diagonal().minCoeff() >= 0.0;
  if (!ok)
    return makeError(ErrorCode::InvalidInput, "{} is out of range: ({}, {}) m, {} rad", name, X.x_m,
                     X.y_m, X.yaw_rad);
  return std::optional(out);
}

}  // namespace

json wallBeliefToJson(const WallBelief& belief) {
  json bricks = json::array();
  for (const PileBrick& brick : belief.bricks) bricks.push_back(toJson(brick));
  json built = json::array();
  for (const Eigen::Isometry3d& X_wall_brick : belief.built) built.push_back(toJson(X_wall_brick));
  return {{"pile", toJson(belief.pile)},
          {"bricks", bricks},
          {"wall", toJson(belief.wall)},
          {"pile_looks", belief.pile_looks},
          {"brick_looks", belief.brick_looks},
          {"marker_looks", belief.marker_looks},
          {"drive_faults", belief.drive_faults},
          {"handling_faults", belief.handling_faults},
          {"stored", belief.stored},
          {"taken_out", belief.taken_out},
          {"built", built},
          {"held", toJson(belief.held)}};
}

Result<WallBelief> wallBeliefFromJson(const json& saved) {
  WallBelief out;
  try {
    auto pile = frameFrom(saved, "pile");
    if (!pile) return tl::make_unexpected(pile.error());
    auto wall = frameFrom(saved, "wall");
    if (!wall) return tl::make_unexpected(wall.error());
    out.pile = *pile;
    out.wall = *wall;
    constexpr std::size_t kMostBricks = 1000;
    auto held = heldFrom(saved.at("held"));
    if (!held) return tl::make_unexpected(held.error());
    out.held = *held;
    out.stored = saved.at("stored").get<std::size_t>();
    out.taken_out = saved.at("taken_out").get<std::size_t>();
    for (const json& node : saved.at("built")) {
      auto X = poseFrom(node);
      if (!X) return tl::make_unexpected(X.error());
      out.built.push_back(*X);
    }
    if (out.stored > kMostBricks || out.taken_out > out.stored ||
        out.built.size() > out.taken_out || out.taken_out > out.built.size() + 1)
      return makeError(ErrorCode::InvalidInput, "{} bricks were stored, {} taken out and {} set",
                       out.stored, out.taken_out, out.built.size());
    if (saved.at("bricks").size() > kMostBricks)
      return makeError(ErrorCode::InvalidInput, "a pile of {} bricks", saved.at("bricks").size());
    for (const json& node : saved.at("bricks")) {
      auto brick = brickFrom(node);
      if (!brick) return tl::make_unexpected(brick.error());
      out.bricks.push_back(*brick);
    }
    for (const auto& [name, count] :
         {std::pair{"pile_looks", &out.pile_looks}, std::pair{"brick_looks", &out.brick_looks},
          std::pair{"marker_looks", &out.marker_looks},
          std::pair{"drive_faults", &out.drive_faults},
          std::pair{"handling_faults", &out.handling_faults}}) {
      *count = saved.at(name).get<int>();
      if (*count < 0 || *count > kMostLooks)
        return makeError(ErrorCode::InvalidInput, "{} is {}", name, *count);
    }
  } catch (const json::exception& e) {
    return makeError(ErrorCode::InvalidInput, "what was known of the wall is damaged: {}",
                     e.what());
  }
  return out;
}

}  // namespace kiln
