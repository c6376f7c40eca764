#include "gui/link/replay_link.h"

#include <QFileInfo>
#include <algorithm>

#include "common/record/run_replay.h"
#include "common/record/run_topics.h"
#include "common/wire/command.h"
#include "gui/link/run_history.h"
#include "gui/link/topic_inboxes.h"

namespace kiln::gui {

namespace {
constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr int kReportPolls = 5;  // the slider moves at 20 Hz
constexpr int kHealthPolls = 20;
constexpr int kTellWhole = 4000;  // messages; the time line grows while a long run is read

QString describe(const RunInfo& info) {
  QStringList words;
  for (const std::string& word :
       {info.robot_name, info.version, info.environment, info.started_utc}) {
    if (!word.empty()) words << QString::fromStdString(word);
  }
  return words.join(QStringLiteral(" · "));
}
}  // namespace

struct ReplayLink::Impl {
  /// What the operator wants; taken by the worker at its next look.
  struct Wish {
    std::optional<bool> playing;
    std::optional<double> speed;
    std::optional<Stamp> seek;
    double step_s = 0.0;
  };

  explicit Impl(RunReplay r) : replay(std::move(r)) {}
  void attach(ReplayLink& owner);
  void run(std::stop_token stop);
  /// @return the wish was a jump to another time.
  [[nodiscard]] bool obey(const Wish& wish);
  void tellJump(const std::stop_token& stop);
  void poll();
  void report();
  void readWhole(const std::stop_token& stop);
  void tellWhole(const RunHistory& run);
  void want(const std::function<void(Wish&)>& change) {
    const std::lock_guard lock(mutex);
    change(wish);
    wake.notify_one();
  }

  RunReplay replay;
  ReplayLink* link = nullptr;
  std::unique_ptr<TopicInboxes> inboxes;
  std::unique_ptr<Inbox<Playback>> playback;
  OperatorSession::Callbacks callbacks;
  Playback now;
  std::mutex mutex;
  std::condition_variable_any wake;
  Wish wish;               // guarded by mutex
  bool jump_told = false;  // guarded by mutex
  std::jthread worker;
  std::jthread reader;  ///< of the whole run, for the time line
};

Result<std::unique_ptr<ReplayLink>> ReplayLink::open(const std::string& path) {
  static const SteadyClock kWall;  // the player keeps a reference to what paces it
  auto replay = RunReplay::open(path, kWall);
  if (!replay) return tl::make_unexpected(replay.error());
  auto impl = std::make_unique<Impl>(std::move(*replay));
  impl->now.file = QFileInfo(QString::fromStdString(path)).fileName();
  impl->now.run = describe(impl->replay.info());
  impl->now.problem = QString::fromStdString(impl->replay.player().reader().defects());
  return std::unique_ptr<ReplayLink>(new ReplayLink(std::move(impl)));
}

ReplayLink::ReplayLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  impl_->attach(*this);
}

ReplayLink::~ReplayLink() { close(); }

void ReplayLink::Impl::attach(ReplayLink& owner) {
  link = &owner;
  inboxes = std::make_unique<TopicInboxes>(owner, nullptr, true);
  callbacks = inboxes->callbacks();
  playback = std::make_unique<Inbox<Playback>>(owner, [this](const Playback& value) {
    link->shown_ = value;
    emit link->playbackChanged(value);
  });
  const Player& player = replay.player();
  now.start = player.start();
  now.end = player.end();
  now.position = player.position();
  owner.shown_ = now;
}

void ReplayLink::open() {
  if (impl_->worker.joinable()) return;
  HelloReply reply;
  const RunInfo info = impl_->replay.info();
  reply.accepted = true;
  reply.robot_name = info.robot_name;
  reply.version = info.version;
  reply.mission_uuid = info.mission_uuid;
  reply.environment = Environment::Replay;
  emit hello(reply);
  impl_->wish.playing = true;
  impl_->worker = std::jthread([this](std::stop_token stop) { impl_->run(std::move(stop)); });
  impl_->reader = std::jthread([this](const std::stop_token& stop) { impl_->readWhole(stop); });
}

void ReplayLink::close() {
  for (std::jthread* thread : {&impl_->reader, &impl_->worker}) {
    if (!thread->joinable()) continue;
    thread->request_stop();
    thread->join();
  }
}

const Clock& ReplayLink::clock() const { return impl_->replay.player().clock(); }

std::optional<Stamp> ReplayLink::robotNow() const { return clock().now(); }

void ReplayLink::setPlaying(bool playing) {
  impl_->want([=](Impl::Wish& wish) { wish.playing = playing; });
}

void ReplayLink::setSpeed(double speed) {
  impl_->want([=](Impl::Wish& wish) { wish.speed = std::clamp(speed, kSlowest, kFastest); });
}

void ReplayLink::seek(Stamp position) {
  impl_->want([=](Impl::Wish& wish) {
    wish.seek = position;
    wish.step_s = 0.0;
  });
}

void ReplayLink::step(double seconds) {
  impl_->want([=](Impl::Wish& wish) { wish.step_s += seconds; });
}

