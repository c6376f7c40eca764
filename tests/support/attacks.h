#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace kiln::test {

/// Something that a hostile process does to a socket, on a thread, until it is destroyed.
class Attack {
 public:
  explicit Attack(std::function<void(const std::stop_token&)> body) : thread_(std::move(body)) {}

 private:
  std::jthread thread_;
};

/// Messages that nobody can read, as fast as the socket takes them.
[[nodiscard]] Attack rubbish(const std::string& address, const std::string& socket_type = "DEALER");
/// Messages of 60 kB parts that never end; a new connection when one is closed.
[[nodiscard]] Attack endlessParts(const std::string& address, const std::string& socket_type);
/// `count` subscriptions to topics of a kilobyte, then away; again and again.
[[nodiscard]] Attack subscriptions(const std::string& address, int count);
/// User messages of the kind that a publisher once took for the end of a subscription.
[[nodiscard]] Attack userMessages(const std::string& address);
/// `count` connections that stay and say nothing but, every other one, their greeting.
[[nodiscard]] Attack crowd(const std::string& address, int count);
/// Connects and leaves, as often as it can.
[[nodiscard]] Attack comingAndGoing(const std::string& address);
/// Subscribes to everything and reads nothing.
[[nodiscard]] Attack deafSubscribers(const std::string& address, int count);
/// Announces a message of a gigabyte and sends it as long as somebody takes it.
[[nodiscard]] Attack gigabyte(const std::string& address);

/// Memory of a process in mebibytes, from /proc.
[[nodiscard]] double residentMiB(pid_t process);

}  // namespace kiln::test
