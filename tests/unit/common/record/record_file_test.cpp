#include <algorithm>
#include <csignal>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/unit/common/record/sample_recording.h"

namespace kiln::test {
namespace {

TEST(Recording, GivesBackWhatWasWrittenInOrder) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 5.0);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->start(), at(10.0));
  EXPECT_EQ(reader->end(), at(14.99));
  const auto topics = reader->topics();
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[0].topic, "/fast");
  EXPECT_EQ(topics[0].schema, "test.Fast");
  EXPECT_EQ(topics[0].messages, 500u);
  EXPECT_EQ(topics[1].messages, 5u);
  EXPECT_EQ(reader->schema("test.Slow"), "slow schema");
  EXPECT_EQ(reader->attachment("notes.txt"), "kiln");
  EXPECT_FALSE(reader->attachment("other.txt"));
  const Collected all = collect(reader->messages());
  ASSERT_EQ(all.payloads.size(), 505u);
  EXPECT_EQ(all.payloads[0], "/fast 0");
  EXPECT_EQ(all.payloads[1], "/slow 0");
  EXPECT_EQ(all.payloads.back(), "/fast 499");
  EXPECT_TRUE(std::is_sorted(all.times.begin(), all.times.end()));
}

TEST(Recording, SeeksAndFiltersTopics) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 60.0);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  const Collected slow = collect(reader->messages({"/slow"}, at(30.5)));
  ASSERT_EQ(slow.payloads.size(), 39u);  // from second 31 (number 21) to number 59
  EXPECT_EQ(slow.payloads.front(), "/slow 21");
  auto cursor = reader->messages({"/fast"});
  for (const double t : {69.0, 10.0, 42.345, 25.0}) {  // to and fro
    cursor.seek(at(t));
    const auto message = cursor.next();
    ASSERT_TRUE(message && *message);
    EXPECT_GE((*message)->logged, at(t));
    EXPECT_LT((*message)->logged, at(t + 0.0101));
  }
  cursor.seek(at(1000.0));
  const auto end = cursor.next();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->has_value());
  EXPECT_TRUE(collect(reader->messages({"/nobody"})).payloads.empty());
}

TEST(Recording, NewestBeforeShowsEachTopicOnce) {
  const RecordFolder folder;
  writeSample(folder.file("a.mcap"), 20.0);
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  const auto newest = reader->newestBefore(at(15.955));
  ASSERT_EQ(newest.size(), 2u);
  EXPECT_EQ(newest[0].data, "/slow 5");
  EXPECT_EQ(newest[1].data, "/fast 595");
  EXPECT_TRUE(reader->newestBefore(at(9.0)).empty());
  EXPECT_EQ(reader->newestBefore(at(10.0)).size(), 2u);
}

TEST(Recording, MergesMessagesThatWereLoggedOutOfOrder) {
  const RecordFolder folder;
  {
    auto writer = RecordWriter::create(folder.file("a.mcap"), {.chunk_bytes = 400});
    ASSERT_TRUE(writer) << writer.error();
    const auto channel = (*writer)->addChannel("/t", {"test.T", "protobuf", ""});
    ASSERT_TRUE(channel);
    for (int i = 0; i < 300; ++i) {  // forwards in steps of 7 ms, with every third 40 ms late
      const double t = 1.0 + 0.007 * i - (i % 3 == 0 ? 0.04 : 0.0);
      ASSERT_TRUE((*writer)->write(*channel, at(t), at(t), std::to_string(i)));
    }
  }  // closed by its destructor
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  const Collected all = collect(reader->messages());
  EXPECT_EQ(all.payloads.size(), 300u);
  EXPECT_TRUE(std::is_sorted(all.times.begin(), all.times.end()));
  const Collected late = collect(reader->messages({}, at(2.0)));
  EXPECT_EQ(late.times.front(), *std::lower_bound(all.times.begin(), all.times.end(), at(2.0)));
}

TEST(Recording, EmptyOneIsAFileToo) {
  const RecordFolder folder;
  { ASSERT_TRUE(RecordWriter::create(folder.file("a.mcap"))); }
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->empty());
  EXPECT_TRUE(reader->complete());
  EXPECT_TRUE(collect(reader->messages()).payloads.empty());
  EXPECT_TRUE(reader->newestBefore(at(1.0)).empty());
}

TEST(Recording, NeverWritesOverAFile) {
  const RecordFolder folder;
  writeAll(folder.file("a.mcap"), "mine");
  const auto writer = RecordWriter::create(folder.file("a.mcap"));
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::Storage);
  EXPECT_EQ(readAll(folder.file("a.mcap")), "mine");
}

TEST(Recording, RefusesWhatCannotBeRecorded) {
  const RecordFolder folder;
  auto writer = RecordWriter::create(folder.file("a.mcap"));
  ASSERT_TRUE(writer) << writer.error();
  EXPECT_FALSE((*writer)->write(7, at(1), at(1), "no such channel"));
  const auto channel = (*writer)->addChannel("/t", {"test.T", "protobuf", ""});
  ASSERT_TRUE(channel);
  EXPECT_FALSE((*writer)->write(*channel, at(-1), at(1), "before time"));
  ASSERT_TRUE((*writer)->close());
  EXPECT_FALSE((*writer)->write(*channel, at(1), at(1), "too late"));
  EXPECT_FALSE((*writer)->close());
}

/// A limit on the size of files does to the writer what a full disk does.
TEST(Recording, FullDiskIsAnErrorAndKeepsWhatIsThere) {
  const RecordFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  auto writer = RecordWriter::create(folder.file("a.mcap"), {.chunk_bytes = 4096});
  ASSERT_TRUE(writer) << writer.error();
  const auto channel = (*writer)->addChannel("/t", {"test.T", "protobuf", ""});
  ASSERT_TRUE(channel);
  const rlimit small{50'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::mt19937 random(1);
  Result<void> written;
  int count = 0;
  for (; written && count < 1000; ++count) {
    std::string noise(1000, 0);
    for (char& c : noise) c = static_cast<char>(random());
    written = (*writer)->write(*channel, at(0.001 * count), at(0.001 * count), noise);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::Storage);
  ASSERT_TRUE((*writer)->close());  // there is space again: the index of what was kept
  const auto reader = RecordReader::open(folder.file("a.mcap"));
  ASSERT_TRUE(reader) << reader.error();
  EXPECT_TRUE(reader->complete());
  const Collected got = collect(reader->messages());
  EXPECT_EQ(got.damaged, 0);
  EXPECT_GE(got.payloads.size(), 40u);
  EXPECT_LT(got.payloads.size(), static_cast<std::size_t>(count));
}

}  // namespace
}  // namespace kiln::test
