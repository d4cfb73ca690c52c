#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "house/source_tree.hpp"

namespace {

namespace fs = std::filesystem;

// The headers that the reference leaves out: those that public headers need, and the rules.
struct Implementation {
  std::set<std::string> needed, rules;
};

Implementation implementation() {
  static const std::regex header(R"(^  ([a-z_]+/[a-z_]+\.hpp)\)?$)");
  Implementation found;
  bool rules = false;
  for (const std::string& line : house::lines_of("cmake/PlexwayReference.cmake")) {
    rules = rules || line.find("# The rules, step by step.") != line.npos;
    std::smatch match;
    if (std::regex_match(line, match, header))
      (rules ? found.rules : found.needed).insert("plexway/" + match[1].str());
  }
  return found;
}

}  // namespace

// Doxygen leaves out what is in a namespace without a docstring, and says nothing.
TEST_CASE("every namespace of the public headers has a docstring") {
  static const std::regex opens(R"(^namespace (plexway[a-z_:]*) \{$)");
  std::map<std::string, bool> documented;
  for (const char* dir : {"include", "complexes"}) {
    for (const std::string& file : house::files_under(dir)) {
      if (file.find("include/plexway/") == file.npos || file.find(".hpp") == file.npos) continue;
      std::string before;
      for (const std::string& line : house::lines_of(file)) {
        std::smatch match;
        if (line.rfind("namespace plexway", 0) == 0 && std::regex_match(line, match, opens))
          documented[match[1]] |= before.rfind("///", 0) == 0;
        before = line;
      }
    }
  }
  documented.erase("plexway::kernel");  // no user's business: cmake/PlexwayReference.cmake
  CHECK(documented.size() >= 9);
  for (const auto& [name, has] : documented) {
    INFO(name);
    CHECK(has);
  }
}

TEST_CASE("what the reference leaves out is there, and public headers do without the rules") {
  const Implementation left_out = implementation();
  REQUIRE(left_out.needed.size() > 10);
  REQUIRE(left_out.rules.size() > 10);
  for (const auto* names : {&left_out.needed, &left_out.rules}) {
    for (const std::string& name : *names) {
      INFO(name);
      CHECK(fs::exists(house::root() / "include" / name));
    }
  }
  std::set<std::string> reached;
  std::vector<std::string> todo;
  for (const std::string& file : house::files_under("include")) {
    const std::string name = file.substr(std::string("include/").size());
    if (fs::path(name).extension() == ".hpp" && left_out.needed.count(name) == 0 &&
        left_out.rules.count(name) == 0)
      todo.push_back(name);
  }
  while (!todo.empty()) {
    const std::string name = todo.back();
    todo.pop_back();
    if (!fs::exists(house::root() / "include" / name) || !reached.insert(name).second) continue;
    for (const house::Include& include : house::includes_of("include/" + name))
      todo.push_back(include.name);
  }
  for (const std::string& name : left_out.rules) {
    INFO(name << " is needed by a public header");
    CHECK(reached.count(name) == 0);
  }
  for (const std::string& name : left_out.needed) {
    INFO(name << " is needed by no public header: it is one of the rules");
    CHECK(reached.count(name) == 1);
  }
}
