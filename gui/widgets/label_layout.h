#pragma once

#include <QLineF>
#include <QRectF>
#include <optional>
#include <vector>

namespace kiln::gui {

/// A label that wants to stand by a marked thing in a picture.
struct LabelWish {
  QRectF target;  ///< what it names; pixels
  QSizeF size;    ///< of its plate; pixels
};

struct LabelPlace {
  QRectF plate;
  std::optional<QLineF> leader;  ///< from plate to target, when they do not touch
};

/// Places labels by their targets so that no plate covers another plate or a target: above the
/// target if there is room, else below or beside it, else as near as possible with a leader line.
/// @param wishes  the most important first: an earlier one never makes way for a later one.
/// @param within  the picture; plates stay inside.
/// @return one entry a wish; nullopt where the picture has no room left.
[[nodiscard]] std::vector<std::optional<LabelPlace>> placeLabels(
    const std::vector<LabelWish>& wishes, const QRectF& within);

}  // namespace kiln::gui
