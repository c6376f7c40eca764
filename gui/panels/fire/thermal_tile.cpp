#include "gui/panels/fire/thermal_tile.h"

#include <QHBoxLayout>
#include <QToolButton>

#include "common/core/units.h"
#include "gui/widgets/text.h"
#include "gui/widgets/word_stack.h"

namespace kiln::gui {
namespace {

constexpr double kFrozen_s = 1.0;          // longer than the camera's own shutter pause of 0.6 s
constexpr double kHfov_rad = 57.0 * kDeg;  // of the Lepton, as the robot's localisation has it
constexpr int kColumn_px = 112;
// A tile narrower than this keeps its room for the picture: numbers without words beside it.
constexpr int kNarrow_px = 400;
constexpr int kNarrowColumn_px = 76;

const HeatBlob* hottestAccepted(const HeatDetections* heat) {
  if (!heat || !heat->usable) return nullptr;
  for (const HeatBlob& blob : heat->blobs)
    if (blob.rejection == HeatRejection::None) return &blob;
  return nullptr;
}

QString rejectedText(const HeatDetections* heat) {
  if (!heat) return {};
  int count = 0;
  QString last;
  for (const HeatBlob& blob : heat->blobs) {
    if (blob.rejection == HeatRejection::None) continue;
    ++count;
    const auto why = toString(blob.rejection);
    last = QString::fromUtf8(why.data(), static_cast<int>(why.size()));
  }
  if (count == 0) return {};
  return count == 1 ? ThermalTile::tr("1 rejected: %1").arg(last)
                    : ThermalTile::tr("%1 rejected").arg(count);
}

}  // namespace

ThermalTile::ThermalTile(const Ui& ui, StationModels& models,
                         const std::optional<RobotGeometry>& geometry, QWidget* parent)
    : Tile(ui, tr("Thermal"), parent),
      ui_(ui),
      models_(models),
      heat_(models.link),
      aim_(models),
      geometry_(geometry),
      view_(new ThermalView(ui)) {
  auto* content = new QWidget;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addWidget(view_, 1);
  row->addWidget(makeColumn());
  setContent(content);
  connect(&aim_, &PictureMarks::changed, this, &ThermalTile::refresh);
  connect(&models_.thermal, &Model::changed, this, &ThermalTile::refresh);
  connect(&models_, &StationModels::aged, this, &ThermalTile::refreshAge);
  connect(&ui_.theme, &Theme::changed, this, &ThermalTile::restyle);
  connect(view_, &ThermalView::hovered, this,
          [this](const QString& reading) { reading_->setText(reading); });
  connect(scale_, &QToolButton::toggled, this, [this](bool automatic) {
    view_->setAutomaticScale(automatic);
    nameScale();
    restyle();
  });
  restyle();
  refresh();
}

QWidget* ThermalTile::makeColumn() {
  column_ = new QWidget;
  column_->setFixedWidth(kColumn_px);
  auto* layout = new QVBoxLayout(column_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  peak_caption_ = new Label(tr("Peak"));
  peak_ = new Label;
  box_ = new Label;
  rejected_ = new Label;
  reading_ = new Label;
  auto* words = new WordStack(3);  // the key below stands still whatever is found
  for (Label* label : {peak_caption_, peak_, box_, rejected_, reading_}) {
    label->setWordWrap(label != peak_);
    words->add(label);
  }
  layout->addWidget(words, 1);
  scale_ = new QToolButton;
  scale_->setCheckable(true);
  nameScale();
  setTip(*scale_,
         tr("fixed 20 to 150 °C, or fitted to each picture (then the same colour means another "
            "temperature)"));
  scale_->setFocusPolicy(Qt::NoFocus);
  layout->addWidget(scale_);
  return column_;
}

void ThermalTile::resizeEvent(QResizeEvent* event) {
  Tile::resizeEvent(event);
  const bool narrow = width() < kNarrow_px;
  column_->setFixedWidth(narrow ? kNarrowColumn_px : kColumn_px);
  view_->setCompact(narrow);
  for (Label* label : {box_, rejected_, reading_}) label->setVisible(!narrow);
  nameScale();
}

void ThermalTile::nameScale() {
  const QString kind = scale_->isChecked() ? tr("AUTO") : tr("fixed");
  scale_->setText(width() < kNarrow_px ? kind : tr("scale: %1").arg(kind));
}

QString ThermalTile::refusal() const {
  const ThermalImagePtr& image = models_.thermal.image();
  if (!image) return tr("no thermal picture yet");
  if (!isWhole(*image))
    return tr("picture damaged: %1 of %2 pixels")
        .arg(image->counts.size())
        .arg(image->width * image->height);
  if (image->agc) return tr("AGC is on: shades are contrast, no temperatures");
  if (!hasTemperatures(*image)) return tr("not TLinear: shades are no temperatures");
  if (image->ffc == FfcState::Running) return tr("shutter closed: the camera calibrates itself");
  const double frozen_s = models_.thermal.frozenS();
  if (frozen_s > kFrozen_s) return tr("frozen %1 s: frames repeat").arg(frozen_s, 0, 'f', 1);
  if (heat_.heat() && !heat_.heat()->usable) return QString::fromStdString(heat_.heat()->refusal);
  return {};
}

void ThermalTile::refresh() {
  describe();
  refreshAge();
}

void ThermalTile::describe() {
  const ThermalImagePtr& image = models_.thermal.image();
  const HeatDetections* heat = heat_.heat().get();
  const HeatBlob* fire = hottestAccepted(heat);
  const auto hottest = image ? peakCelsius(*image) : std::nullopt;
  const double peak_c = fire ? toCelsius(fire->peak_k) : hottest.value_or(0.0);
  peak_caption_->setText(fire ? tr("Peak of the source") : tr("Hottest pixel"));
  peak_->setText(fire || hottest ? tr("%1 °C").arg(peak_c, 0, 'f', 0) : QStringLiteral("–"));
  box_->setText(fire ? tr("Box %1 × %2 px")
                           .arg(fire->u_max - fire->u_min + 1)
                           .arg(fire->v_max - fire->v_min + 1)
                     : tr("no source found"));
  rejected_->setText(rejectedText(heat));
}

void ThermalTile::refreshAge() {
  const double age_s = models_.thermal.ageS();
  setAge(age_s, models_.thermal.ageLevel());
  setInfo(models_.thermal.hasData() ? tr("%1 Hz").arg(models_.thermal.rateHz(), 0, 'f', 1)
                                    : QString());
  setStaleText(models_.link.readOnly() ? tr("recorded %1 before this moment").arg(ageText(age_s))
                                       : tr("no new frame for %1").arg(ageText(age_s)),
               tr("temperatures may have changed"));
  // Once the tile is hatched over it speaks for itself.
  view_->show(models_.thermal.image(), heat_.heat(),
              models_.thermal.ageLevel() == AgeLevel::Red ? QString() : refusal());
  view_->setMarks(placedMarks());
}

std::vector<PlacedMark> ThermalTile::placedMarks() const {
  const ThermalImagePtr& image = models_.thermal.image();
  const RobotStatus* status = models_.status.status();
  if (!geometry_ || !image || !status || models_.thermal.ageLevel() == AgeLevel::Red) return {};
  const Eigen::Isometry3d X_map_camera = toIsometry(status->X_map_base) *
                                         geometry_->X_base_flange(status->arm.q) *
                                         geometry_->X_flange_thermal.pose();
  std::vector<PlacedMark> out;
  for (const PictureMark& mark : aim_.marks()) {
    const auto share =
        placeInPicture(mark.p_map, X_map_camera, kHfov_rad, {image->width, image->height});
    if (share) out.push_back({*share, mark.label});
  }
  return out;
}

void ThermalTile::restyle() {
  const Palette& p = ui_.theme.colors();
  const auto style = [](Label* label, const QColor& color, const QFont& font) {
    label->setFont(font);
    label->setStyleSheet(QStringLiteral("color: %1").arg(color.name()));
  };
  QFont large = ui_.theme.font(TextRole::Value);
  large.setPointSizeF(large.pointSizeF() * 1.5);  // read from across the tent
  style(peak_caption_, p.dim, ui_.theme.font(TextRole::Small));
  style(peak_, p.text, large);
  style(box_, p.dim, ui_.theme.font(TextRole::Small));
  style(rejected_, p.dim, ui_.theme.font(TextRole::Small));
  style(reading_, p.text, ui_.theme.font(TextRole::Small));
  scale_->setFont(ui_.theme.font(TextRole::Small));
  scale_->setStyleSheet(
      QStringLiteral(
          "QToolButton { border: 1px solid %1; border-radius: 3px; padding: 2px 6px; color: %2; }")
          .arg(p.border.name(), scale_->isChecked() ? p.caution.name() : p.dim.name()));
}

}  // namespace kiln::gui
