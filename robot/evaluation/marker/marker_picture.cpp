#include "robot/evaluation/marker/marker_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/core/units.h"
#include "robot/scene/raycaster.h"

namespace kiln {
namespace {

using Eigen::Vector3f;

constexpr int kWidth = 1280, kHeight = 720, kFine = 4;  // fine rays a pixel, each way
constexpr std::uint32_t kGround = 0, kRobot = 1, kFirstBox = 2;
constexpr std::uint32_t kSeen = 1, kShades = 2;
constexpr float kFar_m = 200.0F;

struct Light {
  Vector3f to_sun, sun, sky;
};

Light lightOf(const MarkerScene& scene) {
  // The lower the sun, the warmer and weaker; the sky is bluish and gives a quarter of noon.
  const auto high = static_cast<float>(std::sin(scene.sun_elevation_rad));
  const float low = 1.0F - high;
  Light out;
  out.to_sun = scene.toSun();
  out.sun =
      (0.75F + 0.25F * high) * Vector3f(1.0F, 1.0F - 0.10F * low * low, 1.0F - 0.28F * low * low);
  out.sky = 0.26F * Vector3f(0.86F, 0.97F, 1.16F);
  return out;
}

}  // namespace

struct MarkerPainter::Impl {
  Impl(const MarkerScene& s, const RobotGeometry& r, const HeadCamera& c, std::uint64_t seed)
      : scene(s),
        robot(r),
        head(c),
        camera(CameraModel::fromHorizontalFov(kWidth, kHeight, c.hfov_deg * kDeg)),
        random(seed),
        light(lightOf(s)) {
    build();
    std::normal_distribution<float> bias(0.0F, 0.010F);
    for (float& b : laser_bias_m) b = bias(random);
  }

  void build();
  void place(const Eigen::Isometry3d& X_map_base, const Vector6d& q);
  [[nodiscard]] Vector3f colour(const Raycaster::Ray& ray, const Raycaster::Hit& hit,
                                bool sunlit) const;
  [[nodiscard]] int piece(const Raycaster::Ray& ray, const Raycaster::Hit& hit) const;
  void trace(const std::vector<Raycaster::Ray>& rays, std::vector<Vector3f>& colours,
             std::vector<int>* pieces);
  [[nodiscard]] cv::Mat expose(const cv::Mat& linear, double turning_radps);

  MarkerScene scene;
  RobotGeometry robot;
  HeadCamera head;
  CameraModel camera;
  std::mt19937_64 random;
  Light light;
  Raycaster caster;
  std::vector<std::pair<Raycaster::Id, Eigen::Isometry3d>> body;        // X_base_box
  std::vector<std::pair<Raycaster::Id, Eigen::Isometry3d>> head_boxes;  // X_flange_box
  std::vector<Raycaster::Id> arm;
  std::array<float, 16> laser_bias_m{};
  // Reused from picture to picture.
  std::vector<Raycaster::Ray> sun_rays;
  std::vector<Raycaster::Hit> hits;
  std::vector<std::uint8_t> shaded;
};

void MarkerPainter::Impl::build() {
  // The ground along X: before, slope, level; 200 m wide.
  const auto& a = scene.ground.approach();
  const std::array<double, 4> x{-150.0, a.foot_x_m, a.top_x_m, 150.0};
  std::vector<Vector3f> vertices;
  for (const double at : x)
    for (const float y : {-100.0F, 100.0F})
      vertices.emplace_back(static_cast<float>(at), y, static_cast<float>(scene.ground.height(at)));
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < 6; i += 2) {
    triangles.emplace_back(i, i + 2, i + 1);
    triangles.emplace_back(i + 1, i + 2, i + 3);
  }
  caster.addMesh(vertices, triangles, Eigen::Isometry3d::Identity(), kGround, kSeen | kShades);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i)
    caster.addBox(scene.boxes[i].size_m, scene.boxes[i].X_map_box,
                  kFirstBox + static_cast<std::uint32_t>(i), kSeen | kShades);
  // The camera stands within the head: of arm and head only shadows are drawn.
  for (const BoxConfig& box : robot.body) {
    const Eigen::Vector3d size(box.size_m[0], box.size_m[1], box.size_m[2]);
    body.emplace_back(caster.addBox(size, Eigen::Isometry3d::Identity(), kRobot, kSeen | kShades),
                      box.center.pose());
  }
  for (const BoxConfig& box : robot.head) {
    const Eigen::Vector3d size(box.size_m[0], box.size_m[1], box.size_m[2]);
    head_boxes.emplace_back(caster.addBox(size, Eigen::Isometry3d::Identity(), kRobot, kShades),
                            box.center.pose());
  }
  for (const Capsule& c :
       robot.armCapsules(RobotGeometry::radians(robot.q_drive_deg), Eigen::Isometry3d::Identity()))
    arm.push_back(caster.addCylinder(c.radius, (c.b - c.a).norm() + c.radius,
                                     Eigen::Isometry3d::Identity(), kRobot, kShades));
}

