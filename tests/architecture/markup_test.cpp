#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"

/// Text from outside is never markup: in gui/ only widgets/text.h may hand Qt something that it
/// could read as HTML, and tags stand in literal patterns of markup() alone, whose arguments are
/// escaped.
namespace kiln {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::size_t lineOf(const std::string& text, std::ptrdiff_t at) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + at, '\n'));
}

/// @param path  relative to the tree.
std::vector<std::string> markupViolations(const std::string& path, const std::string& text) {
  if (path == "gui/widgets/text.h" || path == "gui/widgets/text.cpp") return {};
  struct Rule {
    std::regex pattern;
    const char* instead;
  };
  static const std::vector<Rule> rules{
      {std::regex(R"(\bQLabel\s*[*(;]|\bQLabel\s+\w+\s*[;{(=]|new QLabel|public QLabel)"),
       "use Label, which is plain"},
      {std::regex(R"((?:->|\.|\s)setToolTip\s*\(|QToolTip::showText)"), "use setTip or showTip"},
      {std::regex(R"(setHtml\s*\(|insertHtml|appendHtml|QTextBrowser|QMessageBox|QStaticText|)"
                  R"(setWhatsThis|Qt::AutoText|toHtmlEscaped)"),
       "use Markup and Label"},
      {std::regex(R"(markup\s*\((?!\s*(?:tr\("|QStringLiteral\("|")))"),
       "the pattern of markup() is a literal"},
  };
  std::vector<std::string> found;
  const auto report = [&](std::ptrdiff_t at, const std::string& what) {
    found.push_back(path + ":" + std::to_string(lineOf(text, at)) + ": " + what);
  };
  for (const Rule& rule : rules) {
    for (auto it = std::sregex_iterator(text.begin(), text.end(), rule.pattern);
         it != std::sregex_iterator(); ++it)
      report(it->position(), rule.instead);
  }
  // A literal with a tag must be the first argument of markup().
  static const std::regex tagged(R"re("(?:[^"\\\n]|\\.)*<(?:b|br|i|p|a|img|font|span|qt)\b)re");
  static const std::regex before(R"(markup\s*\(\s*(?:tr|QStringLiteral)?\s*\(?\s*$)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), tagged);
       it != std::sregex_iterator(); ++it) {
    const std::string head = text.substr(0, static_cast<std::size_t>(it->position()));
    const std::string tail = head.substr(head.size() > 60 ? head.size() - 60 : 0);
    if (!std::regex_search(tail, before)) report(it->position(), "tags belong into markup()");
  }
  return found;
}

TEST(Markup, OnlyEscapedTextReachesRichText) {
  const fs::path root = kiln::sourceDir();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "gui")) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".h") continue;
    ++files;
    std::ifstream in(entry.path());
    std::ostringstream text;
    text << in.rdbuf();
    for (const std::string& found :
         markupViolations(fs::relative(entry.path(), root).string(), text.str()))
      ADD_FAILURE() << found;
  }
  EXPECT_GT(files, 100);
}

TEST(Markup, TheRuleFindsWhatItForbids) {
  const auto check = [](const std::string& text) {
    return markupViolations("gui/views/thing.cpp", text);
  };
  EXPECT_THAT(check("text = tr(\"<b>Stopped</b>: %1\").arg(name);\n"),
              ElementsAre("gui/views/thing.cpp:1: tags belong into markup()"));
  EXPECT_THAT(check("\nname_ = new QLabel(name);\n"), ElementsAre(HasSubstr(":2: use Label")));
  EXPECT_THAT(check("  QLabel* name_;\n"), ElementsAre(HasSubstr("use Label")));
  EXPECT_THAT(check("row->setToolTip(name);\n"), ElementsAre(HasSubstr("use setTip")));
  EXPECT_THAT(check("  setToolTip(name);\n"), ElementsAre(HasSubstr("use setTip")));
  EXPECT_THAT(check("words->set(markup(name));\n"), ElementsAre(HasSubstr("is a literal")));
  EXPECT_THAT(check("text += name.toHtmlEscaped();\n"), ElementsAre(HasSubstr("use Markup")));
  EXPECT_THAT(check("words->set(markup(tr(\"<b>%1</b><br>at rest\"), name));\n"
                    "words->set(markup(\n    tr(\"<b>%1</b>\"), name));\n"),
              IsEmpty());
  EXPECT_THAT(check("QString a = tr(\"2 < b and more\");\n"), IsEmpty());
}

}  // namespace
}  // namespace kiln
