#include "gui/views/camera/camera_tile.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "common/core/units.h"
#include "common/geom/frames.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/hatch.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kNoteMargin_px = 14;
constexpr double kHfov_rad = 78.0 * kDeg;  // of both cameras, as the robot's calibration has it
}  // namespace

CameraTile::CameraTile(const Ui& ui, StationModels& models, QWidget* parent)
    : Tile(ui, tr("Camera"), parent),
      ui_(ui),
      models_(models),
      picture_(new CameraPicture(ui)),
      choice_(new QButtonGroup(this)) {
  setContent(picture_, true);
  addHeaderWidget(makeChoice());
  connect(&models_.link, &Link::image, this, &CameraTile::accept);
  connect(&models_.link, &Link::absent, this, [this](const std::vector<Topic>& topics) {
    for (const Topic topic : topics) {
      if (topic == Topic::HeadCamera) feeds_[Head] = CameraFeed();
      if (topic == Topic::OperatorCamera) feeds_[Operator] = CameraFeed();
    }
    refresh();
  });
  connect(&models_.camera, &Model::changed, this, &CameraTile::refresh);
  connect(&models_.head_camera, &Model::changed, this, &CameraTile::refresh);
  connect(&models_, &StationModels::aged, this, &CameraTile::refresh);
  connect(&ui_.theme, &Theme::changed, this, &CameraTile::restyle);
  showCamera(Operator);
}

void CameraTile::accept(const RgbImagePtr& image) {
  if (!image) return;
  feeds_[image->frame == frames::kRgb ? Head : Operator].accept(image, ui_.clock.now());
}

const CameraModel& CameraTile::model(Camera camera) const {
  return camera == Head ? models_.head_camera : models_.camera;
}

QWidget* CameraTile::makeChoice() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(1);
  for (const Camera camera : {Operator, Head}) {
    auto* button = new QToolButton;
    button->setText(camera == Operator ? tr("operator") : tr("head"));
    setTip(*button,
           camera == Operator ? tr("rear top, over the deck") : tr("at the end of the arm"));
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    choice_->addButton(button, camera);
    row->addWidget(button);
  }
  connect(choice_, &QButtonGroup::idClicked, this,
          [this](int id) { showCamera(static_cast<Camera>(id)); });
  return bar;
}

void CameraTile::showCamera(Camera camera) {
  shown_ = camera;
  restyle();
  refresh();
}

void CameraTile::refresh() {
  for (const Camera camera : {Operator, Head}) {
    feeds_[camera].setRecorded(models_.link.readOnly());
    feeds_[camera].judge(ui_.clock.now(), model(camera).ageS());
  }
  const CameraFeed& feed = feeds_[shown_];
  const CameraModel& source = model(shown_);
  // The picture crosses itself out with its own words, so the tile's general hatch stays off.
  setAge(source.ageS(), feed.state() == CameraState::Live        ? AgeLevel::Fresh
                        : feed.state() == CameraState::NoPicture ? AgeLevel::None
                                                                 : AgeLevel::Amber);
  const QString rate = source.hasData() ? tr("%1 Hz").arg(source.rateHz(), 0, 'f', 1) : QString();
  setInfo(feed.state() == CameraState::Late ? tr("%1 · late").arg(rate) : rate);
  picture_->show(feed, placedMarks());
}

void CameraTile::setMarks(PictureMarks* marks, const RobotGeometry& geometry) {
  delete std::exchange(marks_, marks);
  geometry_ = geometry;
  if (marks_) {
    marks_->setParent(this);
    connect(marks_, &PictureMarks::changed, this, &CameraTile::refresh);
  }
  refresh();
}

std::vector<PlacedMark> CameraTile::placedMarks() const {
  const RobotStatus* status = models_.status.status();
  const QSize size = feeds_[shown_].picture().size();
  if (!marks_ || !status || feeds_[shown_].crossedOut()) return {};
  const Eigen::Isometry3d X_base_camera =
      shown_ == Head ? geometry_.X_base_flange(status->arm.q) * geometry_.X_flange_rgb.pose()
                     : geometry_.X_base_operatorcamera.pose();
  std::vector<PlacedMark> out;
  for (const PictureMark& mark : marks_->marks()) {
    const auto share =
        placeInPicture(mark.p_map, toIsometry(status->X_map_base) * X_base_camera, kHfov_rad, size);
    if (share) out.push_back({*share, mark.label});
  }
  return out;
}

