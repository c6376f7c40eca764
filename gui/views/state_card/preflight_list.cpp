#include "gui/views/state_card/preflight_list.h"

#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kRow_px = 22, kPassing_px = 19, kMark_px = 20, kGap_px = 4, kBetween_px = 8;
constexpr int kNarrowest_pct = 88;

QString text(const std::string& s) { return QString::fromStdString(s); }
/// Needs the operator's eyes.
bool noted(const Check& check) { return !check.ok || check.warn; }
int rank(const Check& check) { return !check.ok ? 0 : check.warn ? 1 : 2; }
}  // namespace

PreflightList::PreflightList(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void PreflightList::setChecks(const std::vector<Check>& checks) {
  checks_ = checks;
  std::stable_sort(checks_.begin(), checks_.end(),
                   [](const Check& a, const Check& b) { return rank(a) < rank(b); });
  QStringList tip;
  for (const Check& check : checks_) {
    tip << QStringLiteral("%1 %2: %3")
               .arg(!noted(check) ? QStringLiteral("✓")
                    : check.ok    ? QStringLiteral("▲")
                                  : QStringLiteral("!"),
                    text(check.name), text(check.detail));
  }
  setTip(*this, tip.join(QLatin1Char('\n')));
  updateGeometry();
  update();
}

int PreflightList::failing() const {
  return static_cast<int>(
      std::count_if(checks_.begin(), checks_.end(), [](const Check& c) { return !c.ok; }));
}

int PreflightList::warning() const {
  return static_cast<int>(
      std::count_if(checks_.begin(), checks_.end(), [](const Check& c) { return c.ok && c.warn; }));
}

int PreflightList::actionHeight(const Check& check, int width) const {
  if (check.action.empty()) return 0;
  return QFontMetrics(ui_.theme.font(TextRole::Small))
      .boundingRect(QRect(0, 0, std::max(60, width - kMark_px), 1000), Qt::TextWordWrap,
                    text(check.action))
      .height();
}

/// 0 if what was found stands beside the name.
int PreflightList::detailHeight(const Check& check, int width) const {
  const int name =
      QFontMetrics(ui_.theme.font(TextRole::Strong)).horizontalAdvance(text(check.name));
  const QFontMetrics small(ui_.theme.font(TextRole::Small));
  const int room = std::max(60, width - kMark_px);
  if (name + kBetween_px + small.horizontalAdvance(text(check.detail)) <= room) return 0;
  return small.boundingRect(QRect(0, 0, room, 1000), Qt::TextWordWrap, text(check.detail)).height();
}

int PreflightList::rowHeight(const Check& check, int width) const {
  if (!noted(check)) return kPassing_px;
  return kRow_px + detailHeight(check, width) + actionHeight(check, width) + kGap_px;
}

int PreflightList::notedHeight(int width) const {
  int height = 0;
  for (const Check& check : checks_) {
    if (noted(check)) height += rowHeight(check, width);
  }
  return height;
}

int PreflightList::heightForWidth(int width) const {
  return notedHeight(width) + (total() - failing() - warning()) * kPassing_px;
}

QSize PreflightList::sizeHint() const { return {260, heightForWidth(std::max(200, width()))}; }

QSize PreflightList::minimumSizeHint() const {
  return {120, std::min(heightForWidth(std::max(200, width())), kRow_px + kPassing_px)};
}

void PreflightList::paintNoted(QPainter& painter, const Check& check, int y, int width) const {
  const Palette& p = ui_.theme.colors();
  const QPointF c(8, y + kRow_px / 2.0);
  painter.setPen(Qt::NoPen);
  painter.setBrush(p.caution);
  if (check.ok) {
    painter.drawPolygon(QPolygonF()
                        << c + QPointF(-5, 4.5) << c + QPointF(5, 4.5) << c + QPointF(0, -4.5));
  } else {
    painter.drawRoundedRect(QRectF(c.x() - 1.4, c.y() - 6, 2.8, 8), 1, 1);
    painter.drawEllipse(c + QPointF(0, 5), 1.7, 1.7);
  }
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  painter.setFont(strong);
  painter.setPen(p.text);
  painter.drawText(QRect(kMark_px, y, width - kMark_px, kRow_px), Qt::AlignVCenter | Qt::AlignLeft,
                   text(check.name));
  painter.setFont(small);
  painter.setPen(p.caution);
  const int room = width - kMark_px, below = detailHeight(check, width);
  if (below == 0) {
    painter.drawText(QRect(kMark_px, y, room, kRow_px), Qt::AlignVCenter | Qt::AlignRight,
                     text(check.detail));
  } else {
    painter.drawText(QRect(kMark_px, y + kRow_px - 2, room, below), Qt::TextWordWrap,
                     text(check.detail));
  }
  painter.setPen(p.text);
  painter.drawText(QRect(kMark_px, y + kRow_px - 2 + below, room, actionHeight(check, width)),
                   Qt::TextWordWrap, text(check.action));
}

void PreflightList::paintPassing(QPainter& painter, const Check& check, int y) const {
  const Palette& p = ui_.theme.colors();
  const QPointF c(8, y + kPassing_px / 2.0);
  painter.setPen(QPen(p.ok, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(QPolygonF()
                       << c + QPointF(-4, 0) << c + QPointF(-1.5, 3) << c + QPointF(4, -3.5));
  const QFont small = ui_.theme.font(TextRole::Small);
  const QFontMetrics metrics(small);
  painter.setFont(small);
  painter.setPen(p.text);
  const int name = metrics.horizontalAdvance(text(check.name)) + kBetween_px;
  painter.drawText(QRect(kMark_px, y, width() - kMark_px, kPassing_px),
                   Qt::AlignVCenter | Qt::AlignLeft, text(check.name));
  painter.setPen(p.dim);
  const int room = std::max(0, width() - kMark_px - name);
  paintFitted(painter, QRectF(kMark_px + name, y, room, kPassing_px),
              Qt::AlignVCenter | Qt::AlignRight,
              fitText(text(check.detail), {small, condensed(small, kNarrowest_pct)}, room, 1));
}

void PreflightList::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& p = ui_.theme.colors();
  const int bottom = height() - kPassing_px;  // one line is kept for what does not fit
  int y = 0;
  std::size_t i = 0;
  for (; i < checks_.size(); ++i) {
    const Check& check = checks_[i];
    const int needs = rowHeight(check, width());
    const bool last = i + 1 == checks_.size();
    if (y + needs > (last ? height() : bottom)) break;
    noted(check) ? paintNoted(painter, check, y, width()) : paintPassing(painter, check, y);
    y += needs;
  }
  if (i == checks_.size()) return;
  const auto rest = static_cast<int>(checks_.size() - i);
  const auto bad = static_cast<int>(std::count_if(
      checks_.begin() + static_cast<long>(i), checks_.end(), [](const Check& c) { return !c.ok; }));
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(bad > 0 ? p.caution : p.dim);
  painter.drawText(QRect(kMark_px, y, width() - kMark_px, kPassing_px),
                   Qt::AlignVCenter | Qt::AlignLeft,
                   bad > 0 ? tr("and %1 more, %2 of them failing").arg(rest).arg(bad)
                           : tr("✓ %1 more checks hold").arg(rest));
}

}  // namespace kiln::gui
