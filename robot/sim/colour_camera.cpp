#include "robot/sim/colour_camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/units.h"
#include "common/geom/frames.h"
#include "robot/sim/random.h"
#include "robot/sim/ray_scene.h"
#include "robot/sim/surface_look.h"

namespace kiln::sim {
namespace {

constexpr int kBlock = 4;
constexpr std::size_t kNoiseTable = 1u << 16;
constexpr float kPaneTint = 0.20F;
constexpr float kPaneRadius = 0.40F;   // m, encloses a fire box
constexpr float kShadowReach = 60.0F;  // m
constexpr double kMeanGrey = 118.0;
constexpr float kLeastGain = 0.4F, kMostGain = 4.0F;
const Eigen::Vector3f kPaneColour(206, 228, 232);

/// Everything seen along one ray.
struct Sample {
  Raycaster::Hit hit;
  bool pane = false;  // acrylic in front
  int patch = 0;      // surfacePatch()
  float sunlit = 1.0F;
};

}  // namespace

struct ColourCamera::Impl {
  Impl(const WorldConfig& config, const TrueArena& arena, const RobotGeometry& r, CameraMount m)
      : mount(m),
        camera(m == CameraMount::Mast ? config.camera : config.head_camera),
        robot(r),
        X_mount_camera(m == CameraMount::Mast ? arena.robot.X_base_operatorcamera
                                              : arena.robot.X_flange_rgb),
        scene(config, arena, r, true),
        light{arena.to_sun.cast<float>()},
        columns(camera.width / kBlock + 1),
        rows(camera.height / kBlock + 1),
        focal(static_cast<float>(
            CameraModel::fromHorizontalFov(camera.width, camera.height, camera.hfov_deg * kDeg)
                .fx)) {
    for (const TrueFirePlace& place : arena.fire_places) {
      fire_boxes.emplace_back(
          (place.X_map_front * Eigen::Vector3d(-0.5 * place.box_m, 0, 0)).cast<float>());
    }
    Random random(0, "camera noise");
    for (std::size_t i = 0; i < kNoiseTable; ++i) {
      noise.push_back(static_cast<std::int8_t>(std::lround(random.normal(camera.noise))));
    }
  }

  /// Through a pixel, in map; not of unit length, linear in u and v.
  [[nodiscard]] Eigen::Vector3f through(float u, float v) const {
    const float x = (u - 0.5F * static_cast<float>(camera.width - 1)) / focal;
    const float y = (v - 0.5F * static_cast<float>(camera.height - 1)) / focal;
    return R * Eigen::Vector3f(x, y, 1.0F);
  }
  [[nodiscard]] Eigen::Vector3f direction(float u, float v) const {
    return through(u, v).normalized();
  }
  void castSamples(std::vector<Sample>& samples);
  void castPanes(std::vector<Sample>& samples);
  void castShadows(std::vector<Sample>& samples);
  [[nodiscard]] Eigen::Vector3f colour(const Sample& s, const Eigen::Vector3f& d) const;
  [[nodiscard]] bool plain(int column, int row) const;
  void fillPlain(int column, int row, std::vector<std::uint8_t>& out);
  void put(std::vector<std::uint8_t>& out, int u, int v, const Eigen::Vector3f& c) const;
  [[nodiscard]] const Sample& corner(int column, int row) const {
    return corners[static_cast<std::size_t>(row * columns + column)];
  }

  [[nodiscard]] Eigen::Isometry3d X_map_camera(const SceneState& state) const {
    if (mount == CameraMount::Mast) return state.X_map_base * X_mount_camera;
    return state.X_map_base * robot.X_base_flange(state.q) * X_mount_camera;
  }
  /// It looks out of the gripper's box.
  [[nodiscard]] std::uint32_t sees() const {
    return mount == CameraMount::Mast ? mask::kColour : mask::kColour & ~mask::kGripper;
  }
  void expose(const std::vector<std::uint8_t>& picture);

  CameraMount mount;
  CameraConfig camera;
  RobotGeometry robot;
  Eigen::Isometry3d X_mount_camera;
  RayScene scene;
  Daylight light;
  int columns, rows;
  float focal;
  Eigen::Matrix3f R;
  Eigen::Vector3f origin;
  std::vector<Eigen::Vector3f> fire_boxes;  ///< centres in map
  std::vector<std::size_t> special;         ///< rays that need a second look
  std::vector<Raycaster::Ray> rays, special_rays;
  std::vector<Raycaster::Hit> hits, panes;
  std::vector<std::uint8_t> shadows;
  std::vector<Sample> corners, details;
  std::vector<std::int8_t> noise;
  std::size_t noise_at = 0;
  std::uint64_t seq = 0;
  float gain = 1.0F;
};

/// Mean grey towards kMeanGrey, a third of the way in stops with every picture.
void ColourCamera::Impl::expose(const std::vector<std::uint8_t>& picture) {
  if (!camera.auto_exposure) return;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.size(); i += 97, ++count) sum += picture[i];
  const double mean = std::max(4.0, sum / static_cast<double>(std::max<std::size_t>(1, count)));
  gain = std::clamp(gain * static_cast<float>(std::pow(kMeanGrey / mean, 1.0 / 3.0)), kLeastGain,
                    kMostGain);
}

