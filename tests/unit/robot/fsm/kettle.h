#pragma once

#include <string>
#include <vector>

#include "robot/fsm/machine_of.h"

namespace kiln::kettle {

/// A small machine to test the framework with: Idle -> Heat -> (Pour | Overheated) -> Served |
/// Spilt.
struct Kettle {
  std::vector<std::string> calls;  ///< "Heat.enter", ...
  double limit_s = 5.0;
  int arrivals = 0;
  bool switched_on = false;
  bool boils = false;
  bool alarm = false;
  std::string locked;  ///< why Heat may not be entered by hand
};

class Heat;
class Pour;
class Overheated;
class Served;
class Spilt;

template <class Derived, class Targets, class... Options>
class KettleState : public State<Kettle, Derived, Targets, Options...> {
 public:
  static constexpr const char* kGroup = "kitchen";
  static constexpr const char* kDoc = "test";
  static constexpr const char* kConsequence = "water gets hot";
  void arrive() override { ++this->context().arrivals; }
  void enter() override { note("enter"); }
  void leave() override { note("leave"); }
  void pause() override { note("pause"); }
  void resume() override { note("resume"); }

 protected:
  void note(const char* what) {
    this->context().calls.push_back(std::string(this->name()) + "." + what);
  }
};

class Idle : public KettleState<Idle, To<Heat>> {
 public:
  Transition execute() override;
};

class Heat : public KettleState<Heat, To<Pour, Overheated>, OnTimeout<Overheated>> {
 public:
  static constexpr const char* kConsequence = "the plate turns on";
  static double timeLimit(const Kettle& kettle) { return kettle.limit_s; }
  static std::string denyEntry(const Kettle& kettle) { return kettle.locked; }
  Transition execute() override;
};

/// Takes the amount from the state before.
class Pour : public KettleState<Pour, To<Served>, ResumeAt<Heat>> {
 public:
  explicit Pour(int cups) : cups_(cups) {}
  Transition watch() override;
  Transition execute() override;

 private:
  int cups_;
};

class Overheated : public KettleState<Overheated, To<Spilt>> {
 public:
  Transition execute() override { return stay(); }
};

class Served : public KettleState<Served, To<>, Terminal<true>> {
 public:
  Transition execute() override { return stay(); }
};

class Spilt : public KettleState<Spilt, To<>, Terminal<false>> {
 public:
  Transition execute() override { return stay(); }
};

inline Transition Idle::execute() {
  if (guard("Switched on", context().switched_on, "the lid switch", 0.3)) return transit<Heat>();
  display("waiting for the switch");
  return stay();
}

inline Transition Heat::execute() {
  return context().boils ? transit<Pour>(2).because("boils") : stay();
}

inline Transition Pour::watch() {
  return context().alarm ? transit<Served>().because("alarm") : stay();
}

inline Transition Pour::execute() {
  note("execute");
  return cups_ == 2 && timeInState() >= std::chrono::seconds(2) ? transit<Served>() : stay();
}

using KettleMachine = MachineOf<Kettle, Idle, Heat, Pour, Overheated, Served, Spilt>;

/// A started machine that is polled at 50 Hz.
struct Fixture {
  ManualClock clock{Stamp{std::chrono::seconds(100)}};
  Kettle kettle;
  KettleMachine machine{
      {.mission = "kettle", .mission_uuid = "uuid-1", .history_length = 8}, clock, kettle};

  void run(double seconds) {
    const Stamp until = clock.now() + fromSeconds(seconds);
    while (clock.now() < until) {
      clock.advanceBy(std::chrono::milliseconds(20));
      machine.step(clock.now());
    }
  }
  [[nodiscard]] FsmStatus status() const { return machine.status(clock.now()); }
  ChangeStateResult force(const std::string& to) {
    const FsmStatus seen = status();
    return machine.changeState({seen.state, seen.step, to}, "Ada", clock.now());
  }
};

}  // namespace kiln::kettle
