// Random sequences of what operators, stations, links, devices and the world may do, against the
// robot's real parts (operator_rig.h). A sequence that breaks an invariant is cut down to the
// shortest that still does and printed as a row of the table below.
#include <atomic>
#include <cstdlib>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "common/core/check.h"
#include "common/core/log.h"
#include "tests/fuzz/operator_rig.h"

namespace kiln {
namespace {

constexpr std::uint64_t kSeed = 20260101;
constexpr double kBudget_s = 10.0;  // unless KILN_SEQUENCES says how many

struct Sequence {
  bool start_by_itself = false;  ///< --start
  std::vector<Act> acts;
};

/// @param number  gives the same sequence each time.
Sequence drawn(std::uint64_t number) {
  std::mt19937_64 random(kSeed + number);
  std::uniform_int_distribution<int> act(0, static_cast<int>(Act::Count) - 1), length(5, 60);
  Sequence sequence;
  sequence.start_by_itself = (random() & 1U) != 0;
  if ((random() & 3U) != 0) sequence.acts.push_back(Act::AcquireLease);
  if ((random() & 3U) == 0) sequence.acts.push_back(Act::Teleop);
  for (int n = length(random); n > 0; --n) {
    sequence.acts.push_back(static_cast<Act>(act(random)));
    if ((random() & 3U) == 0) sequence.acts.push_back(Act::Again);  // controls are held for a while
  }
  return sequence;
}

/// @return the invariant that it breaks, in words; empty: none.
std::string run(const Sequence& sequence) {
  try {
    OperatorRig rig(sequence.start_by_itself);
    for (std::size_t i = 0; i < sequence.acts.size() && rig.broken().empty(); ++i) {
      rig.give(sequence.acts[i]);
      const bool more = i + 1 < sequence.acts.size() && sequence.acts[i + 1] == Act::And;
      if (!more && sequence.acts[i] != Act::And) rig.tick();
    }
    return rig.broken();
  } catch (const std::logic_error& check) {
    return check.what();
  }
}

/// Leaves out one act after the other, or puts an empty tick in its place, as long as the sequence
/// still fails.
Sequence shrunk(Sequence sequence) {
  const auto shortened = [&](std::size_t i) {
    Sequence shorter = sequence;
    shorter.acts.erase(shorter.acts.begin() + static_cast<std::ptrdiff_t>(i));
    if (run(shorter).empty()) {
      shorter = sequence;
      if (std::exchange(shorter.acts[i], Act::Tick) == Act::Tick || run(shorter).empty())
        return false;
    }
    sequence = std::move(shorter);
    return true;
  };
  for (std::size_t i = 0; i < sequence.acts.size();) i = shortened(i) ? 0 : i + 1;
  return sequence;
}

/// "--start: AcquireLease, 20 Tick, Teleop"
std::string listed(const Sequence& sequence) {
  std::string out = sequence.start_by_itself ? "--start:" : "";
  const std::vector<Act>& acts = sequence.acts;
  for (std::size_t i = 0, same = 1; i < acts.size(); i += same, same = 1) {
    while (i + same < acts.size() && acts[i + same] == acts[i]) ++same;
    out += out.empty() ? "" : out.back() == ':' ? " " : ", ";
    if (same > 1) out += fmt::format("{} ", same);
    out += nameOf(acts[i]);
  }
  return out;
}

/// What listed() has printed.
Sequence parsed(const std::string& text) {
  std::istringstream words(text);
  Sequence sequence;
  std::size_t times = 1;
  for (std::string word; words >> word;) {
    if (word == "--start:")
      sequence.start_by_itself = true;
    else if (std::isdigit(static_cast<unsigned char>(word.front())) != 0)
      times = std::stoul(word);
    else
      sequence.acts.insert(sequence.acts.end(), std::exchange(times, 1),
                           actOf(word.substr(0, word.find(','))));
  }
  return sequence;
}

struct Walked {
  std::uint64_t count = 0;
  double seconds = 0.0;
  std::optional<std::uint64_t> failed;  ///< the first of them
};

/// @param most  sequences, or as many as `limit` leaves time for.
Walked walk(std::uint64_t most, Duration limit) {
  const SteadyClock clock;
  const Stamp begin = clock.now();
  std::atomic<std::uint64_t> next{0}, end{most};
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
    workers.emplace_back([&] {
      for (std::uint64_t n = next++; n < end && clock.now() - begin < limit; n = next++) {
        if (run(drawn(n)).empty()) continue;
        std::uint64_t before = end;
        while (n < before && !end.compare_exchange_weak(before, n)) continue;
      }
    });
  }
  workers.clear();  // joins
  const bool failed = end < most;
  return {std::min(next.load(), end.load()), toSeconds(clock.now() - begin),
          failed ? std::optional(end.load()) : std::nullopt};
}

class OperatorSequence : public ::testing::Test {
 protected:
  OperatorSequence() {
    setLogLevel(6);
    setCheckFailureHandler([](const std::string& what) { throw std::logic_error(what); });
  }
  ~OperatorSequence() override {
    setLogLevel(2);
    setCheckFailureHandler({});
  }
};

/// Each was the shortest that broke an invariant before its mend.
TEST_F(OperatorSequence, FoundOnesStayMended) {
  for (const char* text : {
           // A gentle ramp took over from the one of a time-out and carried the base backwards.
           "--start: AcquireLease, 20 Tick, Teleop, 13 Tick, ForceDone, HoldPumps, LinkGap, 8 Tick",
           // A macro began under a jog that was still held: two writers of the arm.
           "AcquireLease, Teleop, JogArm, HoldMacro",
           // A state that was forced while held was not counted when a kill came in between.
           "--start: AcquireLease, Pause, ForceWork, KillAndResume, AcquireLease, Resume",
       }) {
    const Sequence sequence = parsed(text);
    EXPECT_EQ(listed(sequence), text);
    EXPECT_EQ(run(sequence), "") << text;
  }
}

TEST_F(OperatorSequence, BreaksNoInvariant) {
  const char* wanted = std::getenv("KILN_SEQUENCES");
  const Walked walked = wanted ? walk(std::strtoull(wanted, nullptr, 10), Duration::max())
                               : walk(~std::uint64_t{0}, fromSeconds(kBudget_s));
  fmt::print("{} sequences in {:.1f} s, {:.0f} a minute\n", walked.count, walked.seconds,
             60.0 * static_cast<double>(walked.count) / walked.seconds);
  ASSERT_GT(walked.count, 0U);
  const auto failed = walked.failed;
  if (!failed) return;
  const std::string what = run(drawn(*failed));
  const Sequence shortest = shrunk(drawn(*failed));
  ADD_FAILURE() << "sequence " << *failed << " breaks \"" << what << "\"; the shortest breaks \""
                << run(shortest) << "\":\n    " << listed(shortest);
}

}  // namespace
}  // namespace kiln
