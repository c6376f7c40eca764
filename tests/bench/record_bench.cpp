// Cost of recording one LiDAR scan, and of opening, seeking and reading a recording of 30 minutes.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include <benchmark/benchmark.h>

#include "common/core/check.h"
#include "common/record/foxglove.h"
#include "common/record/player.h"
#include "common/record/schema.h"

namespace kiln {
namespace {

constexpr double kMinutes = 30.0;

Stamp at(double seconds) { return Stamp{} + fromSeconds(seconds); }

/// A room of 5 x 4 m around the LiDAR with 1 cm of noise, 16 lasers.
PointCloud room(int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.01);
  PointCloud cloud;
  cloud.frame = "lidar";
  for (int column = 0; column < columns; ++column) {
    const double azimuth = column * 2 * M_PI / columns;
    for (int ring = 0; ring < 16; ++ring) {
      const double elevation = (2 * ring - 15) * M_PI / 180;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double range = std::min(2.5 / std::abs(ray.x()), 2.0 / std::abs(ray.y()));
      range = std::min(range, ray.z() < 0 ? -1.2 / ray.z() : 1.8 / std::max(ray.z(), 1e-9));
      const Eigen::Vector3f p = (ray * (range + noise(random))).cast<float>();
      cloud.push(p.x(), p.y(), p.z(), static_cast<std::uint8_t>(10 + random() % 8),
                 static_cast<std::uint8_t>(ring),
                 static_cast<float>(0.1 * column / columns + 2.304e-6 * ring));
    }
  }
  return cloud;
}

/// A folder for the whole program, removed at its end.
const std::string& folder() {
  static const struct Folder {
    Folder() {
      path = (std::filesystem::temp_directory_path() / "kiln-record-bench-XXXXXX").string();
      KILN_CHECK(::mkdtemp(path.data()) != nullptr);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::string path;
  } kFolder;
  return kFolder.path;
}

/// Half an hour as the recorder would leave it, with every twelfth of a scan's columns: scans at 10
/// Hz, a thermal frame's worth of noise at 9 Hz, 50 small messages a second, a latched one at the
/// start.
const std::string& halfAnHour() {
  static const std::string kPath = [] {
    const std::string path = folder() + "/half-an-hour.mcap";
    auto writer = RecordWriter::create(path);
    KILN_CHECK(writer.has_value());
    const auto scans = (*writer)->addChannel("/lidar/scan", *protobufSchema("foxglove.PointCloud"));
    const auto frames = (*writer)->addChannel("/thermal", *protobufSchema("foxglove.RawImage"));
    const auto small = (*writer)->addChannel("/small", *protobufSchema("foxglove.Log"));
    const auto latched = (*writer)->addChannel("/latched", *protobufSchema("foxglove.Log"));
    std::vector<std::string> scan, frame;
    std::mt19937 random(1);
    for (unsigned i = 0; i < 8; ++i) {
      scan.push_back(foxglove::encode(room(150, i)));
      frame.emplace_back(20'000, '\0');
      for (char& c : frame.back()) c = static_cast<char>(random());
    }
    KILN_CHECK((*writer)->write(*latched, at(0), at(0), "map").has_value());
    for (int i = 0; i < static_cast<int>(kMinutes * 60 * 50); ++i) {
      const Stamp t = at(0.02 * i);
      KILN_CHECK((*writer)->write(*small, t, t, std::string(300, 'x')).has_value());
      if (i % 5 == 0) KILN_CHECK((*writer)->write(*scans, t, t, scan[i / 5 % 8]).has_value());
      if (i % 6 == 0) KILN_CHECK((*writer)->write(*frames, t, t, frame[i / 6 % 8]).has_value());
    }
    KILN_CHECK((*writer)->close().has_value());
    return path;
  }();
  return kPath;
}

void recordScan(benchmark::State& state) {
  const PointCloud scan = room(1800, 1);
  static int file = 0;
  auto writer = RecordWriter::create(folder() + "/scan" + std::to_string(file++) + ".mcap");
  const auto channel = (*writer)->addChannel("/lidar/scan", *protobufSchema("foxglove.PointCloud"));
  double t = 0.0;
  for (auto _ : state) {
    const std::string bytes = foxglove::encode(scan);
    KILN_CHECK((*writer)->write(*channel, at(t), at(t), bytes).has_value());
    t += 0.1;
  }
  KILN_CHECK((*writer)->flush().has_value());
  state.counters["kB_a_scan"] = 1e-3 * static_cast<double>((*writer)->bytesWritten()) /
                                static_cast<double>(state.iterations());
  const std::string path = (*writer)->path();
  writer->reset();
  std::filesystem::remove(path);
}
BENCHMARK(recordScan)->Unit(benchmark::kMillisecond);

void openWithIndex(benchmark::State& state) {
  const std::string& path = halfAnHour();
  for (auto _ : state) KILN_CHECK(RecordReader::open(path).has_value());
  state.counters["MB"] = 1e-6 * static_cast<double>(std::filesystem::file_size(halfAnHour()));
}
BENCHMARK(openWithIndex)->Unit(benchmark::kMillisecond);

void openCutOff(benchmark::State& state) {
  const std::string path = folder() + "/cut.mcap";
  std::filesystem::copy_file(halfAnHour(), path, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10'000'000);
  for (auto _ : state) KILN_CHECK(!RecordReader::open(path)->complete());
  std::filesystem::remove(path);
}
BENCHMARK(openCutOff)->Unit(benchmark::kMillisecond);

/// As the station's slider does it: jump anywhere, show the newest of every topic, go on.
void seek(benchmark::State& state) {
  ManualClock wall;
  Player player(*RecordReader::open(halfAnHour()), {}, wall);
  std::mt19937 random(7);
  for (auto _ : state) {
    player.seek(at(static_cast<double>(random() % 1'800'000) * 1e-3));
    KILN_CHECK(player.poll([](const RecordedMessage&) {}).has_value());
    player.play();
    wall.advanceBy(std::chrono::milliseconds(20));
    KILN_CHECK(player.poll([](const RecordedMessage&) {}).has_value());
  }
}
BENCHMARK(seek)->Unit(benchmark::kMillisecond);

void readOneMinute(benchmark::State& state) {
  const auto reader = RecordReader::open(halfAnHour());
  std::size_t messages = 0;
  for (auto _ : state) {
    auto cursor = reader->messages({}, at(600.0));
    for (auto m = cursor.next(); m && *m && (*m)->logged < at(660.0); m = cursor.next()) ++messages;
  }
  state.counters["messages"] =
      static_cast<double>(messages) / static_cast<double>(state.iterations());
}
BENCHMARK(readOneMinute)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kiln
