#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config_archive.h"
#include "common/model/status.h"

namespace kiln {

/// Who may command. One holder at a time; kept alive by anything heard of the holder (heartbeats at
/// 5 Hz), lost 2 s after the last. Each grant has a new epoch that every command must carry.
/// Confined to the mission thread.
///
/// Take-over: an operator asks, and the holder hands over (release) or keeps it (acquires again);
/// silence for 10 s is a refusal, unless the holder has died meanwhile. A supervisor pre-empts at
/// once. STOP revokes.
class Lease {
 public:
  struct Config {
    double ttl_s = 2.0;
    double request_s = 10.0;  ///< how long the holder is asked
    void visit(ConfigArchive& a);
  };
  struct Requester {
    std::string client_id;
    std::string name;
    ClientRole role = ClientRole::Operator;
    std::uint64_t nonce = 0;  ///< of the command, for the later answer
  };
  enum class Outcome { Granted, Asked, Refused };
  struct Answer {
    Outcome outcome = Outcome::Granted;
    std::string code;    ///< "lease_held", "request_pending", "not_holder"
    std::string reason;  ///< one sentence
  };
  /// What happened by itself or to somebody else than the caller.
  struct Event {
    enum class Kind { Granted, Denied, Lost };
    Kind kind = Kind::Lost;
    Requester who;       ///< whose request was decided, or who lost the lease
    std::string reason;  ///< one sentence
  };

  explicit Lease(Config config) : config_(config) {}

  [[nodiscard]] Answer acquire(const Requester& requester, bool take_over, Stamp now);
  [[nodiscard]] Answer release(const std::string& client_id, Stamp now);
  /// Something of this client arrived at `when`.
  void heard(const std::string& client_id, Stamp when);
  /// Takes it from the holder and cancels a request: STOP, loss of the link, shutdown.
  void revoke(const std::string& reason);
  /// Expiry and pending requests; returns what was decided since the last call, acquire() and
  /// release() included.
  [[nodiscard]] std::vector<Event> tick(Stamp now);

  [[nodiscard]] bool holds(const std::string& client_id, std::uint64_t epoch) const;
  [[nodiscard]] LeaseStatus status(Stamp now) const;

 private:
  struct Request {
    Requester who;
    Stamp expires;
  };
  void grant(const Requester& who, Stamp now);
  void lose(const std::string& reason);
  [[nodiscard]] bool expired(Stamp now) const;

  Config config_;
  std::optional<Requester> holder_;
  std::uint64_t epoch_ = 0;
  Stamp last_heard_;
  std::optional<Request> request_;
  std::vector<Event> events_;
};

}  // namespace kiln
