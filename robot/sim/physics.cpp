#include "robot/sim/physics.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <mujoco/mujoco.h>

#include "common/core/log.h"
#include "robot/sim/box_contact_filter.h"
#include "robot/sim/mjcf.h"
#include "robot/sim/physics_impl.h"
#include "robot/sim/wall_mjcf.h"

namespace kiln::sim {
namespace {

const Eigen::Vector3d kBelowTheFloor(0, 0, -5);  // as in the model

/// MuJoCo calls this and must not get control back: its state is undefined afterwards.
void onMujocoError(const char* message) {
  logger("sim.physics")
      ->error("MuJoCo stopped: {}; the world ends here, please start it again", message);
  std::_Exit(3);
}

void onMujocoWarning(const char* message) {
  const std::string text = message;
  if (text.find("unstable") != std::string::npos || text.find("Nan, Inf") != std::string::npos) {
    onMujocoError(message);
  }
  logger("sim.physics")->warn("MuJoCo: {}", text);
}

/// The virtual file system is 2 MB: never on the stack.
Result<mjModel*> loadModel(const std::string& xml) {
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  if (mj_makeEmptyFileVFS(vfs.get(), "world.xml", static_cast<int>(xml.size())) != 0) {
    return makeError(ErrorCode::Fault,
                     "the physics model of {} bytes does not fit MuJoCo's file store", xml.size());
  }
  std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), "world.xml")], xml.data(), xml.size());
  char error[1000] = {};
  mjModel* model = mj_loadXML("world.xml", vfs.get(), error, sizeof(error));
  mj_deleteVFS(vfs.get());
  if (model == nullptr)
    return makeError(ErrorCode::InvalidInput, "MuJoCo refuses the world: {}", error);
  return model;
}

std::vector<GeomInfo> describeGeoms(const mjModel* m) {
  std::vector<GeomInfo> out(static_cast<std::size_t>(m->ngeom));
  for (int g = 0; g < m->ngeom; ++g) {
    GeomInfo& info = out[static_cast<std::size_t>(g)];
    const char* name = mj_id2name(m, mjOBJ_GEOM, g);
    info.name = name == nullptr ? "?" : name;
    info.robot =
        m->geom_contype[g] == 2 || m->geom_contype[g] == 4 || m->geom_contype[g] == kFaceBit;
    info.wheel = m->geom_contype[g] == 4;
    info.storage = info.name.starts_with("storage");
    info.floor = info.name.starts_with("floor");
    info.arm = info.robot && (info.name.starts_with("arm") || info.name.starts_with("head") ||
                              info.name.starts_with("hose"));
    if (!info.robot || info.wheel) info.name = info.name.substr(0, info.name.find(" #"));
  }
  return out;
}

}  // namespace

Physics::Impl::~Impl() {
  if (d != nullptr) mj_deleteData(d);
  if (m != nullptr) mj_deleteModel(m);
}

bool Physics::Impl::isObstacle(int geom) const { return m->geom_bodyid[geom] == obstacle_body; }

JointState Physics::Impl::joint(int id) const {
  return {d->qpos[m->jnt_qposadr[id]], d->qvel[m->jnt_dofadr[id]]};
}

void Physics::Impl::resolveNames() {
  geoms = describeGeoms(m);
  base_body = mj_name2id(m, mjOBJ_BODY, names::kBase);
  flange_body = mj_name2id(m, mjOBJ_BODY, names::kFlange);
  obstacle_body = mj_name2id(m, mjOBJ_BODY, names::kObstacle);
  obstacle_mocap = m->body_mocapid[obstacle_body];
  base_qpos = m->jnt_qposadr[m->body_jntadr[base_body]];
  base_qvel = m->jnt_dofadr[m->body_jntadr[base_body]];
  for (std::size_t i = 0; i < 4; ++i) {
    steer_joint[i] = mj_name2id(m, mjOBJ_JOINT, names::kSteer[i]);
    drive_joint[i] = mj_name2id(m, mjOBJ_JOINT, names::kDrive[i]);
    steer_motor[i] = mj_name2id(m, mjOBJ_ACTUATOR, names::kSteer[i]);
    drive_motor[i] = mj_name2id(m, mjOBJ_ACTUATOR, names::kDrive[i]);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    arm_joint[i] = mj_name2id(m, mjOBJ_JOINT, names::kJoint[i]);
    arm_motor[i] = mj_name2id(m, mjOBJ_ACTUATOR, names::kJoint[i]);
    arm_dof[i] = m->jnt_dofadr[arm_joint[i]];
  }
  for (std::size_t i = 0;; ++i) {
    const int id = mj_name2id(m, mjOBJ_JOINT, names::compartment(i).c_str());
    if (id < 0) break;
    compartment_joint.push_back(id);
    compartment_motor.push_back(mj_name2id(m, mjOBJ_ACTUATOR, names::compartment(i).c_str()));
  }
}

