#include "tests/support/attacks.h"

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <random>
#include <sstream>

#include "tests/support/raw_zmtp.h"

namespace kiln::test {
namespace {

void rest(const std::stop_token& stop, int ms) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  (void)stopped.wait_for(lock, stop, std::chrono::milliseconds(ms), [] { return false; });
}

/// Runs `body` on a connection that has shaken hands, until it breaks; then on a new one.
Attack onConnections(const std::string& address, const std::string& socket_type,
                     std::function<void(RawZmtp&, const std::stop_token&)> body) {
  return Attack([=](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      RawZmtp peer(address);
      if (peer.connected() && peer.shakeHands(socket_type)) body(peer, stop);
      rest(stop, 10);
    }
  });
}

/// Sends the same bytes as long as somebody takes them.
std::function<void(RawZmtp&, const std::stop_token&)> repeat(std::string bytes) {
  return [bytes = std::move(bytes)](RawZmtp& peer, const std::stop_token& stop) {
    while (!stop.stop_requested() && peer.sendRaw(bytes)) {
    }
  };
}

}  // namespace

Attack rubbish(const std::string& address, const std::string& socket_type) {
  std::mt19937_64 random(1);
  std::string many;
  for (int i = 0; i < 1000; ++i) {
    std::string message(1 + random() % 60, '\0');
    for (char& c : message) c = static_cast<char>(random());
    many += zmtpFrame(message);
  }
  return onConnections(address, socket_type, repeat(many));
}

Attack endlessParts(const std::string& address, const std::string& socket_type) {
  return onConnections(address, socket_type, repeat(zmtpFrame(std::string(60'000, 'x'), 1)));
}

Attack subscriptions(const std::string& address, int count) {
  return onConnections(address, "SUB", [count](RawZmtp& peer, const std::stop_token& stop) {
    for (int i = 0; i < count && !stop.stop_requested(); ++i) {
      std::string topic = "\1" + std::to_string(i);
      topic.resize(1000, 'x');
      if (!peer.send(topic)) return;
    }
  });
}

Attack userMessages(const std::string& address) {
  std::string many;
  for (const char* topic : {"robot_status", "fsm_status", "scene", "cloud", "thermal", ""}) {
    for (const char first : {'\2', '\0', '\xFF', 'r'})
      many += zmtpFrame(first + std::string(topic));
  }
  return onConnections(address, "XSUB", repeat(many));
}

Attack crowd(const std::string& address, int count) {
  return Attack([=](const std::stop_token& stop) {
    std::vector<RawZmtp> all;
    for (int i = 0; i < count && !stop.stop_requested(); ++i) {
      all.emplace_back(address);
      if (i % 2 == 0) all.back().sendRaw("\xFF");
    }
    while (!stop.stop_requested()) rest(stop, 100);
  });
}

Attack comingAndGoing(const std::string& address) {
  return Attack([=](const std::stop_token& stop) {
    while (!stop.stop_requested()) RawZmtp peer(address);
  });
}

Attack deafSubscribers(const std::string& address, int count) {
  return Attack([=](const std::stop_token& stop) {
    std::vector<RawZmtp> all;
    for (int i = 0; i < count && !stop.stop_requested(); ++i) {
      all.emplace_back(address);
      if (all.back().shakeHands("SUB")) all.back().send("\1");
    }
    while (!stop.stop_requested()) rest(stop, 100);
  });
}

Attack gigabyte(const std::string& address) {
  return onConnections(address, "DEALER", [](RawZmtp& peer, const std::stop_token& stop) {
    peer.sendRaw(std::string("\2\0\0\0\0\x40\0\0\0", 9));
    repeat(std::string(1 << 20, 'x'))(peer, stop);
  });
}

double residentMiB(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}

}  // namespace kiln::test
