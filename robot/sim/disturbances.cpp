#include "robot/sim/disturbances.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "robot/sim/fault_catalog.h"

namespace kiln::sim {
namespace {

constexpr double kStep_mps = 1.1;  // of somebody who steps into the way
constexpr double kAside_m = 1.8;   // where they come from

Pose2 shift(const FaultConfig& fault) {
  return {faultValue(fault, 0), faultValue(fault, 1), faultValue(fault, 2) * kDeg};
}

}  // namespace

Disturbances::Disturbances(const TrueArena& arena, const RobotGeometry& robot, std::uint64_t seed)
    : arena_(arena), robot_(robot), seed_(seed) {
  for (std::size_t i = 0; i < arena.boxes.size() && !cupboard_; ++i) {
    if (arena.boxes[i].name == "cupboard") cupboard_ = i;
  }
}

void Disturbances::kidnap(const FaultScript& faults, Stamp now, Physics& physics) {
  kidnapped_.resize(faults.all().size(), false);
  for (std::size_t i = 0; i < kidnapped_.size(); ++i) {
    const FaultConfig& fault = faults.all()[i];
    if (kidnapped_[i] || fault.name != "kidnap" || toSeconds(now) < fault.at_s) continue;
    kidnapped_[i] = true;
    kidnaps_.push_back(projectToGround(physics.X_map_base()) * shift(fault));
    physics.displace(arena_.ground.standing(kidnaps_.back(), robot_));
  }
}

void Disturbances::moveCupboard(const FaultConfig* fault, Physics& physics) {
  if ((fault != nullptr) == moved_.has_value() || !cupboard_) return;
  const SolidBox& box = arena_.boxes[*cupboard_];
  moved_.reset();
  if (fault != nullptr) {
    const Pose2 by = shift(*fault);
    Eigen::Isometry3d X = box.X_map_box;
    X.pretranslate(Eigen::Vector3d(by.x_m, by.y_m, 0));
    X.rotate(Eigen::AngleAxisd(by.yaw_rad, Eigen::Vector3d::UnitZ()));
    moved_ = MovedBox{*cupboard_, X};
  }
  physics.moveBox(box.name, moved_ ? moved_->X_map_box : box.X_map_box);
}

void Disturbances::walk(const FaultConfig* fault, double step_s, const Physics& physics) {
  if (fault == nullptr) {
    walkers_.reset();
    return;
  }
  if (!walkers_) {
    const double count = std::clamp(faultValue(*fault, 0), 0.0, static_cast<double>(kMaxPeople));
    walkers_.emplace(arena_, seed_, static_cast<std::size_t>(count));
  }
  walkers_->step(step_s, physics.X_map_base().translation().head<2>());
}

void Disturbances::stepInWay(const FaultConfig* fault, double step_s) {
  if (fault == nullptr && !bystander_) return;
  Eigen::Vector2d goal = bystander_ ? bystander_->from : Eigen::Vector2d::Zero();
  if (fault != nullptr) {
    goal = {faultValue(*fault, 0), faultValue(*fault, 1)};
    const Eigen::Vector2d from = goal + Eigen::Vector2d(0.0, kAside_m);
    if (!bystander_) bystander_ = Bystander{from, from};
  }
  const Eigen::Vector2d way = goal - bystander_->p;
  const double stride = kStep_mps * step_s;
  bystander_->p =
      way.norm() <= stride ? goal : Eigen::Vector2d(bystander_->p + stride * way.normalized());
  if (fault == nullptr && bystander_->p == bystander_->from) bystander_.reset();
}

void Disturbances::step(const FaultScript& faults, Stamp now, double step_s, Physics& physics) {
  if (faults.all().empty()) return;
  kidnap(faults, now, physics);
  moveCupboard(faults.find("cupboard_moved", now), physics);
  walk(faults.find("people", now), step_s, physics);
  stepInWay(faults.find("person_in_way", now), step_s);
  const FaultConfig* blocked = faults.find("view_blocked", now);
  board_azimuth_rad_.reset();
  if (blocked != nullptr) board_azimuth_rad_ = faultValue(*blocked, 0) * kDeg;
}

void Disturbances::show(SceneState& state) const {
  if (walkers_) state.people = walkers_->feet();
  if (bystander_)
    state.people.emplace_back(bystander_->p.x(), bystander_->p.y(),
                              arena_.ground.height(bystander_->p.x()));
  state.moved = moved_;
  state.board_azimuth_rad = board_azimuth_rad_;
}

}  // namespace kiln::sim
