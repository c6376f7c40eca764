#include "robot/world_model/checkpoint_writer.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "common/core/regular_file.h"

namespace kiln {
namespace {

class CheckpointWriterTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("kiln_writer_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "checkpoint").string();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  std::string path_;
};

TEST_F(CheckpointWriterTest, KeepsTheNewestText) {
  CheckpointWriter writer(path_);
  for (int i = 0; i < 100; ++i) writer.write(std::to_string(i), i % 10 == 0);
  writer.flush();
  EXPECT_EQ(readRegularFile(path_, 1000).value(), "99");
  EXPECT_FALSE(writer.problem().has_value());
  EXPECT_FALSE(std::filesystem::exists(path_ + ".tmp"));
}

TEST_F(CheckpointWriterTest, WritesTheLastTextBeforeItEnds) {
  { CheckpointWriter(path_).write("last words", false); }
  EXPECT_EQ(readRegularFile(path_, 1000).value(), "last words");
}

TEST_F(CheckpointWriterTest, AFullDiskIsAStorageErrorAndLeavesTheOldFile) {
  CheckpointWriter writer(path_);
  writer.write("old", true);
  writer.flush();
  std::filesystem::create_symlink("/dev/full", path_ + ".tmp");  // writing says: no space left
  writer.write("new", true);
  writer.flush();
  ASSERT_TRUE(writer.problem().has_value());
  EXPECT_EQ(writer.problem()->code, ErrorCode::Storage);
  EXPECT_NE(writer.problem()->message.find("No space left"), std::string::npos)
      << writer.problem()->message;
  EXPECT_EQ(readRegularFile(path_, 1000).value(), "old");
  std::filesystem::remove(path_ + ".tmp");
  writer.write("newer", true);
  writer.flush();
  EXPECT_FALSE(writer.problem().has_value());
  EXPECT_EQ(readRegularFile(path_, 1000).value(), "newer");
}

TEST_F(CheckpointWriterTest, AMissingFileIsNotFound) {
  EXPECT_EQ(readRegularFile(path_, 1000).error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace kiln
