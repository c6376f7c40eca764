#include "robot/evaluation/trajectory_figure.h"

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/units.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr double kScale = 50.0;  ///< pixels a metre
constexpr double kMargin_m = 0.6;
constexpr double kArrow_m = 0.35;
constexpr std::array kDriven = {"#1f5fa8", "#b8860b", "#7b3fa0", "#0f7f7f", "#a04020"};

/// X of map to the right, Y up.
class Canvas {
 public:
  explicit Canvas(const ArenaMap& arena)
      : x0_(arena.geofence_x_min_m - kMargin_m), y1_(arena.geofence_y_max_m + kMargin_m) {
    width_ = (arena.geofence_x_max_m + kMargin_m - x0_) * kScale;
    height_ = (y1_ - arena.geofence_y_min_m + kMargin_m) * kScale;
    svg_ << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"15\">\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
        width_, height_);
  }
  void box(const BoxConfig& box, const char* style) {
    const double yaw = box.center.rpy_deg[2] * kDeg;
    const double c = std::cos(yaw), s = std::sin(yaw);
    svg_ << "<polygon points=\"";
    for (const auto& [u, v] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const double x = 0.5 * u * box.size_m[0], y = 0.5 * v * box.size_m[1];
      svg_ << at(box.center.xyz_m[0] + c * x - s * y, box.center.xyz_m[1] + s * x + c * y) << ' ';
    }
    svg_ << "\" style=\"" << style << "\"/>\n";
  }
  void line(const std::vector<Pose2>& way, const std::string& style) {
    if (way.size() < 2) return;
    svg_ << "<polyline points=\"";
    for (const Pose2& X : way) svg_ << at(X.x_m, X.y_m) << ' ';
    svg_ << "\" style=\"fill:none;" << style << "\"/>\n";
  }
  void arrow(const Pose2& X, const char* colour) {
    const auto tip = [&](double forward, double left) {
      return at(X.x_m + forward * std::cos(X.yaw_rad) - left * std::sin(X.yaw_rad),
                X.y_m + forward * std::sin(X.yaw_rad) + left * std::cos(X.yaw_rad));
    };
    svg_ << fmt::format("<polygon points=\"{} {} {}\" style=\"fill:{}\"/>\n", tip(kArrow_m, 0),
                        tip(-0.1, 0.12), tip(-0.1, -0.12), colour);
  }
  void legend(int row, const std::string& style, const std::string& text) {
    const double y = 22.0 + 20.0 * row;
    svg_ << fmt::format(
        "<line x1=\"14\" y1=\"{0}\" x2=\"44\" y2=\"{0}\" style=\"{1}\"/>"
        "<text x=\"52\" y=\"{2}\" fill=\"#303438\">{3}</text>\n",
        y, style, y + 5, text);
  }
  [[nodiscard]] std::string finish() {
    svg_ << "</svg>\n";
    return svg_.str();
  }

 private:
  [[nodiscard]] std::string at(double x, double y) const {
    return fmt::format("{:.1f},{:.1f}", (x - x0_) * kScale, (y1_ - y) * kScale);
  }
  double x0_, y1_, width_ = 0.0, height_ = 0.0;
  std::ostringstream svg_;
};

std::vector<Pose2> plannedWay(const ArenaMap& arena, const FirePlaceConfig& place) {
  std::vector<Pose2> way;
  if (!arena.entry_path.empty()) way.push_back(arena.entry_path.back().pose());
  for (const GroundPoseConfig& via : place.via) way.push_back(via.pose());
  way.push_back(place.work_pose.pose());
  return way;
}

void drawArena(Canvas& canvas, const ArenaMap& arena, const FireSiteMap& site) {
  for (const BoxConfig& box : arena.furniture) canvas.box(box, "fill:#e4e6e8;stroke:#b0b4b8");
  for (const BoxConfig& box : arena.walls) {
    if (box.center.xyz_m[2] - 0.5 * box.size_m[2] > 1.0) continue;  // a lintel: one drives under it
    canvas.box(box, "fill:#50565c");
  }
  for (const BoxConfig& box : site.fixtures().boxes)
    canvas.box(box, "fill:none;stroke:#c81e2c;stroke-width:3");
}

void drawPlan(Canvas& canvas, const ArenaMap& arena, const FireSiteMap& site) {
  constexpr const char* kPlanned = "#4f9d3a";
  std::vector<std::vector<Pose2>> ways(1, {arena.start.pose()});
  for (const GroundPoseConfig& via : arena.entry_path) ways[0].push_back(via.pose());
  for (const FirePlaceConfig& place : site.places) ways.push_back(plannedWay(arena, place));
  for (const auto& way : ways) {
    canvas.line(way, fmt::format("stroke:{};stroke-width:2", kPlanned));
    for (const Pose2& X : way) canvas.arrow(X, kPlanned);
  }
}

std::vector<Pose2> trueWay(const MissionRun& run) {
  std::vector<Pose2> way;
  std::istringstream lines(run.trace_jsonl);
  for (std::string line; std::getline(lines, line);) {
    const json sample = json::parse(line, nullptr, false);
    if (sample.is_discarded() || !sample.contains("base")) continue;
    const auto& p = sample["base"]["xyz_m"];
    way.push_back({p[0].get<double>(), p[1].get<double>(), 0.0});
  }
  return way;
}

}  // namespace

std::string trajectorySvg(const MissionRun& run, const ArenaMap& arena, const FireSiteMap& site) {
  Canvas canvas(arena);
  drawArena(canvas, arena, site);
  drawPlan(canvas, arena, site);
  std::vector<std::vector<Pose2>> driven;  // by reset
  int resets = -1;
  const json reports = json::parse(run.robot_json, nullptr, false);
  for (const json& row : reports["robot"].value("track", json::array())) {
    if (row[9].get<int>() != resets) driven.emplace_back();
    resets = row[9].get<int>();
    driven.back().push_back({row[1].get<double>(), row[2].get<double>(), row[3].get<double>()});
  }
  canvas.legend(0, "stroke:#4f9d3a;stroke-width:2", "planned way and way-points");
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const std::string style = fmt::format("stroke:{};stroke-width:4", kDriven[i % kDriven.size()]);
    canvas.line(driven[i], style);
    canvas.legend(static_cast<int>(i) + 1, style,
                  i == 0 ? "driven, by localisation" : fmt::format("driven, after reset {}", i));
  }
  const auto truth = trueWay(run);
  if (!truth.empty() && driven.size() < 2) {
    canvas.line(truth, "stroke:#000000;stroke-width:1;stroke-dasharray:5 5");
    canvas.legend(2, "stroke:#000000;stroke-width:1;stroke-dasharray:5 5", "driven, in truth");
  }
  return canvas.finish();
}

}  // namespace kiln
