#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/config_archive.h"
#include "common/model/sensor.h"

namespace kiln {

/// A part of the HSV colour space, in OpenCV's numbers: hue 0 to 179 (2 degrees each), saturation
/// and value 0 to 255.
struct HsvVolume {
  int hue_min = 0, hue_max = 179;  ///< min > max: around through 0
  int saturation_min = 0;
  int value_min = 0;
  void visit(ConfigArchive& a);
};

/// A point of a cluster's outline.
struct OutlinePoint {
  Eigen::Vector2f pixel;    ///< where the mask ends, sub-pixel
  Eigen::Vector2f outward;  ///< unit, away from the cluster, in the picture
};

/// A connected part of the fused mask.
struct MarkerCluster {
  int votes = 0;  ///< corners that both masks share
  int pixels = 0, yellow = 0, magenta = 0;
  Eigen::AlignedBox2i box{Eigen::Vector2i::Zero(), Eigen::Vector2i::Zero()};
  std::string refused;  ///< why it is no marker; empty: a candidate
  /// Of a candidate only: pixels of the masks, thinned to at most Config::max_pixels, and the
  /// outline without what lies at the edge of the picture.
  std::vector<Eigen::Vector2f> mask_pixels;
  std::vector<OutlinePoint> outline;
};

/// A corner that was found in both masks.
struct MarkerVote {
  Eigen::Vector2f pixel;
  int cluster = -1;  ///< index in MarkerView::clusters; -1: voted for none
};

/// What one picture shows, with everything that was looked at on the way (for the operator).
struct MarkerView {
  enum Mask : std::uint8_t { kYellow = 1, kMagenta = 2, kNearYellow = 4, kNearMagenta = 8 };
  Stamp stamp;
  int width = 0, height = 0;
  std::string refused;             ///< why the picture cannot be used; empty: it was
  std::vector<std::uint8_t> mask;  ///< row-major, bits of Mask: of the colour; beside the other one
  std::vector<MarkerVote> votes;
  std::vector<MarkerCluster> clusters;  ///< most votes first; small ones are left out
  int winner = -1;                      ///< the candidate with most votes; -1: none
};

/// Finds the wall marker in one colour picture by its colours and its pattern (NimbRo UGV paper,
/// "Wall Marker Detection"): yellow beside magenta and magenta beside yellow, corners that both
/// masks share, clusters of the fused mask, votes. Thread-compatible, keeps no state; const calls
/// are thread-safe.
class MarkerDetector {
 public:
  struct Config {
    HsvVolume yellow{0, 35, 40, 150};  ///< as used on site (hardware.md section 8)
    HsvVolume magenta{154, 174, 40, 100};
    /// Beyond the paper: both colours in shadow (darker, bluer, so purer ones only), and a yellow
    /// that is purer than the ground where the ground itself is yellowish (sand, low sun).
    bool adapt = true;
    HsvVolume yellow_shade{15, 42, 110, 60};
    HsvVolume magenta_shade{145, 176, 90, 45};
    double ground_share = 0.08;     ///< of the picture in the yellow volume: it is the ground
    int ground_margin = 45;         ///< saturation above the ground's median
    int vicinity_px = 32;           ///< half a window in which the other colour must be
    double vicinity_share = 0.006;  ///< of that window
    int max_corners = 600;          ///< of each mask
    double corner_quality = 0.10;   ///< of the strongest
    double corner_distance_px = 3;  ///< between corners of a mask
    double agree_px = 2.5;          ///< between the two masks
    int closing_px = 9;             ///< gaps of the fused mask that are closed
    int min_pixels = 120;           ///< smaller clusters are not listed
    int min_votes = 5;
    double min_vote_share = 0.2;     ///< of the winner's votes
    double min_colour_share = 0.08;  ///< of each of the two colours in a candidate
    int max_pixels = 1500;           ///< kept of a candidate
    void visit(ConfigArchive& a);
  };
  explicit MarkerDetector(Config config) : config_(config) {}
  [[nodiscard]] MarkerView detect(const RgbImage& image) const;

 private:
  Config config_;
};

}  // namespace kiln
