#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/client/topic_values.h"
#include "common/config/config_archive.h"
#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/model/link.h"
#include "robot/app/link_tap.h"
#include "robot/safety/operator_peer.h"
#include "robot/safety/stop_latch.h"

namespace kiln {

/// The robot's side of the link. Two threads: `link`, sole owner of the command, status and streams
/// sockets, and `stop` with a socket of its own, which sets the StopLatch the moment a request
/// arrives. What a peer may cost is bounded (decision 18).
///
/// Thread-safe: every method may be called from any thread and none blocks longer than a queue's
/// mutex. Encoding (cloud compression) runs on the link thread, and only for topics that somebody
/// subscribes to. All queues are bounded; drops() counts each loss by topic.
class OperatorLink {
 public:
  struct Config {
    std::string endpoint = "tcp://127.0.0.1:7300";  ///< command, status, streams, stop on port +0
                                                    ///< .. +3; or ipc:///dir/prefix
    std::string robot_name = "Bob";
    double forget_after_s = 30.0;  ///< a silent client is dropped from operators()
    int command_queue = 128;  ///< commands of one client that wait for the mission tick; more are
                              ///< refused as "busy"
    double cloud_resolution_m = 0.005;  ///< 0.005 or 0.002
    void visit(ConfigArchive& a);
  };
  /// Fixed for the life of the process; not configuration.
  struct Identity {
    std::string version;
    Environment environment = Environment::Sim;
    std::string mission_uuid;  ///< a client that expects another one is refused in words
  };

  /// Binds the sockets and starts both threads. `clock` and `stop` must outlive the link.
  /// Error: Refused for an address that is neither ipc nor loopback; Unavailable when the port or
  /// path is in use.
  [[nodiscard]] static Result<std::unique_ptr<OperatorLink>> open(Config config, Identity identity,
                                                                  const Clock& clock,
                                                                  StopLatch& stop);
  ~OperatorLink();
  OperatorLink(const OperatorLink&) = delete;
  OperatorLink& operator=(const OperatorLink&) = delete;

  // --- commands: drained by the mission tick
  [[nodiscard]] std::vector<ReceivedCommand> takeCommands();
  /// Goes to ack.client_id, if that client is still connected.
  void acknowledge(const CommandAck& ack);
  [[nodiscard]] std::vector<OperatorPeer> operators() const;
  void setMissionUuid(const std::string& uuid);
  /// Lets somebody hear everything from now on. Call it before anything is published.
  void setTap(LinkTap tap);

  // --- telemetry
  /// On the topic of such a value (common/client/topic_values.h), latched where the topic is: send
  /// a map layer only when the map changes.
  template <class T>
  void publish(std::shared_ptr<const T> value) {
    const Topic topic = topicOf(*value);
    publish(topic, [value = std::move(value), resolution_m = cloudResolution()] {
      if constexpr (std::is_same_v<T, PointCloud>)
        return wire::encode(*value, resolution_m);
      else
        return wire::encode(*value);
    });
  }
  template <class T>
  void publish(T value) {
    publish(std::make_shared<const T>(std::move(value)));
  }
  /// Pictures are taken though no station watches (for the recording).
  void keepPictures(bool keep);
  /// Somebody wants pictures of this frame: encode JPEG only then.
  [[nodiscard]] bool wanted(const std::string& jpeg_frame) const;

  /// By topic, plus "commands" and "acks".
  [[nodiscard]] std::vector<DropCount> drops() const;

 private:
  void publish(Topic topic, LinkTap::Encode encode);
  [[nodiscard]] double cloudResolution() const;
  struct Impl;
  explicit OperatorLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