void CameraTile::restyle() {
  const Palette& p = ui_.theme.colors();
  for (QAbstractButton* button : choice_->buttons()) {
    const bool on = choice_->id(button) == shown_;
    button->setChecked(on);
    button->setFont(ui_.theme.font(TextRole::Small));
    button->setStyleSheet(QStringLiteral("QToolButton { border: none; padding: 1px 5px; "
                                         "border-radius: 3px; color: %1; background: %2; }")
                              .arg(on ? p.text.name() : p.dim.name(),
                                   on ? p.raised.name() : QStringLiteral("transparent")));
  }
}

CameraPicture::CameraPicture(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void CameraPicture::show(const CameraFeed& feed, std::vector<PlacedMark> marks) {
  feed_ = &feed;
  marks_ = std::move(marks);
  update();
}

void CameraPicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Palette& p = ui_.theme.colors();
  painter.fillRect(rect(), p.sunk);
  if (!feed_) return;
  const QImage& picture = feed_->picture();
  QRectF area = rect();
  if (!picture.isNull()) {
    const QSizeF fitted = QSizeF(picture.size()).scaled(rect().size(), Qt::KeepAspectRatio);
    area = QRectF(QPointF(0.5 * (width() - fitted.width()), 0.5 * (height() - fitted.height())),
                  fitted);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(area, picture);
  }
  paintPictureMarks(painter, marks_, area, ui_.theme);
  if (feed_->crossedOut()) paintCrossedOut(painter, area);
  if (feed_->crossedOut() || feed_->state() == CameraState::NoPicture)
    paintNote(painter, rect(), feed_->headline(), feed_->advice());
}

void CameraPicture::paintCrossedOut(QPainter& painter, const QRectF& area) const {
  const Palette& p = ui_.theme.colors();
  QColor veil = p.panel;
  veil.setAlphaF(0.55F);
  painter.fillRect(area, veil);
  QColor stripe = p.caution;
  stripe.setAlphaF(0.4F);
  paintHatch(painter, area, stripe);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(p.caution, 2.0));
  painter.drawLine(area.topLeft(), area.bottomRight());
  painter.drawLine(area.topRight(), area.bottomLeft());
}

void CameraPicture::paintNote(QPainter& painter, const QRectF& area, const QString& headline,
                              const QString& advice) const {
  const Palette& p = ui_.theme.colors();
  const bool quiet = feed_->state() == CameraState::NoPicture;
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  const QFontMetricsF strong_metrics(strong), small_metrics(small);
  const double w =
      std::max(strong_metrics.horizontalAdvance(headline), small_metrics.horizontalAdvance(advice));
  const double width = std::min(w + 2 * kNoteMargin_px, area.width() - 6);
  const FittedText below = fitText(advice, {small}, static_cast<int>(width) - 8, 2);
  const double h = strong_metrics.height() + below.height();
  QRectF box(0, 0, width, h + kNoteMargin_px);
  box.moveCenter(area.center());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(quiet ? p.border : p.caution, 1.2));
  painter.setBrush(p.panel);
  painter.drawRoundedRect(box, 3, 3);
  const QRectF inner = box.adjusted(4, kNoteMargin_px / 2, -4, -kNoteMargin_px / 2);
  painter.setPen(quiet ? p.dim : p.caution);
  painter.setFont(strong);
  painter.drawText(inner, Qt::AlignTop | Qt::AlignHCenter,
                   strong_metrics.elidedText(headline, Qt::ElideRight, inner.width()));
  painter.setPen(p.dim);
  paintFitted(painter, inner, Qt::AlignBottom | Qt::AlignHCenter, below);
}

}  // namespace kiln::gui
