#include "robot/perception/bricks/beam_evidence.h"

#include <algorithm>
#include <cmath>

#include "common/core/units.h"

namespace kiln {
namespace {

constexpr float kCell_rad = 1.0F * static_cast<float>(kDeg);
constexpr int kColumns = 360, kRows = 180;
constexpr double kParallax_m = 0.15;  // how far the LiDAR moved from its mean place
constexpr double kMinCosine = 0.15;   // of a face whose edges are looked at
constexpr double kSegment_m = 0.3;
constexpr double kCornerMargin_m = 0.01;  // not looked at beside the ends of an edge

Eigen::Vector3d axis(int face) {
  return Eigen::Vector3d::Unit(face / 2) * (face % 2 == 0 ? -1.0 : 1.0);
}

/// A stretch of a face's edge. Face coordinates: u, v ascending axes of the brick.
struct EdgeSegment {
  int face = 0, across = 0;  // axis of the brick across the edge, within the face
  double side = 1.0;         // at +half or -half of it
  int along = 0;             // axis along the edge
  double from = 0.0, to = 0.0;
  std::vector<std::pair<float, bool>> samples;  // across, outward of the nominal edge; on the face
};

/// Edges of faces that look at the sensor, beside which the neighbour looks away.
std::vector<EdgeSegment> segments(const Eigen::Vector3d& size, const Eigen::Vector3d& sensor) {
  std::vector<EdgeSegment> out;
  const auto faces = [&](int f) {
    return (sensor - 0.5 * axis(f).cwiseProduct(size)).dot(axis(f));
  };
  for (int f = 0; f < 6; ++f) {
    const Eigen::Vector3d view = (sensor - 0.5 * axis(f).cwiseProduct(size)).normalized();
    if (view.dot(axis(f)) < kMinCosine) continue;
    for (int g = 0; g < 6; ++g) {
      if (g / 2 == f / 2 || faces(g) > 0.0) continue;
      const int along = 3 - f / 2 - g / 2;
      const int pieces = std::max(1, static_cast<int>(std::lround(size[along] / kSegment_m)));
      for (int k = 0; k < pieces; ++k)
        out.push_back({f,
                       g / 2,
                       g % 2 == 0 ? -1.0 : 1.0,
                       along,
                       (static_cast<double>(k) / pieces - 0.5) * size[along],
                       (static_cast<double>(k + 1) / pieces - 0.5) * size[along],
                       {}});
    }
  }
  return out;
}

/// The place of an edge that the fewest beams contradict; false: they do not tell.
bool findEdge(std::vector<std::pair<float, bool>>& samples, const BeamGates& gates, double& at) {
  const auto on = static_cast<int>(
      std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.second; }));
  const int past = static_cast<int>(samples.size()) - on;
  if (on < gates.min_beams || past < gates.min_beams) return false;
  std::sort(samples.begin(), samples.end());
  // Edge before sample k: beams past among those inside, beams on among those outside.
  int wrong = on, best = on;
  std::size_t first = 0, last = 0;
  for (std::size_t k = 1; k <= samples.size(); ++k) {
    wrong += samples[k - 1].second ? -1 : 1;
    if (wrong < best) {
      best = wrong;
      first = k;
    }
    if (wrong == best) last = k;
  }
  if (first == 0 || last == samples.size() || best > gates.max_wrong * std::min(on, past))
    return false;
  const auto between = [&](std::size_t k) {
    return 0.5 *
           (static_cast<double>(samples[k - 1].first) + static_cast<double>(samples[k].first));
  };
  at = 0.5 * (between(first) + between(last));
  return true;
}

}  // namespace

void BeamGates::visit(ConfigArchive& a) {
  a.field("on_m", on_m, "m", 0.005, 0.2, "ends within it: met the surface");
  a.field("through_m", through_m, "m", 0.01, 0.5, "ends farther behind: nothing stands there");
  a.field("window_m", window_m, "m", 0.01, 0.3, "each side of an edge");
  a.field("min_beams", min_beams, "", 2, 1000, "on either side of an edge");
  a.field("max_wrong", max_wrong, "", 0, 0.5, "share that may contradict an edge");
}