void ReplayLink::Impl::run(std::stop_token stop) {
  for (int polls = 0; !stop.stop_requested(); ++polls) {
    Wish wanted;
    {
      std::unique_lock lock(mutex);
      const bool asked = wake.wait_for(lock, stop, kPoll, [this] {
        return wish.playing || wish.speed || wish.seek || wish.step_s != 0.0;
      });
      if (asked) wanted = std::exchange(wish, {});
    }
    if (obey(wanted)) tellJump(stop);
    poll();
    const bool asked = wanted.playing || wanted.speed || wanted.seek || wanted.step_s != 0.0;
    if (asked || polls % kReportPolls == 0) report();
    if (polls % kHealthPolls != 0) continue;
    LinkHealth health;
    health.state = LinkState::Up;
    health.endpoint = now.file;
    health.rtt_s = -1.0;
    QMetaObject::invokeMethod(
        link, [owner = link, health] { emit owner->health(health); }, Qt::QueuedConnection);
  }
}

bool ReplayLink::Impl::obey(const Wish& wanted) {
  Player& player = replay.player();
  if (wanted.speed) player.setSpeed(*wanted.speed);
  const bool back = (wanted.seek && *wanted.seek < player.position()) || wanted.step_s < 0.0;
  if (wanted.seek) player.seek(*wanted.seek);
  if (wanted.step_s != 0.0) player.step(fromSeconds(wanted.step_s));
  if (wanted.playing) {
    if (*wanted.playing && player.ended()) player.seek(player.start());
    *wanted.playing ? player.play() : player.pause();
  }
  return wanted.seek || back;
}

/// What the models remember of the time line is of another time now. They forget it before they get
/// anything of the new one: a message that overtook the word of the jump would be forgotten with
/// the rest, and while the recording stands no other follows.
void ReplayLink::Impl::tellJump(const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  jump_told = false;
  QMetaObject::invokeMethod(
      link,
      [this, absent = replay.silentTopics()] {
        emit link->restarted();
        if (!absent.empty()) emit link->absent(absent);
        const std::lock_guard told(mutex);
        jump_told = true;
        wake.notify_all();
      },
      Qt::QueuedConnection);
  wake.wait(lock, stop, [this] { return jump_told; });
}

void ReplayLink::Impl::poll() {
  const auto polled = replay.poll([this](Topic topic, std::string_view payload, Stamp published) {
    Arrival arrival;
    arrival.received = published;
    const auto done = callbacks.topics.dispatch(topic, payload, arrival);
    if (!done) inboxes->warn(done.error().message);
  });
  if (polled) return;
  now.problem = QString::fromStdString(polled.error().message);
  inboxes->warn(polled.error().message);
}

void ReplayLink::Impl::report() {
  const Player& player = replay.player();
  now.position = player.ended() ? player.end() : player.position();
  now.playing = player.playing() && !player.ended();
  now.ended = player.ended();
  now.speed = player.speed();
  playback->put(now);
}

void ReplayLink::Impl::readWhole(const std::stop_token& stop) {
  RunHistory whole;
  TopicSubscribers take;
  take.on<Topic::MissionInfo>() = [&](const auto& info, const Arrival&) {
    whole.setMission(*info);
  };
  take.on<Topic::FsmStatus>() = [&](const auto& status, const Arrival&) { whole.add(*status); };
  take.on<Topic::RobotStatus>() = [&](const auto& status, const Arrival&) {
    whole.add(*status);
    whole.addAlarms(status->stamp, status->alarms);
  };
  int taken = 0;
  const auto published = [&](Topic topic, std::string_view payload, Stamp) {
    // What cannot be decoded is told of when it is played.
    (void)take.dispatch(topic, payload, {});
    if (++taken % kTellWhole == 0) tellWhole(whole);
  };
  const auto other = [&](const RecordedMessage& message) {
    if (message.topic == run::kCommands) {
      const auto told = wire::decodeToRobot(message.data);
      if (const auto* command = told ? std::get_if<Command>(&*told) : nullptr) whole.add(*command);
    } else {
      const auto told = wire::decodeToStation(message.data);
      if (const auto* ack = told ? std::get_if<CommandAck>(&*told) : nullptr) whole.add(*ack);
    }
  };
  std::vector<std::string> names{std::string(run::kCommands), std::string(run::kAcks)};
  for (const Topic topic :
       {Topic::MissionInfo, Topic::FsmInfo, Topic::RobotStatus, Topic::FsmStatus})
    names.push_back(run::topicName(topic));
  replay.scan(names, published, other, [&] { return !stop.stop_requested(); });
  if (!stop.stop_requested()) tellWhole(whole);
}

void ReplayLink::Impl::tellWhole(const RunHistory& run) {
  QMetaObject::invokeMethod(
      link,
      [owner = link, whole = std::make_shared<const RunHistory>(run)] {
        emit owner->history(whole);
      },
      Qt::QueuedConnection);
}

}  // namespace kiln::gui