Physics::Physics(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Physics::~Physics() = default;

Result<std::unique_ptr<Physics>> Physics::create(const WorldConfig& config, const TrueArena& arena,
                                                 const RobotGeometry& robot) {
  mju_user_error = onMujocoError;
  mju_user_warning = onMujocoWarning;
  installBoxContactFilter();
  auto impl = std::make_unique<Impl>();
  auto model = loadModel(mjcf(config, arena, robot));
  if (!model) return tl::make_unexpected(model.error());
  impl->m = *model;
  impl->d = mj_makeData(impl->m);
  if (impl->d == nullptr) return makeError(ErrorCode::Fault, "MuJoCo has no memory for the world");
  impl->resolveNames();
  impl->wall = config.wall;
  if (arena.wall.present())
    impl->bricks = std::make_unique<BrickBodies>(impl->m, impl->d, config, arena, robot);
  mj_step1(impl->m, impl->d);
  return std::unique_ptr<Physics>(new Physics(std::move(impl)));
}

void Physics::step() {
  Impl& w = *impl_;
  if (w.bricks) w.bricks->pull();
  mj_step2(w.m, w.d);
  w.collectContacts();
  if (w.bricks) w.bricks->settle(w.m->opt.timestep);
  // Positions, velocities and inertia for the devices and sensors of this instant.
  mj_step1(w.m, w.d);
}

void Physics::moveBox(const std::string& name, const Eigen::Isometry3d& X) {
  for (std::size_t g = 0; g < impl_->geoms.size(); ++g) {
    if (impl_->geoms[g].robot || impl_->geoms[g].name != name) continue;
    const Eigen::Quaterniond q(X.linear());
    const double quat[4] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(X.translation().data(), X.translation().data() + 3, impl_->m->geom_pos + 3 * g);
    std::copy(quat, quat + 4, impl_->m->geom_quat + 4 * g);
    return;
  }
}

void Physics::Impl::setObstacle(const Eigen::Vector3d& p) {
  std::copy(p.data(), p.data() + 3, d->mocap_pos + 3 * obstacle_mocap);
}

bool Physics::placeObstacle(const Eigen::Vector3d& p) {
  const mjData* d = impl_->d;
  impl_->setObstacle(p);
  mj_step1(impl_->m, impl_->d);
  const bool touches = std::any_of(d->contact, d->contact + d->ncon, [this](const mjContact& c) {
    return impl_->isObstacle(c.geom1) || impl_->isObstacle(c.geom2);
  });
  if (touches) removeObstacle();
  return !touches;
}

void Physics::removeObstacle() {
  impl_->setObstacle(kBelowTheFloor);
  mj_step1(impl_->m, impl_->d);
}

void Physics::setSteerTorque(std::size_t wheel, double torque) {
  impl_->d->ctrl[impl_->steer_motor[wheel]] = torque;
}
void Physics::setDriveTorque(std::size_t wheel, double torque) {
  impl_->d->ctrl[impl_->drive_motor[wheel]] = torque;
}

void Physics::setCompartmentForce(std::size_t compartment, double force_n) {
  impl_->d->ctrl[impl_->compartment_motor[compartment]] = force_n;
}

void Physics::setCarried(double mass_kg, const Eigen::Vector3d& p_flange_com) {
  impl_->carried_kg = mass_kg;
  impl_->p_flange_carried = p_flange_com;
}

JointState Physics::compartment(std::size_t compartment) const {
  return impl_->joint(impl_->compartment_joint[compartment]);
}

std::vector<double> Physics::compartmentPositions() const {
  std::vector<double> out;
  for (const int joint : impl_->compartment_joint) out.push_back(impl_->joint(joint).position);
  return out;
}

BrickBodies* Physics::bricks() { return impl_->bricks.get(); }
const BrickBodies* Physics::bricks() const { return impl_->bricks.get(); }

JointState Physics::steer(std::size_t wheel) const {
  return impl_->joint(impl_->steer_joint[wheel]);
}
JointState Physics::drive(std::size_t wheel) const {
  return impl_->joint(impl_->drive_joint[wheel]);
}

Vector6d Physics::armPosition() const {
  Vector6d q;
  for (std::size_t i = 0; i < 6; ++i)
    q[static_cast<Eigen::Index>(i)] = impl_->joint(impl_->arm_joint[i]).position;
  return q;
}

Vector6d Physics::armVelocity() const {
  Vector6d qd;
  for (std::size_t i = 0; i < 6; ++i)
    qd[static_cast<Eigen::Index>(i)] = impl_->joint(impl_->arm_joint[i]).velocity;
  return qd;
}

Eigen::Isometry3d Physics::X_map_base() const { return impl_->poseOf(impl_->base_body); }

Eigen::Isometry3d Physics::Impl::poseOf(int body) const {
  const mjtNum* p = d->xpos + 3 * body;
  const mjtNum* q = d->xquat + 4 * body;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return X;
}

Eigen::Vector3d Physics::flangePointVelocity(const Eigen::Vector3d& p_map) const {
  mjtNum v[6];  // angular, linear of the body frame in world orientation
  mj_objectVelocity(impl_->m, impl_->d, mjOBJ_XBODY, impl_->flange_body, v, 0);
  const mjtNum* o = impl_->d->xpos + 3 * impl_->flange_body;
  const Eigen::Vector3d arm = p_map - Eigen::Vector3d(o[0], o[1], o[2]);
  return Eigen::Vector3d(v[3], v[4], v[5]) + Eigen::Vector3d(v[0], v[1], v[2]).cross(arm);
}

const std::vector<BodyContact>& Physics::contacts() const { return impl_->contacts; }

}  // namespace kiln::sim
