#include "common/core/line_writer.h"

#include <array>
#include <csignal>
#include <memory>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/core/log.h"

namespace kiln {
namespace {

constexpr Duration kSoon = std::chrono::seconds(5);
constexpr Duration kMoment = std::chrono::milliseconds(100);

struct Pipe {
  Pipe() { EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0); }
  ~Pipe() {
    ::close(ends[0]);
    ::close(ends[1]);
  }
  /// All that comes until `last` has come.
  std::string readUntil(const std::string& last) const {
    std::string text;
    std::array<char, 4096> part{};
    while (!text.ends_with(last)) {
      const ssize_t n = ::read(ends[0], part.data(), part.size());
      if (n <= 0) break;
      text.append(part.data(), static_cast<std::size_t>(n));
    }
    return text;
  }
  std::array<int, 2> ends{};
};

TEST(LineWriter, WritesWhatWasPushedInItsOrder) {
  const Pipe pipe;
  LineWriter writer(pipe.ends[1]);
  writer.push("one\n");
  writer.push("two\n");
  EXPECT_TRUE(writer.flush(kSoon));
  EXPECT_EQ(pipe.readUntil("two\n"), "one\ntwo\n");
  EXPECT_EQ(writer.lost(), 0u);
}

TEST(LineWriter, APipeThatNobodyReadsKeepsNobodyWaitingAndTheLossIsSaid) {
  const Pipe pipe;
  {
    LineWriter writer(pipe.ends[1]);
    for (int i = 0; i < 20'000; ++i) writer.push(fmt::format("{:990} line {}\n", "", i));
    EXPECT_FALSE(writer.flush(kMoment));
    EXPECT_GT(writer.lost(), 10'000u);
    const std::string text = pipe.readUntil("line 19999\n");
    EXPECT_TRUE(text.find("lines are lost here") != std::string::npos);
    EXPECT_TRUE(text.ends_with("line 19999\n"));
    for (int i = 0; i < 2000; ++i) writer.push("again\n");
  }  // and its end waits for nobody either
}

TEST(LineWriter, GivesUpWhereNobodyWillEverRead) {
  auto pipe = std::make_unique<Pipe>();
  const int writing = ::dup(pipe->ends[1]);
  pipe.reset();
  LineWriter writer(writing);
  ::signal(SIGPIPE, SIG_IGN);
  for (int i = 0; i < 10; ++i) writer.push("x\n");
  EXPECT_TRUE(writer.flush(kSoon));
  ::close(writing);
}

TEST(Log, WhatIsQuotedStaysOneLineWithoutControls) {
  std::string text;
  const LogSinkHandle sink = addLogSink([&](const LogRecord& record) { text = record.text; });
  logger("test.clean")->info("refused {}", "x\n12:00:00.000 info  safety: STOP cleared\x1b[0m");
  EXPECT_EQ(text, "refused x 12:00:00.000 info  safety: STOP cleared?[0m");
  EXPECT_TRUE(flushLog(kSoon));
}

}  // namespace
}  // namespace kiln