void MarkerPainter::Impl::place(const Eigen::Isometry3d& X_map_base, const Vector6d& q) {
  for (const auto& [id, X_base_box] : body) caster.setPose(id, X_map_base * X_base_box);
  const Eigen::Isometry3d X_map_flange = X_map_base * robot.X_base_flange(q);
  for (const auto& [id, X_flange_box] : head_boxes) caster.setPose(id, X_map_flange * X_flange_box);
  const auto shapes = robot.armCapsules(q, X_map_base * robot.X_base_armbase.pose());
  for (std::size_t i = 0; i < arm.size(); ++i) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    const Eigen::Vector3d along = shapes[i].b - shapes[i].a;
    X.translation() = 0.5 * (shapes[i].a + shapes[i].b);
    X.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along).toRotationMatrix();
    caster.setPose(arm[i], X);
  }
  caster.commit();
}

Vector3f MarkerPainter::Impl::colour(const Raycaster::Ray& ray, const Raycaster::Hit& hit,
                                     bool sunlit) const {
  if (!hit.valid()) {
    const float up = std::clamp(2.0F * ray.direction.z(), 0.0F, 1.0F);
    return (1.0F - up) * Vector3f(0.62F, 0.66F, 0.72F) + up * Vector3f(0.25F, 0.40F, 0.70F);
  }
  const Vector3f p = ray.origin + hit.range * ray.direction;
  bool foil = false;
  const Albedo own = hit.material >= kFirstBox ? scene.boxes[hit.material - kFirstBox].colour
                     : hit.material == kRobot
                         ? Albedo::Constant(0.08F)
                         : scene.groundColour(p.head<2>().cast<double>(), foil);
  const float facing = std::max(0.0F, hit.normal.dot(light.to_sun));
  const Vector3f irradiance =
      light.sky * (0.6F + 0.4F * hit.normal.z()) + (sunlit ? facing : 0.0F) * light.sun;
  Vector3f out = own.cwiseProduct(irradiance);
  if (foil) {
    // The foil mirrors the sky towards grazing, and the sun where it stands opposite.
    const float cosine = std::max(0.0F, -ray.direction.dot(hit.normal));
    const float fresnel = 0.04F + 0.96F * std::pow(1.0F - cosine, 5.0F);
    out += 0.35F * fresnel * Vector3f(0.55F, 0.62F, 0.72F);
    const Vector3f mirrored = ray.direction + 2.0F * cosine * hit.normal;
    if (sunlit)
      out += scene.gloss * std::pow(std::max(0.0F, mirrored.dot(light.to_sun)), 24.0F) * light.sun;
  }
  return out;
}

