#pragma once

#include "common/config/resources.h"
#include "common/core/check.h"
#include "robot/scene/fire_site_map.h"

namespace kiln {

/// The shipped kitchen with what stands at its site.
struct Kitchen {
  ArenaMap arena;
  FireSiteMap site;
};

inline Kitchen loadWholeKitchen() {
  auto arena = loadResource<ArenaMap>("config/arena_kitchen.yaml");
  KILN_CHECK(arena.has_value(), arena ? "" : arena.error().message);
  const auto site = loadFireSite(*arena);
  KILN_CHECK(site.has_value(), site ? "" : site.error().message);
  arena->fixtures[kFireSite] = site->fixtures();
  return {*arena, *site};
}
inline ArenaMap loadKitchen() { return loadWholeKitchen().arena; }
inline FireSiteMap loadKitchenSite() { return loadWholeKitchen().site; }

}  // namespace kiln