BeamIndex::BeamIndex(std::span<const Beam> beams, const Eigen::Vector3d& p_sensor)
    : beams_(beams),
      p_sensor_(p_sensor.cast<float>()),
      first_(static_cast<std::size_t>(kColumns * kRows) + 1, 0),
      sorted_(beams.size()) {
  std::vector<std::uint32_t> cells(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto [column, row] = cellOf(beams[i].p - p_sensor_);
    cells[i] = static_cast<std::uint32_t>(row * kColumns + column);
    ++first_[cells[i] + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < beams.size(); ++i)
    sorted_[next[cells[i]]++] = static_cast<std::uint32_t>(i);
}

std::array<int, 2> BeamIndex::cellOf(const Eigen::Vector3f& d) const {
  const float azimuth = std::atan2(d.y(), d.x()) + static_cast<float>(M_PI);
  const float elevation = std::atan2(d.z(), std::hypot(d.x(), d.y())) + static_cast<float>(M_PI_2);
  return {std::clamp(static_cast<int>(azimuth / kCell_rad), 0, kColumns - 1),
          std::clamp(static_cast<int>(elevation / kCell_rad), 0, kRows - 1)};
}

std::vector<std::uint32_t> BeamIndex::near(const ModelBrick& brick, double margin_m) const {
  const Eigen::Vector3d half = 0.5 * brickSize(brick.kind) + Eigen::Vector3d::Constant(margin_m);
  const Eigen::Vector3f centre = brick.X_world_brick.translation().cast<float>() - p_sensor_;
  const double range = static_cast<double>(centre.norm());
  std::vector<std::uint32_t> out;
  if (range < half.norm() + 0.1) return out;  // the LiDAR is not inside of bricks
  const auto middle = cellOf(centre);
  int left = 0, right = 0, low = kRows, high = 0;  // columns relative to the middle's
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3d corner =
        brick.X_world_brick * Eigen::Vector3d((c & 1) != 0 ? half.x() : -half.x(),
                                              (c & 2) != 0 ? half.y() : -half.y(),
                                              (c & 4) != 0 ? half.z() : -half.z());
    const auto [column, row] = cellOf(corner.cast<float>() - p_sensor_);
    int off = column - middle[0];
    off -= off > kColumns / 2 ? kColumns : off < -kColumns / 2 ? -kColumns : 0;
    left = std::min(left, off);
    right = std::max(right, off);
    low = std::min(low, row);
    high = std::max(high, row);
  }
  // The LiDAR moved; beams that end far behind are sorted by where they end.
  const int more =
      1 + static_cast<int>(std::ceil(kParallax_m / range / static_cast<double>(kCell_rad)));
  for (int row = std::max(0, low - more); row <= std::min(kRows - 1, high + more); ++row)
    for (int off = left - more; off <= right + more; ++off) {
      const auto cell =
          static_cast<std::size_t>(row * kColumns + (middle[0] + off + 2 * kColumns) % kColumns);
      out.insert(out.end(), sorted_.begin() + first_[cell], sorted_.begin() + first_[cell + 1]);
    }
  return out;
}

std::vector<Correspondence> outline(const BeamIndex& index, const ModelBrick& brick,
                                    std::span<const std::uint32_t> beams,
                                    const Eigen::Vector3d& p_sensor, const BeamGates& gates) {
  const Eigen::Vector3d size = brickSize(brick.kind);
  const Eigen::Isometry3d X_brick_world = brick.X_world_brick.inverse();
  std::vector<EdgeSegment> edges = segments(size, X_brick_world * p_sensor);
  const Eigen::Isometry3f X = X_brick_world.cast<float>();
  for (const std::uint32_t i : beams) {
    const Beam& beam = index.beam(i);
    const Eigen::Vector3f o = X * beam.origin, end = X * beam.p, d = end - o;
    for (EdgeSegment& edge : edges) {
      const int k = edge.face / 2;
      const float sign = edge.face % 2 == 0 ? -1.0F : 1.0F;
      const float half = 0.5F * static_cast<float>(size[k]);
      if (!(sign * d[k] < 0.0F)) continue;
      // Behind the face's plane, along its normal; and where the beam crosses the plane.
      const float behind = half - sign * end[k];
      if (behind < -static_cast<float>(gates.on_m)) continue;  // ends before it: tells nothing
      const float share = (sign * half - o[k]) / d[k];
      const Eigen::Vector3f hit = o + share * d;
      const float along = hit[edge.along];
      if (along < static_cast<float>(edge.from + kCornerMargin_m) ||
          along > static_cast<float>(edge.to - kCornerMargin_m))
        continue;
      const float out = static_cast<float>(edge.side) * hit[edge.across] -
                        0.5F * static_cast<float>(size[edge.across]);
      if (std::abs(out) > static_cast<float>(gates.window_m)) continue;
      const bool on = behind < static_cast<float>(gates.on_m);
      if (!on && behind < static_cast<float>(gates.through_m)) continue;
      edge.samples.emplace_back(out, on);
    }
  }
  std::vector<Correspondence> out;
  for (EdgeSegment& edge : edges) {
    double at = 0.0;
    if (!findEdge(edge.samples, gates, at)) continue;
    Eigen::Vector3d p = 0.5 * axis(edge.face).cwiseProduct(size);
    p[edge.across] = 0.5 * edge.side * size[edge.across];
    p[edge.along] = 0.5 * (edge.from + edge.to);
    const Eigen::Vector3d n =
        brick.X_world_brick.linear() * (edge.side * Eigen::Vector3d::Unit(edge.across));
    const Eigen::Vector3d p_world = brick.X_world_brick * p;
    out.push_back({p_world, p_world + at * n, n, 1.0});
  }
  return out;
}

