#include "robot/perception/bricks/model_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/check.h"
#include "robot/perception/cloud/leaf_table.h"
#include "robot/scene/raycaster.h"

namespace kiln {
namespace {

constexpr float kLift_m = 5e-4F;  // of a ray's start off its surface; less than any joint
constexpr double kGroundThickness_m = 0.02;
constexpr std::size_t kBatch = 4096;

Eigen::Vector3d axisOf(int face) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  n[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
  return n;
}

int cells(double length_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m - 1e-9)));
}

}  // namespace

void ModelCloudGenerator::Config::visit(ConfigArchive& a) {
  a.field("spacing_m", spacing_m, "m", 0.002, 0.2, "lattice on the faces");
  a.field("min_cosine", min_cosine, "", 0, 0.9, "flatter views give no returns");
}

int ModelCloud::visibleOf(std::size_t brick) const {
  int count = 0;
  for (const FaceGrid& face : lattice[brick])
    count += static_cast<int>(std::count(face.visible.begin(), face.visible.end(), 1));
  return count;
}

/// The rays' view of the last world.
struct ModelCloudGenerator::Scene {
  std::unique_ptr<Raycaster> rays = std::make_unique<Raycaster>();
  std::vector<BrickKind> kinds;
  std::vector<Raycaster::Id> ids;
  std::optional<Eigen::Vector2d> ground_half;
  Raycaster::Id ground = 0;

  // Candidates of one batch and whether they are in sight.
  std::vector<ModelPoint> candidates;
  std::vector<std::uint8_t*> marks;  // a face cell of each; nullptr: ground
  std::vector<Raycaster::Ray> queries;
  std::vector<std::size_t> owners;
  std::vector<std::uint8_t> blocked, seen;

  void show(const ModelWorld& world);
  void ask(const ModelWorld& world, double min_cosine, std::vector<ModelPoint>& out);

 private:
  [[nodiscard]] bool fits(const ModelWorld& world) const;
  [[nodiscard]] static Eigen::Isometry3d slab(const GroundPatch& ground) {
    return ground.X_world_ground * Eigen::Translation3d(0, 0, -kGroundThickness_m / 2.0);
  }
};

bool ModelCloudGenerator::Scene::fits(const ModelWorld& world) const {
  if (kinds.size() != world.bricks.size() || ground_half.has_value() != world.ground.has_value())
    return false;
  if (ground_half &&
      *ground_half != Eigen::Vector2d(world.ground->half_x_m, world.ground->half_y_m))
    return false;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i] != world.bricks[i].kind) return false;
  return true;
}

void ModelCloudGenerator::Scene::show(const ModelWorld& world) {
  if (fits(world)) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      rays->setPose(ids[i], world.bricks[i].X_world_brick);
    if (world.ground) rays->setPose(ground, slab(*world.ground));
    rays->commit();
    return;
  }
  rays = std::make_unique<Raycaster>();
  kinds.clear();
  ids.clear();
  ground_half.reset();
  for (const ModelBrick& brick : world.bricks) {
    kinds.push_back(brick.kind);
    ids.push_back(rays->addBox(brickSize(brick.kind), brick.X_world_brick, 0));
  }
  if (world.ground) {
    const GroundPatch& g = *world.ground;
    ground_half = Eigen::Vector2d(g.half_x_m, g.half_y_m);
    ground = rays->addBox({2.0 * g.half_x_m, 2.0 * g.half_y_m, kGroundThickness_m}, slab(g), 0);
  }
  rays->commit();
}

void ModelCloudGenerator::Scene::ask(const ModelWorld& world, double min_cosine,
                                     std::vector<ModelPoint>& out) {
  seen.assign(candidates.size(), 0);
  for (const Eigen::Vector3d& sensor : world.sensors) {
    const Eigen::Vector3f s = sensor.cast<float>();
    queries.clear();
    owners.clear();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const ModelPoint& c = candidates[i];
      const Eigen::Vector3f start = c.p + kLift_m * c.n;
      const Eigen::Vector3f d = s - start;
      const float range = d.norm();
      if (seen[i] != 0 || !(d.dot(c.n) > static_cast<float>(min_cosine) * range)) continue;
      queries.push_back({start, d / range, range, 1});
      owners.push_back(i);
    }
    blocked.resize(queries.size());
    rays->occluded(queries, blocked);
    for (std::size_t k = 0; k < owners.size(); ++k)
      if (blocked[k] == 0) seen[owners[k]] = 1;
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (seen[i] == 0) continue;
    out.push_back(candidates[i]);
    if (marks[i] != nullptr) *marks[i] = 1;
  }
  candidates.clear();
  marks.clear();
}

ModelCloudGenerator::ModelCloudGenerator(const Config& config)
    : config_(config), scene_(std::make_unique<Scene>()) {}
