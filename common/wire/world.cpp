#include "common/wire/world.h"

#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/world.pb.h"

namespace kiln::wire {
namespace {

using wire::fromProto;
using wire::toProto;

constexpr std::size_t kMaxSceneBytes = 1u << 20;

void toProto(const FireEstimate& fire, v1::FireEstimate& out) {
  out.set_stamp_ns(toNanoseconds(fire.stamp));
  toProto(fire.p_map, *out.mutable_p_map());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.add_covariance(fire.covariance(row, column));
  }
  out.set_views(fire.views);
  out.set_peak_k(fire.peak_k);
  out.set_range_m(fire.range_m);
  out.set_baseline_range_m(fire.baseline_range_m);
  out.set_place(fire.place);
}

Result<FireEstimate> fromProto(const v1::FireEstimate& in) {
  std::array<double, 9> covariance{};
  if (auto ok = copyFixed(in.covariance(), covariance, "fire covariance"); !ok) {
    return tl::make_unexpected(ok.error());
  }
  FireEstimate fire;
  fire.stamp = stampFromNanoseconds(in.stamp_ns());
  fire.p_map = fromProto(in.p_map());
  fire.covariance =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data());
  fire.views = in.views();
  fire.peak_k = in.peak_k();
  fire.range_m = in.range_m();
  fire.baseline_range_m = in.baseline_range_m();
  fire.place = in.place();
  return fire;
}

void toProto(const SceneBox& box, v1::Box& out) {
  out.set_name(box.name);
  toProto(box.X_map_box, *out.mutable_x_map_box());
  toProto(box.half_extent, *out.mutable_half_extent());
  out.set_rgb(box.rgb);
}

Result<SceneBox> fromProto(const v1::Box& in) {
  auto X_map_box = fromProto(in.x_map_box(), "arena box");
  if (!X_map_box) return tl::make_unexpected(X_map_box.error());
  return SceneBox{in.name(), *X_map_box, fromProto(in.half_extent()), in.rgb()};
}

void toProto(const PlaceCheck& check, v1::PlaceCheck& out) {
  out.set_stamp_ns(toNanoseconds(check.stamp));
  out.set_place(validUtf8(check.place));
  toProto(check.X_map_configured, *out.mutable_x_map_configured());
  if (check.X_map_sensed) toProto(*check.X_map_sensed, *out.mutable_x_map_sensed());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.add_covariance(check.covariance(row, column));
  }
  out.set_offset_m(check.offset_m);
  out.set_yaw_offset_rad(check.yaw_offset_rad);
  out.set_coverage(check.coverage);
  out.set_points(check.points);
  out.set_verdict(static_cast<std::uint32_t>(check.verdict));
  out.set_reason(validUtf8(check.reason));
}

Result<PlaceCheck> fromProto(const v1::PlaceCheck& in) {
  const auto verdict = toEnum(in.verdict(), PlaceVerdict::Unseen, "verdict on a place");
  if (!verdict) return tl::make_unexpected(verdict.error());
  const auto configured = fromProto(in.x_map_configured(), "configured place");
  if (!configured) return tl::make_unexpected(configured.error());
  std::array<double, 9> covariance{};
  if (auto ok = copyFixed(in.covariance(), covariance, "place covariance"); !ok)
    return tl::make_unexpected(ok.error());
  PlaceCheck check;
  if (in.has_x_map_sensed()) {
    const auto sensed = fromProto(in.x_map_sensed(), "sensed place");
    if (!sensed) return tl::make_unexpected(sensed.error());
    check.X_map_sensed = *sensed;
  }
  check.stamp = stampFromNanoseconds(in.stamp_ns());
  check.place = in.place();
  check.X_map_configured = *configured;
  check.covariance =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data());
  check.offset_m = in.offset_m();
  check.yaw_offset_rad = in.yaw_offset_rad();
  check.coverage = in.coverage();
  check.points = in.points();
  check.verdict = *verdict;
  check.reason = in.reason();
  return check;
}

}  // namespace

std::string encode(const Scene& scene) {
  v1::Scene out;
  out.set_stamp_ns(toNanoseconds(scene.stamp));
  for (const FireEstimate& fire : scene.fires) toProto(fire, *out.add_fires());
  for (const FirePlaceInfo& place : scene.places) {
    v1::FirePlace& row = *out.add_places();
    row.set_name(place.name);
    toProto(place.p_map, *row.mutable_p_map());
    row.set_yaw_rad(place.yaw_rad);
    row.set_visited(place.visited);
    toProto(place.nudge, *row.mutable_nudge());
  }
  for (const Pose2& waypoint : scene.planned.waypoints_map)
    toProto(waypoint, *out.add_planned_path());
  out.set_planned_next(scene.planned.next);
  for (const Eigen::Vector3d& point : scene.jet.points_map) toProto(point, *out.add_jet());
  out.set_spraying(scene.jet.spraying);
  for (const SceneBox& box : scene.arena) toProto(box, *out.add_arena());
  for (const PlaceCheck& check : scene.place_checks) toProto(check, *out.add_place_checks());
  return serialise(out);
}

Result<Scene> decodeScene(std::string_view bytes) {
  const auto in = parse<v1::Scene>(bytes, kMaxSceneBytes, "scene");
  if (!in) return tl::make_unexpected(in.error());
  Scene scene;
  scene.stamp = stampFromNanoseconds(in->stamp_ns());
  for (const v1::FireEstimate& row : in->fires()) {
    auto fire = fromProto(row);
    if (!fire) return tl::make_unexpected(fire.error());
    scene.fires.push_back(std::move(*fire));
  }
  for (const v1::FirePlace& row : in->places()) {
    scene.places.push_back(
        {row.name(), fromProto(row.p_map()), row.yaw_rad(), row.visited(), fromProto(row.nudge())});
  }
  scene.planned.stamp = scene.stamp;
  for (const v1::Pose2& row : in->planned_path())
    scene.planned.waypoints_map.push_back(fromProto(row));
  scene.planned.next = in->planned_next();
  scene.jet.stamp = scene.stamp;
  for (const v1::Vec3& row : in->jet()) scene.jet.points_map.push_back(fromProto(row));
  scene.jet.spraying = in->spraying();
  for (const v1::Box& row : in->arena()) {
    auto box = fromProto(row);
    if (!box) return tl::make_unexpected(box.error());
    scene.arena.push_back(std::move(*box));
  }
  for (const v1::PlaceCheck& row : in->place_checks()) {
    auto check = fromProto(row);
    if (!check) return tl::make_unexpected(check.error());
    scene.place_checks.push_back(std::move(*check));
  }
  return scene;
}

}  // namespace kiln::wire
