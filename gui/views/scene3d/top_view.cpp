#include "gui/views/scene3d/top_view.h"

#include <QPainter>
#include <QPainterPath>
#include <array>
#include <cmath>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/robot_shape.h"
#include "gui/views/scene3d/scene_actor.h"

namespace kiln::gui {
namespace {

constexpr std::size_t kPointBudget = 30000;  // QPainter's points cost more than OpenGL's
constexpr double kLowest_m = -0.1, kHighest_m = 2.6;
constexpr std::size_t kHeightBins = 16;

QColor qt(Rgb c, int alpha = 255) { return {c.r, c.g, c.b, alpha}; }

/// Everything one layer needs to draw itself.
struct Sheet {
  QPainter& painter;
  const SceneSnapshot& snapshot;
  const OrbitCamera& camera;
  const SceneColors& colors;
  QSize size;

  [[nodiscard]] QPointF at(double x, double y) const {
    const auto p = camera.project({x, y, 0.0}, size.width(), size.height());
    return p ? QPointF(p->x(), p->y()) : QPointF();
  }
  [[nodiscard]] double pixels(double metres) const {
    return metres * 0.5 * size.height() / camera.halfHeight();
  }
  [[nodiscard]] const LayerState& layer(SceneLayer l) const { return snapshot.layer(l); }
  [[nodiscard]] QColor color(Rgb c, SceneLayer l, int alpha = 255) const {
    return qt(agedColor(c, layer(l).freshness, colors), alpha);
  }
  [[nodiscard]] QPolygonF footprint(const Eigen::Isometry3d& X, const Eigen::Vector3d& half) const {
    QPolygonF out;
    for (const auto& [sx, sy] : {std::pair{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}) {
      const Eigen::Vector3d p = X * Eigen::Vector3d(sx * half.x(), sy * half.y(), 0.0);
      out << at(p.x(), p.y());
    }
    return out;
  }
};

void paintGrid(const Sheet& s) {
  s.painter.setPen(QPen(qt(s.colors.grid), 1));
  for (int x = -10; x <= 25; ++x) s.painter.drawLine(s.at(x, -12), s.at(x, 12));
  for (int y = -12; y <= 12; ++y) s.painter.drawLine(s.at(-10, y), s.at(25, y));
}

void paintArena(const Sheet& s) {
  if (!s.layer(SceneLayer::Walls).visible) return;
  s.painter.setPen(QPen(s.color(s.colors.wall_edge, SceneLayer::Walls), 1));
  s.painter.setBrush(s.color(s.colors.wall, SceneLayer::Walls, 70));
  for (const SceneBox& box : s.snapshot.arena) {
    // A lintel hangs above the robot: it is not in the way and would close the door in this view.
    if (box.X_map_box.translation().z() - box.half_extent.z() > 1.8) continue;
    s.painter.drawPolygon(s.footprint(box.X_map_box, box.half_extent));
  }
}

void paintMap(const Sheet& s) {
  if (!s.layer(SceneLayer::Map).visible || !s.snapshot.map) return;
  const MapLayer& map = *s.snapshot.map;
  const std::size_t stride = std::max<std::size_t>(1, map.points_map.size() / kPointBudget);
  std::vector<QPointF> in_use, idle;
  for (std::size_t i = 0; i < map.points_map.size(); i += stride) {
    const Eigen::Vector3f& p = map.points_map[i];
    const bool used = s.snapshot.submap < 0 || map.submap_of[i] == s.snapshot.submap;
    (used ? in_use : idle).push_back(s.at(p.x(), p.y()));
  }
  for (const auto& [points, rgb] :
       {std::pair{&idle, s.colors.map_points_idle}, {&in_use, s.colors.map_points}}) {
    s.painter.setPen(QPen(qt(rgb), 2));
    s.painter.drawPoints(points->data(), static_cast<int>(points->size()));
  }
}

void paintCloud(const Sheet& s) {
  if (!s.layer(SceneLayer::Lidar).visible || !s.snapshot.cloud) return;
  const PointCloud& cloud = *s.snapshot.cloud;
  std::array<std::vector<QPointF>, kHeightBins> bins;
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / kPointBudget);
  for (std::size_t i = 0; i < cloud.size(); i += stride) {
    const Eigen::Vector3d p =
        s.snapshot.X_map_cloud * Eigen::Vector3d(cloud.x[i], cloud.y[i], cloud.z[i]);
    if (!p.allFinite()) continue;
    const double level = std::clamp((p.z() - kLowest_m) / (kHighest_m - kLowest_m), 0.0, 0.999);
    bins[static_cast<std::size_t>(level * kHeightBins)].push_back(s.at(p.x(), p.y()));
  }
  const PerceptualMap map = PerceptualMap::height(s.colors.dark);
  for (std::size_t k = 0; k < bins.size(); ++k) {
    s.painter.setPen(QPen(s.color(map.at((k + 0.5) / kHeightBins), SceneLayer::Lidar), 2));
    s.painter.drawPoints(bins[k].data(), static_cast<int>(bins[k].size()));
  }
}

void paintPaths(const Sheet& s) {
  s.painter.setBrush(Qt::NoBrush);
  if (s.layer(SceneLayer::Driven).visible) {
    for (std::size_t life = 0; life < s.snapshot.driven.size(); ++life) {
      QPolygonF line;
      for (const Eigen::Vector2d& p : s.snapshot.driven[life]) line << s.at(p.x(), p.y());
      s.painter.setPen(
          QPen(s.color(s.colors.driven[life % s.colors.driven.size()], SceneLayer::Driven), 2));
      s.painter.drawPolyline(line);
    }
  }
  if (!s.layer(SceneLayer::Planned).visible) return;
  QPolygonF line;
  s.painter.setPen(QPen(s.color(s.colors.planned, SceneLayer::Planned), 2));
  for (const Pose2& X : s.snapshot.planned.waypoints_map) {
    line << s.at(X.x_m, X.y_m);
    const auto along = [&](double forward, double left) {
      const double c = std::cos(X.yaw_rad), n = std::sin(X.yaw_rad);
      return s.at(X.x_m + forward * c - left * n, X.y_m + forward * n + left * c);
    };
    s.painter.drawLine(along(-0.18, 0), along(0.18, 0));
    s.painter.drawPolyline(QPolygonF()
                           << along(0.06, 0.12) << along(0.18, 0) << along(0.06, -0.12));
  }
  s.painter.drawPolyline(line);
}

void paintRobot(const Sheet& s, const RobotShape& shape) {
  if (!s.layer(SceneLayer::Robot).visible || !s.snapshot.robot_known) return;
  const bool ghost = s.layer(SceneLayer::Robot).freshness == Freshness::Stale;
  const Eigen::Isometry3d X_map_base = s.snapshot.robotPose();
  const auto poses = shape.poses(s.snapshot.q, s.snapshot.steer);
  QPolygonF arm;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const RobotPart& part = shape.parts()[i];
    const Eigen::Isometry3d X = X_map_base * poses[i];
    if (part.form == RobotPart::Form::Capsule) {
      for (const double end : {-0.5, 0.5}) {
        const Eigen::Vector3d p = X * Eigen::Vector3d(0, 0, end * part.size.z());
        arm << s.at(p.x(), p.y());
      }
    } else if (part.form == RobotPart::Form::Box) {
      s.painter.setPen(QPen(s.color(s.colors.body_edge, SceneLayer::Robot), 1));
      s.painter.setBrush(ghost ? QBrush(Qt::NoBrush) : s.color(s.colors.body, SceneLayer::Robot));
      s.painter.drawPolygon(s.footprint(X, 0.5 * part.size));
    }
  }
  const double width = std::max(2.0, s.pixels(0.12));
  s.painter.setPen(QPen(s.color(s.colors.arm, SceneLayer::Robot), width, Qt::SolidLine,
                        Qt::RoundCap, Qt::RoundJoin));
  s.painter.drawPolyline(arm);
}

void paintEstimates(const Sheet& s) {
  for (const SceneItem& item : s.snapshot.items) {
    const LayerState& layer = s.snapshot.layer(item.layer);
    if (item.shape != SceneItem::Shape::Estimate || !layer.visible) continue;
    const Rgb color = agedColor(s.colors.item(item.style), layer.freshness, s.colors);
    s.painter.setPen(QPen(qt(color), 2));
    s.painter.setBrush(qt(color, 90));
    const double sigma =
        std::sqrt(std::max(0.0, item.covariance.topLeftCorner<2, 2>().trace() / 2.0));
    const double radius = std::max(4.0, s.pixels(2.0 * sigma));
    const Eigen::Vector3d p = item.X_map_item.translation();
    s.painter.drawEllipse(s.at(p.x(), p.y()), radius, radius);
  }
}

}  // namespace

void paintTopView(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                  const SceneColors& colors, const RobotShape& shape, const QSize& size) {
  const Sheet sheet{painter, snapshot, camera, colors, size};
  painter.fillRect(QRect(QPoint(0, 0), size), qt(colors.ground));
  paintGrid(sheet);
  paintMap(sheet);
  paintArena(sheet);
  paintCloud(sheet);
  paintPaths(sheet);
  paintRobot(sheet, shape);
  paintEstimates(sheet);
}

}  // namespace kiln::gui
