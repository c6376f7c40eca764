#include "robot/perception/marker/marker_localizer.h"

namespace kiln {

std::string_view toString(MarkerRefusal refusal) {
  switch (refusal) {
    case MarkerRefusal::NothingSeen:
      return "nothing seen";
    case MarkerRefusal::TooSmall:
      return "too small";
    case MarkerRefusal::OneLeg:
      return "one leg only";
    case MarkerRefusal::WrongSides:
      return "wrong sides";
    case MarkerRefusal::HalfHidden:
      return "half hidden";
    case MarkerRefusal::NoFit:
      return "no fit";
    case MarkerRefusal::Uncertain:
      return "uncertain";
  }
  return "unknown";
}

void MarkerLocalizer::Config::visit(ConfigArchive& a) {
  a.field("hfov_deg", hfov_deg, "deg", 10, 150, "head camera's horizontal field of view");
  a.field("window_s", window_s, "s", 0.1, 120, "pictures are gathered over this time");
  a.field("max_pictures", max_pictures, "", 1, 1000, "kept at most");
  a.field("max_outline", max_outline, "", 50, 10000, "points of the outline kept of a picture");
  a.field("max_range_m", max_range_m, "m", 2, 50, "farther points of the ground are left out");
  a.field("gap_m", gap_m, "m", 0.05, 2, "between points of one cluster on the ground");
  a.field("cell_m", cell_m, "m", 0.01, 0.5, "of the grid that clusters");
  a.field("min_hits", min_hits, "", 1, 100, "points that make a cell count, from 3 pictures on");
  a.field("side_tolerance", side_tolerance, "", 0, 0.5, "share by which a side may be off");
  a.field("side_tolerance_m", side_tolerance_m, "m", 0, 2, "and beside that share");
  a.field("refine", refine, "fit the outline; false: take the smallest rectangle");
  a.field("camera_sigma_deg", camera_sigma_deg, "deg", 0.01, 5, "mounting of the head camera");
  a.field("camera_sigma_m", camera_sigma_m, "m", 0, 0.1, "mounting of the head camera");
  a.field("odometry_drift", odometry_drift, "", 0, 0.2, "share of the way driven, one sigma");
  a.field("min_coverage", min_coverage, "", 0, 1, "share of each leg that must be seen");
  a.field("max_outside", max_outside, "", 0, 1, "share of the points that may lie off the marker");
  a.field("min_agreeing", min_agreeing, "", 0, 1, "share of the outline that must fit");
  a.field("max_sigma_m", max_sigma_m, "m", 0.01, 5, "of the position; more is refused");
  a.field("max_sigma_deg", max_sigma_deg, "deg", 0.1, 45, "of the direction; more is refused");
  a.field("paper", paper, "only the winner of each picture and the largest cluster");
  a.section("fit", fit, "the outline in the pictures");
}

}  // namespace kiln
