#pragma once

namespace kiln::sim {

/// MuJoCo 2.2.2 may report aligned, touching boxes as deeply interpenetrating (a contact of -0.43 m
/// between two perfectly stacked bricks), which throws them metres away. This wraps the box-box
/// collision function and drops contacts deeper than the boxes' overlap along their six face axes
/// allows. Process-wide; install once, before the first step; further calls do nothing.
/// (simulation.md section 1.1)
void installBoxContactFilter();

/// Contacts dropped so far in this process; for tests and diagnosis.
[[nodiscard]] unsigned long droppedBoxContacts();

}  // namespace kiln::sim
