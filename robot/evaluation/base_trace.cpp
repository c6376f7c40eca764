#include "robot/evaluation/base_trace.h"

#include <algorithm>
#include <sstream>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace kiln {

BaseTrace::BaseTrace(const std::string& jsonl) {
  using nlohmann::json;
  std::istringstream lines(jsonl);
  for (std::string line; std::getline(lines, line);) {
    const json sample = json::parse(line, nullptr, false);
    if (sample.is_discarded() || !sample.contains("base")) continue;
    const auto& p = sample["base"]["xyz_m"];
    const auto& q = sample["base"]["wxyz"];
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = Eigen::Vector3d(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    X.linear() = Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
                                    q[3].get<double>())
                     .toRotationMatrix();
    samples_.push_back({sample["t"].get<double>(), projectToGround(X)});
  }
}

std::optional<Pose2> BaseTrace::at(double t_s) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), t_s,
                                      [](const Sample& s, double t) { return s.t_s < t; });
  if (after == samples_.begin() || after == samples_.end()) return std::nullopt;
  const Sample& before = *(after - 1);
  const double s = (t_s - before.t_s) / std::max(1e-9, after->t_s - before.t_s);
  const Pose2 &p = before.X_map_base, &q = after->X_map_base;
  return Pose2{p.x_m + s * (q.x_m - p.x_m), p.y_m + s * (q.y_m - p.y_m),
               wrapAngle(p.yaw_rad + s * wrapAngle(q.yaw_rad - p.yaw_rad))};
}

}  // namespace kiln
