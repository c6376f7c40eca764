#include "robot/sim/brick_bodies.h"

#include <algorithm>
#include <cmath>

#include <mujoco/mujoco.h>

#include "robot/sim/mjcf.h"
#include "robot/sim/wall_mjcf.h"

namespace kiln::sim {
namespace {

constexpr double kRest_mps = 0.004, kRest_radps = 0.02;     ///< slower counts as rest
constexpr double kRest_s = 0.3;                             ///< before a brick is frozen
constexpr double kMoving_mps = 0.02, kMoving_radps = 0.05;  ///< faster wakes its neighbours
constexpr double kCheck_s = 0.02;                           ///< at 1 m/s a mover comes 2 cm nearer
constexpr double kHysteresis_m = 0.1;
constexpr double kFaceReach_m = 0.02;  ///< beyond that magnets do nothing that could be seen
constexpr double kStick_mps = 0.01, kStick_radps = 0.05;
constexpr int kStickSteps = 3;
constexpr double kNoWeld_s = 0.1;
constexpr double kGravity_mps2 = 9.81;

Eigen::Vector3d vec(const mjtNum* v) { return {v[0], v[1], v[2]}; }

Eigen::Isometry3d bodyPose(const mjData* d, int body) {
  const mjtNum* q = d->xquat + 4 * body;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = vec(d->xpos + 3 * body);
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return X;
}

void writePose(mjtNum* p, mjtNum* q, const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond r(X.linear());
  const Eigen::Vector3d t = X.translation();
  std::copy(t.data(), t.data() + 3, p);
  const double quat[4] = {r.w(), r.x(), r.y(), r.z()};
  std::copy(quat, quat + 4, q);
}

}  // namespace

bool BrickState::atRest() const {
  return frozen || (v_mps.norm() < kRest_mps && w_radps.norm() < kRest_radps);
}

BrickBodies::BrickBodies(mjModel* model, mjData* data, const WorldConfig& config,
                         const TrueArena& arena, const RobotGeometry& robot)
    : m_(model),
      d_(data),
      config_(config.wall),
      bricks_(arena.wall.bricks),
      X_flange_tool_(robot.X_flange_tool.pose()) {
  brick_of_geom_.assign(static_cast<std::size_t>(m_->ngeom), -1);
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    Body b;
    b.body = mj_name2id(m_, mjOBJ_BODY, names::brick(i).c_str());
    b.geom = m_->body_geomadr[b.body];
    const int twin = mj_name2id(m_, mjOBJ_BODY, names::twin(i).c_str());
    b.twin_geom = m_->body_geomadr[twin];
    b.twin_mocap = m_->body_mocapid[twin];
    b.qpos = m_->jnt_qposadr[m_->body_jntadr[b.body]];
    b.qvel = m_->jnt_dofadr[m_->body_jntadr[b.body]];
    b.weld = mj_name2id(m_, mjOBJ_EQUALITY, names::grip(i).c_str());
    brick_of_geom_[static_cast<std::size_t>(b.geom)] = static_cast<int>(i);
    brick_of_geom_[static_cast<std::size_t>(b.twin_geom)] = static_cast<int>(i);
    bodies_.push_back(b);
  }
  flange_body_ = mj_name2id(m_, mjOBJ_BODY, names::kFlange);
  face_geom_ = mj_name2id(m_, mjOBJ_GEOM, names::kFace);
  for (int g = 0; g < m_->ngeom; ++g) {
    const int type = m_->geom_contype[g];
    if (type == 2 || type == 4 || type == kFaceBit) robot_geoms_.push_back(g);
  }
}

BrickBodies::~BrickBodies() = default;

std::optional<std::size_t> BrickBodies::brickOf(int geom) const {
  const int brick = brick_of_geom_[static_cast<std::size_t>(geom)];
  return brick < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(brick));
}

