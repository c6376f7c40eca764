#include "gui/app/tile_layout.h"

#include <QEvent>
#include <QStringList>
#include <algorithm>
#include <optional>

#include "gui/widgets/act_button.h"

namespace kiln::gui {

namespace {
constexpr int kGap_px = 6, kTab_px = 30;
constexpr double kLeftShare = 0.285;
constexpr int kLeftMin_px = 340, kLeftMax_px = 500;
constexpr double kRightShare = 0.240;
constexpr int kRightMin_px = 366, kRightMax_px = 430;
constexpr double kImagesShare = 0.20;
constexpr int kImagesMin_px = 186, kImagesMax_px = 300;
constexpr double kBottomShare = 0.21;
constexpr int kBottomMin_px = 140, kBottomMax_px = 250;
constexpr int kLow_px = 900;
constexpr QSize kSmall{1280, 690};
const auto kLogWord = QStringLiteral("log"), kMacrosWord = QStringLiteral("macros");

int share(int whole, double part, int low, int high) {
  return std::clamp(static_cast<int>(whole * part), low, high);
}

/// nullopt: as high as there is room.
void setHeight(QWidget& widget, std::optional<int> height_px) {
  widget.setMinimumHeight(height_px.value_or(0));
  widget.setMaximumHeight(height_px.value_or(QWIDGETSIZE_MAX));
}

QBoxLayout* row(QBoxLayout::Direction direction) {
  auto* out = new QBoxLayout(direction);
  out->setContentsMargins(0, 0, 0, 0);
  out->setSpacing(kGap_px);
  return out;
}
}  // namespace

TileLayout::TileLayout(const Ui& ui, const Tiles& tiles, QWidget& window)
    : QObject(&window),
      ui_(ui),
      tiles_(tiles),
      middle_(row(QBoxLayout::LeftToRight)),
      centre_(row(QBoxLayout::TopToBottom)),
      bottom_(row(QBoxLayout::LeftToRight)),
      middle_tabs_(makeTabs({{tr("Scene"), tiles.scene},
                             {tr("Mission"), tiles.mission},
                             {tr("Pictures"), tiles.pictures},
                             {tr("Timeline"), tiles.timeline}})),
      right_(makeRight()),
      front_(tiles.scene) {
  middle_->addWidget(tiles_.mission);
  middle_->addLayout(centre_, 1);
  middle_->addWidget(right_);
  centre_->addWidget(middle_tabs_);
  centre_->addWidget(tiles_.scene, 1);
  centre_->addWidget(tiles_.pictures);
  bottom_->addWidget(tiles_.timeline, 3);
  bottom_->addWidget(tiles_.log, 2);
  tiles_.log->hide();
  tiles_.pictures->installEventFilter(this);
  for (Tile* tile : {tiles_.mission, tiles_.scene, tiles_.timeline}) watch(*tile);
  for (Tile* tile : pictureTiles()) watch(*tile);
}

QWidget* TileLayout::makeTabs(const std::vector<std::pair<QString, QWidget*>>& tabs) {
  auto* out = new QWidget;
  out->setLayout(row(QBoxLayout::LeftToRight));
  for (const auto& [title, tile] : tabs) {
    auto* tab = new ActButton(ui_, title);
    tab->setFixedHeight(kTab_px);
    out->layout()->addWidget(tab);
    tabs_.emplace_back(tab, tile);
    connect(tab, &QAbstractButton::clicked, this, [this, tile = tile] {
      if (tile == tiles_.teleop || tile == tiles_.macros) return showMacros(tile == tiles_.macros);
      front_ = tile;
      large_ = nullptr;
      log_shown_ = false;
      arrange(size_);
    });
  }
  return out;
}

QWidget* TileLayout::makeRight() {
  auto* right = new QWidget;
  auto* column = row(QBoxLayout::TopToBottom);
  right->setLayout(column);
  right_tabs_ = makeTabs({{tr("Take over"), tiles_.teleop}, {tr("Macros"), tiles_.macros}});
  column->addWidget(tiles_.state, 1);
  for (QWidget* widget :
       {right_tabs_, static_cast<QWidget*>(tiles_.teleop), static_cast<QWidget*>(tiles_.macros)})
    column->addWidget(widget);
  return right;
}

bool TileLayout::low() const { return size_.height() < kLow_px; }

bool TileLayout::small() const {
  return size_.width() < kSmall.width() || size_.height() < kSmall.height();
}

std::vector<Tile*> TileLayout::pictureTiles() const {
  const auto found = tiles_.pictures->findChildren<Tile*>(QString(), Qt::FindDirectChildrenOnly);
  return {found.begin(), found.end()};
}

bool TileLayout::inFront(const QWidget* tile) const {
  if (large_) return tile == large_ || (tile == tiles_.pictures && tile == large_->parentWidget());
  return !small() || tile == front_;
}

void TileLayout::watch(Tile& tile) {
  connect(&tile, &Tile::titleDoubleClicked, this, [this, &tile] { enlarge(&tile); });
}

bool TileLayout::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildAdded)
    if (auto* tile = qobject_cast<Tile*>(static_cast<QChildEvent*>(event)->child())) watch(*tile);
  return QObject::eventFilter(watched, event);
}

