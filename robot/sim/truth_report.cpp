#include "robot/sim/truth_report.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace kiln::sim {
namespace {

using Json = nlohmann::ordered_json;

Json json(const Eigen::Vector3d& p) { return Json::array({p.x(), p.y(), p.z()}); }

Json json(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return {{"xyz_m", json(Eigen::Vector3d(X.translation()))},
          {"wxyz", Json::array({q.w(), q.x(), q.y(), q.z()})}};
}

Json json(const Pose2& X) { return {{"x_m", X.x_m}, {"y_m", X.y_m}, {"yaw_rad", X.yaw_rad}}; }

Json json(const Vector6d& q) { return Json::array({q[0], q[1], q[2], q[3], q[4], q[5]}); }

Json firePlaces(const Truth& t) {
  Json out = Json::array();
  for (std::size_t i = 0; i < t.arena.fire_places.size(); ++i) {
    const TrueFirePlace& place = t.arena.fire_places[i];
    out.push_back({{"name", place.name},
                   {"burning", place.burning},
                   {"litres", t.fire.litres_delivered[i]},
                   {"plate_xyz_m", json(place.plateInMap())},
                   {"opening", json(place.X_map_front)}});
  }
  return out;
}

Json groundJson(const GroundProfile& ground) {
  const ApproachConfig& a = ground.approach();
  return {{"flat", ground.flat()},  {"start_z_m", ground.lowest()}, {"slope_deg", a.slope_deg},
          {"foot_x_m", a.foot_x_m}, {"top_x_m", a.top_x_m},         {"edge_x_m", a.edge_x_m},
          {"edge_m", a.edge_m}};
}

Json perturbations(const Truth& t) {
  const TrueRobot& r = t.arena.robot;
  Json boxes = Json::array();
  for (const SolidBox& b : t.arena.boxes) {
    boxes.push_back({{"name", b.name},
                     {"xyz_m", json(Eigen::Vector3d(b.X_map_box.translation()))},
                     {"size_m", json(b.size_m)},
                     {"temperature_c", b.temperature_c}});
  }
  return {{"wheel_radius_error", r.wheel_radius_error},
          {"steer_offset_rad", r.steer_offset_rad},
          {"pump_full_flow_lpm", t.fire.full_flow_lpm},
          {"X_flange_lidar", json(r.X_flange_lidar)},
          {"X_flange_thermal", json(r.X_flange_thermal)},
          {"X_flange_nozzle", json(r.X_flange_nozzle)},
          {"X_base_operatorcamera", json(r.X_base_operatorcamera)},
          {"ground", groundJson(t.arena.ground)},
          {"boxes", boxes}};
}

/// Of the wall's worlds alone: reports of others stay as they are.
void addWall(const Truth& t, Json& out) {
  if (t.wall.bricks.empty()) return;
  const WallTruth& w = t.wall;
  Json bricks = Json::array();
  for (const BrickTruth& b : w.bricks) {
    Json brick = {{"name", b.name},
                  {"pose", json(b.X_map_brick)},
                  {"held", b.held},
                  {"at_rest", b.at_rest},
                  {"falls", b.falls}};
    if (b.stored) brick["bin"] = {b.stored->compartment, b.stored->bin};
    if (b.slot) brick["slot"] = *b.slot;
    bricks.push_back(brick);
  }
  Json slots = Json::array();
  for (const WallSlot& slot : w.slots)
    slots.push_back({{"kind", brickShape(slot.kind).name},
                     {"leg", slot.leg == WallLeg::Orange ? "orange" : "mixed"},
                     {"layer", slot.layer},
                     {"index", slot.index}});
  out["wall"] = {{"pile", json(w.X_map_pile)},
                 {"marker", json(w.X_map_marker)},
                 {"placed", w.score.placed},
                 {"points", w.score.points},
                 {"frame", w.score.X_map_wall ? json(*w.score.X_map_wall) : Json(nullptr)},
                 {"off_marker_m", w.score.off_marker_m},
                 {"off_marker_rad", w.score.off_marker_rad},
                 {"falls", w.falls},
                 {"bricks", bricks},
                 {"slots", slots}};
}

Json profileJson(const std::vector<JetProfile::Row>& rows) {
  Json out = Json::array();
  for (const JetProfile::Row& row : rows) {
    out.push_back({{"distance_m", row.distance_m},
                   {"drops", row.drops},
                   {"drop_m", row.drop_m},
                   {"lateral_m", row.lateral_m},
                   {"rms_m", row.rms_m}});
  }
  return out;
}

}  // namespace

