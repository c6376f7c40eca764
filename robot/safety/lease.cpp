#include "robot/safety/lease.h"

#include <algorithm>
#include <utility>

namespace kiln {

void Lease::Config::visit(ConfigArchive& a) {
  a.field("ttl_s", ttl_s, "s", 0.5, 10.0,
          "the lease ends this long after its holder was heard last");
  a.field("request_s", request_s, "s", 1.0, 60.0, "how long a holder is asked to hand over");
}

bool Lease::expired(Stamp now) const { return now - last_heard_ > fromSeconds(config_.ttl_s); }

void Lease::grant(const Requester& who, Stamp now) {
  holder_ = who;
  last_heard_ = now;
  ++epoch_;
}

void Lease::lose(const std::string& reason) {
  if (!holder_) return;
  events_.push_back({Event::Kind::Lost, *holder_, reason});
  holder_.reset();
}

Lease::Answer Lease::acquire(const Requester& requester, bool take_over, Stamp now) {
  if (holder_ && expired(now)) lose("not heard of for too long");
  if (!holder_) {
    grant(requester, now);
    return {};
  }
  if (holder_->client_id == requester.client_id) {
    if (request_) {
      events_.push_back(
          {Event::Kind::Denied, request_->who,
           fmt::format("{} keeps control; ask by voice or try later", holder_->name)});
      request_.reset();
    }
    return {};
  }
  if (!take_over) {
    return {Outcome::Refused, "lease_held",
            fmt::format("{} has control; ask for a take-over", holder_->name)};
  }
  if (requester.role == ClientRole::Supervisor) {
    lose(fmt::format("{} (supervisor) took over", requester.name));
    grant(requester, now);
    return {};
  }
  if (request_ && request_->who.client_id != requester.client_id) {
    return {Outcome::Refused, "request_pending",
            fmt::format("{} is asking {} already; wait for the answer", request_->who.name,
                        holder_->name)};
  }
  if (!request_) request_ = Request{requester, now + fromSeconds(config_.request_s)};
  request_->who.nonce = requester.nonce;
  return {Outcome::Asked, "asked",
          fmt::format("{} is asked to hand over; without an answer this is denied in {:.0f} s",
                      holder_->name, toSeconds(request_->expires - now))};
}

Lease::Answer Lease::release(const std::string& client_id, Stamp now) {
  if (!holder_ || holder_->client_id != client_id) {
    return {Outcome::Refused, "not_holder",
            "this client does not have control; there is nothing to release"};
  }
  holder_.reset();
  if (request_) {
    const Requester next = std::exchange(request_, std::nullopt)->who;
    grant(next, now);
    events_.push_back({Event::Kind::Granted, next, "handed over"});
  }
  return {};
}

void Lease::heard(const std::string& client_id, Stamp when) {
  if (holder_ && holder_->client_id == client_id) last_heard_ = std::max(last_heard_, when);
}

void Lease::revoke(const std::string& reason) {
  lose(reason);
  if (request_) events_.push_back({Event::Kind::Denied, request_->who, reason});
  request_.reset();
}

std::vector<Lease::Event> Lease::tick(Stamp now) {
  if (holder_ && expired(now)) {
    lose(fmt::format("not heard of for {:.1f} s", config_.ttl_s));
  }
  if (request_ && !holder_) {
    const Requester next = std::exchange(request_, std::nullopt)->who;
    grant(next, now);
    events_.push_back({Event::Kind::Granted, next, "the former holder is gone"});
  } else if (request_ && now >= request_->expires) {
    events_.push_back({Event::Kind::Denied, request_->who,
                       fmt::format("{} did not answer within {:.0f} s and keeps control",
                                   holder_->name, config_.request_s)});
    request_.reset();
  }
  return std::exchange(events_, {});
}

bool Lease::holds(const std::string& client_id, std::uint64_t epoch) const {
  return holder_ && holder_->client_id == client_id && epoch == epoch_;
}

LeaseStatus Lease::status(Stamp now) const {
  LeaseStatus status;
  status.epoch = epoch_;
  if (holder_) {
    status.holder_client = holder_->client_id;
    status.holder_name = holder_->name;
    status.expires_in_s = std::max(0.0, config_.ttl_s - toSeconds(now - last_heard_));
  }
  if (request_) {
    status.requested_by_client = request_->who.client_id;
    status.requested_by_name = request_->who.name;
    status.request_expires_in_s = std::max(0.0, toSeconds(request_->expires - now));
  }
  return status;
}

}  // namespace kiln
