#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "robot/fsm/any_state.h"
#include "robot/fsm/machine.h"
#include "robot/fsm/watchdog.h"

namespace kiln {

/// One state of a machine, without its type.
struct StateEntry {
  FsmStateInfo info;
  std::vector<std::string> targets;
  std::string consequence;  ///< of entering it, for the operator
  std::string resume_state;
  std::function<std::unique_ptr<AnyState>()> make;  ///< empty when it needs arguments
  std::function<std::string()> deny;                ///< why not by hand now; empty text = may
};

/// The engine behind MachineOf: everything that needs no types, so that it is compiled once.
class MachineCore : public Machine, private StateHost {
 public:
  struct Options {
    std::string mission{};            ///< "fire"
    std::string mission_uuid{};       ///< empty: a random one is drawn
    std::size_t history_length = 64;  ///< transitions kept in the status
    Duration watchdog_limit = std::chrono::seconds(1);
  };

  [[nodiscard]] FsmInfo info() const override { return info_; }
  [[nodiscard]] FsmStatus status(Stamp now) const override;
  [[nodiscard]] std::string blocked() const override { return watchdog_.blocked(); }
  void start(const std::string& mission_uuid, Stamp now) override;
  void step(Stamp now) override;
  void pause(std::string why, Stamp now) override;
  void resume(Stamp now) override;
  [[nodiscard]] bool held() const override { return held_; }
  [[nodiscard]] bool running() const override { return running_; }
  [[nodiscard]] bool begun() const override { return current_ != nullptr; }
  ChangeStateResult changeState(const ChangeState& change, const std::string& operator_name,
                                Stamp now) override;
  void restart(std::string why, Stamp now) override;
  [[nodiscard]] FsmCheckpoint checkpoint() const override;
  [[nodiscard]] Result<void> restore(const FsmCheckpoint& checkpoint, Stamp now) override;
  void onTransition(std::function<void(const FsmCheckpoint&)> hook) override;

 protected:
  /// @pre the first entry is the start state; targets name entries (both proven by the compiler in
  /// MachineOf).
  MachineCore(Options options, const Clock& clock, std::vector<StateEntry> entries);

 private:
  [[nodiscard]] Stamp now() const override { return now_; }
  [[nodiscard]] Duration timeInState() const override;
  void addGuard(std::string name, bool met, std::string detail, double input_age_s) override;
  void setDisplay(std::string text) override { display_ = std::move(text); }

  [[nodiscard]] const StateEntry* find(const std::string& name) const;
  [[nodiscard]] const StateEntry& entry() const;
  [[nodiscard]] Transition poll();
  [[nodiscard]] bool timedOut() const;
  void go(std::unique_ptr<AnyState> next, TransitionCause cause, std::string note);
  void enterCurrent();
  [[nodiscard]] bool paused() const { return held_ && running_; }
  void recordEntry(TransitionCause cause, std::string note);

  FsmInfo info_;
  const Options options_;
  Watchdog watchdog_;
  const std::vector<StateEntry> entries_;
  std::function<void(const FsmCheckpoint&)> transition_hook_;

  std::unique_ptr<AnyState> current_;
  bool enter_pending_ = false;   ///< gone to while held: enter() waits for resume()
  bool arrive_pending_ = false;  ///< and so does arrive(), unless this visit was counted before
  bool running_ = false;
  bool held_ = false;
  std::string pause_reason_;
  std::uint64_t step_ = 0;
  Stamp now_;
  Stamp entered_;
  Stamp paused_since_;
  Duration paused_in_state_{};
  std::string display_;
  std::vector<GuardStatus> guards_;
  Stamp guards_stamp_;
  std::deque<FsmHistoryEntry> history_;
};

}  // namespace kiln
