#pragma once

#include "common/client/operator_session.h"
#include "common/core/bounded_queue.h"
#include "gui/link/inbox.h"
#include "gui/link/jpeg_decoder.h"
#include "gui/link/link.h"

namespace kiln::gui {

/// Many short values that must not be lost: handed over in batches, the oldest dropped at the
/// limit.
template <class T>
class Batches {
 public:
  Batches(QObject& target, std::size_t capacity, std::function<void(const std::vector<T>&)> deliver)
      : queue_(capacity, DropPolicy::Oldest),
        bell_(target, [this, deliver](const int&) { deliver(queue_.drain()); }) {}
  void put(T value) {
    queue_.push(std::move(value));
    bell_.put(0);
  }

 private:
  BoundedQueue<T> queue_;
  Inbox<int> bell_;
};

/// What a robot publishes, brought from a worker thread to the signals of a Link on the GUI thread;
/// the same for a live robot and for a recording. Outlives the worker that calls the callbacks.
class TopicInboxes {
 public:
  /// @param arrived  called on the GUI thread with each status; may be empty.
  /// @param replay   statuses are marked as of a recording.
  TopicInboxes(Link& link, std::function<void(const Arrival&)> arrived, bool replay = false);

  /// The subscribers and on_bad_message; the other callbacks stay empty.
  [[nodiscard]] const OperatorSession::Callbacks& callbacks() const { return callbacks_; }
  /// A line for the station's log. Thread-safe.
  void warn(const std::string& text);

 private:
  /// Hands every value of a topic to `deliver` on the GUI thread.
  template <Topic topic>
  void take(std::function<void(const SharedValueOf<topic>&, const Arrival&)> deliver);
  template <Topic topic>
  void relay(void (Link::*signal)(SharedValueOf<topic>));

  Link& link_;
  std::vector<std::shared_ptr<void>> inboxes_;  ///< a queued delivery needs them
  OperatorSession::Callbacks callbacks_;
  Inbox<RgbImagePtr> head_image_, operator_image_;
  Batches<LogLine> log_;
  std::unique_ptr<JpegDecoder> decoder_;  // last: its thread calls the above
};

}  // namespace kiln::gui