void TileLayout::arrange(const QSize& window) {
  size_ = window;
  if (size_.isEmpty()) return;
  arrangeMiddle();
  arrangeRight();
  markTabs();
}

void TileLayout::arrangeMiddle() {
  const bool one = small() || large_;
  middle_tabs_->setVisible(small());
  if (one) {
    for (QWidget* tile : {static_cast<QWidget*>(tiles_.mission), tiles_.pictures,
                          static_cast<QWidget*>(tiles_.timeline)})
      centre_->addWidget(tile, 1);
  } else {
    middle_->insertWidget(0, tiles_.mission);
    centre_->addWidget(tiles_.pictures);
    bottom_->insertWidget(0, tiles_.timeline, 3);
  }
  // A small window has no room below its middle.
  if (small())
    centre_->addWidget(tiles_.log, 1);
  else
    bottom_->addWidget(tiles_.log, 2);
  const bool log_alone = small() && log_shown_;
  for (QWidget* tile : {static_cast<QWidget*>(tiles_.mission), static_cast<QWidget*>(tiles_.scene),
                        tiles_.pictures, static_cast<QWidget*>(tiles_.timeline)})
    tile->setVisible(inFront(tile) && !log_alone);
  for (Tile* tile : pictureTiles()) tile->setVisible(!large_ || inFront(tile));
  tiles_.log->setVisible(log_shown_);
  const int left = share(size_.width(), kLeftShare, kLeftMin_px, kLeftMax_px);
  tiles_.mission->setMinimumWidth(one ? 0 : left);
  tiles_.mission->setMaximumWidth(one ? QWIDGETSIZE_MAX : left);
  const auto fixed = [&](bool alone, double part, int low, int high) {
    return alone ? std::nullopt : std::optional(share(size_.height(), part, low, high));
  };
  setHeight(*tiles_.pictures, fixed(one, kImagesShare, kImagesMin_px, kImagesMax_px));
  setHeight(*tiles_.timeline, fixed(one, kBottomShare, kBottomMin_px, kBottomMax_px));
  setHeight(*tiles_.log, fixed(small(), kBottomShare, kBottomMin_px, kBottomMax_px));
}

void TileLayout::arrangeRight() {
  right_->setFixedWidth(share(size_.width(), kRightShare, kRightMin_px, kRightMax_px));
  right_tabs_->setVisible(low());
  tiles_.teleop->setVisible(!low() || !macros_in_front_);
  tiles_.macros->setVisible(!low() || macros_in_front_);
}

void TileLayout::markTabs() {
  for (const auto& [tab, tile] : tabs_) {
    const bool right = tile == tiles_.teleop || tile == tiles_.macros;
    const bool on = right ? (tile == tiles_.macros) == macros_in_front_
                          : inFront(tile) && !(small() && log_shown_);
    tab->setKind(on ? ActKind::Primary : ActKind::Normal);
  }
}

void TileLayout::showLog(bool shown) {
  log_shown_ = shown;
  arrange(size_);
}

void TileLayout::showMacros(bool in_front) {
  macros_in_front_ = in_front;
  arrange(size_);
  if (tiles_.macros->isVisible() && in_front) tiles_.macros->setFocus();  // its keys jog
}

void TileLayout::bringToFront(Tile& tile) {
  if (inFront(&tile) && !(small() && log_shown_)) return;
  front_ = &tile;
  large_ = nullptr;
  if (small()) log_shown_ = false;
  arrange(size_);
}

void TileLayout::enlarge(Tile* tile) {
  large_ = tile == large_ ? nullptr : tile;
  arrange(size_);
}

QString TileLayout::choices() const {
  QStringList words;
  if (log_shown_) words << kLogWord;
  if (macros_in_front_) words << kMacrosWord;
  return words.join(QLatin1Char(' '));
}

void TileLayout::choose(const QString& choices) {
  const QStringList words = choices.split(QLatin1Char(' '));
  log_shown_ = words.contains(kLogWord);
  macros_in_front_ = words.contains(kMacrosWord);
  arrange(size_);
}

}  // namespace kiln::gui
