#include "gui/views/record/record_chip.h"

#include <QFontMetrics>
#include <QHBoxLayout>
#include <QPainter>
#include <QStringList>

#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kHeight_px = 22, kButton_px = 78, kMark_px = 18, kText_px = 430;
constexpr double kLittleDisk_bytes = 2e9;

QString clock(double seconds) {
  const int whole = static_cast<int>(seconds);
  return QStringLiteral("%1:%2")
      .arg(whole / 60, 2, 10, QLatin1Char('0'))
      .arg(whole % 60, 2, 10, QLatin1Char('0'));
}
}  // namespace

QString bytesText(double bytes) {
  if (bytes < 1e6) return QStringLiteral("%1 kB").arg(bytes / 1e3, 0, 'f', 0);
  if (bytes < 1e9) return QStringLiteral("%1 MB").arg(bytes / 1e6, 0, 'f', bytes < 1e8 ? 1 : 0);
  return QStringLiteral("%1 GB").arg(bytes / 1e9, 0, 'f', bytes < 1e10 ? 2 : 0);
}

RecordChip::RecordChip(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models), button_(new ActButton(ui, tr("Record"), this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  button_->setFixedSize(kButton_px, kHeight_px);
  row->addWidget(button_);
  setFixedHeight(kHeight_px);
  connect(button_, &QAbstractButton::clicked, this, &RecordChip::act);
  connect(&models_.status, &Model::changed, this, &RecordChip::refresh);
  connect(&models_, &StationModels::aged, this, &RecordChip::refresh);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

bool RecordChip::troubled() const {
  const RobotStatus* status = models_.status.status();
  if (!status) return false;
  const RecordingStatus& r = status->recording;
  return !r.problem.empty() || (r.on && (r.dropped > 0 || r.disk_free_bytes < kLittleDisk_bytes));
}

QString RecordChip::text() const {
  const RobotStatus* status = models_.status.status();
  if (!status) return {};
  const RecordingStatus& r = status->recording;
  if (!r.problem.empty()) return QString::fromStdString(r.problem);
  QStringList words;
  if (r.on) {
    words << tr("REC %1").arg(clock(r.duration_s)) << bytesText(static_cast<double>(r.bytes))
          << tr("%1 free").arg(bytesText(r.disk_free_bytes));
    if (r.dropped > 0) words << tr("%1 lost").arg(r.dropped);
    words << QString::fromStdString(r.file);
  } else if (!r.file.empty()) {
    words << tr("last %1").arg(QString::fromStdString(r.file))
          << bytesText(static_cast<double>(r.bytes));
  }
  return words.join(QStringLiteral(" · "));
}

QSize RecordChip::sizeHint() const {
  const QString shown = text();
  const int width =
      shown.isEmpty()
          ? 0
          : kMark_px + QFontMetrics(ui_.theme.font(TextRole::Small)).horizontalAdvance(shown) + 10;
  return {std::min(width, kText_px) + kButton_px, kHeight_px};
}

void RecordChip::act() {
  const RobotStatus* status = models_.status.status();
  if (!status) return;
  const bool on = !status->recording.on;
  models_.commands.send(SetRecording{on}, on ? tr("start recording") : tr("stop recording"));
}

void RecordChip::refresh() {
  const RobotStatus* status = models_.status.status();
  const bool on = status && status->recording.on;
  setVisible(!models_.link.readOnly());
  button_->setText(on ? tr("Stop rec.") : tr("Record"));
  button_->setEnabled(status && models_.link_state.usable());
  setTip(*button_, tr("Records the run on the robot; moves nothing and needs no lease."));
  setTip(*this, text());
  if (width() != sizeHint().width()) setFixedWidth(sizeHint().width());
  update();
}

void RecordChip::paintEvent(QPaintEvent*) {
  const RobotStatus* status = models_.status.status();
  if (!status || text().isEmpty()) return;
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF c(8, height() / 2.0);
  const QColor color = troubled() ? p.caution : status->recording.on ? p.text : p.dim;
  painter.setPen(QPen(color, 1.5));
  painter.setBrush(status->recording.on || troubled() ? QBrush(color) : QBrush(Qt::NoBrush));
  if (troubled()) {
    painter.drawPolygon(QPolygonF()
                        << c + QPointF(0, -5) << c + QPointF(5.5, 4.5) << c + QPointF(-5.5, 4.5));
  } else {
    painter.drawEllipse(c, 4.5, 4.5);
  }
  const QFont small = ui_.theme.font(TextRole::Small);
  const int room = button_->x() - kMark_px - 8;
  painter.setFont(small);
  painter.setPen(color);
  painter.drawText(QRect(kMark_px, 0, room, height()), Qt::AlignVCenter | Qt::AlignLeft,
                   QFontMetrics(small).elidedText(text(), Qt::ElideRight, room));
}

}  // namespace kiln::gui