ModelCloudGenerator::~ModelCloudGenerator() = default;
ModelCloudGenerator::ModelCloudGenerator(ModelCloudGenerator&&) noexcept = default;
ModelCloudGenerator& ModelCloudGenerator::operator=(ModelCloudGenerator&&) noexcept = default;

ModelCloud ModelCloudGenerator::generate(const ModelWorld& world) {
  KILN_CHECK(!world.sensors.empty(), "no sensor");
  scene_->show(world);
  ModelCloud cloud;
  cloud.lattice.resize(world.bricks.size());
  const auto facing = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    return std::any_of(world.sensors.begin(), world.sensors.end(),
                       [&](const Eigen::Vector3d& s) { return (s - p).dot(n) > 0.0; });
  };
  const auto push = [&](const ModelPoint& point, std::uint8_t* mark) {
    scene_->candidates.push_back(point);
    scene_->marks.push_back(mark);
    if (scene_->candidates.size() == kBatch) scene_->ask(world, config_.min_cosine, cloud.points);
  };
  for (std::size_t b = 0; b < world.bricks.size(); ++b) {
    const Eigen::Isometry3d& X = world.bricks[b].X_world_brick;
    const Eigen::Vector3d size = brickSize(world.bricks[b].kind);
    for (int f = 0; f < 6; ++f) {
      const int u = f / 2 == 0 ? 1 : 0, v = f / 2 == 2 ? 1 : 2;
      FaceGrid& grid = cloud.lattice[b][static_cast<std::size_t>(f)];
      grid.nu = cells(size[u], config_.spacing_m);
      grid.nv = cells(size[v], config_.spacing_m);
      grid.visible.assign(static_cast<std::size_t>(grid.nu * grid.nv), 0);
      const Eigen::Vector3d axis = axisOf(f);
      const Eigen::Vector3d n = X.linear() * axis;
      const Eigen::Vector3d centre = 0.5 * axis.cwiseProduct(size);
      if (!facing(X * centre, n)) continue;
      for (int j = 0; j < grid.nv; ++j) {
        for (int i = 0; i < grid.nu; ++i) {
          Eigen::Vector3d p = centre;
          p[u] = ((i + 0.5) / grid.nu - 0.5) * size[u];
          p[v] = ((j + 0.5) / grid.nv - 0.5) * size[v];
          push({(X * p).cast<float>(), n.cast<float>(), static_cast<int>(b),
                static_cast<std::uint8_t>(f)},
               &grid.visible[grid.cell(i, j)]);
        }
      }
    }
  }
  if (world.ground) {
    const GroundPatch& g = *world.ground;
    const int nx = cells(2.0 * g.half_x_m, config_.spacing_m),
              ny = cells(2.0 * g.half_y_m, config_.spacing_m);
    const Eigen::Vector3f n = g.X_world_ground.linear().col(2).cast<float>();
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        push({(g.X_world_ground * Eigen::Vector3d((2.0 * (i + 0.5) / nx - 1.0) * g.half_x_m,
                                                  (2.0 * (j + 0.5) / ny - 1.0) * g.half_y_m, 0.0))
                  .cast<float>(),
              n, ModelPoint::kGround, 0},
             nullptr);
  }
  scene_->ask(world, config_.min_cosine, cloud.points);
  return cloud;
}

std::vector<ModelPoint> voxelised(std::span<const ModelPoint> points, double leaf_m) {
  KILN_CHECK(leaf_m > 0, leaf_m);
  constexpr float kHalfExtent = 1 << 15;  // leaves each side: 16 bits an axis, 15 for the brick
  const float per_m = static_cast<float>(1.0 / leaf_m);
  LeafTable table(points.size());
  std::vector<float> counts;
  std::vector<std::array<std::uint32_t, 6>> faces;
  std::vector<ModelPoint> out;
  for (const ModelPoint& point : points) {
    const auto bits = [&](int axis) {
      const float leaf = std::floor(point.p[axis] * per_m) + kHalfExtent;
      KILN_CHECK(leaf >= 0.0F && leaf < 2.0F * kHalfExtent, leaf);
      return static_cast<std::uint64_t>(leaf);
    };
    const std::uint64_t key =
        static_cast<std::uint64_t>(point.brick + 1) << 48 | bits(0) << 32 | bits(1) << 16 | bits(2);
    const std::uint32_t index = table.find(key, static_cast<std::uint32_t>(counts.size()));
    if (index == counts.size()) {
      counts.push_back(0.0F);
      faces.push_back({});
      out.push_back({Eigen::Vector3f::Zero(), point.n, point.brick, point.face});
    }
    ModelPoint& mean = out[index];
    mean.p += (point.p - mean.p) / (counts[index] += 1.0F);
    if (++faces[index][point.face] > faces[index][mean.face]) {
      mean.face = point.face;
      mean.n = point.n;
    }
  }
  return out;
}

}  // namespace kiln
