#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "common/geom/frames.h"
#include "common/transport/topics.h"
#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"

namespace kiln {

/// What travels on a topic: wire::encode() makes bytes of it, `decode_as` makes it of them.
template <Topic topic_is, auto decode_as>
struct TopicValue {
  static constexpr Topic kTopic = topic_is;
  static constexpr auto kDecode = decode_as;
  using Value = typename decltype(decode_as(std::string_view{}))::value_type;
};

/// One row a topic, in the order of the enum. How it travels stands in common/transport/topics.cpp;
/// session, link, recording and station are made from these two tables.
using TopicValues = std::tuple<
    TopicValue<Topic::RobotStatus, wire::decodeRobotStatus>,
    TopicValue<Topic::FsmStatus, wire::decodeFsmStatus>,
    TopicValue<Topic::FsmInfo, wire::decodeFsmInfo>,
    TopicValue<Topic::MissionInfo, wire::decodeMissionInfo>,
    TopicValue<Topic::Localization, wire::decodeLocalization>,
    TopicValue<Topic::Scene, wire::decodeScene>,
    TopicValue<Topic::Trajectory, wire::decodeTrajectory>,
    TopicValue<Topic::Macros, wire::decodeMacros>, TopicValue<Topic::Log, wire::decodeLogBatch>,
    TopicValue<Topic::Cloud, wire::decodeCloud>, TopicValue<Topic::Thermal, wire::decodeThermal>,
    TopicValue<Topic::MissionStream, wire::decodeMissionDetail>,
    TopicValue<Topic::HeadCamera, wire::decodeJpeg>,
    TopicValue<Topic::OperatorCamera, wire::decodeJpeg>,
    TopicValue<Topic::MapLayer, wire::decodeMapLayer>>;
static_assert(std::tuple_size_v<TopicValues> == kTopicCount);

template <Topic topic>
using TopicRow = std::tuple_element_t<static_cast<std::size_t>(topic), TopicValues>;
template <Topic topic>
using ValueOf = typename TopicRow<topic>::Value;
/// Shared: it may be large, and several threads read it.
template <Topic topic>
using SharedValueOf = std::shared_ptr<const ValueOf<topic>>;

namespace topic_values_detail {
template <class T, std::size_t i = 0>
constexpr Topic find() {
  static_assert(i < kTopicCount, "no topic carries such a value");
  using Row = std::tuple_element_t<i, TopicValues>;
  static_assert(Row::kTopic == static_cast<Topic>(i), "rows stand in the order of the enum");
  if constexpr (std::is_same_v<typename Row::Value, T>)
    return Row::kTopic;
  else
    return find<T, i + 1>();
}
}  // namespace topic_values_detail

/// The topic on which such a value travels; a picture says by its frame from which camera it is.
template <class T>
[[nodiscard]] Topic topicOf(const T& value) {
  if constexpr (std::is_same_v<T, JpegImage>)
    return value.frame == frames::kOperatorCamera ? Topic::OperatorCamera : Topic::HeadCamera;
  else
    return topic_values_detail::find<T>();
}

/// Age of received data.
struct Arrival {
  Stamp received;                 ///< station time
  double latency_s = 0.0;         ///< robot's publish -> here; 0 while the clock offset is unknown
  std::uint64_t lost_before = 0;  ///< messages of this topic lost since the previous one
};

/// Whoever wants to hear what is published: a function a topic, or none.
class TopicSubscribers {
 public:
  template <Topic topic>
  [[nodiscard]] auto& on() {
    return std::get<static_cast<std::size_t>(topic)>(functions_);
  }
  /// Decodes one payload for whoever wants its topic. Error: a corrupt payload; nobody was called.
  [[nodiscard]] Result<void> dispatch(Topic topic, std::string_view payload,
                                      const Arrival& arrival) const;

 private:
  template <class Row>
  using Function = std::function<void(std::shared_ptr<const typename Row::Value>, const Arrival&)>;
  template <class Tuple>
  struct Functions;
  template <class... Rows>
  struct Functions<std::tuple<Rows...>> {
    using Type = std::tuple<Function<Rows>...>;
  };
  Functions<TopicValues>::Type functions_;
};

}  // namespace kiln
