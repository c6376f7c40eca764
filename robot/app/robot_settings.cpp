#include "robot/app/robot_settings.h"

namespace kiln {

void RobotSettings::visit(ConfigArchive& a) {
  a.field("name", name, "shown to operators");
  a.field("geometry", geometry, "resource file of the robot's geometry");
  a.field("arena", arena, "resource file of the nominal arena");
  a.field(
      "flat_ground", flat_ground,
      "the arena without its ramp and edge, as in worlds/fire_flat.yaml; the shipped map has both: "
      "locate against the walls there");
  a.field("checkpoint_period_s", checkpoint_period_s, "s", 0.02, 60,
          "how old a checkpoint may be between actions");
  a.field("camera_rate_hz", camera_rate_hz, "Hz", 0.1, 60, "pictures sent to the stations");
  a.field("jpeg_quality", jpeg_quality, "%", 10, 100, "of those pictures");
  a.section("arm", arm, "arm controller");
  a.section("base", base, "base controller");
  a.section("pumps", pumps, "pump controller");
  a.section("drive_to", drive_to, "way-point driving");
  a.section("move_arm", move_arm, "arm motion");
  a.section("self_filter", self_filter, "the robot's own body in its scans");
  a.section("perception", perception, "how often what is looked at");
  a.section("surroundings", surroundings, "what the live cloud says of the world around");
  a.section("motion_watch", motion_watch, "does the base do what it is told?");
  a.section("localization", localization, "where the robot is");
  missions.visit(a);
  a.section("authority", authority, "lease, command gate, dead-man");
  a.section("macros", macros, "macros");
  a.section("teleop", teleop, "moving by hand");
  a.section("preflight", preflight, "limits of the preflight checks");
  a.section("link", link, "the operators' link");
  a.section("recording", recording, "the recorder");
}

}  // namespace kiln
