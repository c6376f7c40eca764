#include "robot/sim/mjcf.h"

#include <iterator>

#include <fmt/format.h>

#include "robot/sim/arm_hull.h"
#include "robot/sim/wall_mjcf.h"

namespace kiln::sim {
namespace {

/// Vendor's figures (UR10e description): mass, centre of mass in the joint frame, principal
/// inertia. The offset of frames 1, 4, 5 and 6 along the joint axis (DH d) is added where the
/// vendor's frame has its origin there.
struct LinkInertia {
  double mass_kg;
  Eigen::Vector3d com_m;
  Eigen::Vector3d inertia_kgm2;
};

std::array<LinkInertia, 6> linkInertias(const UrKinematics& k) {
  return {{{7.369, {0.021, -0.027, k.d[0]}, {0.0341, 0.0353, 0.0216}},
           {13.051, {-0.2327, 0.0, 0.158}, {0.0281, 0.7707, 0.7694}},
           {3.989, {-0.33155, 0.0, 0.068}, {0.0101, 0.3093, 0.3065}},
           {2.1, {0.0, -0.018, k.d[3] + 0.007}, {0.00296, 0.00222, 0.00258}},
           {1.98, {0.0, 0.018, k.d[4] - 0.007}, {0.00296, 0.00222, 0.00258}},
           {0.615, {0.0, 0.0, k.d[5] - 0.026}, {0.00040, 0.00041, 0.00034}}}};
}

// Collision bits: 1 arena, 2 chassis and arm, 4 wheels. Wheels meet the arena alone: they sit
// inside the chassis box.
constexpr const char* kArenaBits = R"(contype="1" conaffinity="0")";
// Foam: pushes back little at first and more over 10 cm. A motion of 0.5 m/s under a guard of 40 N
// then stops before the 100 N of a protective stop.
constexpr const char* kPadding = R"(solref="0.1 1" solimp="0.02 0.5 0.1")";
constexpr const char* kRobotBits = R"(contype="2" conaffinity="3")";
constexpr const char* kWheelBits = R"(contype="4" conaffinity="1")";

std::string escape(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

class Writer {
 public:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  static std::string pose(const Eigen::Isometry3d& X) {
    const Eigen::Quaterniond q(X.linear());
    return fmt::format(R"(pos="{:.9g} {:.9g} {:.9g}" quat="{:.9g} {:.9g} {:.9g} {:.9g}")",
                       X.translation().x(), X.translation().y(), X.translation().z(), q.w(), q.x(),
                       q.y(), q.z());
  }
  void box(const std::string& name, const Eigen::Isometry3d& X, const Eigen::Vector3d& size,
           const char* bits, double mass_kg) {
    line(R"(<geom name="{}" type="box" size="{:.6g} {:.6g} {:.6g}" {} {} mass="{:.6g}"/>)",
         escape(name), 0.5 * size.x(), 0.5 * size.y(), 0.5 * size.z(), pose(X), bits, mass_kg);
  }
  std::string text_;
};

void writeOptions(Writer& w, const WorldConfig& config, const TrueArena& arena) {
  const double contact_s = 2 * config.physics.step_s + config.physics.contact_slack_s;
  w.line(R"(<compiler angle="radian" autolimits="true" inertiafromgeom="auto"/>)");
  w.line(R"(<option timestep="{:.6g}" solver="Newton" cone="pyramidal" iterations="50"/>)",
         config.physics.step_s);
  if (arena.wall.present())  // simulation.md: 290 contacts, 1100 rows; some 600 with full bins
    w.line(R"(<size njmax="5000" nconmax="1500" nstack="4000000"/>)");
  else
    w.line(R"(<size njmax="1200" nconmax="300" nstack="600000"/>)");
  w.line(
      R"(<default><geom condim="3" friction="{:.4g} 0.005 0.0001" solref="{:.6g} 1" solimp=".95 .99 .001"/></default>)",
      config.physics.friction, contact_s);
}

void writeArena(Writer& w, const TrueArena& arena) {
  w.line(R"(<geom name="floor" type="plane" size="100 100 1" pos="0 0 {:.9g}" {}/>)",
         arena.ground.lowest(), kArenaBits);
  int index = 0;
  for (const SolidBox& b : arena.ground_boxes) {  // the first one is that plane
    if (&b != &arena.ground_boxes.front()) w.box(b.name, b.X_map_box, b.size_m, kArenaBits, 0.0);
  }
  const auto add = [&](const SolidBox& b) {
    if (b.solid)
      w.box(fmt::format("{} #{}", b.name, index++), b.X_map_box, b.size_m, kArenaBits, 0.0);
  };
  for (const SolidBox& b : arena.boxes) add(b);
  for (const TrueFirePlace& place : arena.fire_places) {
    for (const SolidBox& b : place.boxes) add(b);
  }
  // The scripted arm obstacle waits below the floor, where nothing collides. It is padded: its
  // softness wins in every contact.
  w.line(
      R"(<body name="{0}" mocap="true" pos="0 0 -5"><geom name="{0} #{1}" type="box" size="{2} {2} {2}" priority="1" {3} {4}/></body>)",
      names::kObstacle, index, 0.5 * kObstacleSize_m, kPadding, kArenaBits);
}

/// A wheel is a cylinder for its inertia and touches the ground with the two rims of its tread, as
/// spheres: MuJoCo 2.2 finds one shaky contact between cylinder and box, but exact ones between
/// sphere and box, and the wheel rolls on both in the same way (decision 0012). The spheres stay
/// inside the chassis' footprint.
void writeWheels(Writer& w, const WorldConfig& config, const RobotGeometry& robot) {
  const BaseDeviceConfig& c = config.base;
  for (int i = 0; i < 4; ++i) {
    const double x = i < 2 ? robot.wheel_x_m : -robot.wheel_x_m,
                 y = i % 2 == 0 ? robot.wheel_y_m : -robot.wheel_y_m;
    w.line(R"(<body name="{}" pos="{:.6g} {:.6g} {:.6g}">)", names::kSteer[i], x, y,
           robot.wheel_radius_m);
    w.line(R"(<joint name="{}" axis="0 0 1" armature="{:.4g}" damping="0.5"/>)", names::kSteer[i],
           c.rotor_inertia_kgm2);
    w.line(R"(<inertial pos="0 0 0.1" mass="1" diaginertia="0.005 0.005 0.005"/>)");
    w.line(R"(<body name="{}"><joint name="{}" axis="0 1 0" armature="{:.4g}" damping="0.02"/>)",
           names::kWheel[i], names::kDrive[i], c.rotor_inertia_kgm2);
    const double r2 = robot.wheel_radius_m * robot.wheel_radius_m, axial = 0.5 * c.wheel_kg * r2,
                 across = c.wheel_kg * (3 * r2 + c.wheel_width_m * c.wheel_width_m) / 12;
    w.line(R"(<inertial pos="0 0 0" mass="{:.6g}" diaginertia="{:.6g} {:.6g} {:.6g}"/>)",
           c.wheel_kg, across, axial, across);
    for (const double side : {-0.5, 0.5}) {
      w.line(R"(<geom name="{}{}" type="sphere" size="{:.6g}" pos="0 {:.6g} 0" {}/>)",
             names::kWheel[i], side < 0 ? "" : " #2", robot.wheel_radius_m, side * c.wheel_width_m,
             kWheelBits);
    }
    w.line("</body></body>");
  }
}

void writeArmLink(Writer& w, const WorldConfig& config, const RobotGeometry& robot, std::size_t i) {
  const UrKinematics& k = robot.arm;
  const LinkInertia link = linkInertias(k)[i];
  // Body i carries joint i at its origin, Z along the joint axis; it sits in DH frame i - 1.
  const Eigen::Isometry3d X =
      i == 0 ? robot.X_base_armbase.pose()
             : Eigen::Isometry3d(Eigen::Translation3d(k.a[i - 1], 0, k.d[i - 1]) *
                                 Eigen::AngleAxisd(k.alpha[i - 1], Eigen::Vector3d::UnitX()));
  w.line(R"(<body name="arm link {}" {}>)", i + 1, Writer::pose(X));
  w.line(R"(<joint name="{}" axis="0 0 1" armature="{:.4g}"/>)", names::kJoint[i],
         config.arm.rotor_inertia_kgm2[i]);
  w.line(
      R"(<inertial pos="{:.6g} {:.6g} {:.6g}" mass="{:.6g}" diaginertia="{:.6g} {:.6g} {:.6g}"/>)",
      link.com_m.x(), link.com_m.y(), link.com_m.z(), link.mass_kg, link.inertia_kgm2.x(),
      link.inertia_kgm2.y(), link.inertia_kgm2.z());
  const Eigen::Isometry3d X_joint_end(Eigen::Translation3d(k.a[i], 0, k.d[i]) *
                                      Eigen::AngleAxisd(k.alpha[i], Eigen::Vector3d::UnitX()));
  for (const HullPart& part : armHull()) {
    if (part.link != static_cast<int>(i) + 1) continue;
    const Eigen::Vector3d a = X_joint_end * part.from, b = X_joint_end * part.to;
    w.line(
        R"(<geom name="{}{}" type="capsule" size="{:.6g}" fromto="{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}" {} mass="0"/>)",
        part.material == Material::ArmLink ? "arm " : "", part.name, part.radius, a.x(), a.y(),
        a.z(), b.x(), b.y(), b.z(), kRobotBits);
  }
}

void writeHead(Writer& w, const WorldConfig& config, const TrueArena& arena,
               const RobotGeometry& robot) {
  const UrKinematics& k = robot.arm;
  const Eigen::Isometry3d X(Eigen::Translation3d(k.a[5], 0, k.d[5]) *
                            Eigen::AngleAxisd(k.alpha[5], Eigen::Vector3d::UnitX()));
  w.line(R"(<body name="{}" {}>)", names::kFlange, Writer::pose(X));
  const Eigen::Vector3d& com = arena.robot.p_flange_head;
  w.line(R"(<inertial pos="{:.6g} {:.6g} {:.6g}" mass="{:.6g}" diaginertia="0.03 0.03 0.02"/>)",
         com.x(), com.y(), com.z(), arena.robot.head_kg);
  for (const BoxConfig& part : robot.head) {
    w.box("head " + part.name, part.center.pose(), {part.size_m[0], part.size_m[1], part.size_m[2]},
          kRobotBits, 0);
  }
  const Eigen::Vector3d tip = arena.robot.X_flange_nozzle.translation();
  const Eigen::Vector3d root = tip - 0.10 * arena.robot.X_flange_nozzle.linear().col(0);
  w.line(
      R"(<geom name="hose nozzle" type="capsule" size="0.01" fromto="{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}" {} mass="0"/>)",
      root.x(), root.y(), root.z(), tip.x(), tip.y(), tip.z() - 0.01, kRobotBits);
  if (arena.wall.present()) w.text_ += wall_mjcf::face(config, robot);
  w.line("</body>");
}

void writeRobot(Writer& w, const WorldConfig& config, const TrueArena& arena,
                const RobotGeometry& robot) {
  w.line(R"(<body name="{}"><freejoint/>)", names::kBase);
  for (const BoxConfig& part : robot.body) {
    const bool deck = &part == &robot.body.front();
    const bool tank = part.name.starts_with("tank");
    const double mass = deck                         ? config.base.chassis_kg
                        : tank                       ? config.base.tank_kg
                        : part.name == "electronics" ? config.base.electronics_kg
                                                     : 1.0;
    w.box("base " + part.name, part.center.pose(), {part.size_m[0], part.size_m[1], part.size_m[2]},
          kRobotBits, mass);
  }
  writeWheels(w, config, robot);
  for (std::size_t i = 0; i < 6; ++i) writeArmLink(w, config, robot, i);
  writeHead(w, config, arena, robot);
  for (int i = 0; i < 6; ++i) w.line("</body>");
  w.text_ += wall_mjcf::compartments(config, robot);
  w.line("</body>");
}

void writeActuators(Writer& w, const WorldConfig& config, const RobotGeometry& robot) {
  w.line("<actuator>");
  for (int i = 0; i < 4; ++i) {
    const double torque = config.base.steer_torque_nm;
    w.line(R"(<motor name="{0}" joint="{0}" ctrlrange="{1:.4g} {2:.4g}"/>)", names::kSteer[i],
           -torque, torque);
  }
  for (int i = 0; i < 4; ++i) {
    const double torque = config.base.drive_torque_nm;
    w.line(R"(<motor name="{0}" joint="{0}" ctrlrange="{1:.4g} {2:.4g}"/>)", names::kDrive[i],
           -torque, torque);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const double torque = config.arm.max_torque_nm[i];
    w.line(R"(<motor name="{0}" joint="{0}" ctrlrange="{1:.4g} {2:.4g}"/>)", names::kJoint[i],
           -torque, torque);
  }
  w.text_ += wall_mjcf::motors(robot);
  w.line("</actuator>");
}

}  // namespace

std::string mjcf(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& robot) {
  Writer w;
  w.line(R"(<mujoco model="kiln">)");
  writeOptions(w, config, arena);
  w.line("<worldbody>");
  writeArena(w, arena);
  writeRobot(w, config, arena, robot);
  w.text_ += wall_mjcf::bricks(config, arena);
  w.line("</worldbody>");
  // Neighbours but one along the wrist touch by design of the capsules; the flange is rigid with
  // link 6.
  w.line(
      R"(<contact><exclude body1="arm link 4" body2="arm link 6"/><exclude body1="arm link 5" body2="{0}"/></contact>)",
      names::kFlange);
  if (arena.wall.present()) w.text_ += wall_mjcf::grips(config, arena);
  writeActuators(w, config, robot);
  w.line("</mujoco>");
  return w.text_;
}

}  // namespace kiln::sim