namespace {

struct Entry {
  int face = -1;
  float enter = 0.0F, leave = 0.0F;  // shares of the beam's length
};

Entry enterBox(const Eigen::Vector3f& o, const Eigen::Vector3f& d, const Eigen::Vector3f& half) {
  Entry entry{-1, -1e9F, 1e9F};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(d[k]) < 1e-9F) {
      if (std::abs(o[k]) > half[k]) return {};
      continue;
    }
    const float side = d[k] > 0.0F ? -half[k] : half[k];
    const float in = (side - o[k]) / d[k], out = (-side - o[k]) / d[k];
    if (in > entry.enter) {
      entry.enter = in;
      entry.face = 2 * k + (d[k] > 0.0F ? 0 : 1);
    }
    entry.leave = std::min(entry.leave, out);
  }
  if (entry.enter <= 0.0F || entry.enter >= entry.leave) entry.face = -1;
  return entry;
}

struct CellVotes {
  int on = 0, through = 0, before = 0;
};

}  // namespace

SurfaceEvidence weigh(const BeamIndex& index, const ModelBrick& brick,
                      const std::array<FaceGrid, 6>& lattice, std::span<const std::uint32_t> beams,
                      const BeamGates& gates) {
  const Eigen::Vector3f size = brickSize(brick.kind).cast<float>();
  const Eigen::Isometry3f X = brick.X_world_brick.inverse().cast<float>();
  std::array<std::vector<CellVotes>, 6> votes;
  for (std::size_t f = 0; f < 6; ++f) votes[f].resize(lattice[f].visible.size());
  for (const std::uint32_t i : beams) {
    const Beam& beam = index.beam(i);
    const Eigen::Vector3f o = X * beam.origin, end = X * beam.p, d = end - o;
    const Entry entry = enterBox(o, d, 0.5F * size);
    if (entry.face < 0) continue;
    const int k = entry.face / 2, u = k == 0 ? 1 : 0, v = k == 2 ? 1 : 2;
    const FaceGrid& grid = lattice[static_cast<std::size_t>(entry.face)];
    const Eigen::Vector3f hit = o + entry.enter * d;
    const auto cell = [&](int axis_, int n) {
      return std::clamp(static_cast<int>((hit[axis_] / size[axis_] + 0.5F) * static_cast<float>(n)),
                        0, n - 1);
    };
    const std::size_t c = grid.cell(cell(u, grid.nu), cell(v, grid.nv));
    if (grid.visible[c] == 0) continue;
    CellVotes& vote = votes[static_cast<std::size_t>(entry.face)][c];
    const float behind = (1.0F - entry.enter) * std::abs(d[k]);
    const float chord = (entry.leave - entry.enter) * d.norm();
    if (behind < -static_cast<float>(gates.on_m))
      ++vote.before;
    else if (behind < static_cast<float>(gates.on_m))
      ++vote.on;
    else if (behind > static_cast<float>(gates.through_m) &&
             chord > static_cast<float>(gates.through_m))
      ++vote.through;
  }
  SurfaceEvidence out;
  for (std::size_t f = 0; f < 6; ++f) {
    int expected = 0, found = 0;
    for (std::size_t c = 0; c < votes[f].size(); ++c) {
      if (lattice[f].visible[c] == 0) continue;
      ++expected;
      const CellVotes& vote = votes[f][c];
      if (vote.on > 0 && vote.on >= vote.through)
        ++found;
      else if (vote.through > 0)
        ++out.empty;
      else if (vote.before > 0)
        ++out.hidden;
    }
    out.expected += expected;
    out.found += found;
    if (expected > 0 && 3 * found >= expected) ++out.sides_found;
  }
  return out;
}

}  // namespace kiln
