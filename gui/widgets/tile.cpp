#include "gui/widgets/tile.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPainter>

#include "gui/widgets/hatch.h"

namespace kiln::gui {

namespace {
constexpr int kHeader_px = 26;
constexpr double kRadius_px = 4.0;
constexpr int kLeastInfo_px = 44;
const QString kBetweenParts = QStringLiteral(" · ");
}  // namespace

/// Lies over the content while it is stale; lets the mouse through, for the operator may still look
/// around.
class Tile::Overlay : public QWidget {
 public:
  Overlay(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
  }
  void setTexts(const QString& headline, const QString& detail) {
    if (headline == headline_ && detail == detail_) return;
    headline_ = headline;
    detail_ = detail;
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Palette& p = ui_.theme.colors();
    QPainter painter(this);
    QColor veil = p.panel;
    veil.setAlphaF(0.55);
    painter.fillRect(rect(), veil);
    QColor stripe = p.caution;
    stripe.setAlphaF(0.45);
    paintHatch(painter, rect(), stripe);
    const QFont strong = ui_.theme.font(TextRole::Strong);
    const QFont small = ui_.theme.font(TextRole::Small);
    const int w = std::max(QFontMetrics(strong).horizontalAdvance(headline_),
                           QFontMetrics(small).horizontalAdvance(detail_));
    const int h =
        QFontMetrics(strong).height() + (detail_.isEmpty() ? 0 : QFontMetrics(small).height());
    QRect box(0, 0, std::min(w + 28, width() - 8), h + 14);
    box.moveCenter(rect().center());
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(p.caution, 1.2));
    painter.setBrush(p.panel);
    painter.drawRoundedRect(box, 3, 3);
    painter.setPen(p.caution);
    painter.setFont(strong);
    painter.drawText(box.adjusted(4, 7, -4, 0), Qt::AlignTop | Qt::AlignHCenter, headline_);
    painter.setPen(p.dim);
    painter.setFont(small);
    painter.drawText(box.adjusted(4, 0, -4, -7), Qt::AlignBottom | Qt::AlignHCenter, detail_);
  }

 private:
  Ui ui_;
  QString headline_, detail_;
};

Tile::Tile(const Ui& ui, const QString& title, QWidget* parent)
    : QFrame(parent),
      ui_(ui),
      layout_(new QVBoxLayout(this)),
      header_(new QHBoxLayout),
      title_(new Label(title, this)),
      info_(new Label(this)),
      badge_(new AgeBadge(ui, this)),
      overlay_(new Overlay(ui, this)) {
  layout_->setContentsMargins(1, 1, 1, 1);
  layout_->setSpacing(0);
  header_->setContentsMargins(9, 0, 9, 0);
  header_->setSpacing(7);
  header_->addWidget(title_);
  header_->addStretch(1);
  header_->addWidget(info_);
  header_->addWidget(badge_);
  layout_->addLayout(header_);
  title_->setFixedHeight(kHeader_px);
  info_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  info_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  header_->setStretchFactor(info_, 3);
  info_->installEventFilter(this);
  badge_->hide();
  restyle();
  connect(&ui_.theme, &Theme::changed, this, &Tile::restyle);
}

void Tile::setContent(QWidget* content, bool flush) {
  content_ = content;
  auto* holder = new QVBoxLayout;
  if (!flush)
    holder->setContentsMargins(9, 2, 9, 9);
  else
    holder->setContentsMargins(2, 0, 2, 2);
  holder->addWidget(content);
  layout_->addLayout(holder, 1);
  overlay_->raise();
}

void Tile::setTitle(const QString& title) { title_->setText(title); }
void Tile::setInfo(const QString& text) {
  if (info_text_ == text) return;
  info_text_ = text;
  fitInfo();
}

/// Of parts "a · b · c" the first are left out until the rest fits; a single one is shortened, and
/// left out when nothing of use would be left.
void Tile::fitInfo() {
  const QFontMetrics metrics(info_->font());
  QStringList parts = info_text_.split(kBetweenParts);
  while (info_->isVisible() && parts.size() > 1 &&
         metrics.horizontalAdvance(parts.join(kBetweenParts)) > info_->width())
    parts.removeFirst();
  const QString text = parts.join(kBetweenParts);
  const bool useless = info_->width() < kLeastInfo_px && info_->isVisible() &&
                       metrics.horizontalAdvance(text) > info_->width();
  const QString shown = !info_->isVisible() ? text
                        : useless           ? QString()
                                  : metrics.elidedText(text, Qt::ElideRight, info_->width());
  if (info_->text() != shown) info_->setText(shown);
}

bool Tile::eventFilter(QObject* watched, QEvent* event) {
  if (watched == info_ && event->type() == QEvent::Resize) fitInfo();
  return QFrame::eventFilter(watched, event);
}

void Tile::setAge(double age_s, AgeLevel level) {
  if (level != level_) update();  // the frame tells it too
  level_ = level;
  badge_->set(age_s, level);
  badge_->setVisible(true);
  const bool stale = level == AgeLevel::Red;
  if (stale && content_) {
    overlay_->setGeometry(content_->geometry());
    overlay_->setTexts(
        stale_headline_.isEmpty() ? tr("last heard %1 ago").arg(ageText(age_s)) : stale_headline_,
        stale_detail_);
    overlay_->raise();
  }
  overlay_->setVisible(stale && content_);
}

void Tile::addHeaderWidget(QWidget* widget) { header_->addWidget(widget); }

void Tile::setStaleText(const QString& headline, const QString& detail) {
  stale_headline_ = headline;
  stale_detail_ = detail;
}

bool Tile::hatched() const { return !overlay_->isHidden(); }

void Tile::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(p.panel);
  painter.setPen(
      QPen(level_ == AgeLevel::Red ? p.caution : p.border, level_ == AgeLevel::Red ? 1.6 : 1.0));
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), kRadius_px, kRadius_px);
}

void Tile::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && event->pos().y() < kHeader_px)
    emit titleDoubleClicked();
  else
    QFrame::mouseDoubleClickEvent(event);
}

void Tile::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  if (content_) overlay_->setGeometry(content_->geometry());
}

void Tile::restyle() {
  const Palette& p = ui_.theme.colors();
  const auto paint = [](Label* label, const QColor& color, const QFont& font) {
    label->setFont(font);
    QPalette colors = label->palette();
    colors.setColor(QPalette::WindowText, color);
    label->setPalette(colors);
  };
  paint(title_, p.dim, ui_.theme.font(TextRole::Strong));
  paint(info_, p.dim, ui_.theme.font(TextRole::Small));
  update();
}

}  // namespace kiln::gui
