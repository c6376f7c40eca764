#include "robot/sim/collision_monitor.h"

#include <algorithm>

namespace kiln::sim {
namespace {
constexpr Duration kSameTouch = std::chrono::seconds(1);
}

void CollisionMonitor::observe(Stamp now, const std::vector<BodyContact>& contacts) {
  for (const BodyContact& contact : contacts) {
    if (contact.planned || (contact.wheel && contact.floor) || contact.normal_n <= threshold_n_)
      continue;
    bool known = false;
    for (std::size_t i = collisions_.size(); i-- > 0 && !known;) {
      if (now - last_seen_[i] > kSameTouch || collisions_[i].a != contact.a ||
          collisions_[i].b != contact.b)
        continue;
      collisions_[i].force_n = std::max(collisions_[i].force_n, contact.normal_n);
      last_seen_[i] = now;
      known = true;
    }
    if (known) continue;
    collisions_.push_back({now, contact.a, contact.b, contact.normal_n});
    last_seen_.push_back(now);
  }
}

}  // namespace kiln::sim
