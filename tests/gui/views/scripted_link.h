#pragma once

#include <vector>

#include "gui/link/link.h"

namespace kiln::gui {

/// A link whose robot is the test: signals are emitted by hand, everything that a view sends is
/// kept. Time moves only when told; robot time equals station time.
class ScriptedLink : public Link {
  Q_OBJECT
 public:
  using Link::Link;
  void open() override {}
  void close() override {}
  [[nodiscard]] const Clock& clock() const override { return time; }
  [[nodiscard]] std::optional<Stamp> robotNow() const override { return time.now(); }
  [[nodiscard]] QString clientId() const override { return QStringLiteral("me"); }
  [[nodiscard]] QString operatorName() const override { return QStringLiteral("Ada"); }
  std::uint64_t send(const CommandBody& body) override {
    sent.push_back(body);
    return sent.size();
  }
  void startSetpoint(const CommandBody& body, std::uint64_t press) override {
    setpoints.push_back(body);
    presses.push_back(press);
  }
  [[nodiscard]] std::uint64_t press() override { return ++last_press; }
  void releaseSetpoint(const CommandBody& example) override { released.push_back(example); }
  void releaseSetpoints() override { ++releases; }
  void stop() override { ++stops; }

  ManualClock time{Stamp{std::chrono::seconds(100)}};
  std::vector<CommandBody> sent, setpoints;
  std::vector<std::uint64_t> presses;  ///< of each setpoint
  std::vector<CommandBody> released;
  std::uint64_t last_press = 0;
  int releases = 0, stops = 0;
};

}  // namespace kiln::gui