/// From the state itself: positions of bodies are those of the step before until the next one.
BrickState BrickBodies::state(std::size_t brick) const {
  const Body& b = bodies_[brick];
  BrickState out;
  const mjtNum* q = d_->qpos + b.qpos;
  out.X_map_brick.translation() = vec(q);
  out.X_map_brick.linear() =
      Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
  out.v_mps = vec(d_->qvel + b.qvel);
  out.w_radps = vec(d_->qvel + b.qvel + 3);
  out.frozen = b.frozen;
  return out;
}

std::size_t BrickBodies::awake() const {
  return static_cast<std::size_t>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return !b.frozen; }));
}

Eigen::Isometry3d BrickBodies::X_map_tool() const {
  return bodyPose(d_, flange_body_) * X_flange_tool_;
}

/// nullopt: the brick's upper side is not before the face.
std::optional<MagnetTouch> BrickBodies::touchOf(std::size_t brick,
                                                const Eigen::Isometry3d& X_map_tool) const {
  const TrueBrick& truth = bricks_[brick];
  const Eigen::Isometry3d X_brick_tool = bodyPose(d_, bodies_[brick].body).inverse() * X_map_tool;
  const Eigen::Vector3d half = 0.5 * truth.size_m, face = X_brick_tool.translation();
  if (std::fabs(face.z() - half.z()) > kFaceReach_m || std::fabs(face.x()) > half.x() + 0.1 ||
      std::fabs(face.y()) > half.y() + 0.1 || X_brick_tool.linear()(2, 2) > -0.9)
    return std::nullopt;
  MagnetTouch touch;
  const auto positions = magnetPositions();
  for (std::size_t i = 0; i < kMagnets; ++i) {
    const Eigen::Vector3d p = X_brick_tool * Eigen::Vector3d(positions[i].x(), positions[i].y(), 0);
    const bool beside = std::fabs(p.x()) > half.x() || std::fabs(p.y()) > half.y();
    touch.gap_m[i] = beside ? kFaceReach_m : p.z() - half.z();
    touch.share[i] = plateShare(truth, p.head<2>(), config_.magnets.radius_m);
    touch.pull_n[i] = magnetPull(config_.magnets, fields_[i], touch.share[i], touch.gap_m[i]);
  }
  return touch;
}

/// Magnets on what they do not hold yet: real forces between brick and flange. What they hold is
/// welded, and judge() keeps account of the pull.
void BrickBodies::pull() {
  std::fill(d_->xfrc_applied, d_->xfrc_applied + 6 * m_->nbody, 0.0);
  grip_.force_n.setZero();
  grip_.torque_nm.setZero();
  const Eigen::Isometry3d X = X_map_tool();
  grip_.p_map = X.translation();
  if (grip_.held) return;
  grip_.touch = {};
  const Eigen::Vector3d towards = -X.linear().col(2);  // of the brick, to the face
  const auto positions = magnetPositions();
  for (std::size_t brick = 0; brick < size(); ++brick) {
    if (bodies_[brick].frozen) continue;
    const auto touch = touchOf(brick, X);
    if (!touch) continue;
    grip_.touch = *touch;
    if (touch->pull() < 1e-3) continue;
    mjtNum* on_brick = d_->xfrc_applied + 6 * bodies_[brick].body;
    mjtNum* on_flange = d_->xfrc_applied + 6 * flange_body_;
    const Eigen::Vector3d brick_com = vec(d_->xipos + 3 * bodies_[brick].body),
                          flange_com = vec(d_->xipos + 3 * flange_body_);
    for (std::size_t i = 0; i < kMagnets; ++i) {
      const Eigen::Vector3d p = X * Eigen::Vector3d(positions[i].x(), positions[i].y(), 0);
      const Eigen::Vector3d f = touch->pull_n[i] * towards;
      const Eigen::Vector3d t = (p - brick_com).cross(f), back = (p - flange_com).cross(-f);
      for (int k = 0; k < 3; ++k) {
        on_brick[k] += f[k];
        on_brick[3 + k] += t[k];
        on_flange[k] -= f[k];
        on_flange[3 + k] += back[k];
      }
      grip_.force_n -= f;
      grip_.torque_nm += (p - grip_.p_map).cross(-f);
    }
  }
}

