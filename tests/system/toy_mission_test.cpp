// A mission of its own from a folder of its own: the daemon with tests/system/toy in its catalogue
// drives it in the simulator, and nothing of the robot was changed for it.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

/// Programs by the names that kiln-eval starts, the toy's daemon among them.
struct Programs {
  ScratchFolder folder{"toy"};
  Programs() {
    fs::create_symlink(binaryDir() + "/bin/kiln-sim", folder.file("kiln-sim"));
    fs::create_symlink(binaryDir() + "/tests/kiln-robotd-toy", folder.file("kiln-robotd"));
  }
  [[nodiscard]] Result<MissionRun> run(std::vector<std::string> robot_args) const {
    MissionRunOptions options;
    options.mission = "toy";
    options.programs = folder.path();
    options.lockstep = true;
    options.robot_args = std::move(robot_args);
    return runMission(options);
  }
};

TEST(ToyMission, RunsFromItsFolderAndItsLineInTheCatalogue) {
  const Programs programs;
  const auto run = programs.run({});
  ASSERT_TRUE(run.has_value()) << run.error();
  const auto report = nlohmann::json::parse(run->robot_json)["robot"];
  EXPECT_TRUE(run->success) << report.dump(1).substr(0, 2000);
  EXPECT_EQ(report["mission"], "toy");
  ASSERT_EQ(report["states"].size(), 3U);
  EXPECT_EQ(report["states"][1]["name"], "ToyDrive");
  EXPECT_EQ(report["toy_drives"], 1);
  EXPECT_NEAR(report["toy_x_m"].get<double>(), 1.0, 0.1);
}

TEST(ToyMission, ItsSectionOfTheConfigurationIsObeyed) {
  const Programs programs;
  const auto run = programs.run({"--set=toy.distance_m=0.6"});
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_NEAR(nlohmann::json::parse(run->robot_json)["robot"]["toy_x_m"].get<double>(), 0.6, 0.1);
}

/// kiln-eval with the toy's evaluation in its table.
struct Evaluated {
  int status = -1;
  nlohmann::json figures;  ///< {id: ok}
  std::string log;
};
Evaluated evaluate(std::vector<std::string> arguments) {
  const ScratchFolder scratch("toy-eval");
  arguments.insert(arguments.begin(), binaryDir() + "/tests/kiln-eval-toy");
  arguments.push_back("--json=" + scratch.file("figures.json"));
  auto program = ChildProcess::start(arguments, scratch.file("log"));
  EXPECT_TRUE(program.has_value());
  Evaluated out;
  out.status = program->wait(std::chrono::seconds(100)).value_or(-1);
  out.log = tailOf(scratch.file("log"), 40);
  std::ifstream in(scratch.file("figures.json"));
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_discarded())
    for (const auto& figure : json.at("figures")) out.figures[figure.at("id")] = figure.at("ok");
  return out;
}

TEST(ToyMission, BringsItsEvaluationWithOptionsRuleAndGoals) {
  const Programs programs;
  const std::string where = "--programs=" + programs.folder.path();
  const Evaluated good = evaluate({"toy", where});
  EXPECT_EQ(good.status, 0) << good.log;
  EXPECT_EQ(good.figures, nlohmann::json({{"stop_error_max_m", true}, {"success_rate", true}}));
  const Evaluated lazy = evaluate({"toy", where, "--distance-m=0.3"});
  EXPECT_EQ(lazy.status, 1) << lazy.log;
  EXPECT_EQ(lazy.figures, nlohmann::json({{"stop_error_max_m", true}, {"success_rate", false}}))
      << "its rule wants half a metre";
  EXPECT_GT(evaluate({"fire"}).status, 1) << "only its own are known";
}

}  // namespace
}  // namespace kiln
