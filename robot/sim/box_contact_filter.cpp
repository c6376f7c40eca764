#include "robot/sim/box_contact_filter.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include <mujoco/mujoco.h>

namespace kiln::sim {
namespace {

mjfCollision original_box_box = nullptr;
std::atomic<unsigned long> dropped{0};

/// Projected half-length of a box on a unit axis. MuJoCo stores rotations row-major, axes in
/// columns.
mjtNum halfLength(const mjtNum* rotation, const mjtNum* size, const mjtNum* axis) {
  mjtNum sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += size[i] *
           std::fabs(rotation[i] * axis[0] + rotation[3 + i] * axis[1] + rotation[6 + i] * axis[2]);
  }
  return sum;
}

/// Least overlap along the six face axes; negative when they are apart along one of them.
mjtNum faceOverlap(const mjModel* m, const mjData* d, int g1, int g2) {
  const mjtNum* p1 = d->geom_xpos + 3 * g1;
  const mjtNum* p2 = d->geom_xpos + 3 * g2;
  mjtNum least = 1e10;
  for (const int g : {g1, g2}) {
    const mjtNum* r = d->geom_xmat + 9 * g;
    for (int i = 0; i < 3; ++i) {
      const mjtNum axis[3] = {r[i], r[3 + i], r[6 + i]};
      const mjtNum distance = std::fabs(axis[0] * (p2[0] - p1[0]) + axis[1] * (p2[1] - p1[1]) +
                                        axis[2] * (p2[2] - p1[2]));
      const mjtNum overlap = halfLength(d->geom_xmat + 9 * g1, m->geom_size + 3 * g1, axis) +
                             halfLength(d->geom_xmat + 9 * g2, m->geom_size + 3 * g2, axis) -
                             distance;
      least = std::fmin(least, overlap);
    }
  }
  return least;
}

int filteredBoxBox(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                   mjtNum margin) {
  const int found = original_box_box(m, d, contacts, g1, g2, margin);
  if (found == 0) return 0;
  const mjtNum allowed = 1.05 * std::fmax(0.0, faceOverlap(m, d, g1, g2)) + 1e-3;
  int kept = 0;
  for (int i = 0; i < found; ++i) {
    if (-contacts[i].dist > allowed) continue;
    if (kept != i) contacts[kept] = contacts[i];
    ++kept;
  }
  dropped += static_cast<unsigned long>(found - kept);
  return kept;
}

}  // namespace

void installBoxContactFilter() {
  static std::once_flag once;
  std::call_once(once, [] {
    original_box_box = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];
    mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = filteredBoxBox;
  });
}

unsigned long droppedBoxContacts() { return dropped.load(); }

}  // namespace kiln::sim
