#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <string>

#include "house/source_tree.hpp"

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
