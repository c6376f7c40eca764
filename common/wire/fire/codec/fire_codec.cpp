#include "common/wire/fire/codec/fire_codec.h"

#include <cmath>

#include "common/wire/fire/fire_view.h"
#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"
#include "kiln/fire/v1/fire.pb.h"

namespace kiln::wire {
namespace {

using wire::fromProto;
using wire::toProto;

constexpr std::size_t kMaxDetailBytes = 1u << 20;
constexpr int kMaxBlobs = 1000;

void toProto(const FireEstimate& fire, fire::v1::FireEstimate& out) {
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

Result<FireEstimate> fromProto(const fire::v1::FireEstimate& in) {
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

void toProto(const PlaceCheck& check, fire::v1::PlaceCheck& out) {
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

Result<PlaceCheck> fromProto(const fire::v1::PlaceCheck& in) {
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

void toProto(const HeatBlob& blob, fire::v1::HeatBlob& out) {
  out.set_u(blob.u);
  out.set_v(blob.v);
  out.set_u_min(blob.u_min);
  out.set_v_min(blob.v_min);
  out.set_u_max(blob.u_max);
  out.set_v_max(blob.v_max);
  out.set_peak_k(blob.peak_k);
  out.set_background_k(blob.background_k);
  out.set_half_max_area_px(blob.half_max_area_px);
  out.set_rejection(static_cast<std::uint32_t>(blob.rejection));
  out.set_reason(validUtf8(blob.reason));
}

Result<HeatBlob> fromProto(const fire::v1::HeatBlob& in) {
  const auto rejection = toEnum(in.rejection(), HeatRejection::NotLinear, "heat rejection");
  if (!rejection) return tl::make_unexpected(rejection.error());
  HeatBlob blob;
  blob.u = in.u();
  blob.v = in.v();
  blob.u_min = in.u_min();
  blob.v_min = in.v_min();
  blob.u_max = in.u_max();
  blob.v_max = in.v_max();
  blob.peak_k = in.peak_k();
  blob.background_k = in.background_k();
  blob.half_max_area_px = in.half_max_area_px();
  blob.rejection = *rejection;
  blob.reason = in.reason();
  return blob;
}

}  // namespace

MissionDetail encodeDetail(const FireSite& site) {
  fire::v1::FireSite out;
  out.set_stamp_ns(toNanoseconds(site.stamp));
  for (const FireEstimate& fire : site.fires) toProto(fire, *out.add_fires());
  for (const FirePlaceInfo& place : site.places) {
    fire::v1::FirePlace& row = *out.add_places();
    row.set_name(validUtf8(place.name));
    toProto(place.p_map, *row.mutable_p_map());
    row.set_yaw_rad(place.yaw_rad);
    row.set_visited(place.visited);
    toProto(place.nudge, *row.mutable_nudge());
    if (place.X_map_work) toProto(*place.X_map_work, *row.mutable_work());
  }
  for (const Eigen::Vector3d& point : site.jet_map) toProto(point, *out.add_jet());
  out.set_spraying(site.spraying);
  for (const PlaceCheck& check : site.place_checks) toProto(check, *out.add_place_checks());
  out.set_footprint_length_m(site.footprint_m.x());
  out.set_footprint_width_m(site.footprint_m.y());
  return {site.stamp, kiln::fire::kSiteSchema, serialise(out)};
}

Result<FireSite> decodeFireSite(std::string_view bytes) {
  const auto in = parse<fire::v1::FireSite>(bytes, kMaxDetailBytes, "fire site");
  if (!in) return tl::make_unexpected(in.error());
  FireSite site;
  site.stamp = stampFromNanoseconds(in->stamp_ns());
  for (const fire::v1::FireEstimate& row : in->fires()) {
    auto fire = fromProto(row);
    if (!fire) return tl::make_unexpected(fire.error());
    site.fires.push_back(std::move(*fire));
  }
  for (const fire::v1::FirePlace& row : in->places()) {
    site.places.push_back(
        {row.name(), fromProto(row.p_map()), row.yaw_rad(), row.visited(), fromProto(row.nudge())});
    if (row.has_work()) site.places.back().X_map_work = fromProto(row.work());
  }
  site.footprint_m = {in->footprint_length_m(), in->footprint_width_m()};
  for (const v1::Vec3& row : in->jet()) site.jet_map.push_back(fromProto(row));
  site.spraying = in->spraying();
  for (const fire::v1::PlaceCheck& row : in->place_checks()) {
    auto check = fromProto(row);
    if (!check) return tl::make_unexpected(check.error());
    site.place_checks.push_back(std::move(*check));
  }
  return site;
}

MissionDetail encodeDetail(const HeatDetections& detections) {
  fire::v1::HeatDetections out;
  out.set_stamp_ns(toNanoseconds(detections.stamp));
  out.set_image_seq(detections.image_seq);
  out.set_usable(detections.usable);
  out.set_refusal(validUtf8(detections.refusal));
  out.set_threshold_k(detections.threshold_k);
  out.set_max_k(detections.max_k);
  for (const HeatBlob& blob : detections.blobs) toProto(blob, *out.add_blobs());
  out.set_cost_ms(detections.cost_ms);
  return {detections.stamp, kiln::fire::kHeatSchema, serialise(out)};
}

Result<HeatDetections> decodeHeat(std::string_view bytes) {
  const auto in = parse<fire::v1::HeatDetections>(bytes, kMaxDetailBytes, "heat detections");
  if (!in) return tl::make_unexpected(in.error());
  if (in->blobs_size() > kMaxBlobs) {
    return makeError(ErrorCode::InvalidInput, "heat detections: {} blobs are more than {}; dropped",
                     in->blobs_size(), kMaxBlobs);
  }
  HeatDetections detections;
  detections.stamp = stampFromNanoseconds(in->stamp_ns());
  detections.image_seq = in->image_seq();
  detections.usable = in->usable();
  detections.refusal = in->refusal();
  detections.threshold_k = in->threshold_k();
  detections.max_k = in->max_k();
  detections.cost_ms = in->cost_ms();
  for (const fire::v1::HeatBlob& blob : in->blobs()) {
    auto value = fromProto(blob);
    if (!value) return tl::make_unexpected(value.error());
    detections.blobs.push_back(std::move(*value));
  }
  return detections;
}

}  // namespace kiln::wire
