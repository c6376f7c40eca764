#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/core/bounded_queue.h"
#include "common/core/executor.h"

namespace kiln {

/// One question at a time to the pool: asked anew until the pool takes it, and the answer to an
/// older one is dropped. Confined to the mission thread, the work aside, which must keep nothing of
/// that thread but what outlives the mission and does not change.
template <class Answer>
class PoolQuestion {
 public:
  /// @param kind  of the job; its own, because the pool runs one of a kind.
  /// @param latency_s  modelled in lockstep.
  PoolQuestion(Executor& executor, std::string kind, double latency_s)
      : executor_(executor), kind_(std::move(kind)), latency_(fromSeconds(latency_s)) {}

  void ask(std::function<Answer()> work) {
    clear();
    work_ = std::move(work);
    post();
  }
  /// Of the last ask().
  [[nodiscard]] const std::optional<Answer>& answer() const { return answer_; }
  /// Once a tick: takes what is done, posts what waits.
  void tick() {
    for (Numbered& done : answers_->drain())
      if (done.number == number_) answer_ = std::move(done.answer);
    if (work_) post();
  }
  /// What was asked no longer matters.
  void clear() {
    ++number_;
    work_ = nullptr;
    answer_.reset();
  }

 private:
  struct Numbered {
    std::uint64_t number = 0;
    Answer answer;
  };
  void post() {
    const bool taken = executor_.post(
        {kind_, latency_,
         [number = number_, work = work_, answers = answers_](std::stop_token) -> Delivery {
           return [answers, done = Numbered{number, work()}] { answers->push(done); };
         }});
    if (taken) work_ = nullptr;
  }

  Executor& executor_;
  std::string kind_;
  Duration latency_;
  std::uint64_t number_ = 0;
  std::function<Answer()> work_;  ///< to be posted
  std::optional<Answer> answer_;
  std::shared_ptr<BoundedQueue<Numbered>> answers_ =
      std::make_shared<BoundedQueue<Numbered>>(4, DropPolicy::Oldest);
};

}  // namespace kiln
