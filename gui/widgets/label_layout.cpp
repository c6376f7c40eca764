#include "gui/widgets/label_layout.h"

#include <algorithm>
#include <cmath>

namespace kiln::gui {

namespace {
constexpr double kGap_px = 3.0;       // between a target and its label
constexpr double kTouching_px = 5.0;  // a label this near needs no leader
constexpr double kStep_px = 4.0;      // of the search for free room
// A label above its target is what the eye expects: another side must be so much nearer.
constexpr double kBelow_px = 1.0, kBeside_px = 2.0;

/// Of two rectangles along one axis; 0 where they overlap.
double apart(double low_a, double high_a, double low_b, double high_b) {
  return std::max({0.0, low_b - high_a, low_a - high_b});
}

double distance(const QRectF& a, const QRectF& b) {
  return std::hypot(apart(a.left(), a.right(), b.left(), b.right()),
                    apart(a.top(), a.bottom(), b.top(), b.bottom()));
}

double cost(const QRectF& plate, const QRectF& target) {
  const bool above = plate.bottom() <= target.top(), below = plate.top() >= target.bottom();
  const double side = above ? 0.0 : below ? kBelow_px : kBeside_px;
  return std::max(kGap_px, distance(plate, target)) + side +
         0.02 * std::abs(plate.left() - target.left());
}

QPointF nearestIn(const QRectF& box, const QPointF& p) {
  return {std::clamp(p.x(), box.left(), box.right()), std::clamp(p.y(), box.top(), box.bottom())};
}

QLineF leaderOf(const QRectF& plate, const QRectF& target) {
  const QPointF at_target = nearestIn(target, plate.center());
  return {nearestIn(plate, at_target), at_target};
}

class Sheet {
 public:
  Sheet(const std::vector<LabelWish>& wishes, const QRectF& within) : within_(within) {
    for (const LabelWish& wish : wishes) targets_.push_back(wish.target);
  }

  std::optional<LabelPlace> place(const LabelWish& wish) {
    // A target that fills the picture leaves no room beside it: then its label lies over it.
    auto best = nearest(wish, false);
    if (!best) best = nearest(wish, true);
    if (!best) return std::nullopt;
    plates_.push_back(*best);
    LabelPlace out{*best, std::nullopt};
    if (distance(*best, wish.target) > kTouching_px) out.leader = leaderOf(*best, wish.target);
    return out;
  }

 private:
  [[nodiscard]] std::optional<QRectF> nearest(const LabelWish& wish, bool over_targets) const {
    std::optional<QRectF> best;
    const auto consider = [&](double x, double y) {
      const QRectF plate(QPointF(x, y), wish.size);
      if (best && cost(plate, wish.target) >= cost(*best, wish.target)) return;
      if (within_.contains(plate) && !meets(plates_, plate) &&
          (over_targets || !meets(targets_, plate)))
        best = plate;
    };
    const QRectF& t = wish.target;
    const double left = std::clamp(t.left(), within_.left(), lastX(wish));
    consider(left, t.top() - kGap_px - wish.size.height());
    consider(left, t.bottom() + kGap_px);
    const double middle = t.center().y() - wish.size.height() / 2;
    consider(t.right() + kGap_px, middle);
    consider(t.left() - kGap_px - wish.size.width(), middle);
    for (double y = within_.top(); y <= lastY(wish); y += kStep_px)
      for (double x = within_.left(); x <= lastX(wish); x += kStep_px) consider(x, y);
    return best;
  }
  [[nodiscard]] double lastX(const LabelWish& w) const {
    return std::max(within_.left(), within_.right() - w.size.width());
  }
  [[nodiscard]] double lastY(const LabelWish& w) const {
    return within_.bottom() - w.size.height();
  }
  static bool meets(const std::vector<QRectF>& taken, const QRectF& plate) {
    return std::any_of(taken.begin(), taken.end(),
                       [&](const QRectF& other) { return other.intersects(plate); });
  }
  QRectF within_;
  std::vector<QRectF> targets_, plates_;
};

}  // namespace

std::vector<std::optional<LabelPlace>> placeLabels(const std::vector<LabelWish>& wishes,
                                                   const QRectF& within) {
  Sheet sheet(wishes, within);
  std::vector<std::optional<LabelPlace>> out;
  out.reserve(wishes.size());
  for (const LabelWish& wish : wishes) out.push_back(sheet.place(wish));
  return out;
}

}  // namespace kiln::gui
