#include "robot/localization/mapping/map_report.h"

#include <fmt/format.h>

namespace kiln {
namespace {

std::string line(const char* name, const EdgeResidual& residual) {
  return fmt::format("  {:<13} {:4d} edges, rms {:.3f} m, {:.2f} deg, worst {:.3f} m\n", name,
                     residual.edges, residual.rms_m, residual.rms_deg, residual.worst_m);
}

}  // namespace

std::string formatReport(const MapReport& report) {
  std::string out = fmt::format("{} keyframes of {} scans along {:.1f} m, {} did not fit\n",
                                report.keyframes, report.scans, report.path_m, report.refused);
  out += fmt::format("pose graph: cost {:.1f} -> {:.1f}, {} loops closed\n", report.initial_cost,
                     report.final_cost, report.loops);
  out += line("odometry", report.odometry) + line("registration", report.registration) +
         line("loop before", report.loop_before) + line("loop", report.loop);
  out += fmt::format(
      "each scan against the others: {:.0f} % explained (least {:.0f} %), rms {:.3f} m\n",
      100.0 * report.overlap_median, 100.0 * report.overlap_min, report.rms_median_m);
  out += fmt::format(
      "anchor: floor flat to {:.3f} m rms; {} keyframes agree with the walls to {:.3f} m, {:.2f} "
      "deg rms\n",
      report.floor_rms_m, report.wall_fixes, report.wall_rms_m, report.wall_rms_deg);
  for (const MapReport::Segment& segment : report.segments) {
    out += fmt::format("{}: {} keyframes, {} surfels", segment.name, segment.keyframes,
                       fmt::join(segment.surfels, " / "));
    if (segment.wall_coverage > 0.0)
      out += fmt::format(", {:.0f} % of the inner walls", 100.0 * segment.wall_coverage);
    out += "\n";
  }
  if (report.file_bytes > 0) out += fmt::format("{:.0f} KiB\n", report.file_bytes / 1024.0);
  return out;
}

}  // namespace kiln