/// Acrylic before what the rays have met; asked only of rays that pass near a fire box.
void ColourCamera::Impl::castPanes(std::vector<Sample>& samples) {
  special.clear();
  special_rays.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto meets = [&](const Eigen::Vector3f& centre) {
      const Eigen::Vector3f way = centre - origin;
      const float along = way.dot(rays[i].direction);
      return along > 0.0F && way.squaredNorm() - along * along < kPaneRadius * kPaneRadius;
    };
    if (std::none_of(fire_boxes.begin(), fire_boxes.end(), meets)) continue;
    special.push_back(i);
    special_rays.push_back(rays[i]);
    special_rays.back().mask = mask::kAcrylic;
  }
  panes.resize(special.size());
  scene.rays().cast(special_rays, panes, true);
  for (std::size_t k = 0; k < special.size(); ++k) {
    Sample& s = samples[special[k]];
    s.pane = panes[k].valid() && (!s.hit.valid() || panes[k].range < s.hit.range);
  }
}

void ColourCamera::Impl::castShadows(std::vector<Sample>& samples) {
  special.clear();
  special_rays.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Raycaster::Hit& hit = samples[i].hit;
    if (!hit.valid() || hit.normal.dot(light.to_sun) <= 0.0F)
      continue;  // turned away: the light is 0 anyway
    special.push_back(i);
    special_rays.push_back({rays[i].origin + hit.range * rays[i].direction + 0.003F * hit.normal,
                            light.to_sun, kShadowReach,
                            mask::kSolid | mask::kRobot | mask::kGripper});
  }
  shadows.resize(special.size());
  scene.rays().occluded(special_rays, shadows);
  for (std::size_t k = 0; k < special.size(); ++k)
    samples[special[k]].sunlit = shadows[k] != 0 ? 0.0F : 1.0F;
}

/// For the rays in `rays`: nearest surface, acrylic before it, shadow on it.
void ColourCamera::Impl::castSamples(std::vector<Sample>& samples) {
  hits.resize(rays.size());
  samples.assign(rays.size(), Sample{});
  scene.rays().cast(rays, hits, true);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    samples[i].hit = hits[i];
    samples[i].patch =
        surfacePatch(RayScene::material(hits[i]), origin + hits[i].range * rays[i].direction);
  }
  castPanes(samples);
  castShadows(samples);
}

Eigen::Vector3f ColourCamera::Impl::colour(const Sample& s, const Eigen::Vector3f& d) const {
  Eigen::Vector3f c = Daylight::sky(d);
  if (s.hit.valid()) {
    const SurfaceLook look = surfaceLook(RayScene::material(s.hit), origin + s.hit.range * d,
                                         s.hit.normal, scene.temperature(s.hit));
    c = look.glows
            ? look.colour
            : Eigen::Vector3f(look.colour.cwiseProduct(light.strength(s.hit.normal, s.sunlit)));
  }
  if (s.pane) c += kPaneTint * (kPaneColour - c);
  return c;
}

/// Whether all four corners of a block see the same plane in the same way.
bool ColourCamera::Impl::plain(int column, int row) const {
  const Sample& a = corner(column, row);
  for (const Sample* b :
       {&corner(column + 1, row), &corner(column, row + 1), &corner(column + 1, row + 1)}) {
    if (a.hit.instance != b->hit.instance || a.pane != b->pane) return false;
    if (a.hit.valid() && a.hit.normal.dot(b->hit.normal) < 0.9999F) return false;
  }
  return true;
}

void ColourCamera::Impl::put(std::vector<std::uint8_t>& out, int u, int v,
                             const Eigen::Vector3f& c) const {
  const int at = v * camera.width + u;
  std::uint8_t* pixel = out.data() + 3 * static_cast<std::size_t>(at);
  const int n = noise[(noise_at + static_cast<std::size_t>(at)) % kNoiseTable];
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(std::clamp(static_cast<int>(gain * c[k]) + n, 0, 255));
}

