#include "robot/app/instance_lock.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace kiln {
namespace {

class InstanceLockTest : public testing::Test {
 protected:
  void SetUp() override { folder_ = testing::TempDir() + "kiln-lock-" + std::to_string(getpid()); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string folder_;
};

TEST_F(InstanceLockTest, RefusesASecondHolderAndNamesTheFirst) {
  const auto first = InstanceLock::acquire(folder_);
  ASSERT_TRUE(first.has_value()) << first.error();
  const auto second = InstanceLock::acquire(folder_);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::Refused);
  EXPECT_NE(second.error().message.find(std::to_string(getpid())), std::string::npos)
      << second.error();
}

TEST_F(InstanceLockTest, IsFreeAgainAfterItsHolder) {
  { const auto first = InstanceLock::acquire(folder_); }
  EXPECT_TRUE(InstanceLock::acquire(folder_).has_value());
}

TEST_F(InstanceLockTest, SaysWhichFolderCannotBeWritten) {
  const auto lock = InstanceLock::acquire("/proc/kiln");
  ASSERT_FALSE(lock.has_value());
  EXPECT_EQ(lock.error().code, ErrorCode::Storage);
  EXPECT_NE(lock.error().message.find("/proc/kiln"), std::string::npos);
}

}  // namespace
}  // namespace kiln
