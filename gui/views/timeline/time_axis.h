#pragma once

#include <QRectF>

#include "common/core/stamp.h"

namespace kiln::gui {

/// Which times lie where.
struct TimeAxis {
  QRectF plot;  ///< pixels
  Stamp end;    ///< at its right edge
  double span_s = 1.0;
  [[nodiscard]] double xOf(Stamp stamp) const {
    return plot.right() + toSeconds(stamp - end) / span_s * plot.width();
  }
  [[nodiscard]] Stamp stampAt(double x) const {
    return end + fromSeconds((x - plot.right()) / plot.width() * span_s);
  }
};

}  // namespace kiln::gui
