#include "robot/sim/physics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

#include <mujoco/mujoco.h>

#include "common/core/log.h"
#include "robot/sim/box_contact_filter.h"
#include "robot/sim/mjcf.h"

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

struct GeomInfo {
  std::string name;
  bool robot = false, wheel = false, arm = false, floor = false;
};

std::vector<GeomInfo> describeGeoms(const mjModel* m) {
  std::vector<GeomInfo> out(static_cast<std::size_t>(m->ngeom));
  for (int g = 0; g < m->ngeom; ++g) {
    GeomInfo& info = out[static_cast<std::size_t>(g)];
    const char* name = mj_id2name(m, mjOBJ_GEOM, g);
    info.name = name == nullptr ? "?" : name;
    info.robot = m->geom_contype[g] != 1;
    info.wheel = m->geom_contype[g] == 4;
    info.floor = info.name.starts_with("floor");
    info.arm = info.robot && (info.name.starts_with("arm") || info.name.starts_with("head") ||
                              info.name.starts_with("hose"));
    if (!info.robot || info.wheel) info.name = info.name.substr(0, info.name.find(" #"));
  }
  return out;
}

}  // namespace

struct Physics::Impl {
  mjModel* m = nullptr;
  mjData* d = nullptr;
  std::vector<GeomInfo> geoms;
  int base_body = 0, flange_body = 0, obstacle_body = 0, obstacle_mocap = 0;
  int base_qpos = 0, base_qvel = 0;
  std::array<int, 4> steer_joint{}, drive_joint{};
  std::array<int, 6> arm_joint{};
  std::array<int, 4> steer_motor{}, drive_motor{};
  std::array<int, 6> arm_motor{};
  std::vector<mjtNum> mass_matrix;
  std::vector<BodyContact> contacts;

  ~Impl() {
    if (d != nullptr) mj_deleteData(d);
    if (m != nullptr) mj_deleteModel(m);
  }
  void resolveNames();
  void placeBase(const Eigen::Isometry3d& X_map_base);
  void collectContacts();
  void setObstacle(const Eigen::Vector3d& p_map);
  [[nodiscard]] bool isObstacle(int geom) const { return m->geom_bodyid[geom] == obstacle_body; }
  [[nodiscard]] JointState joint(int id) const {
    return {d->qpos[m->jnt_qposadr[id]], d->qvel[m->jnt_dofadr[id]]};
  }
};

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
  }
  mass_matrix.resize(static_cast<std::size_t>(m->nv) * static_cast<std::size_t>(m->nv));
}

/// Sums the points of each touching pair. Forces belong to the step that was just taken.
void Physics::Impl::collectContacts() {
  contacts.clear();
  std::map<std::pair<int, int>, std::size_t> seen;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.efc_address < 0) continue;
    int a = c.geom1, b = c.geom2;
    double sign = -1.0;  // mj_contactForce is the force on geom2
    const auto info = [&](int g) -> const GeomInfo& { return geoms[static_cast<std::size_t>(g)]; };
    if (!info(a).robot || (info(b).arm && !info(a).arm)) {
      std::swap(a, b);
      sign = 1.0;
    }
    mjtNum f[6];
    mj_contactForce(m, d, i, f);
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      force += sign * f[axis] *
               Eigen::Vector3d(c.frame[3 * axis], c.frame[3 * axis + 1], c.frame[3 * axis + 2]);
    const auto [it, fresh] = seen.try_emplace({a, b}, contacts.size());
    if (fresh) {
      BodyContact contact;
      contact.a = info(a).name;
      contact.b = info(b).name;
      contact.wheel = info(a).wheel;
      contact.floor = info(b).floor;
      contact.arm = info(a).arm && !info(b).arm;
      contacts.push_back(contact);
    }
    BodyContact& contact = contacts[it->second];
    // Force-weighted mean of the points, kept as a running mean.
    const double before = contact.normal_n;
    contact.normal_n += f[0];
    const Eigen::Vector3d p(c.pos[0], c.pos[1], c.pos[2]);
    contact.point = contact.normal_n > 1e-9
                        ? Eigen::Vector3d((before * contact.point + f[0] * p) / contact.normal_n)
                        : p;
    contact.force_on_a += force;
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
  mj_step1(impl->m, impl->d);
  return std::unique_ptr<Physics>(new Physics(std::move(impl)));
}

void Physics::step() {
  mj_step2(impl_->m, impl_->d);
  impl_->collectContacts();
  mj_step1(
      impl_->m,
      impl_->d);  // positions, velocities and inertia for the devices and sensors of this instant
}

/// Half a millimetre above the ground, so that no contact begins deep inside it.
void Physics::Impl::placeBase(const Eigen::Isometry3d& X) {
  const Eigen::Vector3d p = X * Eigen::Vector3d(0, 0, 0.0005);
  const Eigen::Quaterniond r(X.linear());
  mjtNum* base = d->qpos + base_qpos;
  const double pose[7] = {p.x(), p.y(), p.z(), r.w(), r.x(), r.y(), r.z()};
  std::copy(pose, pose + 7, base);
}

void Physics::carryTo(const Eigen::Isometry3d& X, const Vector6d& q) {
  mjModel* m = impl_->m;
  mjData* d = impl_->d;
  const Eigen::Vector3d obstacle(d->mocap_pos + 3 * impl_->obstacle_mocap);
  const double time = d->time;
  mj_resetData(m, d);
  d->time = time;
  impl_->setObstacle(obstacle);
  impl_->placeBase(X);
  for (std::size_t i = 0; i < 6; ++i)
    d->qpos[m->jnt_qposadr[impl_->arm_joint[i]]] = q[static_cast<Eigen::Index>(i)];
  impl_->contacts.clear();
  mj_step1(m, d);
}

void Physics::displace(const Eigen::Isometry3d& X) {
  mjtNum* v = impl_->d->qvel + impl_->base_qvel;  // linear in map, angular in base
  const Eigen::Vector3d turned =
      X.linear() * (X_map_base().linear().transpose() * Eigen::Vector3d(v[0], v[1], v[2]));
  std::copy(turned.data(), turned.data() + 3, v);
  impl_->placeBase(X);
  impl_->contacts.clear();
  mj_step1(impl_->m, impl_->d);
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

Vector6d Physics::accelerateArm(const Vector6d& qdd) {
  mjModel* m = impl_->m;
  mjData* d = impl_->d;
  mj_fullM(m, impl_->mass_matrix.data(), d->qM);
  Vector6d torque;
  for (std::size_t i = 0; i < 6; ++i) {
    const int row = m->jnt_dofadr[impl_->arm_joint[i]];
    double sum = d->qfrc_bias[row];
    for (std::size_t j = 0; j < 6; ++j) {
      const int column = m->jnt_dofadr[impl_->arm_joint[j]];
      sum += impl_->mass_matrix[static_cast<std::size_t>(row * m->nv + column)] *
             qdd[static_cast<Eigen::Index>(j)];
    }
    torque[static_cast<Eigen::Index>(i)] = sum;
    d->ctrl[impl_->arm_motor[i]] = sum;
  }
  return torque;
}

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

Eigen::Isometry3d Physics::X_map_base() const {
  const mjtNum* p = impl_->d->xpos + 3 * impl_->base_body;
  const mjtNum* q = impl_->d->xquat + 4 * impl_->base_body;
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
