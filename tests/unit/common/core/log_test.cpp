#include "common/core/log.h"

#include <mutex>
#include <vector>

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(Log, EveryLoggerReachesAnAddedSinkWithNameAndLevel) {
  // Static: a sink stays for the process, as the station's event log does.
  static std::vector<LogRecord> records;
  static std::mutex mutex;
  addLogSink([](const LogRecord& record) {
    const std::lock_guard lock(mutex);
    records.push_back(record);
  });
  logger("test.before")->info("one {}", 1);
  logger("test.after")->warn("two");
  logger("test.after")->debug("below the level, not delivered");
  const std::lock_guard lock(mutex);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].logger, "test.before");
  EXPECT_EQ(records[0].level, 2);
  EXPECT_EQ(records[0].text, "one 1");
  EXPECT_EQ(records[1].logger, "test.after");
  EXPECT_EQ(records[1].level, 3);
}

TEST(Log, ReturnsTheSameLoggerForTheSameName) {
  EXPECT_EQ(logger("test.same").get(), logger("test.same").get());
}

}  // namespace
}  // namespace kiln
