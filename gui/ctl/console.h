#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/client/operator_session.h"
#include "common/core/clock.h"

namespace kiln::ctl {

/// What every subcommand shares: the session, the newest values, waiting and printing.
/// Exit codes: 0 done, 1 refused or failed, 3 no link.
inline constexpr int kDone = 0;
inline constexpr int kRefused = 1;
inline constexpr int kNoLink = 3;
inline constexpr double kLatched_s = 2.5;  ///< what is told once is repeated every 2 s

class Console {
 public:
  struct Options {
    std::string endpoint = "tcp://127.0.0.1:7300";
    std::string name;
    bool json = false;
    bool take_over = false;
    double connect_s = 5.0;  ///< give up after this
    ClientRole role = ClientRole::Operator;
  };
  explicit Console(Options options) : options_(std::move(options)) {}
  ~Console();

  /// Opens the session and waits for hello, clock and a first status. Prints the reason on failure.
  [[nodiscard]] bool connect();
  /// Only the STOP lane and the sockets: STOP must not wait for a hello.
  [[nodiscard]] bool open();
  /// Takes control; prints who refuses and why.
  [[nodiscard]] bool takeControl();
  void giveControlBack();
  /// Sends one command and waits for its end; prints it. @return exit code.
  [[nodiscard]] int run(CommandBody body);

  /// Waits until `condition` (called under the lock) holds, a signal arrives or the time is over.
  [[nodiscard]] bool waitFor(const std::function<bool()>& condition, double limit_s,
                             bool heed_signals = true);
  /// A period of a loop; ends early on a signal.
  void pauseFor(double seconds);
  /// The same, after a signal: the zeros of a release still have to leave.
  void sleepThroughSignals(double seconds);

  void print(const nlohmann::json& object, const std::string& text) const;
  /// A refusal: the object to standard output with --json, else the text to standard error.
  void printRefusal(const nlohmann::json& object, const std::string& text) const;
  int fail(int code, const std::string& reason, const std::string& error_code = "");

  [[nodiscard]] OperatorSession& session() { return *session_; }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] RobotStatus status() const;
  [[nodiscard]] std::optional<FsmStatus> fsm() const;
  [[nodiscard]] std::vector<MacroInfo> macros() const;
  /// What the mission brings, waiting for it a moment; nullopt: the robot does not tell.
  [[nodiscard]] std::optional<MissionInfo> mission();
  [[nodiscard]] std::optional<LocalizationStatus> localization() const;
  /// For conditions of waitFor(): the lock is held.
  [[nodiscard]] bool localizationKnown() const { return localization_.has_value(); }
  /// First refusal since the last call: of a setpoint that is being held.
  [[nodiscard]] std::optional<CommandUpdate> takeRefusal();
  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] bool lost() const;

 private:
  [[nodiscard]] OperatorSession::Callbacks callbacks();
  [[nodiscard]] std::optional<CommandUpdate> waitForEnd(std::uint64_t nonce, double limit_s,
                                                        bool heed_signals = true);

  Options options_;
  SteadyClock clock_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<RobotStatus> status_;  // guarded by mutex_, as all below
  std::optional<FsmStatus> fsm_;
  std::optional<LocalizationStatus> localization_;
  std::optional<std::vector<MacroInfo>> macros_;
  std::optional<MissionInfo> mission_;
  std::map<std::uint64_t, CommandUpdate> fates_;
  std::optional<CommandUpdate> refusal_;
  std::unique_ptr<OperatorSession> session_;
};

}  // namespace kiln::ctl
