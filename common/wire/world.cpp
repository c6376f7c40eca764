#include "common/wire/world.h"

#include "common/wire/geometry.h"
#include "common/wire/mission_fields.h"
#include "common/wire/proto_message.h"
#include "kiln/v1/world.pb.h"

namespace kiln::wire {
namespace {

using wire::fromProto;
using wire::toProto;

constexpr std::size_t kMaxSceneBytes = 1u << 20;
constexpr double kMaxLine_px = 20.0;

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

void toProto(const SceneItem& item, v1::SceneItem& out) {
  out.set_id(validUtf8(item.id));
  out.set_layer(validUtf8(item.layer));
  out.set_shape(static_cast<std::uint32_t>(item.shape));
  out.set_style(static_cast<std::uint32_t>(item.style));
  toProto(item.X_map_item, *out.mutable_x_map_item());
  if (!item.size.isZero(0.0)) toProto(item.size, *out.mutable_size());
  for (const Eigen::Vector3d& point : item.points) toProto(point, *out.add_points());
  if (item.shape == SceneItem::Shape::Estimate) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) out.add_covariance(item.covariance(row, column));
  }
  out.set_width_px(item.width_px);
  out.set_label(validUtf8(item.label));
  out.set_detail(validUtf8(item.detail));
}

Result<SceneItem> fromProto(const v1::SceneItem& in) {
  const auto shape = toEnum(in.shape(), SceneItem::Shape::Cylinder, "shape of a scene item");
  if (!shape) return tl::make_unexpected(shape.error());
  const auto style = toEnum(in.style(), ItemStyle::Intent, "style of a scene item");
  if (!style) return tl::make_unexpected(style.error());
  const auto X_map_item = fromProto(in.x_map_item(), "scene item");
  if (!X_map_item) return tl::make_unexpected(X_map_item.error());
  SceneItem item;
  item.id = in.id();
  item.layer = in.layer();
  item.shape = *shape;
  item.style = *style;
  item.X_map_item = *X_map_item;
  item.size = fromProto(in.size());
  for (const v1::Vec3& row : in.points()) {
    item.points.push_back(fromProto(row));
    if (!item.points.back().allFinite())
      return makeError(ErrorCode::InvalidInput, "scene item '{}': a point is not finite; dropped",
                       in.id());
  }
  if (*shape == SceneItem::Shape::Estimate) {
    std::array<double, 9> covariance{};
    if (auto ok = copyFixed(in.covariance(), covariance, "covariance of a scene item"); !ok)
      return tl::make_unexpected(ok.error());
    item.covariance =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data());
  }
  if (!item.size.allFinite() || !(in.width_px() >= 0.0 && in.width_px() <= kMaxLine_px))
    return makeError(ErrorCode::InvalidInput,
                     "scene item '{}': its size or its line of {} px cannot be drawn; dropped",
                     in.id(), in.width_px());
  item.width_px = in.width_px();
  item.label = in.label();
  item.detail = in.detail();
  return item;
}

}  // namespace

std::string encode(const Scene& scene) {
  v1::Scene out;
  out.set_stamp_ns(toNanoseconds(scene.stamp));
  for (const Pose2& waypoint : scene.planned.waypoints_map)
    toProto(waypoint, *out.add_planned_path());
  out.set_planned_next(scene.planned.next);
  for (const SceneBox& box : scene.arena) toProto(box, *out.add_arena());
  for (const SceneItem& item : scene.items) toProto(item, *out.add_items());
  if (!scene.detail.schema.empty()) toProto(scene.detail, *out.mutable_detail());
  return serialise(out);
}

Result<Scene> decodeScene(std::string_view bytes) {
  const auto in = parse<v1::Scene>(bytes, kMaxSceneBytes, "scene");
  if (!in) return tl::make_unexpected(in.error());
  Scene scene;
  scene.stamp = stampFromNanoseconds(in->stamp_ns());
  scene.planned.stamp = scene.stamp;
  for (const v1::Pose2& row : in->planned_path())
    scene.planned.waypoints_map.push_back(fromProto(row));
  scene.planned.next = in->planned_next();
  for (const v1::Box& row : in->arena()) {
    auto box = fromProto(row);
    if (!box) return tl::make_unexpected(box.error());
    scene.arena.push_back(std::move(*box));
  }
  for (const v1::SceneItem& row : in->items()) {
    auto item = fromProto(row);
    if (!item) return tl::make_unexpected(item.error());
    scene.items.push_back(std::move(*item));
  }
  if (in->has_detail()) scene.detail = fromProto(in->detail());
  return scene;
}

}  // namespace kiln::wire
