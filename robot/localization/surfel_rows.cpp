#include "robot/localization/surfel_rows.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kiln {
namespace {

constexpr double kMeanSteps = 255.0;      // of a cell
constexpr double kCovarianceStep = 1e-4;  // of a cell squared: (1 mm)^2 at 0.1 m
constexpr double kMaxCovariance = 1.0;    // of a cell squared

std::uint64_t zigzag(std::int64_t v) {
  return (static_cast<std::uint64_t>(v) << 1U) ^ static_cast<std::uint64_t>(v >> 63U);
}
std::int64_t unzigzag(std::uint64_t v) {
  return static_cast<std::int64_t>(v >> 1U) ^ -static_cast<std::int64_t>(v & 1U);
}

constexpr std::array<std::array<int, 2>, 6> kEntries{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

SurfelRow rowOf(const SurfelMap::Cell& cell, int side, const SurfelMoments& moments,
                double cell_m) {
  SurfelRow row;
  row.cell = cell;
  row.side = side;
  row.count = static_cast<std::uint64_t>(std::llround(moments.count));
  const Eigen::Vector3d mean = moments.mean() / cell_m - cell.cast<double>();
  const Eigen::Matrix3d covariance = moments.covariance() / (cell_m * cell_m);
  const Eigen::Vector3d view = moments.view_sum / moments.count;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    row.mean[k] =
        static_cast<std::uint8_t>(std::lround(std::clamp(mean[i], 0.0, 1.0) * kMeanSteps));
    row.view[k] = static_cast<std::int8_t>(std::lround(std::clamp(view[i], -1.0, 1.0) * 127.0));
  }
  for (std::size_t i = 0; i < 6; ++i) {
    row.covariance[i] = std::llround(covariance(kEntries[i][0], kEntries[i][1]) / kCovarianceStep);
  }
  return row;
}

}  // namespace

SurfelMoments SurfelRow::moments(double cell_m) const {
  Eigen::Vector3d p, direction;
  Eigen::Matrix3d spread;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    p[i] = (cell[i] + mean[k] / kMeanSteps) * cell_m;
    direction[i] = view[k] / 127.0;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const int r = kEntries[i][0], c = kEntries[i][1];
    spread(r, c) = spread(c, r) =
        static_cast<double>(covariance[i]) * kCovarianceStep * cell_m * cell_m;
  }
  SurfelMoments out;
  out.count = static_cast<double>(count);
  out.sum = out.count * p;
  out.squares = out.count * (spread + p * p.transpose());
  out.view_sum = out.count * direction;
  return out;
}

std::vector<SurfelRow> surfelRows(const SurfelMap& map, int level, int min_points) {
  std::vector<SurfelRow> rows;
  for (const SurfelMap::CellMoments& cell : map.ownCells(level)) {
    for (int side = 0; side < 2; ++side) {
      const SurfelMoments& moments = cell.sides[static_cast<std::size_t>(side)];
      if (moments.count + 0.5 > min_points)
        rows.push_back(rowOf(cell.cell, side, moments, map.cellSize(level)));
    }
  }
  std::sort(rows.begin(), rows.end(), [](const SurfelRow& a, const SurfelRow& b) {
    return std::tie(a.cell.z(), a.cell.y(), a.cell.x(), a.side) <
           std::tie(b.cell.z(), b.cell.y(), b.cell.x(), b.side);
  });
  return rows;
}

void writeSurfelRows(const std::vector<SurfelRow>& rows, ByteWriter& out) {
  out.u32(static_cast<std::uint32_t>(rows.size()));
  SurfelRow last;
  last.cell.setZero();
  for (const SurfelRow& row : rows) {
    for (int i = 2; i >= 0; --i) out.varint(zigzag(row.cell[i] - last.cell[i]));
    last = row;
  }
  for (const SurfelRow& row : rows) out.u8(static_cast<std::uint8_t>(row.side));
  for (const SurfelRow& row : rows) out.varint(row.count);
  for (std::size_t i = 0; i < 3; ++i) {
    for (const SurfelRow& row : rows) out.u8(row.mean[i]);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (const SurfelRow& row : rows) out.varint(zigzag(row.covariance[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (const SurfelRow& row : rows) out.u8(static_cast<std::uint8_t>(row.view[i]));
  }
}

bool readSurfelRows(ByteReader& in, std::vector<SurfelRow>& rows) {
  const std::size_t count = in.u32();
  if (count > in.left()) return false;
  rows.resize(count);
  SurfelMap::Cell cell = SurfelMap::Cell::Zero();
  for (SurfelRow& row : rows) {
    for (int i = 2; i >= 0; --i) {
      const std::int64_t value = cell[i] + unzigzag(in.varint());
      if (std::abs(value) > (1 << 20)) return false;
      cell[i] = static_cast<int>(value);
    }
    row.cell = cell;
  }
  bool good = true;
  for (SurfelRow& row : rows) good &= (row.side = in.u8()) <= 1;
  for (SurfelRow& row : rows) good &= (row.count = in.varint()) >= 1 && row.count < (1ULL << 40U);
  for (std::size_t i = 0; i < 3; ++i) {
    for (SurfelRow& row : rows) row.mean[i] = in.u8();
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (SurfelRow& row : rows) {
      row.covariance[i] = unzigzag(in.varint());
      good &= std::abs(static_cast<double>(row.covariance[i])) * kCovarianceStep <= kMaxCovariance;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (SurfelRow& row : rows) row.view[i] = static_cast<std::int8_t>(in.u8());
  }
  return good && in.ok();
}

}  // namespace kiln
