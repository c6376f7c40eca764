#include "robot/evaluation/map_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/atomic_file.h"
#include "robot/evaluation/recorded_scans.h"
#include "robot/localization/mapping/map_builder.h"
#include "robot/localization/mapping/map_export.h"

namespace kiln {
namespace {

constexpr int kNoLoops = 1'000'000;  // keyframes that would have to lie in between

nlohmann::json toJson(const EdgeResidual& residual) {
  return {{"edges", residual.edges},
          {"rms_m", residual.rms_m},
          {"rms_deg", residual.rms_deg},
          {"worst_m", residual.worst_m}};
}

std::string toJson(const MapReport& report) {
  nlohmann::json segments = nlohmann::json::array();
  for (const MapReport::Segment& segment : report.segments) {
    segments.push_back({{"name", segment.name},
                        {"keyframes", segment.keyframes},
                        {"surfels", segment.surfels},
                        {"wall_coverage", segment.wall_coverage}});
  }
  const nlohmann::json out{{"scans", report.scans},
                           {"keyframes", report.keyframes},
                           {"refused", report.refused},
                           {"loops", report.loops},
                           {"path_m", report.path_m},
                           {"odometry", toJson(report.odometry)},
                           {"registration", toJson(report.registration)},
                           {"loop_before", toJson(report.loop_before)},
                           {"loop", toJson(report.loop)},
                           {"overlap_min", report.overlap_min},
                           {"overlap_median", report.overlap_median},
                           {"rms_median_m", report.rms_median_m},
                           {"floor_rms_m", report.floor_rms_m},
                           {"wall_rms_m", report.wall_rms_m},
                           {"wall_rms_deg", report.wall_rms_deg},
                           {"wall_fixes", report.wall_fixes},
                           {"file_bytes", report.file_bytes},
                           {"segments", segments}};
  return out.dump(2) + "\n";
}

/// Scans that do not fit are left out by the builder and counted; the map goes on without them.
Result<RecordedScanCount> addRecording(const std::string& path, const RobotGeometry& robot,
                                       const ArenaMap& arena, MapBuilder& builder) {
  builder.startRun(arena.start.pose());
  std::uint32_t resets = 0;
  bool first = true;
  return forEachScan(path, robot, [&](RecordedScan scan) -> Result<void> {
    if (!first && scan.resets != resets) builder.startRun(arena.start.pose());
    first = false;
    resets = scan.resets;
    (void)builder.addScan(std::move(scan.scan_base), scan.X_odom_base, scan.p_base_sensor);
    return {};
  });
}

Result<void> writeSideFiles(const MapCommandOptions& options, const BuiltMap& built) {
  if (!options.pcd.empty()) {
    if (auto written = exportPcd(built.map, options.pcd); !written) return written;
  }
  if (!options.ply.empty()) {
    if (auto written = exportPly(built.map, options.ply); !written) return written;
  }
  return options.json.empty() ? Result<void>{}
                              : writeFileAtomically(options.json, toJson(built.report));
}

}  // namespace

Result<MadeMap> makeMap(const MapCommandOptions& options) {
  const auto robot = loadResource<RobotGeometry>(options.geometry);
  if (!robot) return tl::make_unexpected(robot.error());
  const auto arena = loadResource<ArenaMap>(options.arena);
  if (!arena) return tl::make_unexpected(arena.error());
  MapBuilder::Config config;
  if (!options.close_loops) config.loop_gap = kNoLoops;
  MapBuilder builder(config, *arena);
  RecordedScanCount count;
  for (const std::string& path : options.recordings) {
    const auto added = addRecording(path, *robot, *arena, builder);
    if (!added) return tl::make_unexpected(added.error());
    count.scans += added->scans;
    count.without_motion += added->without_motion;
    count.damaged += added->damaged;
  }
  auto built = builder.build();
  if (!built) return tl::make_unexpected(built.error());
  const std::string bytes = encodeMap(built->map);
  built->report.file_bytes = bytes.size();
  if (auto written = writeFileAtomically(options.out, bytes); !written)
    return tl::make_unexpected(written.error());
  if (auto written = writeSideFiles(options, *built); !written)
    return tl::make_unexpected(written.error());
  std::string text =
      fmt::format("{}{} scans read, {} without motion, {} messages damaged\n",
                  formatReport(built->report), count.scans, count.without_motion, count.damaged);
  return MadeMap{std::move(*built), std::move(text)};
}

}  // namespace kiln
