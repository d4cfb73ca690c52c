#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "house/source_tree.hpp"

namespace reference_test {

namespace {

namespace fs = std::filesystem;

bool is_detail(const std::string& header) { return header.find("/detail/") != header.npos; }

}  // namespace

// Doxygen leaves out what is in a namespace without a docstring, and says nothing.
TEST_CASE("every namespace of the public headers has a docstring") {
  static const std::regex opens(R"(^namespace (plexway[a-z_:]*) \{$)");
  std::map<std::string, bool> documented;
  for (const char* dir : {"include", "complexes"}) {
    for (const std::string& file : house::files_under(dir)) {
      if (file.find("include/plexway/") == file.npos || file.find(".hpp") == file.npos) continue;
      if (is_detail(file)) continue;
      std::string before;
      for (const std::string& line : house::lines_of(file)) {
        std::smatch match;
        if (line.rfind("namespace plexway", 0) == 0 && std::regex_match(line, match, opens))
          documented[match[1]] |= before.rfind("///", 0) == 0;
        before = line;
      }
    }
  }
  CHECK(documented.size() >= 9);
  for (const auto& [name, has] : documented) {
    INFO(name);
    CHECK(has);
  }
}

TEST_CASE("public headers need no header of src, and all that are details") {
  std::set<std::string> reached, details;
  std::vector<std::string> todo;
  for (const std::string& file : house::files_under("include")) {
    if (fs::path(file).extension() != ".hpp") continue;
    const std::string name = file.substr(std::string("include/").size());
    if (is_detail(name))
      details.insert(name);
    else
      todo.push_back(name);
    for (const house::Include& include : house::includes_of(file)) {
      INFO(file << ": " << include.name << " is not installed");
      CHECK_FALSE(include.quoted);
    }
  }
  REQUIRE(todo.size() > 80);
  while (!todo.empty()) {
    const std::string name = todo.back();
    todo.pop_back();
    if (!fs::exists(house::root() / "include" / name) || !reached.insert(name).second) continue;
    for (const house::Include& include : house::includes_of("include/" + name))
      todo.push_back(include.name);
  }
  for (const std::string& name : details) {
    INFO(name << " is needed by no public header: it belongs into src");
    CHECK(reached.count(name) == 1);
  }
}

}  // namespace reference_test
