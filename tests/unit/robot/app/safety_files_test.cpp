#include "robot/app/safety_files.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/regular_file.h"
#include "robot/scene/obstacles.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

struct SafetyFile {
  std::string shipped;
  std::function<std::string(const std::string&)> load;  ///< the error, or empty
  std::vector<std::string> keys;
};

template <class T>
std::string errorOf(const Result<T>& loaded) {
  return loaded ? std::string() : loaded.error().message;
}

std::vector<SafetyFile> files() {
  return {{"config/arena_kitchen.yaml",
           [](auto& f) { return errorOf(loadArena(f)); },
           {"geofence", "walls", "start", "sites"}},
          {"robot_model/bob.yaml",
           [](auto& f) { return errorOf(loadGeometry(f)); },
           {"length_m", "max_decel_mps2", "body", "q_drive_deg"}}};
}

/// The file without the lines of one key at its top.
std::string without(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  std::string out, line;
  bool leaves_out = false;
  while (std::getline(lines, line)) {
    if (!line.empty() && line[0] != ' ' && line[0] != '#') leaves_out = line.starts_with(key + ":");
    if (!leaves_out) out += line + "\n";
  }
  return out;
}

TEST(SafetyFiles, TheShippedOnesAreComplete) {
  for (const SafetyFile& file : files()) EXPECT_EQ(file.load(file.shipped), "") << file.shipped;
}

TEST(SafetyFiles, AnAbsentKeyIsAnErrorWithFileAndName) {
  const std::string copy = testing::TempDir() + "safety_file.yaml";
  for (const SafetyFile& file : files()) {
    const auto text =
        readRegularFile(kiln::sourceDir() + "/resources/" + file.shipped, 1U << 20).value();
    for (const std::string& key : file.keys) {
      std::ofstream(copy) << without(text, key);
      const std::string error = file.load(copy);
      EXPECT_NE(error.find(copy + ": '" + key + "' is missing"), std::string::npos)
          << key << ": " << error;
    }
    std::ofstream(copy) << "{}\n";
    EXPECT_NE(file.load(copy).find("is missing"), std::string::npos) << file.shipped;
  }
  std::filesystem::remove(copy);
}

TEST(SafetyFiles, WhatStandsAtASiteIsAnObstacleWhicheverMissionRuns) {
  const auto arena = loadArena("config/arena_kitchen.yaml");
  ASSERT_TRUE(arena.has_value()) << arena.error();
  std::set<std::string> names;
  for (const BoxConfig& box : obstacles(*arena)) names.insert(box.name);
  for (const char* name : {"place 1 box", "place 1 table", "place 2 box", "place 2 table"})
    EXPECT_EQ(names.count(name), 1U) << name;
}

TEST(SafetyFiles, ASiteThatNobodyKnowsIsRefused) {
  const std::string copy = testing::TempDir() + "arena_site.yaml";
  const auto text =
      readRegularFile(kiln::sourceDir() + "/resources/config/arena_kitchen.yaml", 1U << 20).value();
  const auto with = [&](const std::string& site) {
    std::ofstream(copy) << without(text, "sites") << "sites:\n  - " << site << "\n";
    return errorOf(loadArena(copy));
  };
  const std::string unknown = with("{ mission: circus, file: config/fire_site_kitchen.yaml }");
  EXPECT_NE(unknown.find("mission 'circus', which has none here"), std::string::npos) << unknown;
  const std::string absent = with("{ mission: fire, file: config/nowhere.yaml }");
  EXPECT_NE(absent.find("nowhere.yaml"), std::string::npos) << absent;
  const std::string wrong = with("{ mission: fire, file: config/robot.yaml }");
  EXPECT_NE(wrong.find("robot.yaml"), std::string::npos) << wrong;
  std::filesystem::remove(copy);
}

}  // namespace
}  // namespace kiln
