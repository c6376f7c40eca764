#include "robot/app/runtime.h"

#include "common/core/log.h"

namespace kiln {

Result<void> Runtime::open(const DeviceSources& sources, const std::string& version) {
  if (sources.lockstep || !sources.replay.empty()) {
    manual = std::make_unique<ManualExecutor>(manual_clock);
  } else {
    threads = std::make_unique<ThreadExecutor>(steady_clock, 2);
  }
  if (!sources.sim.empty()) {
    SimLink::Config config;
    config.endpoint = sources.sim;
    config.lockstep = sources.lockstep;
    config.version = version;
    auto connected = SimLink::connect(config, clock());
    if (!connected) return tl::make_unexpected(connected.error());
    sim = std::move(*connected);
    if (manual) manual_clock.advanceTo(sim->world().now);
  }
  if (!sources.replay.empty()) {
    auto opened = RecordedRun::open(sources.replay, steady_clock);
    if (!opened) return tl::make_unexpected(opened.error());
    run = std::move(*opened);
    if (const std::string defects = run->player().reader().defects(); !defects.empty())
      logger("replay")->warn("{}: {}", sources.replay, defects);
    manual_clock.advanceTo(run->player().start());
  }
  return recorded_.open(sources.lidar, sources.thermal, executor());
}

Devices Runtime::devices() {
  if (run) return run->devices();
  if (!sim) {
    Devices none{absent_.arm, absent_.base};
    none.lidar = recorded_.lidar();
    none.thermal = recorded_.thermal();
    return none;
  }
  const DeviceSet& has = sim->world().devices;
  Devices all{sim->arm(), sim->base()};
  all.arena = &sim->arena();
  if (has.contains(DeviceKind::Pumps)) all.pumps = &sim->pumps();
  if (has.contains(DeviceKind::Lidar)) all.lidar = &sim->lidar();
  if (has.contains(DeviceKind::ThermalCamera)) all.thermal = &sim->thermalCamera();
  if (has.contains(DeviceKind::OperatorCamera)) all.operator_camera = &sim->operatorCamera();
  if (has.contains(DeviceKind::HeadCamera)) all.head_camera = &sim->headCamera();
  if (has.contains(DeviceKind::Gripper)) all.gripper = &sim->gripper();
  if (has.contains(DeviceKind::Storage)) all.storage = &sim->storage();
  if (recorded_.lidar() != nullptr) all.lidar = recorded_.lidar();
  if (recorded_.thermal() != nullptr) all.thermal = recorded_.thermal();
  all.connected = [link = sim.get()] { return link->connected(); };
  all.resets = [link = sim.get()] { return link->resets(); };
  return all;
}

}  // namespace kiln