int MarkerPainter::Impl::piece(const Raycaster::Ray& ray, const Raycaster::Hit& hit) const {
  if (!hit.valid()) return -1;
  if (hit.material != kGround) {
    const int face = static_cast<int>(
        std::lround(4.0F * hit.normal.x() + 2.0F * hit.normal.y() + hit.normal.z()));
    return 10000 + 100 * static_cast<int>(hit.material) + face;
  }
  const Vector3f p = ray.origin + hit.range * ray.direction;
  return scene.groundPiece(p.head<2>().cast<double>());
}

void MarkerPainter::Impl::trace(const std::vector<Raycaster::Ray>& rays,
                                std::vector<Vector3f>& colours, std::vector<int>* pieces) {
  hits.resize(rays.size());
  caster.cast(rays, hits, true);
  sun_rays.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Raycaster::Ray to_sun;
    to_sun.direction = light.to_sun;
    to_sun.mask = kShades;
    to_sun.max_range = hits[i].valid() ? kFar_m : 0.0F;
    to_sun.origin = rays[i].origin + std::max(0.0F, hits[i].range) * rays[i].direction +
                    0.004F * hits[i].normal;
    sun_rays.push_back(to_sun);
  }
  shaded.resize(rays.size());
  caster.occluded(sun_rays, shaded);
  colours.resize(rays.size());
  if (pieces != nullptr) pieces->resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    colours[i] = colour(rays[i], hits[i], shaded[i] == 0);
    if (pieces != nullptr) (*pieces)[i] = 2 * piece(rays[i], hits[i]) + (shaded[i] != 0 ? 1 : 0);
  }
}

cv::Mat MarkerPainter::Impl::expose(const cv::Mat& linear, double turning_radps) {
  cv::Mat image;
  cv::GaussianBlur(linear, image, {5, 5}, head.blur_px);
  const int blur_px =
      static_cast<int>(std::lround(std::abs(turning_radps) * head.shutter_s * camera.fx));
  if (blur_px > 1) cv::blur(image, image, {blur_px, 1});
  // Automatic exposure: the lower two thirds are metered.
  const cv::Scalar mean = cv::mean(image.rowRange(kHeight / 3, kHeight));
  const double grey = (mean[0] + mean[1] + mean[2]) / 3.0;
  const auto gain =
      static_cast<float>(0.21 / std::max(1e-3, grey) * std::exp2(head.exposure_stops));
  std::normal_distribution<float> normal(0.0F, 1.0F);
  cv::Mat out(image.size(), CV_8UC3);
  constexpr int kLevels = 4096;
  static const std::array<std::uint8_t, kLevels> kCurve = [] {
    std::array<std::uint8_t, kLevels> curve{};
    for (int i = 0; i < kLevels; ++i) {
      const double v = i / (kLevels - 1.0);
      const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
      curve[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * s));
    }
    return curve;
  }();
  const auto noise = static_cast<float>(head.noise);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const auto& in = image.at<cv::Vec3f>(v, u);
      for (int k = 0; k < 3; ++k) {
        const float signal = gain * head.balance[k] * in[k];
        // Photon noise: its variance grows with the light; 0.2 is mid grey.
        const float sigma = noise * std::sqrt(0.1F + std::max(0.0F, signal) / 0.2F);
        const float value = std::clamp(signal + sigma * normal(random), 0.0F, 1.0F);
        // OpenCV's order for the encoder: blue first.
        out.at<cv::Vec3b>(v, u)[2 - k] =
            kCurve[static_cast<std::size_t>(std::lround(value * (kLevels - 1.0F)))];
      }
    }
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", out, jpeg, {cv::IMWRITE_JPEG_QUALITY, head.jpeg_quality});
  cv::Mat decoded = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  cv::cvtColor(decoded, decoded, cv::COLOR_BGR2RGB);
  return decoded;
}

MarkerPainter::MarkerPainter(const MarkerScene& scene, const RobotGeometry& robot,
                             const HeadCamera& camera, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(scene, robot, camera, seed)) {}
