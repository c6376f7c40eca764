#include "gui/models/fsm_model.h"

#include <algorithm>

namespace kiln::gui {

namespace {
constexpr int kRecentStates = 3;
/// States come ten times a second: later than this the robot is silent, and nobody knows.
constexpr double kUnheard_s = 0.5;
QString edgeKey(const QString& from, const QString& to) { return from + QLatin1Char('>') + to; }
}  // namespace

FsmModel::FsmModel(Link& link, QObject* parent) : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::fsmInfo, this, [this](std::shared_ptr<const FsmInfo> info) {
    const bool other = !info_ || info_->mission_uuid != info->mission_uuid;
    info_ = std::move(info);
    if (!other) return;
    visits_.clear();
    recount();
    touch();
    emit missionChanged();
  });
  connect(&link, &Link::restarted, this, [this] {
    visits_.clear();
    paused_ = Duration::zero();
    recount();
    touch();
  });
  connect(&link, &Link::history, this, [this](std::shared_ptr<const RunHistory> whole) {
    whole_ = std::move(whole);
    touch();
  });
  connect(&link, &Link::fsmStatus, this,
          [this](std::shared_ptr<const FsmStatus> status) { onStatus(std::move(status)); });
}

const FsmStateInfo* FsmModel::state(const QString& name) const {
  if (!info_) return nullptr;
  const std::string wanted = name.toStdString();
  const auto found = std::find_if(info_->states.begin(), info_->states.end(),
                                  [&](const FsmStateInfo& s) { return s.name == wanted; });
  return found == info_->states.end() ? nullptr : &*found;
}

const FsmEdgeInfo* FsmModel::edge(const QString& from, const QString& to) const {
  if (!info_) return nullptr;
  const std::string a = from.toStdString();
  const std::string b = to.toStdString();
  const auto found = std::find_if(info_->edges.begin(), info_->edges.end(),
                                  [&](const FsmEdgeInfo& e) { return e.from == a && e.to == b; });
  return found == info_->edges.end() ? nullptr : &*found;
}

QString FsmModel::label(const QString& name) const {
  const FsmStateInfo* info = state(name);
  return info && !info->label.empty() ? QString::fromStdString(info->label) : name;
}

QString FsmModel::current() const {
  return status_ ? QString::fromStdString(status_->state) : QString{};
}

double FsmModel::timeInStateS() const {
  if (!status_) return 0.0;
  // Once the mission has ended or the link is silent the clock of the state must not run on by
  // itself.
  if (status_->state.empty()) return 0.0;
  const double since_s = toSeconds(status_->stamp - status_->entered - pausedInState());
  const bool running = status_->running && !status_->paused && !status_->terminal;
  return std::max(0.0, since_s + (running ? std::clamp(ageS(), 0.0, kUnheard_s) : 0.0));
}

/// A robot that does not tell is an older recording: this station has not seen what came before a
/// jump in it; the recording has.
Duration FsmModel::pausedInState() const {
  if (status_->paused_in_state) return *status_->paused_in_state;
  return whole_ ? whole_->paused(status_->entered, status_->stamp) : paused_;
}

Stamp FsmModel::knownUntil() const {
  return stamp() + fromSeconds(std::clamp(ageS(), 0.0, kUnheard_s));
}

int FsmModel::timesTaken(const QString& from, const QString& to) const {
  return taken_.value(edgeKey(from, to));
}

int FsmModel::recency(const QString& name) const {
  int age = 0;
  for (auto visit = visits().rbegin(); visit != visits().rend() && age <= kRecentStates;
       ++visit, ++age) {
    if (visit->state == name) return age;
  }
  return -1;
}

void FsmModel::onStatus(std::shared_ptr<const FsmStatus> status) {
  if (status_ && status_->mission_uuid != status->mission_uuid) visits_.clear();
  const bool moved = !status_ || status_->step != status->step || status_->state != status->state;
  if (moved) {
    paused_ = Duration::zero();
  } else if (status_->paused && status->stamp > status_->stamp) {
    paused_ += status->stamp - status_->stamp;
  }
  status_ = std::move(status);
  visits_.add(*status_);
  if (moved) recount();
  arrived(status_->stamp);
  if (moved) emit stateEntered(current());
}

void FsmModel::recount() {
  records_.clear();
  taken_.clear();
  const std::vector<Visit>& all = visits();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Visit& visit = all[i];
    StateRecord& record = records_[visit.state];
    ++record.visits;
    if (visit.left != Stamp{}) {
      record.last_s = toSeconds(visit.left - visit.entered);
      record.total_s += record.last_s;
    }
    if (i > 0 && all[i - 1].step + 1 == visit.step)
      ++taken_[edgeKey(all[i - 1].state, visit.state)];
  }
}

}  // namespace kiln::gui
