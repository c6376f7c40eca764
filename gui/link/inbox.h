#pragma once

#include <QObject>
#include <atomic>
#include <functional>
#include <utility>

#include "common/core/latest_value.h"

namespace kiln::gui {

/// Hands the newest value of one topic from the link thread to the GUI thread. At most one delivery
/// is queued, whatever the sender's rate: a GUI that is busy finds the newest value when it comes
/// back, not a queue. put() is thread-safe.
template <class T>
class Inbox {
 public:
  /// @param target   lives on the GUI thread and outlives the sender.
  /// @param deliver  called on the GUI thread.
  Inbox(QObject& target, std::function<void(const T&)> deliver)
      : target_(target), deliver_(std::move(deliver)) {}

  void put(T value) {
    value_.put(std::move(value));
    if (queued_.exchange(true)) return;
    QMetaObject::invokeMethod(
        &target_, [this] { take(); }, Qt::QueuedConnection);
  }
  [[nodiscard]] std::uint64_t overwritten() const { return value_.overwritten(); }

 private:
  void take() {
    queued_ = false;
    if (auto value = value_.takeFresh()) deliver_(*value);
  }
  QObject& target_;
  std::function<void(const T&)> deliver_;
  LatestValue<T> value_;
  std::atomic<bool> queued_ = false;
};

}  // namespace kiln::gui
