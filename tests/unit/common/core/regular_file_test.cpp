#include "common/core/regular_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace kiln {
namespace {

class RegularFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("kiln-regular-{}", getpid());
};

TEST_F(RegularFile, IsReadWholeUpToItsBound) {
  const std::string text(10'000, 'x');
  std::ofstream(file("a")) << text;
  EXPECT_EQ(readRegularFile(file("a"), 10'000).value(), text);
  const auto longer = readRegularFile(file("a"), 9'999);
  ASSERT_FALSE(longer.has_value());
  EXPECT_EQ(longer.error().code, ErrorCode::InvalidInput);
  std::ofstream(file("empty")) << "";
  EXPECT_EQ(readRegularFile(file("empty"), 1).value(), "");
}

TEST_F(RegularFile, WhatIsNoneIsRefusedAtOnceByName) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  for (const std::string& path : {file("pipe"), folder_.string(), std::string("/dev/zero")}) {
    const auto read = readRegularFile(path, 1000);
    ASSERT_FALSE(read.has_value()) << path;
    EXPECT_EQ(read.error().code, ErrorCode::InvalidInput) << path;
    EXPECT_NE(read.error().message.find(path), std::string::npos) << read.error();
  }
  EXPECT_EQ(readRegularFile(file("nowhere"), 1000).error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace kiln
