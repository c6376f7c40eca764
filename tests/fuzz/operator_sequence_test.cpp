// Random sequences of what operators, stations, links, devices and the world may do, against the
// robot's real parts (operator_desk.h). A sequence that breaks an invariant is cut down to the
// shortest that still does and printed as a list.
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "common/core/clock.h"
#include "common/core/log.h"
#include "tests/fuzz/operator_desk.h"

namespace kiln {
namespace {

constexpr std::uint64_t kSeed = 20260101;

struct Sequence {
  bool start_by_itself = false;
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

std::string run(const Sequence& sequence) {
  OperatorDesk desk(sequence.start_by_itself);
  for (const Act act : sequence.acts)
    if (std::string what = desk.perform(act); !what.empty()) return what;
  return {};
}

/// Leaves out one act after the other as long as the sequence still fails.
Sequence shrunk(Sequence sequence) {
  for (std::size_t i = 0; i < sequence.acts.size();) {
    Sequence shorter = sequence;
    shorter.acts.erase(shorter.acts.begin() + static_cast<std::ptrdiff_t>(i));
    if (run(shorter).empty())
      ++i;
    else
      sequence = std::move(shorter), i = 0;
  }
  return sequence;
}

std::string listed(const Sequence& sequence) {
  std::string out = sequence.start_by_itself ? "--start" : "no --start";
  for (const Act act : sequence.acts) out += fmt::format(", {}", nameOf(act));
  return out;
}

/// The first sequence below `count` that fails; nullopt: none does.
std::optional<std::uint64_t> firstFailure(std::uint64_t count) {
  std::atomic<std::uint64_t> next{0}, failed{count};
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
    workers.emplace_back([&] {
      for (std::uint64_t n = next++; n < failed.load(); n = next++) {
        if (run(drawn(n)).empty()) continue;
        std::uint64_t before = failed.load();
        while (n < before && !failed.compare_exchange_weak(before, n)) continue;
      }
    });
  }
  workers.clear();  // joins
  return failed.load() < count ? std::optional(failed.load()) : std::nullopt;
}

TEST(OperatorSequence, BreaksNoInvariant) {
  setLogLevel(6);
  const char* wanted = std::getenv("KILN_SEQUENCES");
  const std::uint64_t count = wanted ? std::strtoull(wanted, nullptr, 10) : 3000;
  const SteadyClock clock;
  const Stamp begin = clock.now();
  const auto failed = firstFailure(count);
  const double seconds = toSeconds(clock.now() - begin);
  const Sequence shortest = failed ? shrunk(drawn(*failed)) : Sequence{};
  const std::string what = failed ? run(shortest) : std::string();
  setLogLevel(2);
  EXPECT_FALSE(failed) << "sequence " << *failed << " breaks invariant " << what << "\n  "
                       << listed(shortest);
  fmt::print("{} sequences in {:.1f} s, {:.0f} a minute\n", count, seconds,
             60.0 * static_cast<double>(count) / seconds);
}

}  // namespace
}  // namespace kiln
