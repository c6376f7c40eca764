#include "common/client/hold_stream.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

Monotonic::time_point at(double s) {
  return Monotonic::time_point(
      std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(s)));
}
template <class T>
int count(const std::vector<HoldStream::Setpoint>& setpoints) {
  int n = 0;
  for (const auto& setpoint : setpoints) n += std::holds_alternative<T>(setpoint.body) ? 1 : 0;
  return n;
}

TEST(HoldStream, StreamsAtItsRateWhileRefreshed) {
  HoldStream stream(25.0, 0.2);
  int sent = 0;
  for (int ms = 0; ms < 1000; ms += 10) {
    stream.hold(JogBase{{0.1, 0, 0}}, 1, at(ms * 1e-3));
    sent += static_cast<int>(stream.due(at(ms * 1e-3)).size());
  }
  EXPECT_EQ(sent, 25);
}

TEST(HoldStream, ReleaseSendsZeroThreeTimesThenSilence) {
  HoldStream stream(25.0, 0.2);
  stream.hold(JogBase{{0.1, 0, 0}}, 1, at(0));
  static_cast<void>(stream.due(at(0)));
  stream.release(JogBase{});
  int zeros = 0;
  for (int i = 1; i < 20; ++i) zeros += count<ReleaseAll>(stream.due(at(i * 0.04)));
  EXPECT_EQ(zeros, 3);
  EXPECT_FALSE(stream.active());
}

TEST(HoldStream, HungCallerIsARelease) {
  HoldStream stream(25.0, 0.2);
  stream.hold(HoldActuator{"pumps", 1}, 1, at(0));
  int last_pump = -1, zeros = 0;
  for (int i = 0; i < 20; ++i) {
    const auto out = stream.due(at(i * 0.04));
    if (count<HoldActuator>(out) > 0) last_pump = i;
    zeros += count<ReleaseAll>(out);
  }
  EXPECT_EQ(last_pump, 5);  // 0.20 s
  EXPECT_EQ(zeros, 3);
}

TEST(HoldStream, ReleasingOneKindLeavesTheOthersHeld) {
  HoldStream stream(25.0, 0.2);
  stream.hold(JogBase{{0.1, 0, 0}}, 1, at(0));
  stream.hold(HoldActuator{"pumps", 1}, 1, at(0));
  stream.release(JogBase{});
  const auto out = stream.due(at(0.04));
  EXPECT_EQ(count<ReleaseAll>(out), 0);
  ASSERT_EQ(count<JogBase>(out), 1);
  EXPECT_EQ(count<HoldActuator>(out), 1);
  for (const auto& [body, press] : out) {
    if (const auto* jog = std::get_if<JogBase>(&body)) {
      EXPECT_EQ(jog->twist.vx_mps, 0.0);
    }
  }
}

TEST(HoldStream, APressThatIsOverSendsNothingAnyMore) {
  HoldStream stream(25.0, 0.2);
  const std::uint64_t first = stream.press();
  stream.hold(JogBase{{0.1, 0, 0}}, first, at(0));
  for (int i = 0; i < 20; ++i) static_cast<void>(stream.due(at(i * 0.04)));  // the caller hung
  stream.hold(JogBase{{0.1, 0, 0}}, first, at(1.0));
  EXPECT_TRUE(stream.due(at(1.0)).empty());
  const std::uint64_t second = stream.press();
  EXPECT_GT(second, first);
  stream.hold(JogBase{{0.1, 0, 0}}, second, at(1.1));
  const auto out = stream.due(at(1.1));
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].press, second);
  stream.releaseAll();
  stream.hold(JogBase{{0.1, 0, 0}}, second, at(1.2));
  for (const auto& setpoint : stream.due(at(1.2))) EXPECT_EQ(setpoint.press, 0u) << "a release";
}

TEST(HoldStream, MacroRestartIsMeantOncePerPress) {
  HoldStream stream(25.0, 0.2);
  int restarts = 0;
  for (int i = 0; i < 5; ++i) {
    stream.hold(HoldMacro{"m", true}, 1, at(i * 0.04));
    for (const auto& setpoint : stream.due(at(i * 0.04)))
      restarts += std::get<HoldMacro>(setpoint.body).restart ? 1 : 0;
  }
  EXPECT_EQ(restarts, 1);
}

}  // namespace
}  // namespace kiln
