#pragma once

#include <memory>

#include "common/core/error.h"
#include "gui/link/link.h"

namespace kiln::gui {

/// The live link: an OperatorSession (its own link and stop threads) seen as Qt signals on the GUI
/// thread. No method blocks on the network.
class RobotLink : public Link {
  Q_OBJECT
 public:
  struct Options {
    std::string endpoint;
    std::string operator_name;
    std::string version;
  };
  explicit RobotLink(Options options, QObject* parent = nullptr);
  ~RobotLink() override;

  /// Error: the address is neither ipc nor loopback. open() reports the same through health().
  [[nodiscard]] Result<void> connectToRobot();
  void open() override;
  void close() override;
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] std::optional<Stamp> robotNow() const override;
  [[nodiscard]] QString clientId() const override;
  [[nodiscard]] QString operatorName() const override;
  std::uint64_t send(const CommandBody& body) override;
  void startSetpoint(const CommandBody& body, std::uint64_t press) override;
  [[nodiscard]] std::uint64_t press() override;
  void releaseSetpoint(const CommandBody& example) override;
  void releaseSetpoints() override;
  void stop() override;

 private:
  struct Impl;
  SteadyClock clock_;
  Options options_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln::gui