/// One plane, one material: the light is worked out once, the pattern and the shadow's edge pixel
/// by pixel.
void ColourCamera::Impl::fillPlain(int column, int row, std::vector<std::uint8_t>& out) {
  const Sample& a = corner(column, row);
  const float sun[4] = {a.sunlit, corner(column + 1, row).sunlit, corner(column, row + 1).sunlit,
                        corner(column + 1, row + 1).sunlit};
  const bool even = sun[0] == sun[1] && sun[0] == sun[2] && sun[0] == sun[3];
  const Material material = RayScene::material(a.hit);
  const int u0 = column * kBlock, v0 = row * kBlock;
  const Eigen::Vector3f first = through(static_cast<float>(u0), static_cast<float>(v0));
  const int patch = a.patch;
  const bool one_patch = patch >= 0 && patch == corner(column + 1, row).patch &&
                         patch == corner(column, row + 1).patch &&
                         patch == corner(column + 1, row + 1).patch;
  if (!a.hit.valid() || (even && one_patch)) {
    const Eigen::Vector3f c = colour(a, first.normalized());
    for (int k = 0; k < kBlock * kBlock; ++k) put(out, u0 + k % kBlock, v0 + k / kBlock, c);
    return;
  }
  const Eigen::Vector3f normal = a.hit.normal, dark = light.strength(normal, 0.0F),
                        lit = light.strength(normal, 1.0F) - dark;
  const Eigen::Vector3f step_u = R.col(0) / focal, step_v = R.col(1) / focal;
  const float offset =
      a.hit.range * normal.dot(first.normalized());  // the plane: normal . (p - origin) = offset
  for (int k = 0; k < kBlock * kBlock; ++k) {
    const float du = static_cast<float>(k % kBlock), dv = static_cast<float>(k / kBlock);
    const float x = du / kBlock, y = dv / kBlock;
    const float sunlit =
        even ? sun[0]
             : (1 - y) * ((1 - x) * sun[0] + x * sun[1]) + y * ((1 - x) * sun[2] + x * sun[3]);
    const Eigen::Vector3f d = first + du * step_u + dv * step_v;
    const SurfaceLook look = surfaceLook(material, origin + (offset / normal.dot(d)) * d, normal,
                                         scene.temperature(a.hit));
    Eigen::Vector3f c =
        look.glows ? look.colour : Eigen::Vector3f(look.colour.cwiseProduct(dark + sunlit * lit));
    if (a.pane) c += kPaneTint * (kPaneColour - c);
    put(out, u0 + k % kBlock, v0 + k / kBlock, c);
  }
}

ColourCamera::ColourCamera(const WorldConfig& config, const TrueArena& arena,
                           const RobotGeometry& robot, CameraMount mount)
    : impl_(std::make_unique<Impl>(config, arena, robot, mount)) {}
ColourCamera::~ColourCamera() = default;

RgbImagePtr ColourCamera::render(const SceneState& state) {
  Impl& w = *impl_;
  w.scene.update(state);
  const Eigen::Isometry3d X = w.X_map_camera(state);
  w.R = X.linear().cast<float>();
  w.origin = X.translation().cast<float>();
  auto image = std::make_shared<RgbImage>();
  image->stamp = state.stamp;
  image->seq = ++w.seq;
  image->frame = w.mount == CameraMount::Mast ? frames::kOperatorCamera : frames::kRgb;
  image->width = w.camera.width;
  image->height = w.camera.height;
  image->data.resize(3 * static_cast<std::size_t>(w.camera.width) *
                     static_cast<std::size_t>(w.camera.height));
  w.noise_at = static_cast<std::size_t>(w.seq * 40503u) % kNoiseTable;

  w.rays.clear();
  for (int row = 0; row < w.rows; ++row) {
    for (int column = 0; column < w.columns; ++column) {
      w.rays.push_back(
          {w.origin,
           w.direction(static_cast<float>(column * kBlock), static_cast<float>(row * kBlock)), 1e4F,
           w.sees()});
    }
  }
  w.castSamples(w.corners);
  std::vector<std::pair<int, int>> busy;
  w.rays.clear();
  for (int row = 0; row + 1 < w.rows; ++row) {
    for (int column = 0; column + 1 < w.columns; ++column) {
      if (w.plain(column, row)) {
        w.fillPlain(column, row, image->data);
        continue;
      }
      busy.emplace_back(column, row);
      for (int k = 0; k < kBlock * kBlock; ++k) {
        const float u = static_cast<float>(column * kBlock + k % kBlock),
                    v = static_cast<float>(row * kBlock + k / kBlock);
        w.rays.push_back({w.origin, w.direction(u, v), 1e4F, w.sees()});
      }
    }
  }
  w.castSamples(w.details);
  for (std::size_t i = 0; i < w.details.size(); ++i) {
    const auto [column, row] = busy[i / (kBlock * kBlock)];
    const int k = static_cast<int>(i % (kBlock * kBlock));
    const Sample& s = w.details[i];
    w.put(image->data, column * kBlock + k % kBlock, row * kBlock + k / kBlock,
          w.colour(s, w.rays[i].direction));
  }
  w.expose(image->data);
  return image;
}

}  // namespace kiln::sim
