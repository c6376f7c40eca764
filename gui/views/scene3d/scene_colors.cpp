#include "gui/views/scene3d/scene_colors.h"

namespace kiln::gui {
namespace {

Rgb rgb(const QColor& c) {
  return {static_cast<std::uint8_t>(c.red()), static_cast<std::uint8_t>(c.green()),
          static_cast<std::uint8_t>(c.blue())};
}

SceneColors darkSolids() {
  SceneColors c;
  c.dark = true;
  c.wall = rgbFromHex(0x6c757c);
  c.wall_edge = rgbFromHex(0x565d63);
  c.furniture = rgbFromHex(0x6f6a60);
  c.body = rgbFromHex(0x6d7880);
  c.body_edge = rgbFromHex(0xb4bdc4);
  c.arm = rgbFromHex(0xd3d9dd);
  c.joint = rgbFromHex(0x7f9db4);
  c.wheel = rgbFromHex(0x3a3e42);
  c.head = rgbFromHex(0x8d959b);
  c.map_points = rgbFromHex(0x70736d);
  c.map_points_idle = rgbFromHex(0x4a4d4f);
  c.suspected = rgbFromHex(0xe0525c);
  c.sensed = rgbFromHex(0xf0f3f5);
  c.planned = rgbFromHex(0x5fa8c8);
  c.waypoint = rgbFromHex(0x8cc4dc);
  c.driven = {rgbFromHex(0xe4e8ea), rgbFromHex(0xb9a6d8), rgbFromHex(0x9ec7a0),
              rgbFromHex(0xd8b48c)};
  c.done = rgbFromHex(0x9aa3aa);
  c.target = rgbFromHex(0xe6a23c);
  c.uncertainty = rgbFromHex(0xf2c56b);
  c.active = rgbFromHex(0xcfe8ff);
  c.predicted = rgbFromHex(0x6f9fc4);
  return c;
}

SceneColors lightSolids() {
  SceneColors c;
  c.dark = false;
  c.wall = rgbFromHex(0xc3cace);
  c.wall_edge = rgbFromHex(0x9aa3aa);
  c.furniture = rgbFromHex(0xc9c0b0);
  c.body = rgbFromHex(0xaab4bb);
  c.body_edge = rgbFromHex(0x4a5258);
  c.arm = rgbFromHex(0x6b747b);
  c.joint = rgbFromHex(0x4f7896);
  c.wheel = rgbFromHex(0x3f4549);
  c.head = rgbFromHex(0x7d868c);
  c.map_points = rgbFromHex(0x85867c);
  c.map_points_idle = rgbFromHex(0xbfc2c0);
  c.suspected = rgbFromHex(0xc0202c);
  c.sensed = rgbFromHex(0x1c2124);
  c.planned = rgbFromHex(0x1f6f95);
  c.waypoint = rgbFromHex(0x1f6f95);
  c.driven = {rgbFromHex(0x30363b), rgbFromHex(0x6b4fa0), rgbFromHex(0x2f7a3a),
              rgbFromHex(0x9a5b1c)};
  c.done = rgbFromHex(0x6a737a);
  c.target = rgbFromHex(0xb86a00);
  c.uncertainty = rgbFromHex(0xd08a1c);
  c.active = rgbFromHex(0x2a78c0);
  c.predicted = rgbFromHex(0x6f9fc4);
  return c;
}

}  // namespace

SceneColors SceneColors::of(const Theme& theme) {
  SceneColors c = theme.kind() == ThemeKind::Dark ? darkSolids() : lightSolids();
  const Palette& p = theme.colors();
  c.ground = rgb(p.scene_ground);
  c.grid = rgb(p.scene_line);
  c.intent = rgb(p.manual);
  c.caution = rgb(p.caution);
  c.text = rgb(p.text);
  c.text_dim = rgb(p.dim);
  c.panel = rgb(p.panel);
  c.panel_edge = rgb(p.border);
  return c;
}

Rgb SceneColors::item(ItemStyle style) const {
  switch (style) {
    case ItemStyle::Normal:
      return text;
    case ItemStyle::Configured:
      return text_dim;
    case ItemStyle::Sensed:
      return sensed;
    case ItemStyle::Planned:
      return predicted;
    case ItemStyle::Suspected:
      return suspected;
    case ItemStyle::Done:
      return done;
    case ItemStyle::Target:
      return target;
    case ItemStyle::Active:
      return active;
    case ItemStyle::Caution:
      return caution;
    case ItemStyle::Intent:
      return intent;
  }
  return text;
}

}  // namespace kiln::gui
