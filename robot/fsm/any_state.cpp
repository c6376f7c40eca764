#include "robot/fsm/any_state.h"

#include "common/core/check.h"

namespace kiln {

Transition::Transition() = default;
Transition::Transition(std::unique_ptr<AnyState> next) : next_(std::move(next)) {}
Transition::Transition(Transition&&) noexcept = default;
Transition& Transition::operator=(Transition&&) noexcept = default;
Transition::~Transition() = default;

Transition Transition::because(std::string note) && {
  note_ = std::move(note);
  return std::move(*this);
}

Stamp AnyState::now() const {
  KILN_CHECK(host_ != nullptr);
  return host_->now();
}

Duration AnyState::timeInState() const {
  KILN_CHECK(host_ != nullptr);
  return host_->timeInState();
}

bool AnyState::guard(std::string name, bool met, std::string detail, double input_age_s) {
  KILN_CHECK(host_ != nullptr);
  host_->addGuard(std::move(name), met, std::move(detail), input_age_s);
  return met;
}

void AnyState::display(std::string text) {
  KILN_CHECK(host_ != nullptr);
  host_->setDisplay(std::move(text));
}

}  // namespace kiln
