#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/core/stamp.h"

namespace kiln {

class AnyState;
class MachineCore;

/// What a state answers each time it is polled: stay, or the next state, already constructed. Made
/// by State::transit<T>(args...) and State::stay() only, so that the compiler sees every edge.
class [[nodiscard]] Transition {
 public:
  Transition();  ///< stay
  explicit Transition(std::unique_ptr<AnyState> next);
  Transition(Transition&&) noexcept;
  Transition& operator=(Transition&&) noexcept;
  ~Transition();

  /// Adds the outcome that the history shows, e.g. "no heat source at place 1".
  [[nodiscard]] Transition because(std::string note) &&;
  [[nodiscard]] bool stays() const { return next_ == nullptr; }

 private:
  friend class MachineCore;
  std::unique_ptr<AnyState> next_;
  std::string note_;
};

/// What the machine offers to the state that it runs. Confined to the mission thread.
class StateHost {
 public:
  virtual ~StateHost() = default;
  [[nodiscard]] virtual Stamp now() const = 0;
  [[nodiscard]] virtual Duration timeInState() const = 0;  ///< without the time spent paused
  virtual void addGuard(std::string name, bool met, std::string detail, double input_age_s) = 0;
  virtual void setDisplay(std::string text) = 0;
};

/// A state as the machine sees it. Write states by deriving from State (state.h), never from this.
///
/// Call order: arrive + enter, then watch + execute at each step, then leave. No method may block:
/// the watchdog names the state and method that does. A state object lives from its transition
/// until it is left and is never reused.
class AnyState {
 public:
  virtual ~AnyState() = default;
  AnyState() = default;
  AnyState(const AnyState&) = delete;
  AnyState& operator=(const AnyState&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;  ///< static storage
  /// Once for each transition that leads here, before enter(), and not after a pause or a restart
  /// of the program: what counts visits counts here.
  virtual void arrive() {}
  virtual void enter() {}
  /// Checks common to a family of states, before execute(); a transition from here skips execute().
  [[nodiscard]] virtual Transition watch() { return Transition{}; }
  [[nodiscard]] virtual Transition execute() = 0;
  virtual void leave() {}
  /// Operator pause: come to rest in a safe way. The default does nothing.
  virtual void pause() {}
  /// After a pause; the operator may have moved the robot meanwhile.
  virtual void resume() {}

  void setHost(StateHost* host) { host_ = host; }

 protected:
  [[nodiscard]] Stamp now() const;
  [[nodiscard]] Duration timeInState() const;
  /// Publishes a named condition with the age of what it was judged from, for "why is it waiting".
  /// @param input_age_s  < 0 when there was no input yet.
  /// @return met, so that it can stand in an `if`.
  bool guard(std::string name, bool met, std::string detail = {}, double input_age_s = 0.0);
  /// One line for the operator's state card.
  void display(std::string text);

 private:
  StateHost* host_ = nullptr;
};

}  // namespace kiln
