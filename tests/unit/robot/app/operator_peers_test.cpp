#include "robot/app/operator_peers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Hello helloOf(const std::string& id, std::uint64_t key = 0,
              ClientRole role = ClientRole::Operator) {
  Hello hello;
  hello.version = "1";
  hello.client_id = id;
  hello.operator_name = id + "'s name";
  hello.role = role;
  hello.key = key;
  return hello;
}

struct Door {
  OperatorPeers peers{"Bob", "1", 30.0};
  double now_s = 100.0;
  Monotonic::time_point at() const {
    return Monotonic::time_point(
        std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(now_s)));
  }
  std::string hello(PeerId from, const Hello& hello) {
    return peers.hello(from, hello, "m", Stamp{fromSeconds(now_s)}, at());
  }
  void close(PeerId peer) { peers.closed(peer, at()); }
  void wait(double s) {
    now_s += s;
    (void)peers.tick(at());
  }
  const OperatorPeer* find(PeerId from) {
    return peers.heard(from, Stamp{fromSeconds(now_s)}, at());
  }
};

TEST(OperatorPeers, NobodyElseGetsAnIdThatIsConnected) {
  Door door;
  EXPECT_THAT(door.hello(1, helloOf("anna", 7)), IsEmpty());
  EXPECT_THAT(door.hello(2, helloOf("anna")), HasSubstr("client id"));
  EXPECT_THAT(door.hello(2, helloOf("anna", 8)), HasSubstr("client id"));
  EXPECT_EQ(door.peers.connectionOf("anna"), 1u);
  EXPECT_EQ(door.find(2), nullptr);
}

TEST(OperatorPeers, ASecondHelloChangesNothingAndForgetsNobody) {
  Door door;
  EXPECT_THAT(door.hello(1, helloOf("anna", 0, ClientRole::Viewer)), IsEmpty());
  EXPECT_THAT(door.hello(1, helloOf("anna", 0, ClientRole::Viewer)), IsEmpty());  // a repetition
  EXPECT_THAT(door.hello(1, helloOf("anna", 0, ClientRole::Supervisor)), HasSubstr("second hello"));
  EXPECT_THAT(door.hello(1, helloOf("ben")), HasSubstr("second hello"));
  Hello elsewhere = helloOf("anna", 0, ClientRole::Viewer);
  elsewhere.expected_mission_uuid = "other";
  EXPECT_THAT(door.hello(1, elsewhere), HasSubstr("mission"));
  ASSERT_NE(door.find(1), nullptr);
  EXPECT_EQ(door.find(1)->role, ClientRole::Viewer);
  EXPECT_EQ(door.find(1)->client_id, "anna");
}

TEST(OperatorPeers, AClientComesBackByItsKeyAndNobodyElseAsIt) {
  Door door;
  EXPECT_THAT(door.hello(1, helloOf("anna", 7)), IsEmpty());
  EXPECT_THAT(door.hello(2, helloOf("anna", 7)), IsEmpty());  // the old connection has hung
  EXPECT_EQ(door.peers.connectionOf("anna"), 2u);
  EXPECT_EQ(door.find(1), nullptr);
  door.close(1);
  EXPECT_EQ(door.peers.connectionOf("anna"), 2u);
  door.close(2);
  door.wait(20.0);
  EXPECT_THAT(door.hello(3, helloOf("anna")), HasSubstr("client id"));
  EXPECT_THAT(door.hello(3, helloOf("anna", 8)), HasSubstr("client id"));
  EXPECT_THAT(door.hello(4, helloOf("anna", 7)), IsEmpty());
}

TEST(OperatorPeers, AnIdWithoutAKeyIsKeptUntilItsLeaseIsOver) {
  Door door;
  EXPECT_THAT(door.hello(1, helloOf("anna")), IsEmpty());
  door.close(1);
  door.wait(2.1);
  EXPECT_THAT(door.hello(2, helloOf("anna")), HasSubstr("client id"));
  door.wait(1.0);
  EXPECT_THAT(door.hello(2, helloOf("anna")), IsEmpty());
}

TEST(OperatorPeers, InAFullListWhoIsSilentMakesRoomAndNobodyElse) {
  Door door;
  for (PeerId i = 1; i <= 32; ++i)
    EXPECT_THAT(door.hello(i, helloOf("client " + std::to_string(i))), IsEmpty());
  EXPECT_THAT(door.hello(33, helloOf("late")), HasSubstr("32 clients"));
  door.now_s += 2.1;
  for (PeerId i = 2; i <= 32; ++i) EXPECT_NE(door.find(i), nullptr);
  EXPECT_THAT(door.hello(33, helloOf("late")), IsEmpty());
  EXPECT_EQ(door.find(1), nullptr);
  EXPECT_THAT(door.peers.tick(door.at()).released, ::testing::ElementsAre(1u));
  EXPECT_THAT(door.hello(34, helloOf("later")), HasSubstr("32 clients"));
}

TEST(OperatorPeers, SilentClientsAreForgottenAndToldUnasked) {
  Door door;
  EXPECT_THAT(door.hello(1, helloOf("anna")), IsEmpty());
  door.now_s += 0.3;
  EXPECT_EQ(door.peers.tick(door.at()).due.size(), 1u);
  door.now_s += 30.0;
  EXPECT_THAT(door.peers.tick(door.at()).gone, ::testing::ElementsAre("anna's name"));
  EXPECT_THAT(door.peers.list(door.at()), IsEmpty());
}

}  // namespace
}  // namespace kiln
