#include "common/core/log.h"

#include <mutex>
#include <vector>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(Log, EveryLoggerReachesAnAddedSinkWithNameAndLevel) {
  std::vector<LogRecord> records;
  std::mutex mutex;
  LogSinkHandle sink = addLogSink([&](const LogRecord& record) {
    const std::lock_guard lock(mutex);
    records.push_back(record);
  });
  logger("test.before")->info("one {}", 1);
  logger("test.after")->warn("two");
  logger("test.after")->debug("below the level, not delivered");
  sink.reset();
  logger("test.before")->info("after the sink was taken away");
  const std::lock_guard lock(mutex);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].logger, "test.before");
  EXPECT_EQ(records[0].level, 2);
  EXPECT_EQ(records[0].text, "one 1");
  EXPECT_EQ(records[1].logger, "test.after");
  EXPECT_EQ(records[1].level, 3);
}

TEST(Log, ReturnsTheSameLoggerForTheSameName) {
  EXPECT_EQ(logger("test.same"), logger("test.same"));
}

}  // namespace
}  // namespace kiln
