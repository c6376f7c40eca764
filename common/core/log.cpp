#include "common/core/log.h"

#include <cstdlib>
#include <map>
#include <mutex>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink-inl.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "common/core/line_writer.h"
#include "common/core/mutex.h"
#include "common/core/text.h"

namespace kiln {
namespace {

constexpr Duration kLastWords = std::chrono::milliseconds(500);

std::string_view viewOf(spdlog::string_view_t text) { return {text.data(), text.size()}; }

class CallbackSink final : public spdlog::sinks::base_sink<Mutex> {
 public:
  explicit CallbackSink(std::function<void(const LogRecord&)> callback)
      : callback_(std::move(callback)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    callback_({std::string(viewOf(message.logger_name)), static_cast<int>(message.level),
               std::string(viewOf(message.payload))});
  }
  void flush_() override {}

  std::function<void(const LogRecord&)> callback_;
};

/// Standard error. Its thread lives as long as the process, which may end while a write hangs.
LineWriter& errorOutput() {
  static LineWriter& writer = []() -> LineWriter& {
    std::atexit([] { (void)flushLog(kLastWords); });
    return *new LineWriter(STDERR_FILENO);
  }();
  return writer;
}

class StderrSink final : public spdlog::sinks::base_sink<Mutex> {
 public:
  StderrSink() { set_pattern_("%H:%M:%S.%e %^%-5l%$ %n: %v"); }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t formatted;
    formatter_->format(message, formatted);
    std::string line = fmt::to_string(formatted);
    if (colours_ && message.color_range_end > message.color_range_start) {
      line.insert(message.color_range_end, "\033[m");
      line.insert(message.color_range_start, colourOf(message.level));
    }
    if (::getpid() == process_) return errorOutput().push(std::move(line));
    (void)writeWithin(STDERR_FILENO, line, kLastWords);  // a fork has no second thread
  }
  void flush_() override {}
  static const char* colourOf(spdlog::level::level_enum level) {
    return level >= spdlog::level::err    ? "\033[31m\033[1m"
           : level >= spdlog::level::warn ? "\033[33m\033[1m"
           : level >= spdlog::level::info ? "\033[32m"
                                          : "\033[36m";
  }

  const bool colours_ = ::isatty(STDERR_FILENO) == 1;
  const pid_t process_ = ::getpid();
};

/// All sinks. What is logged may quote anybody: it stays one printable line.
class CleaningSink final : public spdlog::sinks::dist_sink<Mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text = printable(viewOf(message.payload));
    spdlog::details::log_msg clean(message);
    clean.payload = text;
    dist_sink::sink_it_(clean);
  }
};

std::shared_ptr<CleaningSink> sharedSink() {
  static const auto sink = [] {
    auto all = std::make_shared<CleaningSink>();
    all->add_sink(std::make_shared<StderrSink>());
    return all;
  }();
  return sink;
}

/// Ours and not spdlog's registry: control loops log, and its mutex does not lend its priority.
struct Loggers {
  Mutex mutex;
  std::map<std::string, Logger> by_name;  ///< their addresses stay
  spdlog::level::level_enum level = spdlog::level::info;
};
Loggers& loggers() {
  static Loggers& all = *new Loggers;  // for whatever logs at the very end
  return all;
}

}  // namespace

bool flushLog(Duration limit) { return errorOutput().flush(limit); }

void Logger::write(LogLevel level, fmt::string_view format, fmt::format_args args) const {
  const auto severity = static_cast<spdlog::level::level_enum>(level);
  if (out_->should_log(severity))
    out_->log(severity, spdlog::string_view_t(fmt::vformat(format, args)));
}

const Logger* logger(const std::string& name) {
  Loggers& all = loggers();
  const std::lock_guard lock(all.mutex);
  const auto found = all.by_name.find(name);
  if (found != all.by_name.end()) return &found->second;
  auto made = std::make_shared<spdlog::logger>(name, sharedSink());
  made->set_level(all.level);
  return &all.by_name.emplace(name, Logger(std::move(made))).first->second;
}

LogSinkHandle addLogSink(std::function<void(const LogRecord&)> sink) {
  auto added = std::make_shared<CallbackSink>(std::move(sink));
  sharedSink()->add_sink(added);
  return {added.get(), [added](void*) { sharedSink()->remove_sink(added); }};
}

void setLogLevel(int level) {
  Loggers& all = loggers();
  const std::lock_guard lock(all.mutex);
  all.level = static_cast<spdlog::level::level_enum>(level);
  for (auto& [name, logger] : all.by_name) logger.out_->set_level(all.level);
}

}  // namespace kiln
