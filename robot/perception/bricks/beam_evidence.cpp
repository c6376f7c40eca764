#include "robot/perception/bricks/beam_evidence.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

// Cells in the plane at distance 1 ahead of the sensor.
constexpr float kCell = 0.02F;
constexpr int kColumns = 400, kRows = 200;
constexpr std::uint32_t kAside = 0xffffffffU;
constexpr double kMinCosine = 0.15;  // of a face whose edges are looked at
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

/// The place of an edge: beams inside of it end on the face, beams outside go on. Judged by those
/// within `beside_m` alone, so that a neighbour behind a gap does not matter. False: the beams do not
/// tell.
bool findEdge(std::vector<std::pair<float, bool>>& samples, const BeamGates& gates, double& at) {
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  std::vector<int> on(n + 1, 0);  // among the first k
  for (std::size_t k = 0; k < n; ++k) on[k + 1] = on[k] + (samples[k].second ? 1 : 0);
  const auto beside = static_cast<float>(gates.beside_m);
  double best = 2.0 * gates.max_wrong;
  std::size_t first = 0, last = 0, low = 0, high = 0;
  for (std::size_t k = 1; k < n; ++k) {  // between samples k - 1 and k
    const float place = 0.5F * (samples[k - 1].first + samples[k].first);
    while (samples[low].first < place - beside) ++low;
    while (high < n && samples[high].first <= place + beside) ++high;
    const int inside = static_cast<int>(k - low), outside = static_cast<int>(high - k);
    if (inside < gates.min_beams || outside < gates.min_beams) continue;
    const double past_inside = static_cast<double>(inside - (on[k] - on[low])) / inside,
                 on_outside = static_cast<double>(on[high] - on[k]) / outside;
    if (std::max(past_inside, on_outside) > gates.max_wrong) continue;
    const double wrong = past_inside + on_outside;
    if (wrong > best || (wrong == best && first != 0 && k != last + 1)) continue;
    if (wrong < best) first = k;
    if (first == 0) first = k;
    best = wrong;
    last = k;
  }
  if (first == 0) return false;
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
  a.field("window_m", window_m, "m", 0.01, 0.3, "each side of an edge's expected place");
  a.field("beside_m", beside_m, "m", 0.005, 0.1, "each side of an edge, that judge it");
  a.field("min_beams", min_beams, "", 2, 1000, "on either side of an edge");
  a.field("max_wrong", max_wrong, "", 0, 0.5, "share that may contradict an edge");
}

BeamIndex::BeamIndex(std::span<const Beam> beams, const Eigen::Vector3d& p_sensor,
                     const Eigen::Vector3d& ahead)
    : beams_(beams),
      p_sensor_(p_sensor.cast<float>()),
      first_(static_cast<std::size_t>(kColumns * kRows) + 1, 0) {
  Eigen::Vector3d level = ahead - p_sensor;
  level.z() = 0.0;
  if (level.norm() < 1e-3) level = Eigen::Vector3d(1, 0, 0);
  level.normalize();
  axes_.row(0) = Eigen::Vector3d(level.y(), -level.x(), 0.0).cast<float>();
  axes_.row(1) = Eigen::Vector3f(0, 0, 1);
  axes_.row(2) = level.cast<float>();
  std::vector<std::uint32_t> cells(beams.size());
  Eigen::Vector2f at;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    parallax_m_ = std::max(parallax_m_, (beams[i].origin - p_sensor_).squaredNorm());
    if (!project(beams[i].p, at)) {
      cells[i] = kAside;
      continue;
    }
    cells[i] =
        static_cast<std::uint32_t>(static_cast<int>(at.y()) * kColumns + static_cast<int>(at.x()));
    ++first_[cells[i] + 1];
  }
  parallax_m_ = std::sqrt(parallax_m_);
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  sorted_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < beams.size(); ++i)
    if (cells[i] != kAside) sorted_[next[cells[i]]++] = static_cast<std::uint32_t>(i);
}

bool BeamIndex::project(const Eigen::Vector3f& p, Eigen::Vector2f& cell) const {
  const Eigen::Vector3f d = axes_ * (p - p_sensor_);
  if (!(d.z() > 0.25F * std::abs(d.x())) || !(d.z() > 1e-3F)) return false;
  cell.x() = std::clamp((d.x() / d.z()) / kCell + 0.5F * kColumns, 0.0F, kColumns - 1.0F);
  cell.y() = std::clamp((d.y() / d.z()) / kCell + 0.5F * kRows, 0.0F, kRows - 1.0F);
  return true;
}

std::vector<std::uint32_t> BeamIndex::near(const ModelBrick& brick, double margin_m) const {
  const Eigen::Vector3d half = 0.5 * brickSize(brick.kind) + Eigen::Vector3d::Constant(margin_m);
  std::vector<std::uint32_t> out;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(1e9F), high = -low;
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3f corner =
        (brick.X_world_brick * Eigen::Vector3d((c & 1) != 0 ? half.x() : -half.x(),
                                               (c & 2) != 0 ? half.y() : -half.y(),
                                               (c & 4) != 0 ? half.z() : -half.z()))
            .cast<float>();
    Eigen::Vector2f at;
    if (!project(corner, at)) return out;
    // The LiDAR moved: a beam that ends far behind is sorted by where it ends.
    const float depth = axes_.row(2).dot(corner - p_sensor_);
    const float more = 1.0F + parallax_m_ / depth / kCell *
                                  (1.0F + std::max(std::abs(at.x() - 0.5F * kColumns),
                                                   std::abs(at.y() - 0.5F * kRows)) *
                                              kCell);
    low = low.cwiseMin((at.array() - more).matrix());
    high = high.cwiseMax((at.array() + more).matrix());
  }
  const int left = std::max(0, static_cast<int>(low.x())),
            right = std::min(kColumns - 1, static_cast<int>(high.x()));
  const int bottom = std::max(0, static_cast<int>(low.y())),
            top = std::min(kRows - 1, static_cast<int>(high.y()));
  for (int row = bottom; row <= top; ++row) {
    const auto begin = static_cast<std::size_t>(row * kColumns + left),
               end = static_cast<std::size_t>(row * kColumns + right + 1);
    out.insert(out.end(), sorted_.begin() + first_[begin], sorted_.begin() + first_[end]);
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