void BrickBodies::beginContacts() {
  grip_.touched.reset();
  for (Body& b : bodies_) {
    b.force_n.setZero();
    b.torque_nm.setZero();
    b.face = false;
  }
}

void BrickBodies::noteContact(std::size_t brick, int other_geom, const Eigen::Vector3d& force_n,
                              const Eigen::Vector3d& p_map) {
  Body& b = bodies_[brick];
  if (other_geom == face_geom_) {
    b.face = true;
    grip_.touched = brick;
    return;
  }
  b.force_n += force_n;
  b.torque_nm += (p_map - vec(d_->xipos + 3 * b.body)).cross(force_n);
}

GripLoad BrickBodies::loadOf(std::size_t brick, const Eigen::Isometry3d& X_map_tool) const {
  const Body& b = bodies_[brick];
  const TrueBrick& truth = bricks_[brick];
  const Eigen::Matrix3d R = bodyPose(d_, b.body).linear();
  const Eigen::Vector3d inertia =
      truth.mass_kg / 12.0 *
      Eigen::Vector3d(truth.size_m.y() * truth.size_m.y() + truth.size_m.z() * truth.size_m.z(),
                      truth.size_m.x() * truth.size_m.x() + truth.size_m.z() * truth.size_m.z(),
                      truth.size_m.x() * truth.size_m.x() + truth.size_m.y() * truth.size_m.y());
  const Eigen::Vector3d a = vec(d_->qacc + b.qvel), alpha = vec(d_->qacc + b.qvel + 3),
                        w = vec(d_->qvel + b.qvel + 3);
  // What the face must do to the brick, at its middle, map.
  const Eigen::Vector3d force =
      truth.mass_kg * (a + Eigen::Vector3d(0, 0, kGravity_mps2)) - b.force_n;
  const Eigen::Vector3d torque =
      R * (inertia.cwiseProduct(alpha) + w.cross(inertia.cwiseProduct(w))) - b.torque_nm;
  const Eigen::Vector3d lever = vec(d_->xipos + 3 * b.body) - X_map_tool.translation();
  GripLoad load;
  load.force_n = -(X_map_tool.linear().transpose() * force);
  load.torque_nm = -(X_map_tool.linear().transpose() * (torque + lever.cross(force)));
  return load;
}

void BrickBodies::judge(double step_s) {
  no_weld_s_ = std::max(0.0, no_weld_s_ - step_s);
  // Positions of bodies and accelerations are both of the step that was just taken.
  const Eigen::Isometry3d X = X_map_tool();
  if (grip_.held) {
    const std::size_t brick = *grip_.held;
    const GripLoad load = loadOf(brick, X);
    // Gaps and shares are those of the moment when the weld took over: it gives a little.
    for (std::size_t i = 0; i < kMagnets; ++i)
      grip_.touch.pull_n[i] =
          magnetPull(config_.magnets, fields_[i], grip_.touch.share[i], grip_.touch.gap_m[i]);
    grip_.force_n = X.linear() * load.force_n;
    grip_.torque_nm = X.linear() * load.torque_nm;
    grip_.p_map = X.translation();
    if (judgeGrip(config_.magnets, grip_.touch, load) != GripVerdict::Holds) unweld();
    return;
  }
  if (!grip_.touched || no_weld_s_ > 0.0) {
    held_steps_ = 0;
    return;
  }
  const std::size_t brick = *grip_.touched;
  const auto touch = touchOf(brick, X);
  if (!touch || touch->pull() <= 0.0 ||
      judgeGrip(config_.magnets, *touch, loadOf(brick, X)) != GripVerdict::Holds) {
    held_steps_ = 0;
    return;
  }
  mjtNum v[6];
  mj_objectVelocity(m_, d_, mjOBJ_XBODY, flange_body_, v, 0);
  const Eigen::Vector3d w_flange = vec(v), o = vec(d_->xpos + 3 * flange_body_);
  const BrickState s = state(brick);
  const Eigen::Vector3d p = X.translation(), w_brick = s.X_map_brick.linear() * s.w_radps;
  const Eigen::Vector3d v_flange = vec(v + 3) + w_flange.cross(p - o),
                        v_brick = s.v_mps + w_brick.cross(p - s.X_map_brick.translation());
  const bool sticks =
      (v_flange - v_brick).norm() < kStick_mps && (w_flange - w_brick).norm() < kStick_radps;
  held_steps_ = sticks ? held_steps_ + 1 : 0;
  if (held_steps_ < kStickSteps) return;
  grip_.touch = *touch;
  weld(brick);
}

