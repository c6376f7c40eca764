#include "robot/app/safety_files.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/regular_file.h"
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
           {"geofence", "walls", "start"}},
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

}  // namespace
}  // namespace kiln
