#include "gui/link/run_history.h"

#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
SpanLook lookOf(StatusWord word) {
  switch (word) {
    case StatusWord::Auto:
    case StatusWord::Supervised:
      return SpanLook::Active;
    case StatusWord::Teleop:
      return SpanLook::Manual;
    case StatusWord::NotReady:
    case StatusWord::Paused:
      return SpanLook::Caution;
    case StatusWord::Stopped:
      return SpanLook::Fault;
    case StatusWord::NoLink:
    case StatusWord::Ready:
      return SpanLook::Plain;
  }
  return SpanLook::Plain;
}

bool isDuty(const FigureSpec& spec) {
  return spec.unit.empty() && spec.low == 0.0 && spec.high == 1.0;
}

void addSample(HistorySeries& series, Stamp stamp, double value) {
  if (!series.empty() && stamp <= series.back().stamp) return;  // repeated or re-ordered
  series.push_back({stamp, value});
}
}  // namespace

void RunHistory::setMission(const MissionInfo& info) {
  std::map<std::string, HistorySeries> plotted;
  duties_.clear();
  for (const FigureSpec& spec : info.figures) {
    if (spec.plot) plotted[spec.id] = std::move(figures_[spec.id]);
    if (isDuty(spec)) duties_.push_back(spec);
  }
  figures_ = std::move(plotted);
}

void RunHistory::add(const RobotStatus& status) {
  if (end_ != Stamp{} && status.stamp <= end_) return;
  goOn(Mode, status.stamp, {std::string(toString(status.word)), lookOf(status.word)});
  goOn(Stop, status.stamp,
       status.stop.latched ? Wanted{"STOP by " + status.stop.source, SpanLook::Fault} : Wanted{});
  goOn(Macros, status.stamp, {status.macro.running, SpanLook::Manual});
  goOn(Actuators, status.stamp, {running(status), SpanLook::Active});
  addSamples(status);
  if (start_ == Stamp{}) start_ = status.stamp;
  end_ = status.stamp;
}

void RunHistory::add(const FsmStatus& status) {
  visits_.add(status);
  const bool paused = status.running && status.paused;
  if (paused && !machine_paused_) pauses_.emplace_back(status.stamp, status.stamp);
  if (machine_paused_) pauses_.back().second = status.stamp;
  machine_paused_ = paused;
}

Duration RunHistory::paused(Stamp from, Stamp to) const {
  Duration sum{};
  for (const auto& [begin, end] : pauses_)
    sum += std::max(Duration{}, std::min(end, to) - std::max(begin, from));
  return sum;
}

std::string RunHistory::running(const RobotStatus& status) const {
  std::string names;
  for (const FigureSpec& spec : duties_) {
    const Figure* figure = findFigure(status.figures, spec.id);
    if (!figure || !(figure->value > 0.0)) continue;
    names += (names.empty() ? "" : ", ") + spec.label;
  }
  return names;
}

void RunHistory::addSamples(const RobotStatus& status) {
  addSample(force_, status.stamp, status.arm.wrench_tool.head<3>().norm());
  for (auto& [id, series] : figures_) {
    const Figure* figure = findFigure(status.figures, id);
    addSample(series, status.stamp, figure ? figure->value : NAN);
  }
}

void RunHistory::addAlarms(Stamp now, const std::vector<Alarm>& alarms) {
  const Alarm* top = nullptr;
  int standing = 0;
  for (const Alarm& alarm : alarms) {
    if (!alarm.active) continue;
    ++standing;
    const bool heavier =
        !top || alarm.level > top->level || (alarm.level == top->level && alarm.since < top->since);
    if (heavier) top = &alarm;
  }
  if (!top) return goOn(Alarms, now, {});
  const std::string more = standing > 1 ? " and " + std::to_string(standing - 1) + " more" : "";
  const SpanLook look = top->level == AlarmLevel::Warning   ? SpanLook::Fault
                        : top->level == AlarmLevel::Caution ? SpanLook::Caution
                                                            : SpanLook::Plain;
  goOn(Alarms, now, {top->text + more, look, top->id + more});
}

void RunHistory::goOn(Lane lane, Stamp now, const Wanted& wanted) {
  auto& spans = lanes_[static_cast<std::size_t>(lane)];
  bool& open = open_[static_cast<std::size_t>(lane)];
  const std::string& key = wanted.key.empty() ? wanted.text : wanted.key;
  if (open && toSeconds(now - spans.back().to) > kGap_s) open = false;  // not heard in between
  if (open) spans.back().to = now;
  if (open && spans.back().key == key && spans.back().look == wanted.look) return;
  open = !wanted.text.empty();
  if (open) spans.push_back({now, now, wanted.text, wanted.look, key});
}

void RunHistory::add(const Command& command) {
  if (isSetpoint(command.body)) return;
  commands_.push_back({command.issued, command.client_id, command.operator_name,
                       std::string(commandName(command.body)), command.nonce});
}

void RunHistory::add(const CommandAck& ack) {
  const auto found =
      std::find_if(commands_.rbegin(), commands_.rend(), [&](const HistoryCommand& c) {
        return c.nonce == ack.nonce && c.client_id == ack.client_id;
      });
  if (found == commands_.rend()) return;
  found->outcome = ack.outcome;
  found->reason = ack.reason;
}

void RunHistory::forgetBefore(Stamp limit) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    auto& spans = lanes_[i];
    std::size_t old = 0;
    while (old + (open_[i] ? 1 : 0) < spans.size() && spans[old].to < limit) ++old;
    spans.erase(spans.begin(), spans.begin() + static_cast<std::ptrdiff_t>(old));
  }
  const auto cut = [&](HistorySeries& series) {
    while (!series.empty() && series.front().stamp < limit) series.pop_front();
  };
  cut(force_);
  for (auto& [id, series] : figures_) cut(series);
}

const HistorySeries& RunHistory::figure(const std::string& id) const {
  static const HistorySeries kNone;
  const auto found = figures_.find(id);
  return found == figures_.end() ? kNone : found->second;
}

const HistorySpan* spanAt(const std::vector<HistorySpan>& spans, Stamp at) {
  const auto after = std::upper_bound(spans.begin(), spans.end(), at,
                                      [](Stamp t, const HistorySpan& s) { return t < s.from; });
  if (after == spans.begin()) return nullptr;
  const HistorySpan& span = *(after - 1);
  return at <= span.to ? &span : nullptr;
}

std::optional<double> sampleAt(const HistorySeries& series, Stamp at, double reach_s) {
  const auto after = std::upper_bound(series.begin(), series.end(), at,
                                      [](Stamp t, const HistorySample& s) { return t < s.stamp; });
  if (after == series.begin()) return std::nullopt;
  const HistorySample& sample = *(after - 1);
  if (toSeconds(at - sample.stamp) > reach_s || !std::isfinite(sample.value)) return std::nullopt;
  return sample.value;
}

}  // namespace kiln::gui
