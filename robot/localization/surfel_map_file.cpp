#include "robot/localization/surfel_map_file.h"

#include <algorithm>
#include <cmath>

#include <zstd.h>

#include "common/core/atomic_file.h"
#include "common/core/regular_file.h"
#include "robot/localization/surfel_rows.h"

namespace kiln {
namespace {

constexpr std::string_view kMagic = "KILNSMAP";
constexpr std::size_t kHeaderSize = 8 + 4 + 8 + 8 + 8;
constexpr std::uint64_t kMaxRawSize = 256ULL << 20U;
constexpr std::uint64_t kMostBytes = 256ULL << 20U;  // of a file; the shipped map has 1 MB
constexpr std::size_t kMaxSegments = 16;
constexpr int kCompression = 19;

/// FNV-1a.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ULL;
  return hash;
}

void writePosts(const std::vector<Post>& posts, ByteWriter& out) {
  out.u32(static_cast<std::uint32_t>(posts.size()));
  for (const Post& post : posts) {
    for (const float value : {post.p.x(), post.p.y(), post.free.x(), post.free.y(), post.variance,
                              post.z_min, post.z_max})
      out.f32(value);
  }
}

bool readPosts(ByteReader& in, std::vector<Post>& posts) {
  const std::size_t count = in.u32();
  if (count > in.left()) return false;
  posts.resize(count);
  bool good = true;
  for (Post& post : posts) {
    for (float* value : {&post.p.x(), &post.p.y(), &post.free.x(), &post.free.y(), &post.variance,
                         &post.z_min, &post.z_max}) {
      *value = in.f32();
      good &= std::abs(*value) < 1e4F;  // NaN is not
    }
    good &= post.variance >= 0.0F;
  }
  return good && in.ok();
}

std::string payload(const LocalizationMap& map, int min_points) {
  ByteWriter out;
  out.text(map.arena);
  out.u32(static_cast<std::uint32_t>(map.segments.size()));
  for (const MapSegment& segment : map.segments) {
    const SurfelMap::Config& config = segment.map->config();
    out.text(segment.name);
    out.f64(config.finest_cell_m);
    for (const int value : {config.levels, config.cells_xy, config.cells_z})
      out.u32(static_cast<std::uint32_t>(value));
    for (int i = 0; i < 3; ++i) out.f64(segment.map->center()[i]);
    for (int level = 0; level < config.levels; ++level)
      writeSurfelRows(surfelRows(*segment.map, level, min_points), out);
    writePosts(segment.map->posts(), out);
  }
  return out.bytes();
}

tl::unexpected<Error> outOfRange(const std::string& name) {
  return makeError(ErrorCode::InvalidInput,
                   "{}: the map holds values out of range; make it again with kiln-eval map", name);
}

Result<LocalizationMap> parse(std::string_view raw, const std::string& name) {
  ByteReader in(raw);
  LocalizationMap out;
  out.arena = in.text(1024);
  const std::size_t segments = in.u32();
  if (!in.ok() || segments > kMaxSegments) return outOfRange(name);
  for (std::size_t s = 0; s < segments; ++s) {
    MapSegment segment;
    segment.name = in.text(1024);
    SurfelMap::Config config;
    config.finest_cell_m = in.f64();
    for (int* value : {&config.levels, &config.cells_xy, &config.cells_z})
      *value = static_cast<int>(std::min<std::uint32_t>(in.u32(), 1 << 20));
    Eigen::Vector3d center;
    for (int i = 0; i < 3; ++i) center[i] = in.f64();
    if (!in.ok() || !config.validate() || !center.allFinite() || center.norm() > 1e4)
      return outOfRange(name);
    auto map = std::make_shared<SurfelMap>(config, center);
    for (int level = 0; level < config.levels; ++level) {
      std::vector<SurfelRow> rows;
      if (!readSurfelRows(in, rows)) return outOfRange(name);
      for (const SurfelRow& row : rows) {
        SurfelMap::CellMoments cell;
        cell.cell = row.cell;
        cell.sides[static_cast<std::size_t>(row.side)] = row.moments(map->cellSize(level));
        if (!map->addMoments(level, cell)) return outOfRange(name);
      }
    }
    std::vector<Post> posts;
    if (!readPosts(in, posts)) return outOfRange(name);
    map->setPosts(std::move(posts));
    map->refresh();
    segment.map = std::move(map);
    out.segments.push_back(std::move(segment));
  }
  if (in.left() != 0) return outOfRange(name);
  return out;
}

}  // namespace

std::shared_ptr<const SurfelMap> LocalizationMap::find(const std::string& name) const {
  for (const MapSegment& segment : segments) {
    if (segment.name == name) return segment.map;
  }
  return nullptr;
}

std::string encodeMap(const LocalizationMap& map, int min_points) {
  const std::string raw = payload(map, min_points);
  std::string packed(ZSTD_compressBound(raw.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), kCompression));
  ByteWriter header;
  header.u32(kMapFileVersion);
  header.u64(raw.size());
  header.u64(packed.size());
  header.u64(checksum(packed));
  return std::string(kMagic) + header.bytes() + packed;
}

Result<LocalizationMap> decodeMap(const std::string& bytes, const std::string& name) {
  if (std::string_view(bytes).substr(0, kMagic.size()) != kMagic)
    return makeError(ErrorCode::InvalidInput, "{}: not a Kiln map; make one with kiln-eval map",
                     name);
  ByteReader header(std::string_view(bytes).substr(kMagic.size()));
  const std::uint32_t version = header.u32();
  if (header.ok() && version != kMapFileVersion) {
    return makeError(ErrorCode::VersionMismatch,
                     "{}: map of version {}, this program reads version {}; make it again with "
                     "kiln-eval map",
                     name, version, kMapFileVersion);
  }
  const std::uint64_t raw_size = header.u64(), packed_size = header.u64(), sum = header.u64();
  if (!header.ok() || bytes.size() - kHeaderSize < packed_size) {
    return makeError(ErrorCode::Truncated, "{}: the map is cut off after {} bytes; copy it again",
                     name, bytes.size());
  }
  const std::string_view packed = std::string_view(bytes).substr(kHeaderSize);
  if (packed.size() != packed_size || checksum(packed) != sum) {
    return makeError(ErrorCode::Truncated,
                     "{}: the map's checksum does not fit its contents; copy it again", name);
  }
  if (raw_size > kMaxRawSize) return outOfRange(name);
  std::string raw(raw_size, '\0');
  const std::size_t got = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != raw_size) return outOfRange(name);
  auto map = parse(raw, name);
  if (map) map->checksum = sum;
  return map;
}

Result<void> saveMap(const LocalizationMap& map, const std::string& path, int min_points) {
  return writeFileAtomically(path, encodeMap(map, min_points));
}

Result<LocalizationMap> loadMap(const std::string& path) {
  const auto bytes = readRegularFile(path, kMostBytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return decodeMap(*bytes, path);
}

}  // namespace kiln
