#include "robot/sim/box_contact_filter.h"

#include <cmath>
#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

namespace kiln::sim {
namespace {

struct Model {
  explicit Model(const std::string& xml) {
    const auto vfs = std::make_unique<mjVFS>();
    mj_defaultVFS(vfs.get());
    mj_makeEmptyFileVFS(vfs.get(), "m.xml", static_cast<int>(xml.size()));
    std::memcpy(vfs->filedata[0], xml.data(), xml.size());
    char error[500] = {};
    m = mj_loadXML("m.xml", vfs.get(), error, sizeof(error));
    EXPECT_NE(m, nullptr) << error;
    mj_deleteVFS(vfs.get());
    d = mj_makeData(m);
  }
  ~Model() {
    mj_deleteData(d);
    mj_deleteModel(m);
  }
  mjModel* m = nullptr;
  mjData* d = nullptr;
};

/// Bricks of 0.3 x 0.2 x 0.2 m, perfectly aligned: the case that makes MuJoCo 2.2.2 report phantom
/// contacts.
std::string alignedWall(int columns, int layers) {
  std::string xml = R"(<mujoco><option timestep="0.004" solver="Newton" cone="pyramidal"/>
    <size njmax="3000" nconmax="1000" nstack="2000000"/>
    <default><geom solref="0.009 1" solimp=".95 .99 .001"/></default><worldbody>
    <geom type="plane" size="10 10 1"/>)";
  for (int layer = 0; layer < layers; ++layer) {
    for (int column = 0; column < columns; ++column) {
      xml += "<body pos=\"" + std::to_string(0.302 * column) + " 0 " +
             std::to_string(0.1 + 0.2 * layer) +
             "\"><freejoint/><geom type=\"box\" size=\".15 .1 .1\" mass=\"1\"/></body>";
    }
  }
  return xml + "</worldbody></mujoco>";
}

TEST(BoxContactFilter, PerfectlyStackedWallStandsStill) {
  installBoxContactFilter();
  for (const auto& [columns, layers] : {std::pair{4, 5}, std::pair{6, 3}, std::pair{1, 6}}) {
    Model model(alignedWall(columns, layers));
    for (int i = 0; i < 750; ++i) mj_step(model.m, model.d);  // 3 s
    for (int brick = 0; brick < columns * layers; ++brick) {
      const mjtNum* p = model.d->qpos + 7 * brick;
      const mjtNum* p0 = model.m->qpos0 + 7 * brick;
      EXPECT_LT(std::hypot(p[0] - p0[0], p[1] - p0[1]), 0.002)
          << columns << "x" << layers << " brick " << brick;
      EXPECT_NEAR(p[2], p0[2], 0.002) << columns << "x" << layers << " brick " << brick;
    }
  }
}

/// The wall as it is built: 3.6 m of red, green and blue in five layers with the planned joint, and
/// a stack of long bricks. Perfectly aligned, as no world draws them.
TEST(BoxContactFilter, AWallOfTheTasksBricksStandsStill) {
  installBoxContactFilter();
  std::string xml = R"(<mujoco><option timestep="0.004" solver="Newton" cone="pyramidal"/>
    <size njmax="3000" nconmax="1000" nstack="2000000"/>
    <default><geom solref="0.009 1" solimp=".95 .99 .001" friction="0.6 0.005 0.0001"/></default>
    <worldbody><geom type="plane" size="10 10 1"/>)";
  int bricks = 0;
  const auto add = [&](double x, double y, int layer, double length) {
    xml += "<body pos=\"" + std::to_string(x) + " " + std::to_string(y) + " " +
           std::to_string(0.1 + 0.2 * layer) + "\"><freejoint/><geom type=\"box\" size=\"" +
           std::to_string(0.5 * length) + " .1 .1\" mass=\"1.5\"/></body>";
    ++bricks;
  };
  for (int layer = 0; layer < 5; ++layer) {
    double x = 0.0;
    for (int i = 0; i < 7; ++i) {  // another order in each layer
      constexpr double kLengths[7] = {0.3, 0.6, 1.2, 0.3, 0.6, 0.3, 0.3};
      const double length = kLengths[(i + 2 * layer) % 7];
      add(x + 0.5 * length, 0.0, layer, length);
      x += length + 0.003;
    }
    add(1.0, 2.6, layer, 1.8);
  }
  Model model(xml + "</worldbody></mujoco>");
  for (int i = 0; i < 1250; ++i) mj_step(model.m, model.d);  // 5 s
  for (int brick = 0; brick < bricks; ++brick) {
    const mjtNum* p = model.d->qpos + 7 * brick;
    const mjtNum* p0 = model.m->qpos0 + 7 * brick;
    EXPECT_LT(std::hypot(p[0] - p0[0], p[1] - p0[1]), 0.002) << brick;
    EXPECT_NEAR(p[2], p0[2], 0.002) << brick;
  }
}

/// The filter keeps true contacts: a box dropped on a box comes to rest on it, also when it lands
/// askew.
TEST(BoxContactFilter, TrueContactsStay) {
  installBoxContactFilter();
  Model model(R"(<mujoco><option timestep="0.004" solver="Newton"/><worldbody>
    <geom type="box" size=".5 .5 .5" pos="0 0 .5"/>
    <body pos="0.1 0.05 1.3" euler="10 15 30"><freejoint/><geom type="box" size=".1 .1 .1" mass="1"/></body>
    </worldbody></mujoco>)");
  for (int i = 0; i < 1000; ++i) mj_step(model.m, model.d);
  EXPECT_NEAR(model.d->qpos[2], 1.1, 0.005);
}

/// Every contact that comes out lies within what the boxes' overlap allows, whatever the pose.
TEST(BoxContactFilter, NoContactIsDeeperThanTheOverlap) {
  installBoxContactFilter();
  Model model(R"(<mujoco><worldbody><geom type="box" size=".15 .1 .1" pos="0 0 .1"/>
    <body pos="0 0 .3"><freejoint/><geom type="box" size=".15 .1 .1" mass="1"/></body></worldbody></mujoco>)");
  for (int i = 0; i < 400; ++i) {
    model.d->qpos[0] = 0.30 * std::sin(0.37 * i);
    model.d->qpos[1] = 0.20 * std::sin(0.11 * i);
    model.d->qpos[2] = 0.30 - 1e-6 * (i % 5);  // touching, barely
    mj_fwdPosition(model.m, model.d);
    for (int c = 0; c < model.d->ncon; ++c) EXPECT_GT(model.d->contact[c].dist, -0.0011) << i;
  }
}

}  // namespace
}  // namespace kiln::sim
