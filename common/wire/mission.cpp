#include "common/wire/mission.h"

#include <cmath>

#include "common/wire/mission_fields.h"
#include "common/wire/proto_message.h"

namespace kiln::wire {
namespace {

constexpr std::size_t kMaxInfoBytes = 256u << 10;
constexpr std::size_t kMaxDetailBytes = 1u << 20;
constexpr int kMaxRows = 64;  // of layers, commands, actuators and panels

void toProto(const FigureSpec& spec, v1::FigureSpec& out) {
  out.set_id(validUtf8(spec.id));
  out.set_label(validUtf8(spec.label));
  out.set_unit(validUtf8(spec.unit));
  out.set_decimals(spec.decimals);
  out.set_low(spec.low);
  out.set_high(spec.high);
  if (spec.caution_below) out.set_caution_below(*spec.caution_below);
  if (spec.caution_above) out.set_caution_above(*spec.caution_above);
  out.set_estimated(spec.estimated);
  out.set_top_bar(spec.top_bar);
  out.set_plot(spec.plot);
  out.set_doc(validUtf8(spec.doc));
}

Result<FigureSpec> fromProto(const v1::FigureSpec& in) {
  constexpr int kMostDecimals = 6;
  if (in.decimals() < 0 || in.decimals() > kMostDecimals || !std::isfinite(in.low() + in.high())) {
    return makeError(ErrorCode::InvalidInput,
                     "mission info: figure '{}' has {} decimals, range {} to {}; dropped", in.id(),
                     in.decimals(), in.low(), in.high());
  }
  FigureSpec spec;
  spec.id = in.id();
  spec.label = printableName(in.label());
  spec.unit = printableName(in.unit());
  spec.decimals = in.decimals();
  spec.low = in.low();
  spec.high = in.high();
  if (in.has_caution_below()) spec.caution_below = in.caution_below();
  if (in.has_caution_above()) spec.caution_above = in.caution_above();
  spec.estimated = in.estimated();
  spec.top_bar = in.top_bar();
  spec.plot = in.plot();
  spec.doc = in.doc();
  return spec;
}

void toProto(const CommandSpec& spec, v1::CommandSpec& out) {
  out.set_name(validUtf8(spec.name));
  out.set_text(validUtf8(spec.text));
  out.set_consequence(validUtf8(spec.consequence));
  out.set_confirmation(static_cast<std::uint32_t>(spec.confirmation));
  out.set_while_stopped(spec.while_stopped);
  out.set_needs_live(spec.needs_live);
  out.set_target(validUtf8(spec.target));
  for (const ArgumentSpec& argument : spec.arguments) {
    v1::ArgumentSpec& row = *out.add_arguments();
    row.set_name(validUtf8(argument.name));
    row.set_unit(validUtf8(argument.unit));
    row.set_low(argument.low);
    row.set_high(argument.high);
    row.set_doc(validUtf8(argument.doc));
  }
}

Result<CommandSpec> fromProto(const v1::CommandSpec& in) {
  const auto confirmation = toEnum(in.confirmation(), Confirmation::TwoSteps, "confirmation");
  if (!confirmation) return tl::make_unexpected(confirmation.error());
  CommandSpec spec;
  spec.name = printableName(in.name());
  spec.text = printableName(in.text());
  spec.consequence = in.consequence();
  spec.confirmation = *confirmation;
  spec.while_stopped = in.while_stopped();
  spec.needs_live = in.needs_live();
  spec.target = printableName(in.target());
  for (const v1::ArgumentSpec& row : in.arguments())
    spec.arguments.push_back(
        {printableName(row.name()), printableName(row.unit()), row.low(), row.high(), row.doc()});
  return spec;
}

}  // namespace

void toProto(const Figure& figure, v1::Figure& out) {
  out.set_id(validUtf8(figure.id));
  out.set_value(figure.value);
  out.set_age_s(figure.age_s);
}

Figure fromProto(const v1::Figure& in) { return {in.id(), in.value(), in.age_s()}; }

void toProto(const MissionDetail& detail, v1::MissionDetail& out) {
  out.set_stamp_ns(toNanoseconds(detail.stamp));
  out.set_schema(validUtf8(detail.schema));
  out.set_data(detail.data);
}

MissionDetail fromProto(const v1::MissionDetail& in) {
  return {stampFromNanoseconds(in.stamp_ns()), in.schema(), in.data()};
}

std::string encode(const MissionInfo& info) {
  v1::MissionInfo out;
  out.set_mission(validUtf8(info.mission));
  out.set_mission_uuid(validUtf8(info.mission_uuid));
  out.set_title(validUtf8(info.title));
  for (const FigureSpec& spec : info.figures) toProto(spec, *out.add_figures());
  for (const LayerSpec& layer : info.layers) {
    v1::LayerSpec& row = *out.add_layers();
    row.set_id(validUtf8(layer.id));
    row.set_label(validUtf8(layer.label));
  }
  for (const CommandSpec& spec : info.commands) toProto(spec, *out.add_commands());
  for (const ActuatorSpec& actuator : info.actuators) {
    v1::ActuatorSpec& row = *out.add_actuators();
    row.set_name(validUtf8(actuator.name));
    row.set_text(validUtf8(actuator.text));
    row.set_low(actuator.low);
    row.set_high(actuator.high);
  }
  for (const std::string& panel : info.panels) out.add_panels(validUtf8(panel));
  return serialise(out);
}

Result<MissionInfo> decodeMissionInfo(std::string_view bytes) {
  const auto in = parse<v1::MissionInfo>(bytes, kMaxInfoBytes, "mission info");
  if (!in) return tl::make_unexpected(in.error());
  if (in->figures_size() > kMaxFigures)
    return makeError(ErrorCode::InvalidInput, "mission info: {} figures are more than {}; dropped",
                     in->figures_size(), kMaxFigures);
  for (const int rows :
       {in->layers_size(), in->commands_size(), in->actuators_size(), in->panels_size()}) {
    if (rows > kMaxRows)
      return makeError(ErrorCode::InvalidInput,
                       "mission info: {} layers, commands, actuators or panels are more than {}; "
                       "dropped",
                       rows, kMaxRows);
  }
  MissionInfo info;
  info.mission = printableName(in->mission());
  info.mission_uuid = printableName(in->mission_uuid());
  info.title = printableName(in->title());
  for (const v1::FigureSpec& row : in->figures()) {
    auto spec = fromProto(row);
    if (!spec) return tl::make_unexpected(spec.error());
    info.figures.push_back(std::move(*spec));
  }
  for (const v1::LayerSpec& row : in->layers())
    info.layers.push_back({row.id(), printableName(row.label())});
  for (const v1::CommandSpec& row : in->commands()) {
    auto spec = fromProto(row);
    if (!spec) return tl::make_unexpected(spec.error());
    info.commands.push_back(std::move(*spec));
  }
  for (const v1::ActuatorSpec& row : in->actuators())
    info.actuators.push_back(
        {printableName(row.name()), printableName(row.text()), row.low(), row.high()});
  info.panels.assign(in->panels().begin(), in->panels().end());
  return info;
}

std::string encode(const MissionDetail& detail) {
  v1::MissionDetail out;
  toProto(detail, out);
  return serialise(out);
}

Result<MissionDetail> decodeMissionDetail(std::string_view bytes) {
  const auto in = parse<v1::MissionDetail>(bytes, kMaxDetailBytes, "mission detail");
  if (!in) return tl::make_unexpected(in.error());
  return fromProto(*in);
}

}  // namespace kiln::wire
