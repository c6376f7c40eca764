#include "common/client/stop_caller.h"

#include <utility>

#include "common/transport/stop_lane.h"
#include "common/wire/command.h"

namespace kiln {

StopCaller::StopCaller(std::string client_id, std::string operator_name, Hooks hooks,
                       const Clock& clock)
    : hooks_(std::move(hooks)), clock_(clock) {
  request_.client_id = std::move(client_id);
  request_.operator_name = std::move(operator_name);
}

StopCaller::~StopCaller() = default;

Result<std::unique_ptr<StopCaller>> StopCaller::connect(const std::string& address,
                                                        std::string client_id,
                                                        std::string operator_name, Hooks hooks,
                                                        const Clock& clock) {
  std::unique_ptr<StopCaller> out(
      new StopCaller(std::move(client_id), std::move(operator_name), std::move(hooks), clock));
  auto client = StopClient::connect(
      address, {[raw = out.get()](std::string_view bytes) { return raw->onAnswer(bytes); },
                [raw = out.get()] { raw->onSent(); }});
  if (!client) return tl::make_unexpected(client.error());
  out->client_ = std::move(*client);
  return out;
}

void StopCaller::press() {
  std::string bytes;
  {
    const std::lock_guard lock(mutex_);
    ++request_.nonce;
    request_.sent_station_ns = toNanoseconds(clock_.now());
    report_ = {};
    report_.state = StopReport::State::Sent;
    report_.press = request_.nonce;
    bytes = wire::encode(request_);
  }
  client_->request(std::move(bytes));
}

StopReport StopCaller::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

bool StopCaller::onAnswer(std::string_view bytes) {
  const auto ack = wire::decodeStopAck(bytes);
  if (!ack) {
    if (hooks_.on_bad_message) hooks_.on_bad_message(ack.error());
    return false;
  }
  const double round_trip_s =
      static_cast<double>(toNanoseconds(clock_.now()) - ack->sent_station_ns) * 1e-9;
  const auto latched_ns = hooks_.to_station_ns(ack->latched_robot_ns);
  StopReport report;
  {
    const std::lock_guard lock(mutex_);
    if (ack->nonce != request_.nonce || !ack->latched) return false;
    report_.state = StopReport::State::Latched;
    report_.round_trip_s = round_trip_s;
    report_.send_to_latched_s =
        latched_ns ? static_cast<double>(*latched_ns - ack->sent_station_ns) * 1e-9 : round_trip_s;
    report = report_;
  }
  if (hooks_.on_report) hooks_.on_report(report);
  return true;
}

void StopCaller::onSent() {
  StopReport report;
  {
    const std::lock_guard lock(mutex_);
    ++report_.repetitions;
    report = report_;
  }
  if (hooks_.on_report) hooks_.on_report(report);
}

}  // namespace kiln
