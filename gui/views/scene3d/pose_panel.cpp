#include "gui/views/scene3d/pose_panel.h"

#include <QHBoxLayout>
#include <cmath>

#include "common/core/units.h"

namespace kiln::gui {

namespace {
constexpr int kWidth_px = 500, kHeight_px = 58;
constexpr double kHold_s = 1.0;
}  // namespace

PosePanel::PosePanel(const Ui& ui, PosePlacer& placer, QWidget* parent)
    : QFrame(parent),
      ui_(ui),
      placer_(placer),
      words_(new Banner(ui)),
      confirm_(new HoldButton(ui, tr("Set pose"), kHold_s)),
      cancel_(new ActButton(ui, tr("Cancel"))) {
  setObjectName(QStringLiteral("overlay"));
  confirm_->setKind(ActKind::Manual);
  confirm_->setSubtext(tr("hold 1 s"));
  cancel_->setSubtext(tr("Esc"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 6, 8, 6);
  row->setSpacing(8);
  row->addWidget(words_, 1);
  confirm_->setFixedSize(112, kHeight_px - 14);
  cancel_->setFixedSize(76, kHeight_px - 14);
  row->addWidget(confirm_);
  row->addWidget(cancel_);
  resize(kWidth_px, kHeight_px);
  connect(confirm_, &HoldButton::completed, &placer_, &PosePlacer::confirm);
  connect(cancel_, &QAbstractButton::clicked, &placer_, &PosePlacer::cancel);
  connect(&placer_, &PosePlacer::changed, this, &PosePanel::refresh);
  connect(&ui_.theme, &Theme::changed, this, &PosePanel::restyle);
  restyle();
  refresh();
}

void PosePanel::refresh() {
  using Phase = PosePlacer::Phase;
  const Pose2& pose = placer_.pose();
  const QString figures = tr("x %1 m, y %2 m, %3°")
                              .arg(pose.x_m, 0, 'f', 2)
                              .arg(pose.y_m, 0, 'f', 2)
                              .arg(pose.yaw_rad / kDeg, 0, 'f', 0);
  switch (placer_.phase()) {
    case Phase::Idle:
      break;
    case Phase::Armed:
      words_->set(tr("Press where the robot stands, drag to where it looks."));
      break;
    case Phase::Placed:
      words_->set(markup(tr("<b>%1</b><br>nothing moves; the next scan corrects it"), figures));
      break;
    case Phase::Sent:
      words_->set(markup(tr("<b>%1</b><br>sent …"), figures));
      break;
    case Phase::Refused:
      words_->set(placer_.reason(), BannerKind::Caution);
      break;
  }
  confirm_->setEnabled(placer_.phase() == Phase::Placed);
  setVisible(placer_.active());
  if (placer_.active()) raise();
}

void PosePanel::restyle() {
  const Palette& p = ui_.theme.colors();
  setStyleSheet(
      QStringLiteral("#overlay { background: %1; border: 1px solid %2; border-radius: 4px; }")
          .arg(p.panel.name(), p.manual.name()));
}

}  // namespace kiln::gui
