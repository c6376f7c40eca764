#include "robot/app/stop_receiver.h"

#include <algorithm>
#include <utility>

#include "common/transport/stop_lane.h"
#include "common/wire/command.h"

namespace kiln {
namespace {
constexpr std::size_t kRemembered = 64;
}  // namespace

StopReceiver::StopReceiver(const Clock& clock, StopLatch& latch) : clock_(clock), latch_(latch) {}

StopReceiver::~StopReceiver() = default;

Result<std::unique_ptr<StopReceiver>> StopReceiver::bind(const std::string& address,
                                                         const Clock& clock, StopLatch& latch) {
  std::unique_ptr<StopReceiver> out(new StopReceiver(clock, latch));
  auto server = StopServer::bind(
      address, [raw = out.get()](std::string_view bytes) { return raw->onRequest(bytes); });
  if (!server) return tl::make_unexpected(server.error());
  out->server_ = std::move(*server);
  return out;
}

std::string StopReceiver::onRequest(std::string_view bytes) {
  const auto request = wire::decodeStopRequest(bytes);
  if (!request) {
    latch_.set("unreadable request on the STOP lane", clock_.now());
    return {};
  }
  auto known = std::find_if(handled_.begin(), handled_.end(), [&](const Handled& h) {
    return h.client_id == request->client_id && h.nonce == request->nonce;
  });
  if (known == handled_.end()) {
    latch_.set(
        request->operator_name.empty() ? std::string("an unnamed station") : request->operator_name,
        clock_.now());
    const Stamp latched = clock_.now();
    handled_.push_back({request->client_id, request->nonce, latched});
    if (handled_.size() > kRemembered) handled_.pop_front();
    known = std::prev(handled_.end());
    log_.warn("STOP by {}", request->operator_name);
  }
  return wire::encode(
      StopAck{request->nonce, request->sent_station_ns, toNanoseconds(known->latched), true});
}

}  // namespace kiln
