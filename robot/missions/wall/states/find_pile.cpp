#include "robot/missions/wall/states/find_pile.h"

#include <fmt/format.h>

#include "robot/missions/wall/states/drive_to_pile.h"
#include "robot/missions/wall/states/locate_bricks.h"
#include "robot/missions/wall/states/wall_given_up.h"

namespace kiln {

Transition FindPile::execute() {
  WallContext& c = context();
  if (asked_) {
    c.pile.tick();
    return c.pile.answer() ? conclude(*c.pile.answer()) : stay();
  }
  const bool settled = toSeconds(timeInState()) >= c.config.pile_look.settle_s;
  guard("At rest", settled);
  display("looking for the pile");
  if (!settled) return stay();
  if (!started_) c.look.start(std::nullopt, c.storageNow());
  started_ = true;
  const SkillStatus look = c.look.poll(now());
  display("looking for the pile: " + look.text);
  if (look.phase == SkillPhase::Failed) return again(look.text);
  if (look.phase != SkillPhase::Done) return stay();
  asked_ = true;
  c.pile.begin(c.look.sweep(), c.parts.pose(), c.site.pile.pose());
  return stay();
}

Transition FindPile::conclude(const PileAnswer& answer) {
  WallContext& c = context();
  if (!answer.found) return again(answer.why);
  const Pose2& X = answer.found->X_map_pile;
  c.belief.pile = {X, answer.found->covariance};
  c.siteMoved();
  return transit<LocateBricks>().because(fmt::format("pile at ({:.2f}, {:.2f}) m", X.x_m, X.y_m));
}

Transition FindPile::again(const std::string& why) {
  const WallContext& c = context();
  if (c.belief.pile_looks < c.config.pile_look.max_looks)
    return transit<DriveToPile>().because("not found: " + why);
  return transit<WallGivenUp>().because(
      fmt::format("the pile was not found in {} looks: {}", c.belief.pile_looks, why));
}

}  // namespace kiln