std::string truthJson(const Truth& t) {
  Json starts = Json::array();
  for (const Pose2& start : t.starts) starts.push_back(json(start));
  Json collisions = Json::array();
  for (const Collision& c : t.collisions) {
    collisions.push_back(
        {{"t_s", toSeconds(c.time)}, {"robot", c.a}, {"other", c.b}, {"force_n", c.force_n}});
  }
  Json kidnaps = Json::array();
  for (const Pose2& to : t.kidnaps) kidnaps.push_back(json(to));
  const auto& places = t.arena.fire_places;
  const std::string burning = places.empty() ? "" : places[t.fire.burning].name;
  Json out = {{"seed", t.seed},
              {"world", t.world},
              {"simulated_s", toSeconds(t.now)},
              {"litres_delivered", t.fire.litres_delivered},
              {"burning", t.fire.burning},
              {"burning_name", burning},
              {"score", t.score},
              {"collisions", collisions},
              {"resets", t.resets},
              {"pump_on_s", t.fire.pump_on_s},
              {"litres_emitted", t.fire.litres_emitted},
              {"jet_profile", profileJson(t.fire.jet_profile)},
              {"tank_l", t.fire.tank_l},
              {"plate_c", t.fire.plate_c},
              {"final_base", json(t.X_map_base)},
              {"final_q_rad", json(t.q)},
              {"start", json(t.starts.back())},
              {"starts", starts},
              {"kidnaps", kidnaps},
              {"fell_s", t.fell ? Json(toSeconds(*t.fell)) : Json(nullptr)},
              {"fire_places", firePlaces(t)},
              {"perturbations", perturbations(t)}};
  addWall(t, out);
  return out.dump(2) + "\n";
}

std::string truthTraceLine(const Truth& t) {
  Json out = {{"t", toSeconds(t.now)},
              {"base", json(t.X_map_base)},
              {"thermal", json(t.X_map_thermal)},
              {"nozzle", json(t.fire.X_map_nozzle)},
              {"q_rad", json(t.q)},
              {"plate_c", t.fire.plate_c},
              {"jet", t.fire.jet_on},
              {"litres", t.fire.litres_delivered}};
  if (!t.people.empty()) out["people"] = Json::array();
  for (const Eigen::Vector3d& feet : t.people) out["people"].push_back(json(feet));
  if (!t.wall.bricks.empty()) {
    out["placed"] = t.wall.score.placed;
    out["falls"] = t.wall.falls;
    out["bricks"] = Json::array();
    for (const BrickTruth& b : t.wall.bricks) out["bricks"].push_back(json(b.X_map_brick));
  }
  return out.dump() + "\n";
}

Result<void> writeAtomically(const std::string& path, const std::string& text) {
  const std::string part = path + ".tmp";
  const auto failed = [&](const char* what) {
    const int code = errno;
    ::unlink(part.c_str());
    return makeError(ErrorCode::Storage,
                     "{}: cannot {}: {}; check the folder, its rights and the free space", path,
                     what, std::strerror(code));
  };
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return failed("create");
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const auto error = failed("write");
      ::close(file);
      return error;
    }
    done += static_cast<std::size_t>(n);
  }
  if (::fsync(file) != 0 || ::close(file) != 0) return failed("write to disk");
  if (std::rename(part.c_str(), path.c_str()) != 0) return failed("rename");
  return {};
}

}  // namespace kiln::sim
