#include "gui/link/topic_inboxes.h"

namespace kiln::gui {

namespace {
constexpr std::size_t kLogQueue = 2000;
constexpr int kWarnLevel = 3;

template <class T>
std::shared_ptr<const T> shared(const T& value) {
  return std::make_shared<const T>(value);
}
}  // namespace

TopicInboxes::TopicInboxes(Link& link, std::function<void(const Arrival&)> arrived, bool replay)
    : replay_(replay),
      status_(link,
              [&link, arrived = std::move(arrived)](const auto& value) {
                if (arrived) arrived(value.second);
                emit link.status(value.first);
              }),
      fsm_info_(link, [&link](const auto& value) { emit link.fsmInfo(value); }),
      fsm_status_(link, [&link](const auto& value) { emit link.fsmStatus(value); }),
      scene_(link, [&link](const auto& value) { emit link.scene(value); }),
      localization_(link, [&link](const auto& value) { emit link.localization(value); }),
      trajectory_(link, [&link](const auto& value) { emit link.trajectory(value); }),
      map_layer_(link, [&link](const auto& value) { emit link.mapLayer(value); }),
      macros_(link, [&link](const auto& value) { emit link.macros(value); }),
      cloud_(link, [&link](const auto& value) { emit link.cloud(value); }),
      thermal_(link, [&link](const auto& value) { emit link.thermal(value); }),
      mission_info_(link, [&link](const auto& value) { emit link.missionInfo(value); }),
      mission_stream_(link, [&link](const auto& value) { emit link.missionStream(value); }),
      head_image_(link, [&link](const auto& value) { emit link.image(value); }),
      operator_image_(link, [&link](const auto& value) { emit link.image(value); }),
      log_(link, kLogQueue, [&link](const std::vector<LogLine>& lines) { emit link.log(lines); }) {
  decoder_ = std::make_unique<JpegDecoder>(
      [this](RgbImagePtr image) {
        (image->frame == "rgb" ? head_image_ : operator_image_).put(std::move(image));
      },
      [this](const std::string& text) { warn(text); });
}

void TopicInboxes::warn(const std::string& text) {
  log_.put(LogLine{Stamp{}, kWarnLevel, "station", text});
}

OperatorSession::Callbacks TopicInboxes::callbacks() {
  OperatorSession::Callbacks c;
  c.on_status = [this](const RobotStatus& v, const Arrival& a) {
    auto status = std::make_shared<RobotStatus>(v);
    if (replay_) status->environment = Environment::Replay;
    status_.put({std::move(status), a});
  };
  c.on_fsm_info = [this](const FsmInfo& v, const Arrival&) { fsm_info_.put(shared(v)); };
  c.on_fsm_status = [this](const FsmStatus& v, const Arrival&) { fsm_status_.put(shared(v)); };
  c.on_scene = [this](const Scene& v, const Arrival&) { scene_.put(shared(v)); };
  c.on_localization = [this](const LocalizationStatus& v, const Arrival&) {
    localization_.put(shared(v));
  };
  c.on_trajectory = [this](const Trajectory& v, const Arrival&) { trajectory_.put(shared(v)); };
  c.on_map_layer = [this](std::shared_ptr<const MapLayer> v, const Arrival&) {
    map_layer_.put(std::move(v));
  };
  c.on_macros = [this](const std::vector<MacroInfo>& v, const Arrival&) { macros_.put(v); };
  c.on_log = [this](const LogBatch& v, const Arrival&) {
    for (const LogLine& line : v.lines) log_.put(line);
  };
  c.on_cloud = [this](PointCloudPtr v, const Arrival&) { cloud_.put(std::move(v)); };
  c.on_thermal = [this](ThermalImagePtr v, const Arrival&) { thermal_.put(std::move(v)); };
  c.on_mission_info = [this](const MissionInfo& v, const Arrival&) {
    mission_info_.put(shared(v));
  };
  c.on_mission_stream = [this](const MissionDetail& v, const Arrival&) {
    mission_stream_.put(shared(v));
  };
  c.on_jpeg = [this](JpegImagePtr v, const Arrival&) { decoder_->put(std::move(v)); };
  c.on_bad_message = [this](const Error& e) { warn(e.message); };
  return c;
}

}  // namespace kiln::gui
