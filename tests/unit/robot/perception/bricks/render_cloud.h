#pragma once

#include <vector>

#include "robot/perception/bricks/model_cloud.h"

namespace kiln {

/// The paper's way to a model cloud: a picture of `pixels` x `pixels` of depth and brick id from the
/// world's first sensor, every pixel a point. The camera looks at the middle of the bricks; its
/// opening angle just holds them. By Embree rays instead of OpenGL.
[[nodiscard]] std::vector<ModelPoint> renderCloud(const ModelWorld& world, int pixels);

/// The arena's pile from 2.8 m before its first line, in the pile's frame.
[[nodiscard]] ModelWorld pileSeenFromAhead();

}  // namespace kiln
