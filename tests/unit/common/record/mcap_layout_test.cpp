// The bytes of single records, written out by hand from the published format.
#include <gtest/gtest.h>

#include "common/record/mcap_decode.h"
#include "common/record/mcap_encode.h"
#include "tests/unit/common/record/sample_recording.h"

namespace kiln::mcap {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string out;
  for (const int value : values) out.push_back(static_cast<char>(value));
  return out;
}

TEST(McapLayout, ChannelRecordIsAsPublished) {
  std::string out;
  append(out, Channel{1, 2, "/a", "protobuf", {{"k", "v"}}});
  // opcode, length (8); id, schema id, topic, encoding, map of 10 bytes
  EXPECT_EQ(out, bytes({4, 36, 0, 0, 0, 0, 0, 0, 0}) + bytes({1, 0, 2, 0, 2, 0, 0, 0}) + "/a" +
                     bytes({8, 0, 0, 0}) + "protobuf" + bytes({10, 0, 0, 0, 1, 0, 0, 0}) + "k" +
                     bytes({1, 0, 0, 0}) + "v");
}

TEST(McapLayout, MessageRecordIsAsPublished) {
  std::string out;
  append(out, Message{0x0102, 3, 0x0405060708ULL, 9, "xy"});
  EXPECT_EQ(out, bytes({5, 24, 0, 0, 0, 0, 0, 0, 0}) + bytes({2, 1, 3, 0, 0, 0}) +
                     bytes({8, 7, 6, 5, 4, 0, 0, 0}) + bytes({9, 0, 0, 0, 0, 0, 0, 0}) + "xy");
}

TEST(McapLayout, CrcIsThatOfZlib) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);  // check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32("6789", crc32("12345")), 0xCBF43926u);
}

TEST(McapLayout, EachRecordSurvivesARoundTripAndNoCutOfIt) {
  std::string out;
  append(out, Statistics{5, 1, 2, 3, 0, 4, 10, 20, {{1, 2}, {7, 3}}});
  ByteReader in(out);
  const auto record = nextRecord(in);
  ASSERT_TRUE(record);
  const auto statistics = decodeStatistics(record->content);
  ASSERT_TRUE(statistics);
  EXPECT_EQ(statistics->message_count, 5u);
  EXPECT_EQ(statistics->end_time, 20u);
  EXPECT_EQ(statistics->channel_message_counts.at(7), 3u);
  for (std::size_t n = 0; n < record->content.size(); ++n)
    EXPECT_FALSE(decodeStatistics(record->content.substr(0, n))) << n;
}

TEST(McapLayout, AttachmentWithAFlippedByteIsRefused) {
  std::string out;
  append(out, Attachment{1, 2, "a.txt", "text/plain", "content"});
  ASSERT_TRUE(decodeAttachment(std::string_view(out).substr(kRecordHeadBytes)));
  out[out.size() - 6] = 'X';
  EXPECT_FALSE(decodeAttachment(std::string_view(out).substr(kRecordHeadBytes)));
}

TEST(McapLayout, FileBeginsAndEndsAsPublished) {
  const test::RecordFolder folder;
  test::writeSample(folder.file("a.mcap"), 3.0);
  const std::string file = test::readAll(folder.file("a.mcap"));
  EXPECT_TRUE(file.starts_with(kMagic));
  EXPECT_TRUE(file.ends_with(kMagic));
  EXPECT_EQ(file[8], 1);  // header
  ByteReader end(std::string_view(file).substr(file.size() - 8 - kFooterBytes - kRecordHeadBytes));
  const auto footer = nextRecord(end);
  ASSERT_TRUE(footer);
  EXPECT_EQ(footer->opcode, Opcode::Footer);
  const auto content = decodeFooter(footer->content);
  ASSERT_TRUE(content);
  // The CRC covers the summary and the footer up to itself.
  const std::string_view covered = std::string_view(file).substr(
      content->summary_start, file.size() - 12 - content->summary_start);
  EXPECT_EQ(content->summary_crc, crc32(covered));
  // The data section ends with DataEnd, whose CRC covers everything before it.
  constexpr std::size_t kDataEnd = kRecordHeadBytes + 4;
  const std::string_view data_end =
      std::string_view(file).substr(content->summary_start - kDataEnd);
  ASSERT_EQ(data_end[0], static_cast<char>(Opcode::DataEnd));
  ByteReader crc(data_end.substr(kRecordHeadBytes));
  EXPECT_EQ(crc.u32(), crc32(std::string_view(file).substr(0, content->summary_start - kDataEnd)));
}

}  // namespace
}  // namespace kiln::mcap
