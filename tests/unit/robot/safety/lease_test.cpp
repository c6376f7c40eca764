#include "robot/safety/lease.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;

Stamp at(double s) { return Stamp{fromSeconds(s)}; }
Lease::Requester who(const char* id, ClientRole role = ClientRole::Operator,
                     std::uint64_t nonce = 1) {
  return {id, id, role, nonce};
}

TEST(Lease, IsGrantedOnceAndNamesItsHolder) {
  Lease lease({});
  EXPECT_EQ(lease.acquire(who("anna"), false, at(0)).outcome, Lease::Outcome::Granted);
  const auto denied = lease.acquire(who("ben"), false, at(0.1));
  EXPECT_EQ(denied.outcome, Lease::Outcome::Refused);
  EXPECT_EQ(denied.code, "lease_held");
  EXPECT_THAT(denied.reason, HasSubstr("anna"));
  EXPECT_TRUE(lease.holds("anna", 1));
  EXPECT_FALSE(lease.holds("anna", 0));
  EXPECT_FALSE(lease.holds("ben", 1));
}

TEST(Lease, HeartbeatsKeepItAndSilenceLosesIt) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  for (int i = 1; i <= 50; ++i) {  // until 10 s
    lease.heard("anna", at(0.2 * i));
    EXPECT_TRUE(lease.tick(at(0.2 * i)).empty());
  }
  EXPECT_TRUE(lease.tick(at(11.9)).empty());
  const auto events = lease.tick(at(12.1));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Lease::Event::Kind::Lost);
  EXPECT_TRUE(lease.status(at(12.1)).holder_client.empty());
}

TEST(Lease, AnothersHeartbeatDoesNotKeepIt) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  lease.heard("ben", at(1.9));
  EXPECT_EQ(lease.tick(at(2.1)).size(), 1u);
}

TEST(Lease, EachGrantHasItsOwnEpoch) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  static_cast<void>(lease.release("anna", at(1)));
  static_cast<void>(lease.acquire(who("anna"), false, at(2)));
  EXPECT_FALSE(lease.holds("anna", 1));
  EXPECT_TRUE(lease.holds("anna", 2));
}

TEST(Lease, TakeOverIsDeniedWhenALivingHolderStaysSilent) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  EXPECT_EQ(lease.acquire(who("ben", ClientRole::Operator, 9), true, at(0)).outcome,
            Lease::Outcome::Asked);
  for (double t = 0.2; t < 9.9; t += 0.2) {
    lease.heard("anna", at(t));
    EXPECT_TRUE(lease.tick(at(t)).empty());
  }
  EXPECT_EQ(lease.status(at(5)).requested_by_name, "ben");
  lease.heard("anna", at(10));
  const auto events = lease.tick(at(10));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Lease::Event::Kind::Denied);
  EXPECT_EQ(events[0].who.nonce, 9u);
  EXPECT_TRUE(lease.holds("anna", 1));
}

TEST(Lease, TakeOverSucceedsWhenTheHolderDies) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  static_cast<void>(lease.acquire(who("ben"), true, at(0.5)));
  const auto events = lease.tick(at(2.1));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, Lease::Event::Kind::Lost);
  EXPECT_EQ(events[1].kind, Lease::Event::Kind::Granted);
  EXPECT_TRUE(lease.holds("ben", 2));
}

TEST(Lease, HolderMayKeepOrHandOver) {
  Lease keep({});
  static_cast<void>(keep.acquire(who("anna"), false, at(0)));
  static_cast<void>(keep.acquire(who("ben"), true, at(0)));
  EXPECT_EQ(keep.acquire(who("anna"), false, at(1)).outcome, Lease::Outcome::Granted);
  EXPECT_EQ(keep.tick(at(1)).at(0).kind, Lease::Event::Kind::Denied);
  EXPECT_TRUE(keep.holds("anna", 1));

  Lease hand({});
  static_cast<void>(hand.acquire(who("anna"), false, at(0)));
  static_cast<void>(hand.acquire(who("ben"), true, at(0)));
  static_cast<void>(hand.release("anna", at(1)));
  EXPECT_TRUE(hand.holds("ben", 2));
}

TEST(Lease, SupervisorPreempts) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  EXPECT_EQ(lease.acquire(who("chief", ClientRole::Supervisor), true, at(0.1)).outcome,
            Lease::Outcome::Granted);
  EXPECT_TRUE(lease.holds("chief", 2));
  EXPECT_EQ(lease.tick(at(0.1)).at(0).who.client_id, "anna");
}

TEST(Lease, RevokeFreesItAndDeniesWhoWasWaiting) {
  Lease lease({});
  static_cast<void>(lease.acquire(who("anna"), false, at(0)));
  static_cast<void>(lease.acquire(who("ben"), true, at(0)));
  lease.revoke("STOP by guest");
  const auto events = lease.tick(at(0.1));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(lease.status(at(0.1)).holder_client.empty());
  EXPECT_EQ(lease.release("anna", at(0.2)).code, "not_holder");
}

}  // namespace
}  // namespace kiln
