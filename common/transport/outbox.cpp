#include "common/transport/outbox.h"

#include <algorithm>

namespace kiln {

void Outbox::push(Topic topic, Encode encode, Stamp now) {
  const TopicInfo& info = topicInfo(topic);
  const std::lock_guard lock(mutex_);
  Row& row = rows_[static_cast<std::size_t>(topic)];
  if (!row.subscribed && !info.latched) return;  // wanted by nobody: not a loss
  if (row.waiting.size() >= info.queue) {
    row.waiting.pop_front();
    ++row.dropped;
  }
  row.waiting.push_back({std::move(encode), now});
}

double Outbox::holdBack(const TopicInfo& info, const Row& row, Monotonic::time_point now) {
  if (info.max_rate_hz <= 0.0 || !row.last_sent) return 0.0;
  return std::max(0.0, 1.0 / info.max_rate_hz - secondsBetween(*row.last_sent, now));
}

std::optional<Outbox::Message> Outbox::take(Monotonic::time_point now) {
  Waiting next;
  Message message{};
  {
    const std::lock_guard lock(mutex_);
    // The table lists the status lane first.
    const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) {
      const auto& info = topicTable()[static_cast<std::size_t>(&r - rows_.data())];
      return !r.waiting.empty() && holdBack(info, r, now) <= 0.0;
    });
    if (row == rows_.end()) return std::nullopt;
    message.topic = topicTable()[static_cast<std::size_t>(row - rows_.begin())].topic;
    next = std::move(row->waiting.front());
    row->waiting.pop_front();
    row->last_sent = now;
    message.header = {++row->seq, toNanoseconds(next.stamp), row->dropped};
  }
  message.payload = next.encode();  // outside the lock: a cloud takes about a millisecond
  if (topicInfo(message.topic).latched) {
    const std::lock_guard lock(mutex_);
    rows_[static_cast<std::size_t>(message.topic)].latched = message.payload;
  }
  return message;
}

std::optional<double> Outbox::waits(Monotonic::time_point now) const {
  const std::lock_guard lock(mutex_);
  std::optional<double> least;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].waiting.empty()) continue;
    const double wait = holdBack(topicTable()[i], rows_[i], now);
    least = least ? std::min(*least, wait) : wait;
  }
  return least;
}

std::optional<Outbox::Message> Outbox::again(Topic topic, Stamp now) {
  const std::lock_guard lock(mutex_);
  Row& row = rows_[static_cast<std::size_t>(topic)];
  if (row.latched.empty()) return std::nullopt;
  return Message{topic, {++row.seq, toNanoseconds(now), row.dropped}, row.latched};
}

std::optional<Outbox::Message> Outbox::newest(Topic topic, Stamp now) const {
  const std::lock_guard lock(mutex_);
  const Row& row = rows_[static_cast<std::size_t>(topic)];
  if (row.latched.empty()) return std::nullopt;
  return Message{topic, {row.seq, toNanoseconds(now), row.dropped}, row.latched};
}

void Outbox::setSubscribed(Topic topic, bool subscribed) {
  const std::lock_guard lock(mutex_);
  Row& row = rows_[static_cast<std::size_t>(topic)];
  row.subscribed = subscribed;
  if (!subscribed && !topicInfo(topic).latched) row.waiting.clear();
}

bool Outbox::subscribed(Topic topic) const {
  const std::lock_guard lock(mutex_);
  return rows_[static_cast<std::size_t>(topic)].subscribed;
}

std::uint64_t Outbox::dropped(Topic topic) const {
  const std::lock_guard lock(mutex_);
  return rows_[static_cast<std::size_t>(topic)].dropped;
}

}  // namespace kiln
