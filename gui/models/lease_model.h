#pragma once

#include "gui/models/command_model.h"
#include "gui/models/model.h"

namespace kiln::gui {

enum class LeaseHolder : std::uint8_t { Unknown, Free, Mine, Other };

/// Who may command the robot, from its status. STOP needs no lease.
class LeaseModel : public Model {
  Q_OBJECT
 public:
  LeaseModel(Link& link, CommandModel& commands, QObject* parent = nullptr);
  [[nodiscard]] LeaseHolder holder() const;
  [[nodiscard]] bool mine() const { return holder() == LeaseHolder::Mine; }
  [[nodiscard]] QString holderName() const;
  [[nodiscard]] const LeaseStatus& lease() const { return lease_; }
  /// True from a request until the robot's answer shows.
  [[nodiscard]] bool requesting() const;
  /// Who asks us to hand over, with the seconds left to answer; empty = nobody. Doing nothing keeps
  /// the lease.
  [[nodiscard]] QString askedBy() const;
  /// Why the last request was refused; empty when it was not.
  [[nodiscard]] QString refusal() const;
  /// False in a recording: there is nobody to ask.
  [[nodiscard]] bool possible() const { return !link().readOnly(); }
  void request(bool take_over = false);
  void release();

 private:
  CommandModel& commands_;
  LeaseStatus lease_;
  std::uint64_t request_ = 0;
};

}  // namespace kiln::gui
