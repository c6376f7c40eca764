#pragma once

#include "common/core/error.h"
#include "common/model/mission.h"
#include "kiln/v1/mission.pb.h"

/// For the .cpp files of this folder alone: what other messages carry of a mission.
namespace kiln::wire {

inline constexpr int kMaxFigures = 500;

void toProto(const Figure& figure, v1::Figure& out);
[[nodiscard]] Figure fromProto(const v1::Figure& in);
void toProto(const MissionDetail& detail, v1::MissionDetail& out);
[[nodiscard]] MissionDetail fromProto(const v1::MissionDetail& in);

}  // namespace kiln::wire
