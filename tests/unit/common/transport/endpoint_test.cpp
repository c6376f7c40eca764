#include "common/transport/endpoint.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;

TEST(Endpoint, UsesFourPortsInARow) {
  const auto addresses = parseEndpoint("tcp://127.0.0.1:7300");
  ASSERT_TRUE(addresses.has_value()) << addresses.error();
  EXPECT_EQ(addresses->command, "tcp://127.0.0.1:7300");
  EXPECT_EQ(addresses->stop, "tcp://127.0.0.1:7303");
}

TEST(Endpoint, RefusesEveryAddressThatOthersCanReach) {
  for (const char* address :
       {"tcp://0.0.0.0:7300", "tcp://*:7300", "tcp://192.168.1.5:7300", "tcp://eth0:7300",
        "tcp://[::]:7300", "tcp://127.evil.example:7300", "tcp://localhost.example:7300",
        "udp://127.0.0.1:7300", "pgm://x", ""}) {
    const auto refused = parseEndpoint(address);
    ASSERT_FALSE(refused.has_value()) << address;
    EXPECT_EQ(refused.error().code, ErrorCode::Refused) << address;
    EXPECT_THAT(refused.error().message, HasSubstr("keys")) << address;
  }
}

TEST(Endpoint, NamesWhatIsWrongWithThePort) {
  for (const char* address : {"tcp://127.0.0.1", "tcp://127.0.0.1:", "tcp://127.0.0.1:0",
                              "tcp://127.0.0.1:65535", "tcp://127.0.0.1:73x0"}) {
    const auto wrong = parseEndpoint(address);
    ASSERT_FALSE(wrong.has_value()) << address;
    EXPECT_EQ(wrong.error().code, ErrorCode::InvalidInput) << address;
  }
}

TEST(Endpoint, ChecksIpcPaths) {
  EXPECT_TRUE(parseEndpoint("ipc:///tmp/bob").has_value());
  EXPECT_FALSE(parseEndpoint("ipc://bob").has_value());
  EXPECT_FALSE(parseEndpoint("ipc:///no/such/folder/bob").has_value());
  EXPECT_FALSE(parseEndpoint("ipc:///tmp/" + std::string(120, 'x')).has_value());
}

TEST(Endpoint, LockHoldsUntilItsOwnerIsGone) {
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("kiln-lock-{}", ::getpid());
  std::filesystem::create_directories(folder);
  const std::string prefix = (folder / "bob").string();
  {
    const auto first = IpcLock::acquire(prefix);
    ASSERT_TRUE(first.has_value()) << first.error();
    const auto second = IpcLock::acquire(prefix);
    ASSERT_FALSE(second.has_value());
    EXPECT_THAT(second.error().message, HasSubstr("in use"));
  }
  EXPECT_TRUE(IpcLock::acquire(prefix).has_value());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace kiln
