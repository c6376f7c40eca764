#include "common/wire/arm_state.h"

#include "common/wire/geometry.h"
#include "common/wire/proto_message.h"

namespace kiln::wire {

void toProto(const ArmState& arm, v1::ArmState& out) {
  out.set_stamp_ns(toNanoseconds(arm.stamp));
  out.set_seq(arm.seq);
  for (int i = 0; i < 6; ++i) {
    out.add_q_rad(arm.q[i]);
    out.add_qd_radps(arm.qd[i]);
    out.add_wrench(arm.wrench_tool[i]);
  }
  out.set_safety(static_cast<std::uint32_t>(arm.safety));
  out.set_powered(arm.powered);
}

Result<ArmState> fromProto(const v1::ArmState& in) {
  ArmState arm;
  if (auto ok = copyFixed(in.q_rad(), arm.q, "arm joints"); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = copyFixed(in.qd_radps(), arm.qd, "arm speeds"); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = copyFixed(in.wrench(), arm.wrench_tool, "arm wrench"); !ok)
    return tl::make_unexpected(ok.error());
  const auto safety = toEnum(in.safety(), ArmSafetyMode::Fault, "arm safety mode");
  if (!safety) return tl::make_unexpected(safety.error());
  arm.stamp = stampFromNanoseconds(in.stamp_ns());
  arm.seq = in.seq();
  arm.safety = *safety;
  arm.powered = in.powered();
  return arm;
}

}  // namespace kiln::wire
