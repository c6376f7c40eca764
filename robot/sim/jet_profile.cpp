#include "robot/sim/jet_profile.h"

#include <algorithm>
#include <cmath>

namespace kiln::sim {

void JetProfile::pass(const Eigen::Isometry3d& X_map_nozzle, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b) {
  const Eigen::Vector3d axis = X_map_nozzle.linear().col(0);
  const double from = axis.dot(a - X_map_nozzle.translation());
  const double to = axis.dot(b - X_map_nozzle.translation());
  for (std::size_t i = 0; i < kDistances_m.size(); ++i) {
    const double d = kDistances_m[i];
    if (from >= d || to < d) continue;
    const Eigen::Vector3d at = a + (d - from) / (to - from) * (b - a);
    const Eigen::Vector3d off = at - (X_map_nozzle.translation() + d * axis);
    const double lateral = X_map_nozzle.linear().col(1).dot(off);
    Sum& sum = sums_[i];
    sum.n += 1.0;
    sum.fall -= off.z();
    sum.lateral += lateral;
    sum.square += off.z() * off.z() + lateral * lateral;
  }
}

std::vector<JetProfile::Row> JetProfile::rows() const {
  std::vector<Row> out;
  for (std::size_t i = 0; i < kDistances_m.size(); ++i) {
    const Sum& sum = sums_[i];
    if (sum.n < 1.0) continue;
    const double fall = sum.fall / sum.n, lateral = sum.lateral / sum.n;
    const double variance = std::max(0.0, sum.square / sum.n - fall * fall - lateral * lateral);
    out.push_back({kDistances_m[i], sum.n, fall, lateral, std::sqrt(variance)});
  }
  return out;
}

}  // namespace kiln::sim
