#include "gui/views/log/log_view.h"

#include <QScrollBar>
#include <QTextCharFormat>
#include <QTextCursor>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr int kWarn = 3;
constexpr int kError = 4;
}  // namespace

LogView::LogView(const Ui& ui, StationModels& models, QWidget* parent)
    : QPlainTextEdit(parent), ui_(ui), models_(models) {
  setReadOnly(true);
  setFrameShape(QFrame::NoFrame);
  setMaximumBlockCount(static_cast<int>(LogModel::kCapacity));
  setFocusPolicy(Qt::ClickFocus);
  connect(&models_.log, &Model::changed, this, &LogView::append);
  connect(&models_.link, &Link::restarted, this, &LogView::rebuild);
  connect(&ui_.theme, &Theme::changed, this, &LogView::rebuild);
  rebuild();
}

QString LogView::lineText(const LogLine& line, Stamp zero) {
  const double t = toSeconds(line.stamp - zero);
  const int whole = static_cast<int>(std::floor(std::abs(t)));
  const QString mark = line.level >= kError  ? QStringLiteral("✕")
                       : line.level == kWarn ? QStringLiteral("▲")
                                             : QStringLiteral("  ");
  return QStringLiteral("%1%2:%3  %4 %5: %6")
      .arg(t < 0 ? QStringLiteral("−") : QString{})
      .arg(whole / 60, 2, 10, QLatin1Char('0'))
      .arg(whole % 60, 2, 10, QLatin1Char('0'))
      .arg(mark, QString::fromStdString(line.logger), QString::fromStdString(line.text));
}

void LogView::addLine(const LogLine& line) {
  const Palette& p = ui_.theme.colors();
  QTextCharFormat format;
  format.setForeground(line.level >= kError ? p.fault : line.level == kWarn ? p.caution : p.text);
  QTextCursor cursor(document());
  cursor.movePosition(QTextCursor::End);
  if (!document()->isEmpty()) cursor.insertBlock();
  const RobotStatus* status = models_.status.status();
  // Mission time, as on the clock above; before a mission the robot's own time.
  const Stamp zero = status ? status->stamp - fromSeconds(status->mission_elapsed_s) : Stamp{};
  cursor.insertText(lineText(line, zero), format);
}

void LogView::append() {
  const auto& lines = models_.log.lines();
  const std::uint64_t first = models_.log.total() - lines.size();
  const bool at_end = verticalScrollBar()->value() >= verticalScrollBar()->maximum() - 2;
  for (std::uint64_t i = std::max(shown_, first); i < models_.log.total(); ++i) {
    addLine(lines[static_cast<std::size_t>(i - first)]);
  }
  shown_ = models_.log.total();
  if (at_end) verticalScrollBar()->setValue(verticalScrollBar()->maximum());
}

void LogView::rebuild() {
  setFont(ui_.theme.font(TextRole::Small));
  clear();
  shown_ = 0;
  append();
}

}  // namespace kiln::gui