MarkerPainter::~MarkerPainter() = default;

RgbImage MarkerPainter::paint(const Eigen::Isometry3d& X_map_base, const Vector6d& q,
                              const Eigen::Isometry3d& X_map_rgb, double turning_radps) {
  Impl& w = *impl_;
  w.place(X_map_base, q);
  const Vector3f eye = X_map_rgb.translation().cast<float>();
  const Eigen::Matrix3f R = X_map_rgb.linear().cast<float>();
  const auto ray = [&](double u, double v) {
    return Raycaster::Ray{eye, R * w.camera.ray({u, v}).cast<float>(), kFar_m, kSeen};
  };
  std::vector<Raycaster::Ray> rays;
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) rays.push_back(ray(u, v));
  std::vector<Vector3f> colours;
  std::vector<int> pieces;
  w.trace(rays, colours, &pieces);
  // Where neighbours show different things, and all over the foil, finer.
  std::vector<int> busy;
  rays.clear();
  for (int v = 1; v + 1 < kHeight; ++v)
    for (int u = 1; u + 1 < kWidth; ++u) {
      const int i = v * kWidth + u;
      const auto at = [&](int k) { return pieces[static_cast<std::size_t>(k)]; };
      const bool foil = at(i) >= 2 && at(i) < 6;
      if (!foil && at(i) == at(i - 1) && at(i) == at(i + 1) && at(i) == at(i - kWidth) &&
          at(i) == at(i + kWidth))
        continue;
      busy.push_back(i);
      for (int k = 0; k < kFine * kFine; ++k)
        rays.push_back(
            ray(u + (k % kFine + 0.5) / kFine - 0.5, v + (k / kFine + 0.5) / kFine - 0.5));
    }
  std::vector<Vector3f> fine;
  w.trace(rays, fine, nullptr);
  for (std::size_t b = 0; b < busy.size(); ++b) {
    Vector3f sum = Vector3f::Zero();
    for (std::size_t k = 0; k < kFine * kFine; ++k) sum += fine[b * kFine * kFine + k];
    colours[static_cast<std::size_t>(busy[b])] = sum / (kFine * kFine);
  }
  cv::Mat linear(kHeight, kWidth, CV_32FC3, colours.data());
  const cv::Mat rgb = w.expose(linear, turning_radps);
  RgbImage out;
  out.frame = "rgb";
  out.width = kWidth;
  out.height = kHeight;
  out.data.assign(rgb.data, rgb.data + rgb.total() * 3);
  return out;
}

PointCloud MarkerPainter::scan(const Eigen::Isometry3d& X_map_lidar) {
  Impl& w = *impl_;
  w.caster.commit();
  std::vector<Raycaster::Ray> rays;
  std::vector<std::uint8_t> rings;
  const Eigen::Matrix3f R = X_map_lidar.linear().cast<float>();
  for (int ring = 0; ring < 16; ++ring)
    for (int step = -225; step <= 225; ++step) {
      const double e = (2.0 * ring - 15.0) * kDeg, a = 0.4 * step * kDeg;
      const Eigen::Vector3d d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      rays.push_back({X_map_lidar.translation().cast<float>(), R * d.cast<float>(), 100.0F, kSeen});
      rings.push_back(static_cast<std::uint8_t>(ring));
    }
  std::vector<Raycaster::Hit> hits(rays.size());
  w.caster.cast(rays, hits);
  std::normal_distribution<float> white(0.0F, 0.010F);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  PointCloud out;
  out.frame = "lidar";
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].valid() || chance(w.random) < 0.005) continue;
    const float range = hits[i].range + w.laser_bias_m[rings[i]] + white(w.random);
    const Vector3f p = range * (R.transpose() * rays[i].direction);
    out.push(p.x(), p.y(), p.z(), 20, rings[i], 0.0F);
  }
  return out;
}

}  // namespace kiln