/// Where it hangs now, seen from the flange.
void BrickBodies::weld(std::size_t brick) {
  const Body& b = bodies_[brick];
  const Eigen::Isometry3d X = bodyPose(d_, flange_body_).inverse() * bodyPose(d_, b.body);
  mjtNum* data = m_->eq_data + mjNEQDATA * b.weld;
  std::fill(data, data + 3, 0.0);
  writePose(data + 3, data + 6, X);
  m_->eq_active[b.weld] = 1;
  m_->geom_conaffinity[b.geom] = kBrickMeets & ~kFaceBit;
  grip_.held = brick;
  held_steps_ = 0;
}

void BrickBodies::unweld() {
  if (!grip_.held) return;
  const Body& b = bodies_[*grip_.held];
  m_->eq_active[b.weld] = 0;
  m_->geom_conaffinity[b.geom] = kBrickMeets;
  grip_.held.reset();
  held_steps_ = 0;
  no_weld_s_ = kNoWeld_s;
}

void BrickBodies::letGo() { unweld(); }

void BrickBodies::freeze(Body& b) {
  b.frozen = true;
  b.X_frozen = state(static_cast<std::size_t>(&b - bodies_.data())).X_map_brick;
  m_->geom_contype[b.geom] = m_->geom_conaffinity[b.geom] = 0;
  m_->geom_contype[b.twin_geom] = kBrickBit;
  m_->geom_conaffinity[b.twin_geom] = kTwinMeets;
  writePose(d_->mocap_pos + 3 * b.twin_mocap, d_->mocap_quat + 4 * b.twin_mocap, b.X_frozen);
  putBack(b);
}

void BrickBodies::thaw(Body& b) {
  b.frozen = false;
  b.rest_s = 0.0;
  m_->geom_contype[b.geom] = kBrickBit;
  m_->geom_conaffinity[b.geom] = kBrickMeets;
  m_->geom_contype[b.twin_geom] = m_->geom_conaffinity[b.twin_geom] = 0;
  const mjtNum away[3] = {0, 0, -20};
  std::copy(away, away + 3, d_->mocap_pos + 3 * b.twin_mocap);
}

void BrickBodies::putBack(Body& b) {
  writePose(d_->qpos + b.qpos, d_->qpos + b.qpos + 3, b.X_frozen);
  std::fill(d_->qvel + b.qvel, d_->qvel + b.qvel + 6, 0.0);
  std::fill(d_->qacc + b.qvel, d_->qacc + b.qvel + 6, 0.0);
  std::fill(d_->qacc_warmstart + b.qvel, d_->qacc_warmstart + b.qvel + 6, 0.0);
}

