#include "gui/views/scene3d/scene_overlay.h"

#include <QPainter>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/scene_actor.h"

namespace kiln::gui {
namespace {

constexpr double kBox_m = 0.4;     // acrylic box of a fire place (scenario.md section 3)
constexpr double kRecess_m = 0.1;  // of the plate behind the box's face
constexpr double kGround_m = 0.02;
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

/// The front frame of a place (place_check.h) from its configured plate.
Eigen::Isometry3d frontOf(const FirePlaceInfo& place) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(place.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = place.p_map + X.linear().col(0) * kRecess_m;
  return X;
}

/// The box behind a front: upper and lower rim, uprights, and the opening's direction.
void paintBox(const Sheet& s, const Eigen::Isometry3d& X) {
  const double h = 0.5 * kBox_m;
  for (const double z : {-h, h}) s.line(closed(X, -kBox_m, 0.0, -h, h, z));
  for (const double x : {-kBox_m, 0.0}) {
    for (const double y : {-h, h})
      s.line({X * Eigen::Vector3d(x, y, -h), X * Eigen::Vector3d(x, y, h)});
  }
  s.line({X * Eigen::Vector3d(0, 0, 0), X * Eigen::Vector3d(0.25, 0, 0)});
}

/// The paper's figure: a red rectangle on the ground where it may burn; grey once visited.
void paintSuspected(const Sheet& s) {
  const LayerState& layer = s.snapshot.layer(SceneLayer::Places);
  if (!layer.visible) return;
  for (const FirePlaceInfo& place : s.snapshot.places) {
    Eigen::Isometry3d X = frontOf(place);
    X.translation().z() = kGround_m;
    s.pen(qt(agedColor(place.visited ? s.colors.place : s.colors.suspected, layer.freshness,
                       s.colors)),
          place.visited ? 1.5 : 2.5);
    s.line(closed(X, -kBox_m, 0.0, -0.5 * kBox_m, 0.5 * kBox_m, 0.0));
  }
}

void paintChecks(const Sheet& s) {
  const LayerState& layer = s.snapshot.layer(SceneLayer::Places);
  if (!layer.visible) return;
  for (const PlaceCheck& check : s.snapshot.place_checks) {
    s.pen(qt(s.colors.text_dim), 1.2, Qt::DashLine);
    paintBox(s, check.X_map_configured);
    if (!check.X_map_sensed) continue;
    const bool off = check.verdict == PlaceVerdict::Misplaced;
    s.pen(off ? qt(s.colors.caution) : qt(s.colors.sensed, 150), off ? 2.5 : 1.2);
    paintBox(s, *check.X_map_sensed);
    s.line({check.X_map_configured.translation(), check.X_map_sensed->translation()});
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

void paintNudgeGhost(const Sheet& s, const SceneIntent& intent) {
  for (const FirePlaceInfo& place : s.snapshot.places) {
    if (place.name != intent.place) continue;
    FirePlaceInfo moved = place;
    moved.p_map += Eigen::Vector3d(intent.nudge.x_m, intent.nudge.y_m, 0.0);
    moved.yaw_rad += intent.nudge.yaw_rad;
    s.pen(qt(s.colors.intent), 2.5);
    paintBox(s, frontOf(moved));
  }
}

}  // namespace

void paintSceneOverlay(QPainter& painter, const SceneSnapshot& snapshot, const SceneIntent& intent,
                       const OrbitCamera& camera, const SceneColors& colors, const QSize& size) {
  const Sheet sheet{painter, snapshot, camera, colors, size};
  painter.setRenderHint(QPainter::Antialiasing);
  paintSuspected(sheet);
  paintChecks(sheet);
  paintUncertainty(sheet);
  if (!intent.place.empty()) paintNudgeGhost(sheet, intent);
  if (intent.robot) paintRobotGhost(sheet, *intent.robot);
}

}  // namespace kiln::gui
