#include "gui/views/scene3d/scene_overlay.h"

#include <QPainter>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/scene_actor.h"

namespace kiln::gui {
namespace {

constexpr double kGround_m = 0.02;
constexpr double kArrowHead_m = 0.3;
constexpr double kLeastShown_m = 0.05;  // smaller uncertainties hide under the robot
constexpr double kHalfLength_m = 0.95,
                 kHalfWidth_m = 0.7;  // of the base (data sheet in hardware.md)

QColor qt(Rgb c, int alpha = 255) { return {c.r, c.g, c.b, alpha}; }

struct Sheet {
  QPainter& painter;
  const SceneSnapshot& snapshot;
  const OrbitCamera& camera;
  const SceneColors& colors;
  QSize size;

  void line(const std::vector<Eigen::Vector3d>& points) const {
    QPolygonF out;
    for (const Eigen::Vector3d& p : points) {
      if (const auto pixel = camera.project(p, size.width(), size.height()))
        out << QPointF(pixel->x(), pixel->y());
    }
    painter.drawPolyline(out);
  }
  void pen(QColor color, double width, Qt::PenStyle style = Qt::SolidLine) const {
    painter.setPen(QPen(color, width, style, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
  }
};

std::vector<Eigen::Vector3d> closed(const Eigen::Isometry3d& X, double x0, double x1, double y0,
                                    double y1, double z) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}})
    out.push_back(X * Eigen::Vector3d(x, y, z));
  return out;
}

/// The head lies flat.
void paintArrow(const Sheet& s, const std::vector<Eigen::Vector3d>& points) {
  s.line(points);
  if (points.size() < 2) return;
  const Eigen::Vector3d tip = points.back(), way = tip - points[points.size() - 2];
  const double length = way.norm();
  if (!(length > 0.0)) return;
  const Eigen::Vector3d along = way / length;
  Eigen::Vector3d side = along.cross(Eigen::Vector3d::UnitZ());
  if (side.norm() < 1e-6) side = Eigen::Vector3d::UnitX();
  const double head = std::min(0.25 * length, kArrowHead_m);
  const Eigen::Vector3d across = 0.5 * head * side.normalized();
  s.line({tip - head * along + across, tip, tip - head * along - across});
}

void paintCylinder(const Sheet& s, const Eigen::Isometry3d& X, const Eigen::Vector3d& half) {
  constexpr int kSteps = 36, kStaves = 4;
  const auto at = [&](int i, double z) {
    const double a = 2.0 * M_PI * i / kSteps;
    return X * Eigen::Vector3d(half.x() * std::cos(a), half.y() * std::sin(a), z);
  };
  for (const double z : {-half.z(), half.z()}) {
    std::vector<Eigen::Vector3d> ring;
    for (int i = 0; i <= kSteps; ++i) ring.push_back(at(i, z));
    s.line(ring);
  }
  for (int i = 0; i < kSteps; i += kSteps / kStaves) s.line({at(i, -half.z()), at(i, half.z())});
}

void paintItem(const Sheet& s, const SceneItem& item) {
  if (item.shape == SceneItem::Shape::Polyline) return s.line(item.points);
  if (item.shape == SceneItem::Shape::Arrow) return paintArrow(s, item.points);
  const Eigen::Isometry3d& X = item.X_map_item;
  const Eigen::Vector3d h = 0.5 * item.size;
  if (item.shape == SceneItem::Shape::Cylinder) return paintCylinder(s, X, h);
  if (item.shape != SceneItem::Shape::Box) return;
  for (const double z : {-h.z(), h.z()}) s.line(closed(X, -h.x(), h.x(), -h.y(), h.y(), z));
  for (const double x : {-h.x(), h.x()}) {
    for (const double y : {-h.y(), h.y()})
      s.line({X * Eigen::Vector3d(x, y, -h.z()), X * Eigen::Vector3d(x, y, h.z())});
  }
}

void paintItems(const Sheet& s) {
  for (const SceneItem& item : s.snapshot.items) {
    const LayerState& layer = s.snapshot.layer(item.layer);
    if (!layer.visible) continue;
    s.pen(qt(agedColor(s.colors.item(item.style), layer.freshness, s.colors)), item.width_px,
          item.style == ItemStyle::Configured ? Qt::DashLine : Qt::SolidLine);
    paintItem(s, item);
  }
}

/// Two standard deviations of the position, when they are worth a look.
void paintUncertainty(const Sheet& s) {
  const Eigen::Matrix2d& covariance = s.snapshot.covariance_xy;
  if (!s.snapshot.robot_known || !s.snapshot.layer(SceneLayer::Robot).visible) return;
  if (s.snapshot.health == LocalizationHealth::Good || !covariance.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  const Eigen::Vector2d half = 2.0 * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (half.maxCoeff() < kLeastShown_m) return;
  constexpr int kSteps = 48;
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = 2.0 * M_PI * i / kSteps;
    const Eigen::Vector2d p =
        solver.eigenvectors() * Eigen::Vector2d(half.x() * std::cos(a), half.y() * std::sin(a));
    line.emplace_back(s.snapshot.X_map_base.x_m + p.x(), s.snapshot.X_map_base.y_m + p.y(),
                      s.snapshot.X_ground_base.translation().z() + kGround_m);
  }
  s.pen(qt(s.colors.caution), 2.0, Qt::DashLine);
  s.line(line);
}

void paintRobotGhost(const Sheet& s, const Pose2& pose) {
  const Eigen::Isometry3d X = toIsometry(pose);
  s.pen(qt(s.colors.ground, 200), 5.0);  // a rim that keeps it apart from whatever lies below
  const auto outline =
      closed(X, -kHalfLength_m, kHalfLength_m, -kHalfWidth_m, kHalfWidth_m, kGround_m);
  const auto at = [&](double x, double y) { return X * Eigen::Vector3d(x, y, kGround_m); };
  const auto draw = [&] {
    s.line(outline);
    s.line({at(0, 0), at(1.6, 0)});
    s.line({at(1.3, 0.22), at(1.6, 0), at(1.3, -0.22)});
  };
  draw();
  s.pen(qt(s.colors.intent), 2.5);
  draw();
}

void paintGhosts(const Sheet& s, const std::vector<SceneItem>& ghosts) {
  constexpr double kGhost_px = 2.5;
  s.pen(qt(s.colors.intent), kGhost_px);
  for (const SceneItem& item : ghosts) paintItem(s, item);
}

}  // namespace

void paintSceneOverlay(QPainter& painter, const SceneSnapshot& snapshot, const SceneIntent& intent,
                       const OrbitCamera& camera, const SceneColors& colors, const QSize& size) {
  const Sheet sheet{painter, snapshot, camera, colors, size};
  painter.setRenderHint(QPainter::Antialiasing);
  paintItems(sheet);
  paintUncertainty(sheet);
  paintGhosts(sheet, intent.items);
  if (intent.robot) paintRobotGhost(sheet, *intent.robot);
}

}  // namespace kiln::gui
