#include "robot/app/alarm_book.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

void raise(AlarmBook& book, const std::string& id, bool active, int second) {
  book.set(id, active, AlarmLevel::Caution, id + " text", "do",
           Stamp{std::chrono::seconds(second)});
}

TEST(AlarmBook, KeepsTheFirstTimeWhileTheConditionLasts) {
  AlarmBook book;
  raise(book, "a", true, 1);
  raise(book, "a", true, 5);
  ASSERT_EQ(book.list().size(), 1U);
  EXPECT_EQ(book.list()[0].since, Stamp{std::chrono::seconds(1)});
}

TEST(AlarmBook, KeepsAnEndedAlarmUntilItIsAcknowledged) {
  AlarmBook book;
  raise(book, "a", true, 1);
  raise(book, "a", false, 2);
  ASSERT_EQ(book.list().size(), 1U);
  EXPECT_FALSE(book.list()[0].active);
  EXPECT_TRUE(book.acknowledge("a"));
  EXPECT_TRUE(book.list().empty());
}

TEST(AlarmBook, KeepsAnAcknowledgedAlarmWhileItIsActive) {
  AlarmBook book;
  raise(book, "a", true, 1);
  EXPECT_TRUE(book.acknowledge("a"));
  ASSERT_EQ(book.list().size(), 1U);
  EXPECT_TRUE(book.list()[0].acknowledged);
  raise(book, "a", false, 3);
  EXPECT_TRUE(book.list().empty());
}

TEST(AlarmBook, ListsTheFirstCauseFirst) {
  AlarmBook book;
  raise(book, "z", true, 1);
  raise(book, "a", true, 2);
  EXPECT_EQ(book.list()[0].id, "z");
}

TEST(AlarmBook, SaysThatAnUnknownAlarmIsUnknown) {
  EXPECT_FALSE(AlarmBook().acknowledge("nothing"));
}

}  // namespace
}  // namespace kiln
