#include "robot/world_model/checkpoint_writer.h"

#include <utility>

#include "common/core/atomic_file.h"

namespace kiln {

CheckpointWriter::CheckpointWriter(std::string path)
    : path_(std::move(path)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

CheckpointWriter::~CheckpointWriter() { flush(); }

void CheckpointWriter::write(std::string text, bool durable) {
  const std::lock_guard lock(mutex_);
  order_ = Order{std::move(text), durable || (order_ && order_->durable)};
  changed_.notify_all();
}

std::optional<Error> CheckpointWriter::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void CheckpointWriter::flush() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !order_ && !busy_; });
}

void CheckpointWriter::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return order_.has_value(); })) {
    const Order order = *std::exchange(order_, std::nullopt);
    busy_ = true;
    lock.unlock();
    const Result<void> written = writeFileAtomically(path_, order.text, order.durable);
    lock.lock();
    busy_ = false;
    problem_ = written ? std::nullopt : std::optional<Error>(written.error());
    changed_.notify_all();
  }
}

}  // namespace kiln
