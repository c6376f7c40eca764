// Files that a crash, a full disk or a bad sector has damaged.
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/record/chunk_builder.h"
#include "common/record/mcap_encode.h"
#include "common/record/run_topics.h"
#include "tests/fuzz/mutator.h"
#include "tests/support/data_dir.h"
#include "tests/unit/common/record/sample_recording.h"

namespace kiln::test {
namespace {

TEST(Recovery, FileWithoutAnEndOpensUpToItsLastChunk) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 5.0, 10.0, true);
  const std::string whole = readAll(folder.file("a.mcap"));
  std::size_t most = 0;
  bool grew = false;
  for (std::size_t n = 8; n < whole.size(); n += 7) {
    writeAll(folder.file("cut.mcap"), std::string_view(whole).substr(0, n));
    const auto reader = RecordReader::open(folder.file("cut.mcap"));
    ASSERT_TRUE(reader) << n << ": " << reader.error();
    const Collected got = collect(reader->messages());
    EXPECT_EQ(got.damaged, 0) << n;
    EXPECT_GE(got.payloads.size(), most) << n;  // more bytes never show less
    grew = grew || got.payloads.size() > most;
    most = got.payloads.size();
    // Whole seconds: a chunk is there as a whole or not at all.
    EXPECT_EQ(got.payloads.size() % 101, 0u) << n;
  }
  EXPECT_TRUE(grew);
  EXPECT_EQ(most, 505u);
}

TEST(Recovery, RecordingInProgressCanBeRead) {
  const RecordFolder folder;
  auto writer = RecordWriter::create(folder.file("a.mcap"));
  ASSERT_TRUE(writer) << writer.error();
  const auto channel = (*writer)->addChannel("/t", {"test.T", "protobuf", "s"});
  ASSERT_TRUE(channel);
  for (int i = 0; i < 35; ++i)
    ASSERT_TRUE((*writer)->write(*channel, at(0.1 * i), at(0.1 * i), "x"));
  // 3.4 s have been written in chunks of one second: three of them are out, which is what survives
  // a kill -9 at this moment.
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_FALSE(reader->complete());
  EXPECT_EQ(collect(reader->messages()).payloads.size(), 30u);
  ASSERT_TRUE((*writer)->flushIfDue(at(3.9)));  // 0.9 s old
  EXPECT_EQ(collect(RecordReader::open(folder.file("a.mcap"))->messages()).payloads.size(), 30u);
  ASSERT_TRUE((*writer)->flushIfDue(at(4.0)));
  EXPECT_EQ(collect(RecordReader::open(folder.file("a.mcap"))->messages()).payloads.size(), 35u);
}

TEST(Recovery, DamagedChunkIsNamedAndLeftOut) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 5.0);
  std::string file = readAll(folder.file("a.mcap"));
  std::size_t frame = 0;
  for (int chunk = 0; chunk < 3; ++chunk) frame = file.find("\x28\xB5\x2F\xFD", frame + 1);  // zstd
  ASSERT_NE(frame, std::string::npos);
  file[frame + 40] = static_cast<char>(file[frame + 40] ^ 0x40);
  writeAll(folder.file("b.mcap"), file);
  const auto reader = RecordReader::open(folder.file("b.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  const Collected got = collect(reader->messages());
  EXPECT_EQ(got.damaged, 1);
  EXPECT_EQ(got.payloads.size(), 404u);
}

TEST(Recovery, DamagedSummaryFallsBackToTheData) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 5.0);
  std::string file = readAll(folder.file("a.mcap"));
  file[file.size() - 60] = static_cast<char>(file[file.size() - 60] ^ 1);
  writeAll(folder.file("b.mcap"), file);
  const auto reader = RecordReader::open(folder.file("b.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_EQ(collect(reader->messages()).payloads.size(), 505u);
  EXPECT_EQ(reader->topics().at(0).messages, 500u);
}

TEST(Recovery, OtherFilesAreRefusedInWords) {
  const RecordFolder folder;
  for (const std::string_view content : {"", "short", "not an MCAP file, but long enough"}) {
    writeAll(folder.file("x"), content);
    const auto reader = RecordReader::open(folder.file("x"));
    ASSERT_FALSE(reader);
    EXPECT_EQ(reader.error().code, ErrorCode::InvalidInput);
  }
  EXPECT_EQ(RecordReader::open(folder.file("absent")).error().code, ErrorCode::NotFound);
}

TEST(Recovery, FifosFoldersAndDevicesAreRefusedAtOnce) {
  const RecordFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("fifo").c_str(), 0600), 0);
  for (const std::string& path :
       {folder.file("fifo"), folder.file("."), std::string("/dev/zero")}) {
    const auto reader = RecordReader::open(path);
    ASSERT_FALSE(reader) << path;
    EXPECT_NE(reader.error().message.find("not a file"), std::string::npos) << reader.error();
  }
}

TEST(Recovery, NoDamageCrashesTheReader) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 3.0);
  const std::string whole = readAll(folder.file("a.mcap"));
  const fuzz::Bytes original(whole.begin(), whole.end());
  int opened = 0, messages = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    fuzz::Mutator mutator(seed);
    const fuzz::Bytes damaged = mutator.mutate(original);
    writeAll(folder.file("d.mcap"),
             std::string_view(reinterpret_cast<const char*>(damaged.data()), damaged.size()));
    const auto reader = RecordReader::open(folder.file("d.mcap"));
    if (!reader) continue;
    ++opened;
    const Collected got = collect(reader->messages({}, at(0.01 * static_cast<double>(seed))));
    messages += static_cast<int>(got.payloads.size());
    EXPECT_TRUE(std::is_sorted(got.times.begin(), got.times.end())) << seed;
    (void)reader->newestBefore(at(11.5));
    (void)reader->attachment("notes.txt");
  }
  EXPECT_GT(opened, 1000);
  EXPECT_GT(messages, 10000);
}

