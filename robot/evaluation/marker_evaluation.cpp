#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <optional>
#include <thread>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/units.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/marker/marker_trial.h"

namespace kiln {
namespace {

using nlohmann::json;

constexpr std::array<int, 3> kDistances_m{4, 7, 11};
constexpr std::array<MarkerCase, 7> kOthers{
    MarkerCase::Absent,      MarkerCase::OneLeg,    MarkerCase::LegHidden, MarkerCase::CornerHidden,
    MarkerCase::OtherColour, MarkerCase::OneColour, MarkerCase::Small};
constexpr int kDefaultPictures = 12, kMostPictures = 100;
constexpr double kWrong_m = 0.5, kWrong_rad = 10.0 * kDeg;
constexpr double kInside95 = 5.991;  // chi squared, 2 degrees of freedom

/// Ours; ours without the fit of the outline; the paper's: colours as on site, flat ground, each
/// picture's winner, the largest cluster. All three on the same pictures.
enum Method : std::size_t { kOurs, kRectangle, kPaper, kMethods };
constexpr std::array<const char*, kMethods> kPrefix{"", "rectangle_", "paper_"};

struct Pose {
  Eigen::Vector2d off_m = Eigen::Vector2d::Zero();  ///< in base: estimated minus true
  double yaw_off_rad = 0.0;
  double inside = 0.0;  ///< squared error of the position by its own covariance
  [[nodiscard]] bool wrong() const {
    return off_m.norm() > kWrong_m || std::abs(yaw_off_rad) > kWrong_rad;
  }
};

struct Look {
  int seed = 0;
  MarkerCase what = MarkerCase::Whole;
  double distance_m = 0.0;
  std::array<std::optional<Pose>, kMethods> pose;
  std::array<std::string, kMethods> refused;
  int pictures_with_marker = 0;
};

std::array<MarkerLocalizer, kMethods> localizers() {
  MarkerLocalizer::Config ours, rectangle, paper;
  rectangle.refine = false;
  paper.refine = false;
  paper.paper = true;
  return {MarkerLocalizer(ours), MarkerLocalizer(rectangle), MarkerLocalizer(paper)};
}

Pose judge(const MarkerEstimate& estimate, const MarkerTrial::Step& last) {
  Pose out;
  const Pose2 found = projectToGround(estimate.X_base_wall);
  const Pose2 truth = projectToGround(last.X_base_wall);
  out.off_m = {found.x_m - truth.x_m, found.y_m - truth.y_m};
  out.yaw_off_rad = wrapAngle(found.yaw_rad - truth.yaw_rad);
  // The covariance has the axes of odom.
  const Eigen::Vector2d in_odom = Eigen::Rotation2Dd(last.from.X_odom_base.yaw_rad) * out.off_m;
  out.inside = in_odom.dot(estimate.covariance.topLeftCorner<2, 2>().inverse() * in_odom);
  return out;
}

Look runLook(const RobotGeometry& robot, MarkerCase what, double distance_m, int seed,
             int pictures) {
  Look out{seed, what, distance_m, {}, {}, 0};
  const auto draw = static_cast<std::uint64_t>(seed) * 1000 +
                    static_cast<std::uint64_t>(10.0 * distance_m) +
                    100000000ULL * static_cast<std::uint64_t>(what);
  MarkerTrial trial(drawYard(what, distance_m, draw), robot, draw);
  const MarkerDetector detector({});
  MarkerDetector::Config on_site;
  on_site.adapt = false;
  const MarkerDetector paper_detector(on_site);
  auto methods = localizers();
  MarkerTrial::Step step;
  for (int i = 0; i < pictures; ++i) {
    step = trial.at((i + 1.0) / pictures);
    const MarkerView view = detector.detect(step.image);
    methods[kPaper].add(paper_detector.detect(step.image), step.from);  // ground: z = 0 of base
    const auto ray = winnerRay(view, methods[kOurs].camera());
    if (!ray) continue;
    ++out.pictures_with_marker;
    const auto& X_base_rgb = step.from.X_base_rgb;
    const auto ground = groundAlongRay(step.scan_base, X_base_rgb.translation(),
                                       X_base_rgb.linear() * *ray, 20.0, {});
    if (!ground) continue;
    step.from.ground = *ground;
    methods[kOurs].add(view, step.from);
    methods[kRectangle].add(view, step.from);
  }
  for (std::size_t m = 0; m < kMethods; ++m) {
    const MarkerSearch search = methods[m].search();
    if (search.estimate)
      out.pose[m] = judge(*search.estimate, step);
    else if (!search.refused.empty())
      out.refused[m] = search.refused.front().text;
  }
  return out;
}

json toJson(const Look& look) {
  json out{{"seed", look.seed},
           {"case", toString(look.what)},
           {"distance_m", look.distance_m},
           {"pictures_with_marker", look.pictures_with_marker}};
  for (std::size_t m = 0; m < kMethods; ++m) {
    json& one = out[std::string(kPrefix[m]) + "pose"];
    if (look.pose[m])
      one = {{"off_m", {look.pose[m]->off_m.x(), look.pose[m]->off_m.y()}},
             {"yaw_off_deg", look.pose[m]->yaw_off_rad / kDeg}};
    else
      one = {{"refused", look.refused[m]}};
  }
  return out;
}

/// Figures of one method at one distance.
void addFigures(const std::vector<Look>& looks, int distance_m, std::size_t m,
                EvaluationResult& out) {
  double n = 0.0, found = 0.0, yaw = 0.0;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (const Look& look : looks) {
    if (look.what != MarkerCase::Whole || look.distance_m != distance_m) continue;
    ++n;
    if (!look.pose[m]) continue;
    ++found;
    squares += look.pose[m]->off_m.cwiseAbs2();
    yaw += look.pose[m]->yaw_off_rad * look.pose[m]->yaw_off_rad;
  }
  const Eigen::Vector2d sd = (squares / found).cwiseSqrt();
  const std::string prefix = kPrefix[m];
  // About the truth, not about the mean: a bias counts. The worse of forward and sideways.
  out.figures.push_back(
      {fmt::format("{}sd_{}m_m", prefix, distance_m), sd.maxCoeff(), "m", "", true});
  if (m == kOurs)
    out.figures.push_back({fmt::format("sideways_sd_{}m_m", distance_m), sd.y(), "m", "", true});
  out.figures.push_back({fmt::format("{}yaw_{}m_deg", prefix, distance_m),
                         std::sqrt(yaw / found) / kDeg, "deg", "", true});
  out.figures.push_back({fmt::format("{}found_{}m", prefix, distance_m), found / n, "", "", true});
}

Result<int> picturesOf(const SweepOptions& options) {
  const auto given = options.own.find("pictures");
  if (given == options.own.end()) return kDefaultPictures;
  int n = 0;
  const std::string& text = given->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size() || n < 1 || n > kMostPictures)
    return makeError(ErrorCode::InvalidInput, "--pictures must be 1 to {}, not '{}'", kMostPictures,
                     text);
  return n;
}

}  // namespace

