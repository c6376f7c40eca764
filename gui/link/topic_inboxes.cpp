#include "gui/link/topic_inboxes.h"

namespace kiln::gui {

namespace {
constexpr std::size_t kLogQueue = 2000;
constexpr int kWarnLevel = 3;
}  // namespace

template <Topic topic>
void TopicInboxes::take(std::function<void(const SharedValueOf<topic>&, const Arrival&)> deliver) {
  using Arrived = std::pair<SharedValueOf<topic>, Arrival>;
  auto inbox = std::make_shared<Inbox<Arrived>>(
      link_, [deliver = std::move(deliver)](const Arrived& a) { deliver(a.first, a.second); });
  inboxes_.push_back(inbox);
  callbacks_.topics.on<topic>() = [inbox](SharedValueOf<topic> value, const Arrival& arrival) {
    inbox->put({std::move(value), arrival});
  };
}

template <Topic topic>
void TopicInboxes::relay(void (Link::*signal)(SharedValueOf<topic>)) {
  take<topic>([this, signal](const auto& value, const Arrival&) { (link_.*signal)(value); });
}

TopicInboxes::TopicInboxes(Link& link, std::function<void(const Arrival&)> arrived, bool replay)
    : link_(link),
      head_image_(link, [&link](const auto& value) { emit link.image(value); }),
      operator_image_(link, [&link](const auto& value) { emit link.image(value); }),
      log_(link, kLogQueue, [&link](const std::vector<LogLine>& lines) { emit link.log(lines); }) {
  take<Topic::RobotStatus>([&link, arrived, replay](const auto& value, const Arrival& arrival) {
    if (arrived) arrived(arrival);
    if (!replay) return link.status(value);
    auto recorded = std::make_shared<RobotStatus>(*value);
    recorded->environment = Environment::Replay;
    emit link.status(std::move(recorded));
  });
  take<Topic::Macros>([&link](const auto& value, const Arrival&) { emit link.macros(*value); });
  relay<Topic::FsmInfo>(&Link::fsmInfo);
  relay<Topic::FsmStatus>(&Link::fsmStatus);
  relay<Topic::Scene>(&Link::scene);
  relay<Topic::Localization>(&Link::localization);
  relay<Topic::Trajectory>(&Link::trajectory);
  relay<Topic::MapLayer>(&Link::mapLayer);
  relay<Topic::Cloud>(&Link::cloud);
  relay<Topic::Thermal>(&Link::thermal);
  relay<Topic::MissionInfo>(&Link::missionInfo);
  relay<Topic::MissionStream>(&Link::missionStream);
  decoder_ = std::make_unique<JpegDecoder>(
      [this](RgbImagePtr image) {
        (image->frame == frames::kRgb ? head_image_ : operator_image_).put(std::move(image));
      },
      [this](const std::string& text) { warn(text); });
  const auto decode = [this](const JpegImagePtr& value, const Arrival&) { decoder_->put(value); };
  callbacks_.topics.on<Topic::HeadCamera>() = decode;
  callbacks_.topics.on<Topic::OperatorCamera>() = decode;
  // Lines must not be lost: they are handed over in batches.
  callbacks_.topics.on<Topic::Log>() = [this](const auto& batch, const Arrival&) {
    for (const LogLine& line : batch->lines) log_.put(line);
  };
  callbacks_.on_bad_message = [this](const Error& e) { warn(e.message); };
}

void TopicInboxes::warn(const std::string& text) {
  log_.put(LogLine{Stamp{}, kWarnLevel, "station", text});
}

}  // namespace kiln::gui
