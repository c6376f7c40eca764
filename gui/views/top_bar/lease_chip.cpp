#include "gui/views/top_bar/lease_chip.h"

#include <QHBoxLayout>
#include <QPainter>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kText_px = 128, kButton_px = 88;
constexpr int kHeight_px = 36;
}  // namespace

LeaseChip::LeaseChip(const Ui& ui, LeaseModel& lease, QWidget* parent)
    : QWidget(parent), ui_(ui), lease_(lease), button_(new ActButton(ui, tr("Request"), this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(kText_px, 0, 0, 0);
  row->addWidget(button_);
  button_->setFixedSize(kButton_px, kHeight_px);
  setFixedSize(kText_px + kButton_px, kHeight_px);
  connect(button_, &QAbstractButton::clicked, this, &LeaseChip::act);
  connect(&lease_, &Model::changed, this, &LeaseChip::refresh);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  refresh();
}

QString LeaseChip::shortText() const {
  return lease_.holder() == LeaseHolder::Other ? lease_.holderName() : text();
}

QString LeaseChip::text() const {
  switch (lease_.holder()) {
    case LeaseHolder::Unknown:
      return tr("Lease unknown");
    case LeaseHolder::Free:
      return tr("Control is free");
    case LeaseHolder::Mine:
      return lease_.askedBy().isEmpty() ? tr("You in control") : lease_.askedBy();
    case LeaseHolder::Other:
      return tr("%1 in control").arg(lease_.holderName());
  }
  return {};
}

void LeaseChip::act() {
  if (lease_.mine())
    lease_.release();
  else
    lease_.request(lease_.holder() == LeaseHolder::Other);
}

void LeaseChip::refresh() {
  const LeaseHolder holder = lease_.holder();
  button_->setText(lease_.requesting() ? tr("asking …")
                   : holder == LeaseHolder::Mine
                       ? lease_.askedBy().isEmpty() ? tr("Release") : tr("Hand over")
                   : holder == LeaseHolder::Other ? tr("Take over")
                                                  : tr("Request"));
  button_->setKind(holder == LeaseHolder::Free   ? ActKind::Primary
                   : !lease_.askedBy().isEmpty() ? ActKind::Caution
                                                 : ActKind::Normal);
  button_->setEnabled(lease_.possible() && holder != LeaseHolder::Unknown && !lease_.requesting());
  setTip(
      *this,
      !lease_.possible() ? tr("A recording cannot be commanded.")
      : lease_.refusal().isEmpty()
          ? tr("%1. The lease lets one station command the robot. STOP needs no lease.").arg(text())
          : tr("Refused: %1").arg(lease_.refusal()));
  update();
}

void LeaseChip::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  const LeaseHolder holder = lease_.holder();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(holder == LeaseHolder::Mine ? p.manual : p.border, 1.2));
  painter.setBrush(p.sunk);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
  // Shape tells it as well: a filled dot is you, a ring is nobody, a half-filled one is somebody
  // else.
  const QRectF dot(9, height() / 2.0 - 4.5, 9, 9);
  const QColor mark = holder == LeaseHolder::Mine    ? p.manual
                      : holder == LeaseHolder::Other ? p.caution
                                                     : p.dim;
  painter.setPen(QPen(mark, 1.6));
  painter.setBrush(holder == LeaseHolder::Mine ? QBrush(mark) : Qt::NoBrush);
  painter.drawEllipse(dot);
  if (holder == LeaseHolder::Other) {
    painter.setBrush(mark);
    painter.drawPie(dot, 90 * 16, 180 * 16);
  }
  painter.setPen(holder == LeaseHolder::Unknown ? p.faint : p.text);
  const QFont small = ui_.theme.font(TextRole::Small);
  const QRect area(24, 0, kText_px - 28, height());
  FittedText words = fitText(text(), {small}, area.width(), 2);
  // The mark says "somebody else" already: a long name goes before the words about it.
  if (!words.whole) words = fitText(shortText(), {small}, area.width(), 2);
  paintFitted(painter, area, Qt::AlignLeft | Qt::AlignVCenter, words);
}

}  // namespace kiln::gui
