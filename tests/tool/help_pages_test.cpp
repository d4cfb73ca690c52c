// The manual page and the completions have what --help has.

#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "folder.hpp"
#include "tool/tool.hpp"

namespace help_pages_test {

using namespace cli_testing;

namespace {

std::string page(const std::string& kind) {
  const auto run = run_tool({"--help-page", kind});
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  return run.out;
}

std::set<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex looked_for(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), looked_for), end; at != end; ++at)
    found.insert((*at)[1]);
  return found;
}

}  // namespace

TEST_CASE("the manual page and the completions know every command and option") {
  const std::string all = run_tool({"--help"}).out;
  auto commands = matches(all.substr(all.find("Subcommands:")), "\\n  ([a-z]+) ");
  commands.erase("plexway");  // an example
  REQUIRE(commands.size() >= 11);
  const std::string man = page("man"), bash = page("bash"), zsh = page("zsh"), fish = page("fish");
  std::size_t options = 0;
  for (const std::string& command : commands) {
    INFO(command);
    CHECK(man.find("\\fB" + command + "\\fR") != man.npos);
    CHECK(zsh.find("  " + command + ")\n") != zsh.npos);
    const auto at = bash.find("      " + command + ") words=");
    REQUIRE(at != bash.npos);
    const std::string words = bash.substr(at, bash.find(";;", at) - at);
    const std::string help = run_tool({command, "--help"}).out;
    for (const std::string& name : matches(help, "\\n  (?:-[a-zA-Z],)?(--[a-z-]+)")) {
      INFO(name);
      ++options;
      CHECK(std::regex_search(words, std::regex("[ \"]" + name + "[ \"]")));
      CHECK(zsh.find("'*" + name + "[") != zsh.npos);
      CHECK(fish.find("-l " + name.substr(2) + " ") != fish.npos);
      CHECK(man.find("\\fB" + std::regex_replace(name, std::regex("-"), "\\-")) != man.npos);
    }
  }
  CHECK(options > 100);
  CHECK(man.find("\\e") == man.npos);  // no escape is shown as text
  CHECK(run_tool({"--help-page", "teapot"}).code == 2);
}

TEST_CASE("-h is a screen: 25 lines of 80 columns with three examples") {
  const std::string tool = run_tool({"--help"}).out;
  auto commands = matches(tool.substr(tool.find("Subcommands:")), "\\n  ([a-z]+) ");
  commands.erase("plexway");  // an example
  REQUIRE(commands.size() >= 11);
  commands.insert("");
  for (const std::string& command : commands) {
    INFO(command);
    const auto run = command.empty() ? run_tool({"-h"}) : run_tool({command, "-h"});
    CHECK(run.code == 0);
    std::istringstream lines(run.out);
    std::size_t count = 0, examples = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      INFO(line);
      CHECK(line.size() <= 80);
      examples += line.starts_with("  plexway ");
    }
    CHECK(count <= 25);
    CHECK(examples == 3);
  }
}

TEST_CASE("without its program TetGen is not there, and that is no fault of the surface") {
  const testing::Folder empty;
  ::setenv("PLEXWAY_HELPERS", empty.path().c_str(), 1);
  const auto run = run_tool({"tetrahedralize", sample("elbow.off"), "--out", empty.at("e.vtu")});
  ::unsetenv("PLEXWAY_HELPERS");
  CHECK(run.code == 4);
  CHECK(run.complaints() == 1);
  CHECK(empty.files() == 0);
}

}  // namespace help_pages_test
