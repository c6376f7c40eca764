#include "gui/models/status_models.h"

#include <algorithm>

namespace kiln::gui {

StatusModel::StatusModel(Link& link, QObject* parent) : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::status, this, [this](std::shared_ptr<const RobotStatus> status) {
    status_ = std::move(status);
    arrived(status_->stamp);
  });
  connect(&link, &Link::hello, this, [this](const HelloReply& reply) {
    hello_ = reply;
    touch();
  });
}

StatusWord StatusModel::word() const {
  if (!status_ || ageLevel() == AgeLevel::Red) return StatusWord::NoLink;
  return status_->word;
}

QString StatusModel::robotName() const {
  if (status_) return QString::fromStdString(status_->robot_name);
  return QString::fromStdString(hello_.robot_name);
}

LinkModel::LinkModel(Link& link, QObject* parent) : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::health, this, [this](const LinkHealth& health) {
    health_ = health;
    arrived(this->link().robotNow().value_or(Stamp{}));
  });
}

MacroModel::MacroModel(Link& link, QObject* parent) : Model(link, kSlowAge, parent) {
  connect(&link, &Link::macros, this, [this](const std::vector<MacroInfo>& macros) {
    macros_ = macros;
    touch();
  });
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    running_ = status->macro;
    arrived(status->stamp);
  });
}

namespace {
/// A recording tells the newest lines before the place that it jumps to once more.
bool known(const std::deque<LogLine>& lines, const LogLine& line) {
  if (lines.empty() || line.stamp > lines.back().stamp) return false;
  return std::any_of(lines.begin(), lines.end(), [&](const LogLine& old) {
    return old.stamp == line.stamp && old.logger == line.logger && old.text == line.text;
  });
}
}  // namespace

LogModel::LogModel(Link& link, QObject* parent) : Model(link, kSlowAge, parent) {
  connect(&link, &Link::restarted, this, [this] {
    // A jump back: what was logged later has not happened yet.
    const auto now = this->link().robotNow();
    if (now) std::erase_if(lines_, [&](const LogLine& line) { return line.stamp > *now; });
    touch();
  });
  connect(&link, &Link::log, this, [this](const std::vector<LogLine>& lines) {
    for (const LogLine& line : lines) {
      if (!known(lines_, line)) add(line);
    }
  });
}

void LogModel::addOwn(int level, const QString& text) {
  add(LogLine{link().robotNow().value_or(Stamp{}), level, "station", text.toStdString()});
}

void LogModel::add(LogLine line) {
  if (lines_.size() == kCapacity) lines_.pop_front();
  const Stamp stamp = line.stamp;
  lines_.push_back(std::move(line));
  ++total_;
  arrived(stamp);
}

}  // namespace kiln::gui
