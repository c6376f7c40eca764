#include <cmath>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/views/scene3d/scene_actor.h"
#include "gui/views/scene3d/vtk_shapes.h"

namespace kiln::gui {
namespace {

using Line = std::vector<Eigen::Vector3d>;
constexpr double kPathHeight_m = 0.02,
                 kTrailHeight_m = 0.03;  // over the grid, so that nothing flickers
constexpr double kArrow_m = 0.35;

vtkSmartPointer<vtkActor> addLines(vtkRenderer& renderer, float width) {
  vtkNew<vtkPolyData> empty;
  auto actor = addActor(renderer, empty);
  makeFlat(*actor, width);
  return actor;
}

/// Shaft and head of an arrow on the ground.
std::vector<Line> arrow(const Pose2& X) {
  const auto at = [&](double forward, double left) {
    return Eigen::Vector3d(X.x_m + forward * std::cos(X.yaw_rad) - left * std::sin(X.yaw_rad),
                           X.y_m + forward * std::sin(X.yaw_rad) + left * std::cos(X.yaw_rad),
                           kPathHeight_m);
  };
  const double half = 0.5 * kArrow_m, barb = 0.35 * kArrow_m;
  return {{at(-half, 0), at(half, 0)},
          {at(half - barb, barb), at(half, 0), at(half - barb, -barb)}};
}

/// Metre grid on the ground round the arena.
class GridActor final : public SceneActor {
 public:
  explicit GridActor(vtkRenderer& renderer) : lines_(addLines(renderer, 1.0F)) {
    constexpr int kLow = -10, kHigh = 25, kSide = 12;
    std::vector<Line> lines;
    for (int x = kLow; x <= kHigh; ++x)
      lines.push_back({{double(x), -kSide, 0}, {double(x), kSide, 0}});
    for (int y = -kSide; y <= kSide; ++y)
      lines.push_back({{kLow, double(y), 0}, {kHigh, double(y), 0}});
    setMesh(*lines_, lineMesh(lines));
  }
  void update(const SceneSnapshot&, const SceneColors& colors) override {
    setColor(*lines_, colors.grid);
  }

 private:
  vtkSmartPointer<vtkActor> lines_;
};

class PlannedPathActor final : public SceneActor {
 public:
  explicit PlannedPathActor(vtkRenderer& renderer)
      : line_(addLines(renderer, 2.0F)),
        arrows_(addLines(renderer, 2.0F)),
        done_(addLines(renderer, 1.0F)) {}

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Planned);
    for (const auto& actor : {line_, arrows_, done_}) actor->SetVisibility(layer.visible);
    setColor(*line_, agedColor(colors.planned, layer.freshness, colors));
    setColor(*arrows_, agedColor(colors.waypoint, layer.freshness, colors));
    setColor(*done_, agedColor(mix(colors.planned, colors.ground, 0.55), layer.freshness, colors));
    if (revision_ == layer.revision) return;
    revision_ = layer.revision;
    rebuild(snapshot.planned);
  }

 private:
  void rebuild(const PathInfo& path) {
    std::vector<Line> ahead(1), behind(1), marks;
    for (std::size_t i = 0; i < path.waypoints_map.size(); ++i) {
      const Pose2& X = path.waypoints_map[i];
      const auto next = static_cast<std::size_t>(std::max(0, path.next));
      const Eigen::Vector3d p(X.x_m, X.y_m, kPathHeight_m);
      if (i < next) behind[0].push_back(p);
      if (i + 1 >= next) ahead[0].push_back(p);
      if (i < next) continue;
      for (Line& line : arrow(X)) marks.push_back(std::move(line));
    }
    setMesh(*line_, lineMesh(ahead));
    setMesh(*done_, lineMesh(behind));
    setMesh(*arrows_, lineMesh(marks));
  }

  std::uint64_t revision_ = ~std::uint64_t{0};
  vtkSmartPointer<vtkActor> line_, arrows_, done_;
};

/// The trail: one line a life, each reset begins a new colour.
class DrivenPathActor final : public SceneActor {
 public:
  explicit DrivenPathActor(vtkRenderer& renderer) {
    for (auto& actor : lines_) actor = addLines(renderer, 2.0F);
  }

  void update(const SceneSnapshot& snapshot, const SceneColors& colors) override {
    const LayerState& layer = snapshot.layer(SceneLayer::Driven);
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      lines_[k]->SetVisibility(layer.visible);
      setColor(*lines_[k], agedColor(colors.driven[k], layer.freshness, colors));
    }
    if (revision_ == layer.revision) return;
    revision_ = layer.revision;
    std::array<std::vector<Line>, 4> by_color;
    for (std::size_t life = 0; life < snapshot.driven.size(); ++life) {
      Line line;
      for (const Eigen::Vector2d& p : snapshot.driven[life])
        line.emplace_back(p.x(), p.y(), kTrailHeight_m);
      by_color[life % by_color.size()].push_back(std::move(line));
    }
    for (std::size_t k = 0; k < lines_.size(); ++k) setMesh(*lines_[k], lineMesh(by_color[k]));
  }

 private:
  std::uint64_t revision_ = ~std::uint64_t{0};
  std::array<vtkSmartPointer<vtkActor>, 4> lines_;
};

}  // namespace

std::unique_ptr<SceneActor> makeGridActor(vtkRenderer& renderer) {
  return std::make_unique<GridActor>(renderer);
}
std::unique_ptr<SceneActor> makePlannedPathActor(vtkRenderer& renderer) {
  return std::make_unique<PlannedPathActor>(renderer);
}
std::unique_ptr<SceneActor> makeDrivenPathActor(vtkRenderer& renderer) {
  return std::make_unique<DrivenPathActor>(renderer);
}

}  // namespace kiln::gui
