#include "common/wire/localization.h"

#include <algorithm>
#include <cmath>

#include "common/wire/cloud_codec.h"
#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/localization.pb.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxStatusBytes = 16u << 10;
constexpr std::size_t kMaxLayerBytes = 4u << 20;
constexpr std::size_t kMaxTrajectoryBytes = 1u << 20;
constexpr double kLayerResolution_m = 0.01;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

PointCloud asCloud(const MapLayer& layer) {
  const std::size_t n = std::min(layer.points_map.size(), kMaxMapLayerPoints);
  PointCloud cloud;
  cloud.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f& p = layer.points_map[i];
    const std::uint8_t submap = i < layer.submap_of.size() ? layer.submap_of[i] : 0;
    cloud.push(p.x(), p.y(), p.z(), 0, submap, 0.0f);
  }
  return cloud;
}

Result<TrajectoryLeg> fromProto(const v1::TrajectoryLeg& in) {
  if (in.y_m_size() != in.x_m_size() || in.yaw_rad_size() != in.x_m_size()) {
    return makeError(ErrorCode::InvalidInput, "trajectory: {}, {} and {} values; dropped",
                     in.x_m_size(), in.y_m_size(), in.yaw_rad_size());
  }
  TrajectoryLeg leg;
  leg.resets = in.resets();
  for (int i = 0; i < in.x_m_size(); ++i) {
    const Pose2 pose{in.x_m(i), in.y_m(i), in.yaw_rad(i)};
    if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.yaw_rad))
      return makeError(ErrorCode::InvalidInput, "trajectory: pose {} is not finite; dropped", i);
    leg.X_map_base.push_back(pose);
  }
  return leg;
}

}  // namespace

std::string encode(const LocalizationStatus& status) {
  v1::LocalizationStatus out;
  out.set_stamp_ns(toNanoseconds(status.stamp));
  out.set_health(static_cast<std::uint32_t>(status.health));
  out.set_reason(validUtf8(status.reason));
  out.set_method(status.method);
  out.set_submap(validUtf8(status.submap));
  toProto(status.X_map_base, *out.mutable_x_map_base());
  toProto(status.X_map_odom, *out.mutable_x_map_odom());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.add_covariance(status.covariance(row, column));
  }
  out.set_sigma_m(status.sigma_m);
  out.set_sigma_yaw_rad(status.sigma_yaw_rad);
  out.set_match_age_s(status.match_age_s);
  out.set_inlier_fraction(status.inlier_fraction);
  out.set_observable_directions(status.observable_directions);
  out.set_matches(status.matches);
  out.set_rejected(status.rejected);
  if (status.tracking_error_m) out.set_tracking_error_m(*status.tracking_error_m);
  if (status.tracking_error_yaw_rad) out.set_tracking_error_yaw_rad(*status.tracking_error_yaw_rad);
  out.set_resets(status.resets);
  return serialise(out);
}

Result<LocalizationStatus> decodeLocalization(std::string_view bytes) {
  const auto in = parse<v1::LocalizationStatus>(bytes, kMaxStatusBytes, "localization");
  if (!in) return tl::make_unexpected(in.error());
  const auto health = toEnum(in->health(), LocalizationHealth::Lost, "localization health");
  if (!health) return tl::make_unexpected(health.error());
  const auto X_map_base = fromProto(in->x_map_base(), "localised pose");
  if (!X_map_base) return tl::make_unexpected(X_map_base.error());
  std::array<double, 9> covariance{};
  if (auto ok = copyFixed(in->covariance(), covariance, "pose covariance"); !ok)
    return tl::make_unexpected(ok.error());
  LocalizationStatus status;
  status.stamp = stampFromNanoseconds(in->stamp_ns());
  status.health = *health;
  status.reason = in->reason();
  status.method = in->method();
  status.submap = in->submap();
  status.X_map_base = *X_map_base;
  status.X_map_odom = fromProto(in->x_map_odom());
  status.covariance = Eigen::Map<const RowMajor3>(covariance.data());
  status.sigma_m = in->sigma_m();
  status.sigma_yaw_rad = in->sigma_yaw_rad();
  status.match_age_s = in->match_age_s();
  status.inlier_fraction = in->inlier_fraction();
  status.observable_directions = in->observable_directions();
  status.matches = in->matches();
  status.rejected = in->rejected();
  if (in->has_tracking_error_m()) status.tracking_error_m = in->tracking_error_m();
  if (in->has_tracking_error_yaw_rad())
    status.tracking_error_yaw_rad = in->tracking_error_yaw_rad();
  status.resets = in->resets();
  return status;
}

std::string encode(const MapLayer& layer) {
  v1::MapLayer out;
  out.set_stamp_ns(toNanoseconds(layer.stamp));
  out.set_name(validUtf8(layer.name));
  out.set_version(layer.version);
  for (const std::string& name : layer.submaps) out.add_submaps(validUtf8(name));
  *out.mutable_points() = packCloud(asCloud(layer), kLayerResolution_m);
  return serialise(out);
}

Result<MapLayer> decodeMapLayer(std::string_view bytes) {
  const auto in = parse<v1::MapLayer>(bytes, kMaxLayerBytes, "map layer");
  if (!in) return tl::make_unexpected(in.error());
  const v1::Cloud& points = in->points();
  if (points.points() > kMaxMapLayerPoints) {
    return makeError(ErrorCode::InvalidInput, "map layer: {} points are more than {}; dropped",
                     points.points(), kMaxMapLayerPoints);
  }
  const auto cloud = unpackCloud(points);
  if (!cloud) return tl::make_unexpected(cloud.error());
  MapLayer layer;
  layer.stamp = stampFromNanoseconds(in->stamp_ns());
  layer.name = in->name();
  layer.version = in->version();
  layer.submaps.assign(in->submaps().begin(), in->submaps().end());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (!std::isfinite(cloud->x[i])) continue;  // was out of reach
    layer.points_map.emplace_back(cloud->x[i], cloud->y[i], cloud->z[i]);
    layer.submap_of.push_back(cloud->ring[i]);
  }
  return layer;
}

std::string encode(const Trajectory& trajectory) {
  v1::Trajectory out;
  out.set_stamp_ns(toNanoseconds(trajectory.stamp));
  for (const TrajectoryLeg& leg : trajectory.legs) {
    v1::TrajectoryLeg& row = *out.add_legs();
    row.set_resets(leg.resets);
    for (const Pose2& pose : leg.X_map_base) {
      row.add_x_m(static_cast<float>(pose.x_m));
      row.add_y_m(static_cast<float>(pose.y_m));
      row.add_yaw_rad(static_cast<float>(pose.yaw_rad));
    }
  }
  return serialise(out);
}

Result<Trajectory> decodeTrajectory(std::string_view bytes) {
  const auto in = parse<v1::Trajectory>(bytes, kMaxTrajectoryBytes, "trajectory");
  if (!in) return tl::make_unexpected(in.error());
  Trajectory trajectory;
  trajectory.stamp = stampFromNanoseconds(in->stamp_ns());
  for (const v1::TrajectoryLeg& row : in->legs()) {
    auto leg = fromProto(row);
    if (!leg) return tl::make_unexpected(leg.error());
    trajectory.legs.push_back(std::move(*leg));
  }
  return trajectory;
}

}  // namespace kiln::wire
