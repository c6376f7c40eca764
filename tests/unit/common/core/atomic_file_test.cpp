#include "common/core/atomic_file.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/core/regular_file.h"

namespace kiln {
namespace {

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("kiln-atomic-{}", getpid());
};

TEST_F(AtomicFile, ReplacesARegularFileAndNothingElse) {
  ASSERT_TRUE(writeFileAtomically(file("a"), "first").has_value());
  ASSERT_TRUE(writeFileAtomically(file("a"), "second").has_value());
  EXPECT_EQ(readRegularFile(file("a"), 100).value(), "second");
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(file("folder"));
  for (const char* name : {"pipe", "folder"}) {
    const auto written = writeFileAtomically(file(name), "text");
    ASSERT_FALSE(written.has_value()) << name;
    EXPECT_NE(written.error().message.find("not a regular file"), std::string::npos)
        << written.error();
  }
  EXPECT_TRUE(std::filesystem::is_fifo(file("pipe")));
}

TEST_F(AtomicFile, ALinkStaysALinkAndItsTargetIsReplaced) {
  ASSERT_TRUE(writeFileAtomically(file("target"), "old").has_value());
  std::filesystem::create_symlink("target", file("link"));
  ASSERT_TRUE(writeFileAtomically(file("link"), "new").has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(file("link")));
  EXPECT_EQ(readRegularFile(file("target"), 100).value(), "new");
  std::filesystem::create_symlink("/dev/full", file("device"));
  EXPECT_FALSE(writeFileAtomically(file("device"), "new").has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(file("device")));
}

}  // namespace
}  // namespace kiln
