#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/paths.h"

/// What the documents say about the tree must be so: files that they link, tests that they name.
namespace kiln {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = kiln::sourceDir();

std::string read(const fs::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<fs::path> documents() {
  std::vector<fs::path> out{kRoot / "README.md", kRoot / "CHANGELOG.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "resources/docs")) {
    if (entry.path().extension() == ".md") out.push_back(entry.path());
  }
  return out;
}

/// The first groups of all matches.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> out;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    out.push_back((*it)[1].str());
  }
  return out;
}

TEST(Documents, LinkOnlyFilesThatAreThere) {
  const std::regex link("\\]\\(([^)#]+)(#[^)]*)?\\)"), quotation("```[\\s\\S]*?```");
  for (const fs::path& document : documents()) {
    ASSERT_TRUE(fs::exists(document)) << document;
    // What is quoted is no link.
    const std::string text = std::regex_replace(read(document), quotation, "");
    for (const std::string& target : matches(text, link)) {
      if (target.find("://") != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << " links " << target;
    }
  }
}

/// Without leading, trailing and repeated blanks.
std::string squeezed(const std::string& text) {
  std::istringstream words(text);
  std::string out, word;
  while (words >> word) out += word + " ";
  return out;
}

TEST(Documents, QuoteTheTreeWordForWord) {
  // ```cpp FILE: what stands in the block stands in that file, and is compiled with it.
  const std::regex block("```cpp([^\\n]*)\\n([\\s\\S]*?)\\n *```");
  int quotations = 0;
  for (const fs::path& document : documents()) {
    const std::string text = read(document);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), block);
         it != std::sregex_iterator(); ++it) {
      const std::string file = squeezed((*it)[1].str());
      ASSERT_FALSE(file.empty()) << document << " quotes code of no file: " << (*it)[2].str();
      const fs::path source = kRoot / file.substr(0, file.size() - 1);
      ASSERT_TRUE(fs::is_regular_file(source)) << document << " quotes " << source;
      EXPECT_NE(squeezed(read(source)).find(squeezed((*it)[2].str())), std::string::npos)
          << document << " quotes " << source << " wrongly:\n"
          << (*it)[2].str();
      ++quotations;
    }
  }
  EXPECT_GT(quotations, 12);
}

TEST(Documents, SafetyNamesOnlyTestsThatExist) {
  std::set<std::string> existing;
  const std::regex declared("TEST(?:_F|_P)?\\(\\s*(\\w+\\s*,\\s*\\w+)\\s*\\)");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    for (const std::string& test : matches(read(entry.path()), declared)) {
      existing.insert(std::regex_replace(test, std::regex("\\s*,\\s*"), "."));
    }
  }
  const auto named =
      matches(read(kRoot / "resources/docs/safety.md"), std::regex("`([A-Z]\\w+\\.[A-Z]\\w+)`"));
  EXPECT_GT(named.size(), 20U) << "a requirement without a test proves nothing";
  for (const std::string& test : named) EXPECT_EQ(existing.count(test), 1U) << "no test " << test;
}

TEST(Documents, ReadmeShowsTheTwoCommands) {
  const std::string readme = read(kRoot / "README.md");
  EXPECT_NE(readme.find("./kiln demo"), std::string::npos);
  EXPECT_NE(readme.find("./kiln test"), std::string::npos);
}

}  // namespace
}  // namespace kiln
