#include "common/core/log.h"

#include <mutex>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace kiln {
namespace {

class CallbackSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit CallbackSink(std::function<void(const LogRecord&)> callback)
      : callback_(std::move(callback)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    callback_({std::string(message.logger_name.data(), message.logger_name.size()),
               static_cast<int>(message.level),
               std::string(message.payload.data(), message.payload.size())});
  }
  void flush_() override {}

  std::function<void(const LogRecord&)> callback_;
};

std::shared_ptr<spdlog::sinks::dist_sink_mt> sharedSink() {
  static const auto sink = [] {
    auto dist = std::make_shared<spdlog::sinks::dist_sink_mt>();
    auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    console->set_pattern("%H:%M:%S.%e %^%-5l%$ %n: %v");
    dist->add_sink(console);
    return dist;
  }();
  return sink;
}

}  // namespace

std::shared_ptr<spdlog::logger> logger(const std::string& name) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (auto existing = spdlog::get(name)) return existing;
  auto created = std::make_shared<spdlog::logger>(name, sharedSink());
  created->set_level(spdlog::get_level());
  created->flush_on(spdlog::level::warn);
  spdlog::register_logger(created);
  return created;
}

LogSinkHandle addLogSink(std::function<void(const LogRecord&)> sink) {
  auto added = std::make_shared<CallbackSink>(std::move(sink));
  sharedSink()->add_sink(added);
  return {added.get(), [added](void*) { sharedSink()->remove_sink(added); }};
}

void setLogLevel(int level) { spdlog::set_level(static_cast<spdlog::level::level_enum>(level)); }

}  // namespace kiln