Result<EvaluationResult> evaluateMarker(const SweepOptions& options) {
  const auto robot = loadResource<RobotGeometry>("robot_model/bob.yaml");
  if (!robot) return tl::make_unexpected(robot.error());
  const auto pictures = picturesOf(options);
  if (!pictures) return tl::make_unexpected(pictures.error());
  struct Task {
    int seed;
    MarkerCase what;
    double distance_m;
  };
  std::vector<Task> tasks;
  for (int seed = options.first_seed; seed <= options.last_seed; ++seed) {
    for (const int distance : kDistances_m)
      tasks.push_back({seed, MarkerCase::Whole, distance * 1.0});
    for (std::size_t i = 0; i < 2; ++i)  // two of the others a seed, each kind in turn
      tasks.push_back({seed, kOthers[(2 * static_cast<std::size_t>(seed) + i) % kOthers.size()],
                       5.0 + (seed * 7 + static_cast<int>(i) * 3) % 5});
  }
  std::vector<Look> looks(tasks.size());
  std::atomic<std::size_t> next = 0;
  {
    std::vector<std::jthread> workers;
    for (int job = 0; job < std::max(1, options.jobs); ++job)
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < tasks.size(); i = next++)
          looks[i] = runLook(*robot, tasks[i].what, tasks[i].distance_m, tasks[i].seed, *pictures);
      });
  }
  EvaluationResult out;
  out.name = "marker";
  json runs = json::array();
  for (const Look& look : looks) runs.push_back(toJson(look));
  out.runs_json = runs.dump();
  for (std::size_t m = 0; m < kMethods; ++m)
    for (const int distance : kDistances_m) addFigures(looks, distance, m, out);
  double inside = 0.0, found = 0.0;
  std::array<double, kMethods> wrong{}, falsely{};
  int others = 0;
  for (const Look& look : looks) {
    others += look.what != MarkerCase::Whole ? 1 : 0;
    for (std::size_t m = 0; m < kMethods; ++m) {
      if (!look.pose[m]) continue;
      if (look.what != MarkerCase::Whole)
        ++falsely[m];
      else if (look.pose[m]->wrong())
        ++wrong[m];
    }
    if (look.what != MarkerCase::Whole || !look.pose[kOurs]) continue;
    ++found;
    inside += look.pose[kOurs]->inside <= kInside95 ? 1.0 : 0.0;
  }
  for (std::size_t m = 0; m < kMethods; ++m) {
    out.figures.push_back({std::string(kPrefix[m]) + "wrong_poses", wrong[m], "", "", true});
    out.figures.push_back({std::string(kPrefix[m]) + "false_detections", falsely[m], "", "", true});
  }
  out.figures.push_back({"inside_95", inside / found, "", "", true});
  out.notes = fmt::format(
      "{} looks of 10 s, {} pictures each; {} of them at what is no whole marker. sd: about the "
      "truth, in base, the worse of forward and sideways. wrong: off by more than {} m or {:.0f} "
      "deg. inside_95: share within the 95 % ellipse of its own covariance. rectangle_: without "
      "the fit of the outline; paper_: colours as on site, flat ground, "
      "winner and largest cluster, side check alone.",
      looks.size(), *pictures, others, kWrong_m, kWrong_rad / kDeg);
  return out;
}

}  // namespace kiln
