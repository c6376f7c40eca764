#include "common/client/link_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;

Monotonic::time_point at(double s) {
  return Monotonic::time_point(
      std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(s)));
}
LinkReport report(const LinkWatch& watch, double s) {
  LinkReport out;
  watch.report(at(s), out);
  return out;
}
LinkWatch connectedAt(double s) {
  LinkWatch watch(0.5, 1.5);
  watch.accepted();
  watch.heard(at(s));
  watch.robotHeardUs(0.01, at(s));
  return watch;
}

TEST(LinkWatch, GoesFromConnectedOverDegradedToLost) {
  const LinkWatch watch = connectedAt(10.0);
  EXPECT_EQ(report(watch, 10.1).state, LinkState::Connected);
  EXPECT_EQ(report(watch, 10.7).state, LinkState::Degraded);
  EXPECT_EQ(report(watch, 11.6).state, LinkState::Lost);
  EXPECT_THAT(report(watch, 11.6).reason, HasSubstr("nothing heard"));
}

TEST(LinkWatch, NamesTheDeafSide) {
  LinkWatch watch = connectedAt(10.0);
  watch.heard(at(11.9));  // status goes on arriving, our heartbeats are not answered
  const LinkReport lost = report(watch, 12.0);
  EXPECT_EQ(lost.state, LinkState::Lost);
  EXPECT_THAT(lost.reason, HasSubstr("does not hear us"));
}

TEST(LinkWatch, RefusalIsShownUntilAccepted) {
  LinkWatch watch(0.5, 1.5);
  EXPECT_EQ(report(watch, 0.0).state, LinkState::Connecting);
  watch.heard(at(1.0));
  watch.refused("another mission");
  EXPECT_EQ(report(watch, 1.1).state, LinkState::Refused);
  EXPECT_EQ(report(watch, 1.1).reason, "another mission");
  watch.accepted();
  EXPECT_EQ(report(watch, 1.2).state, LinkState::Connecting);  // until a heartbeat has come back
  watch.robotHeardUs(0.01, at(1.3));
  watch.heard(at(1.3));
  EXPECT_EQ(report(watch, 1.4).state, LinkState::Connected);
}

}  // namespace
}  // namespace kiln
