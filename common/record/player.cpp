#include "common/record/player.h"

#include <algorithm>
#include <iterator>

namespace kiln {

Player::Player(RecordReader reader, std::vector<std::string> topics, const Clock& wall)
    : reader_(std::move(reader)),
      topics_(std::move(topics)),
      wall_(wall),
      start_(reader_.start()),
      end_(reader_.end()),
      cursor_(reader_.messages(topics_, start_)),
      ended_(reader_.empty()) {
  anchor(start_);
}

void Player::anchor(Stamp t) {
  clock_.set(t);
  anchor_recording_ = target_ = t;
  anchor_wall_ = wall_.now();
}

Stamp Player::due() const {
  if (!playing_) return target_;
  const double wall_s = toSeconds(wall_.now() - anchor_wall_);
  return std::min(end_, anchor_recording_ + fromSeconds(wall_s * speed_));
}

void Player::play() {
  if (ended_ || playing_) return;
  anchor(position());
  playing_ = true;
}

void Player::pause() {
  if (!playing_) return;
  playing_ = false;
  anchor(position());
}

void Player::setSpeed(double speed) {
  if (!(speed == speed)) return;  // NaN
  if (playing_) anchor(position());
  speed_ = std::clamp(speed, kMinSpeed, kMaxSpeed);
}

void Player::seek(Stamp t) {
  t = std::clamp(t, start_, end_);
  const auto before = reader_.newestBefore(t, topics_);
  snapshot_.assign(before.begin(), before.end());
  silent_.clear();
  std::copy_if(topics_.begin(), topics_.end(), std::back_inserter(silent_),
               [&](const std::string& topic) {
                 return std::none_of(before.begin(), before.end(),
                                     [&](const RecordedMessage& m) { return m.topic == topic; });
               });
  cursor_.seek(t + Duration{1});
  ended_ = reader_.empty();
  anchor(t);
}

void Player::step(Duration d) {
  pause();
  if (d < Duration::zero()) return seek(position() + d);
  target_ = std::min(end_, target_ + d);
}

Result<std::size_t> Player::poll(const Sink& sink, std::size_t limit) {
  const Stamp until = due();
  std::size_t count = 0;
  while (!snapshot_.empty()) {
    sink(snapshot_.front());
    snapshot_.pop_front();
    ++count;
  }
  for (; count < limit; ++count) {
    const auto next = cursor_.peek();
    if (!next) return tl::make_unexpected(next.error());
    if (!*next || **next > until) {
      clock_.set(until);
      if (!*next && until >= end_) {
        ended_ = true;
        playing_ = false;
        anchor(end_);
      }
      return count;
    }
    const auto message = cursor_.next();
    if (!message) return tl::make_unexpected(message.error());
    clock_.set((*message)->logged);
    sink(**message);
  }
  if (playing_) anchor(position());  // the consumer is slower than the speed asked for
  return count;
}

}  // namespace kiln