TEST(Recovery, MessagesOutsideOfChunksAreRead) {
  const RecordFolder folder;
  std::string file(mcap::kMagic);
  mcap::append(file, mcap::Channel{1, 0, "/t", "raw", {}});
  for (std::uint64_t i = 0; i < 200'000; ++i)  // 6.8 MB: several runs of 2 MiB
    mcap::append(file, mcap::Message{1, 0, i * 1'000'000, i * 1'000'000, "abc"});
  writeAll(folder.file("a.mcap"), file);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_EQ(collect(reader->messages()).payloads.size(), 200'000u);
  EXPECT_EQ(reader->end(), at(199.999));
}

TEST(Recovery, OneMessageOfAnotherTimeDoesNotStretchTheTimeLine) {
  const RecordFolder folder;
  auto writer = RecordWriter::create(folder.file("a.mcap"));
  ASSERT_TRUE(writer) << writer.error();
  const auto channel = (*writer)->addChannel("/t", {"test.T", "protobuf", "s"});
  ASSERT_TRUE(channel);
  for (int i = 0; i < 200; ++i)
    ASSERT_TRUE((*writer)->write(*channel, at(i == 50 ? 0.0 : 5000 + 0.01 * i), at(1), "x"));
  ASSERT_TRUE((*writer)->close());
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_EQ(reader->start(), at(5000));
  EXPECT_EQ(collect(reader->messages()).payloads.size(), 199u);
  EXPECT_NE(reader->defects().find("1 messages"), std::string::npos) << reader->defects();
}

TEST(Recovery, ChunksThatClaimMuchAreNamedAndCostTheirSizeInTheFile) {
  const RecordFolder folder;
  std::string file(mcap::kMagic);
  mcap::append(file, mcap::Channel{1, 0, "/t", "raw", {}});
  mcap::append(file, mcap::Chunk{1, 2, (32u << 20) + 1, 0, "lz4", "abc"});
  writeAll(folder.file("a.mcap"), file);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  auto cursor = reader->messages();
  const auto message = cursor.next();
  ASSERT_FALSE(message);
  EXPECT_NE(message.error().message.find("over 32 MiB"), std::string::npos);
}

/// Largest memory of this process so far, MiB.
double peakMiB() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0.0;
  while (status >> word)
    if (word == "VmHWM:") status >> kib;
  return kib / 1024.0;
}

TEST(Recovery, ChunksThatAllOverlapCostNoMoreThanAFewAndTheRestIsNamed) {
  constexpr int kChunks = 20;
  const RecordFolder folder;
  std::string file(mcap::kMagic);
  mcap::append(file, mcap::Channel{1, 0, "/t", "raw", {}});
  {
    const std::string zeros(10u << 20, '\0');  // 200 MiB in all, some 20 kB in the file
    ChunkBuilder chunk(1);
    for (std::uint32_t i = 0; i < kChunks; ++i) {
      chunk.add({1, i, 1000 + i, 1000 + i, zeros});
      chunk.add({1, i, 9000 + i, 9000 + i, "end"});
      file += chunk.close(file.size()).bytes;
    }
  }
  EXPECT_LT(file.size(), 1u << 20);
  writeAll(folder.file("a.mcap"), file);
  const double before_MiB = peakMiB();
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  auto cursor = reader->messages();
  int left_out = 0, ends = 0;
  for (;;) {
    const auto message = cursor.next();
    if (!message) {
      EXPECT_NE(message.error().message.find("overlap in time"), std::string::npos);
      ASSERT_LE(++left_out, kChunks);
      continue;
    }
    if (!*message) break;
    ends += (*message)->data == "end" ? 1 : 0;
  }
  EXPECT_EQ(left_out + ends, kChunks);
  EXPECT_GE(ends, 4);  // of what fits into 48 MiB
  EXPECT_LT(peakMiB() - before_MiB, 110.0);
}

TEST(Recovery, UnreadCompressionIsRefusedByItsName) {
  const RecordFolder folder;
  std::string file(mcap::kMagic);
  mcap::append(file, mcap::Chunk{1, 2, 3, 0, "brotli", "abc"});
  writeAll(folder.file("a.mcap"), file);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("compressed with brotli"), std::string::npos);
}

TEST(RecordingsOnDisk, HaveTheirOutcomes) {
  const auto cases = testing::dataFile("../cases/mcap");
  if (!cases) GTEST_SKIP() << "no cases here: set KILN_DATA_DIR";
  for (const auto& entry : std::filesystem::directory_iterator(*cases)) {
    const std::string name = entry.path().filename().string();
    const auto reader = RecordReader::open(entry.path().string());
    ASSERT_TRUE(reader) << reader.error();
    const auto scan = run::requireMessages(*reader, run::kLidarScan);
    const bool refused = name == "no_scans.mcap" || name == "another_robot.mcap";
    EXPECT_EQ(scan.has_value(), !refused) << name;
    if (!refused) {
      EXPECT_LT(toSeconds(reader->end() - reader->start()), 3.0) << name;
    }
    std::printf("%-26s %zu messages, %s %s\n", name.c_str(),
                collect(reader->messages()).payloads.size(), reader->defects().c_str(),
                scan ? "" : scan.error().message.c_str());
  }
}

}  // namespace
}  // namespace kiln::test
