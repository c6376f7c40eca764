#pragma once

#include <atomic>
#include <functional>
#include <mutex>

#include "common/core/latest_value.h"
#include "common/core/mutex.h"
#include "kiln/v1/device.pb.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {

/// Commands waiting for the socket: the newest of each device; reset and release stay until they
/// are sent. Thread-safe.
class Outbox {
 public:
  /// Called after each change, from the commanding thread (wakes the io thread).
  std::function<void()> wake = [] {};

  template <class Change>
  Result<void> put(Change change) {
    if (!open_.load()) {
      return makeError(ErrorCode::Unavailable, "the world does not answer; is kiln-sim running?");
    }
    {
      const std::lock_guard lock(mutex_);
      change(pending_);
      filled_ = true;
    }
    wake();
    return {};
  }
  [[nodiscard]] bool take(v1::device::Advance& out);
  void setOpen(bool open);
  [[nodiscard]] bool open() const { return open_.load(); }

 private:
  Mutex mutex_;
  v1::device::Advance pending_;
  bool filled_ = false;
  std::atomic<bool> open_{false};
};

class SimArm final : public Arm {
 public:
  SimArm(Outbox& outbox, const Clock& clock) : outbox_(outbox), clock_(clock) {}
  [[nodiscard]] std::optional<ArmState> state() const override { return latest.peek(); }
  Result<void> servo(const ArmServo& target) override;
  Result<void> releaseProtectiveStop() override;
  Result<void> setPayload(const ArmPayload& payload) override;
  Result<void> zeroForceSensor() override;
  LatestValue<ArmState> latest;

 private:
  Outbox& outbox_;
  const Clock& clock_;
};

class SimDriveBase final : public DriveBase {
 public:
  explicit SimDriveBase(Outbox& outbox) : outbox_(outbox) {}
  [[nodiscard]] std::optional<BaseState> state() const override { return latest.peek(); }
  Result<void> write(const WheelCommands& command) override;
  LatestValue<BaseState> latest;

 private:
  Outbox& outbox_;
};

class SimPumps final : public Pumps {
 public:
  explicit SimPumps(Outbox& outbox) : outbox_(outbox) {}
  [[nodiscard]] std::optional<PumpsState> state() const override { return latest.peek(); }
  Result<void> write(const std::array<double, 2>& duty) override;
  LatestValue<PumpsState> latest;

 private:
  Outbox& outbox_;
};

class SimGripper final : public Gripper {
 public:
  explicit SimGripper(Outbox& outbox) : outbox_(outbox) {}
  [[nodiscard]] std::optional<GripperState> state() const override { return latest.peek(); }
  Result<void> write(const MagnetMask& on) override;
  LatestValue<GripperState> latest;

 private:
  Outbox& outbox_;
};

class SimStorage final : public Storage {
 public:
  explicit SimStorage(Outbox& outbox) : outbox_(outbox) {}
  [[nodiscard]] std::optional<StorageState> state() const override { return latest.peek(); }
  Result<void> write(std::span<const double> targets_m) override;
  LatestValue<StorageState> latest;

 private:
  Outbox& outbox_;
};

class SimArena final : public Arena {
 public:
  explicit SimArena(Outbox& outbox) : outbox_(outbox) {}
  Result<void> requestReset() override;
  Result<void> startClock() override;
  /// After a (re)connect: the world may be another one.
  void forget() { clock_told_ = false; }

 private:
  Outbox& outbox_;
  std::atomic<bool> clock_told_{false};
};

/// Which sensors run, as one message; shared by the sensors below. Thread-safe.
class SensorSwitch {
 public:
  explicit SensorSwitch(Outbox& outbox) : outbox_(outbox) {}
  Result<void> set(int sensor, bool on);
  /// After a (re)connect: says again what is wanted.
  void repeat();
  static constexpr int kLidar = 0, kThermal = 1, kOperatorCamera = 2, kHeadCamera = 3;

 private:
  void fill(v1::device::Advance& message) const;
  Outbox& outbox_;
  mutable Mutex mutex_;
  std::array<bool, 4> on_{};
};

/// A sensor of the world: `Interface` is Lidar, ThermalCamera or RgbCamera.
template <class Interface, class FramePtr, int kSensor>
class SimSensor final : public Interface {
 public:
  explicit SimSensor(SensorSwitch& sensors) : sensors_(sensors) {}
  Result<void> start(Sink<FramePtr> sink) override {
    {
      const std::lock_guard lock(mutex_);
      sink_ = std::move(sink);
    }
    return sensors_.set(kSensor, true);
  }
  void stop() override {
    (void)sensors_.set(kSensor, false);  // a world that is gone has stopped by itself
    const std::lock_guard lock(mutex_);
    sink_ = nullptr;
  }
  void deliver(FramePtr frame) {
    const std::lock_guard lock(mutex_);
    if (sink_) sink_(std::move(frame));
  }

 private:
  SensorSwitch& sensors_;
  Mutex mutex_;
  Sink<FramePtr> sink_;
};

using SimLidar = SimSensor<Lidar, PointCloudPtr, SensorSwitch::kLidar>;
using SimThermalCamera = SimSensor<ThermalCamera, ThermalImagePtr, SensorSwitch::kThermal>;
using SimHeadCamera = SimSensor<RgbCamera, RgbImagePtr, SensorSwitch::kHeadCamera>;
using SimOperatorCamera = SimSensor<RgbCamera, RgbImagePtr, SensorSwitch::kOperatorCamera>;

}  // namespace kiln