Eigen::AlignedBox3d BrickBodies::boxAround(int geom) const {
  const Eigen::Vector3d p = vec(d_->geom_xpos + 3 * geom);
  Eigen::Vector3d half = Eigen::Vector3d::Constant(m_->geom_rbound[geom]);
  if (m_->geom_type[geom] == mjGEOM_BOX) {
    const mjtNum* r = d_->geom_xmat + 9 * geom;
    const mjtNum* s = m_->geom_size + 3 * geom;
    for (int i = 0; i < 3; ++i)
      half[i] = std::fabs(r[3 * i]) * s[0] + std::fabs(r[3 * i + 1]) * s[1] +
                std::fabs(r[3 * i + 2]) * s[2];
  }
  return {p - half, p + half};
}

void BrickBodies::freezeAndThaw(double step_s) {
  for (Body& b : bodies_) {
    if (b.frozen) continue;
    const std::size_t brick = static_cast<std::size_t>(&b - bodies_.data());
    b.rest_s = state(brick).atRest() ? b.rest_s + step_s : 0.0;
  }
  check_s_ += step_s;
  if (check_s_ < kCheck_s - 1e-9) return;
  check_s_ = 0.0;
  std::vector<Eigen::AlignedBox3d> movers;
  Eigen::AlignedBox3d robot;
  for (const int g : robot_geoms_) {
    movers.push_back(boxAround(g));
    robot.extend(movers.back());
  }
  const std::size_t parts = movers.size();
  for (std::size_t i = 0; i < size(); ++i) {
    if (bodies_[i].frozen) continue;
    const BrickState s = state(i);
    const bool moves = s.v_mps.norm() > kMoving_mps || s.w_radps.norm() > kMoving_radps;
    if (moves || grip_.held == i) movers.push_back(boxAround(bodies_[i].geom));
  }
  for (std::size_t i = 0; i < size(); ++i) {
    Body& b = bodies_[i];
    const Eigen::AlignedBox3d box = boxAround(b.geom);
    const double reach = config_.thaw_m + (b.frozen ? 0.0 : kHysteresis_m);
    const auto close = [&](const Eigen::AlignedBox3d& other) {
      return box.exteriorDistance(other) < reach;
    };
    bool near =
        close(robot) &&
        std::any_of(movers.begin(), movers.begin() + static_cast<std::ptrdiff_t>(parts), close);
    near = near ||
           std::any_of(movers.begin() + static_cast<std::ptrdiff_t>(parts), movers.end(), close);
    if (b.frozen && near)
      thaw(b);
    else if (!b.frozen && !near && b.rest_s >= kRest_s)
      freeze(b);
  }
}

void BrickBodies::settle(double step_s) {
  judge(step_s);
  for (Body& b : bodies_)
    if (b.frozen) putBack(b);
  if (config_.freeze) freezeAndThaw(step_s);
}

std::vector<double> BrickBodies::save() const {
  std::vector<double> out;
  for (const Body& b : bodies_) {
    out.insert(out.end(), d_->qpos + b.qpos, d_->qpos + b.qpos + 7);
    out.insert(out.end(), d_->qvel + b.qvel, d_->qvel + b.qvel + 6);
  }
  return out;
}

void BrickBodies::restore(const std::vector<double>& saved) {
  auto from = saved.begin();
  for (Body& b : bodies_) {
    std::copy(from, from + 7, d_->qpos + b.qpos);
    std::copy(from + 7, from + 13, d_->qvel + b.qvel);
    from += 13;
    if (b.frozen)
      writePose(d_->mocap_pos + 3 * b.twin_mocap, d_->mocap_quat + 4 * b.twin_mocap, b.X_frozen);
  }
}

void BrickBodies::place(std::size_t brick, const Eigen::Isometry3d& X) {
  Body& b = bodies_[brick];
  if (b.frozen) thaw(b);
  writePose(d_->qpos + b.qpos, d_->qpos + b.qpos + 3, X);
  std::fill(d_->qvel + b.qvel, d_->qvel + b.qvel + 6, 0.0);
  mj_step1(m_, d_);
}

}  // namespace kiln::sim
