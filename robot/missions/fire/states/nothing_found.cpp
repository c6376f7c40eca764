#include "robot/missions/fire/states/nothing_found.h"

namespace kiln {

void NothingFound::enter() {
  FireContext& c = context();
  c.haltAll(now());
  std::string text = "no fire was put out";
  for (const FirePlace& place : c.belief.places) text += "; " + place.name + ": " + place.outcome;
  display(text);
}

}  // namespace kiln
