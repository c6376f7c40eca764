#include "common/client/topic_dispatch.h"

#include "common/wire/fsm.h"
#include "common/wire/localization.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"

namespace kiln {
namespace {

/// By value to a callback that takes a const reference.
template <class T, class Callback>
Result<void> hand(Result<T> value, const Callback& callback, const Arrival& arrival) {
  if (!value) return tl::make_unexpected(value.error());
  if (callback) callback(*value, arrival);
  return {};
}
/// Large values travel on as shared pointers to const.
template <class T, class Callback>
Result<void> share(Result<T> value, const Callback& callback, const Arrival& arrival) {
  if (!value) return tl::make_unexpected(value.error());
  callback(std::make_shared<const T>(std::move(*value)), arrival);
  return {};
}

}  // namespace

Result<void> dispatch(Topic topic, std::string_view payload,
                      const OperatorSession::Callbacks& callbacks, const Arrival& arrival,
                      const std::function<void(const RobotStatus&)>& on_status) {
  switch (topic) {
    case Topic::RobotStatus: {
      auto status = wire::decodeRobotStatus(payload);
      if (status) on_status(*status);
      return hand(std::move(status), callbacks.on_status, arrival);
    }
    case Topic::FsmStatus:
      return hand(wire::decodeFsmStatus(payload), callbacks.on_fsm_status, arrival);
    case Topic::FsmInfo:
      return hand(wire::decodeFsmInfo(payload), callbacks.on_fsm_info, arrival);
    case Topic::Scene:
      return hand(wire::decodeScene(payload), callbacks.on_scene, arrival);
    case Topic::Localization:
      return hand(wire::decodeLocalization(payload), callbacks.on_localization, arrival);
    case Topic::Trajectory:
      return hand(wire::decodeTrajectory(payload), callbacks.on_trajectory, arrival);
    case Topic::MapLayer:
      return callbacks.on_map_layer
                 ? share(wire::decodeMapLayer(payload), callbacks.on_map_layer, arrival)
                 : Result<void>{};
    case Topic::Macros:
      return hand(wire::decodeMacros(payload), callbacks.on_macros, arrival);
    case Topic::Log:
      return hand(wire::decodeLogBatch(payload), callbacks.on_log, arrival);
    case Topic::MissionInfo:
      return hand(wire::decodeMissionInfo(payload), callbacks.on_mission_info, arrival);
    case Topic::MissionStream:
      return hand(wire::decodeMissionDetail(payload), callbacks.on_mission_stream, arrival);
    case Topic::Cloud:
      return callbacks.on_cloud ? share(wire::decodeCloud(payload), callbacks.on_cloud, arrival)
                                : Result<void>{};
    case Topic::Thermal:
      return callbacks.on_thermal
                 ? share(wire::decodeThermal(payload), callbacks.on_thermal, arrival)
                 : Result<void>{};
    case Topic::HeadCamera:
    case Topic::OperatorCamera:
      return callbacks.on_jpeg ? share(wire::decodeJpeg(payload), callbacks.on_jpeg, arrival)
                               : Result<void>{};
  }
  return {};
}

}  // namespace kiln
