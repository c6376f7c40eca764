// What touches what, and what of it is on purpose.
#include <map>

#include <mujoco/mujoco.h>

#include "robot/sim/physics_impl.h"

namespace kiln::sim {

/// What the robot meets on purpose: the face of its magnets a brick's side before it; a brick on the
/// floor, the back and the walls of its bin; what it holds on a support, or beside a neighbour.
bool Physics::Impl::planned(int a, int b, const BodyContact& contact) const {
  if (!bricks) return false;
  const double n = contact.force_on_a.norm();
  const auto brick = bricks->brickOf(b);
  if (bricks->isFace(a) && brick) {
    const Eigen::Vector3d out =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d->geom_xmat + 9 * a).col(2);
    return n < 1e-9 || std::fabs(contact.force_on_a.dot(out)) > 0.8 * n;
  }
  if (geoms[static_cast<std::size_t>(a)].storage && brick) return !holds(b) || n <= wall.support_n;
  const auto held = bricks->brickOf(a);
  if (!held) return false;
  if (contact.force_on_a.z() > 0.8 * n) return n <= wall.support_n;
  return brick && n <= wall.side_n;
}

bool Physics::Impl::holds(int geom) const {
  return bricks && bricks->grip().held && bricks->brickOf(geom) == bricks->grip().held;
}

void Physics::Impl::noteBrickContact(const mjContact& c, const Eigen::Vector3d& force_on_2) {
  const Eigen::Vector3d p(c.pos[0], c.pos[1], c.pos[2]);
  if (const auto brick = bricks->brickOf(c.geom1))
    bricks->noteContact(*brick, c.geom2, -force_on_2, p);
  if (const auto brick = bricks->brickOf(c.geom2))
    bricks->noteContact(*brick, c.geom1, force_on_2, p);
}

/// Sums the points of each touching pair. Forces belong to the step that was just taken.
void Physics::Impl::collectContacts() {
  contacts.clear();
  if (bricks) bricks->beginContacts();
  std::map<std::pair<int, int>, std::size_t> seen;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.efc_address < 0) continue;
    int a = c.geom1, b = c.geom2;
    double sign = -1.0;  // mj_contactForce is the force on geom2
    const auto info = [&](int g) -> const GeomInfo& { return geoms[static_cast<std::size_t>(g)]; };
    if (!info(a).robot || (info(b).arm && !info(a).arm)) {
      std::swap(a, b);
      sign = 1.0;
    }
    mjtNum f[6];
    mj_contactForce(m, d, i, f);
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      force += sign * f[axis] *
               Eigen::Vector3d(c.frame[3 * axis], c.frame[3 * axis + 1], c.frame[3 * axis + 2]);
    if (bricks) {
      noteBrickContact(c, sign < 0 ? Eigen::Vector3d(-force) : force);
      if (!info(a).robot && !holds(a)) {
        if (!holds(b)) continue;  // bricks among themselves, and on the ground
        std::swap(a, b);
        force = -force;
      }
    }
    const auto [it, fresh] = seen.try_emplace({a, b}, contacts.size());
    if (fresh) {
      BodyContact contact;
      contact.a = info(a).name;
      contact.b = info(b).name;
      contact.wheel = info(a).wheel;
      contact.floor = info(b).floor;
      contact.arm = info(a).arm && !info(b).arm;
      contacts.push_back(contact);
    }
    BodyContact& contact = contacts[it->second];
    // Force-weighted mean of the points, kept as a running mean.
    const double before = contact.normal_n;
    contact.normal_n += f[0];
    const Eigen::Vector3d p(c.pos[0], c.pos[1], c.pos[2]);
    contact.point = contact.normal_n > 1e-9
                        ? Eigen::Vector3d((before * contact.point + f[0] * p) / contact.normal_n)
                        : p;
    contact.force_on_a += force;
  }
  for (const auto& [pair, index] : seen)
    contacts[index].planned = planned(pair.first, pair.second, contacts[index]);
}

}  // namespace kiln::sim
