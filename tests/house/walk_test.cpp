#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <vector>

#include "house/source_tree.hpp"

namespace {

// A row of the page: a file, and its function that the walk goes through.
struct Step {
  std::string file, function;
};

// The tables of docs/DESIGN.md whose second column is `through`.
std::vector<std::vector<Step>> walks() {
  std::vector<std::vector<Step>> found;
  const std::regex row(R"(\| `([a-z_/]+\.[a-z]+)` \| `([A-Za-z_]+)` \|.*)");
  bool inside = false;
  for (const std::string& line : house::lines_of("docs/DESIGN.md")) {
    if (line.rfind("| file | through |", 0) == 0) {
      found.emplace_back();
      inside = true;
    }
    inside = inside && !line.empty() && line.front() == '|';
    std::smatch match;
    if (inside && std::regex_match(line, match, row)) found.back().push_back({match[1], match[2]});
  }
  return found;
}

std::string text_of(const std::string& file) {
  std::string text;
  for (const std::string& line : house::lines_of(file)) text += line + '\n';
  return text;
}

// Does the text have the name where a function is defined or called?
bool names(const std::string& text, const std::string& function) {
  return std::regex_search(text, std::regex("\\b" + function + "(<[^;{]*>)?( step)?\\("));
}

}  // namespace

TEST_CASE("a vertex source walks through the files that the page lists") {
  const auto found = walks();
  REQUIRE(found.size() == 2);
  CHECK(found[0].size() <= 8);   // by windows, the default
  CHECK(found[1].size() <= 13);  // by labels
  for (const auto& walk : found) {
    std::vector<std::string> before;
    for (const Step& step : walk) {
      CAPTURE(step.file, step.function);
      const std::string text = text_of("src/" + step.file);
      CHECK(names(text, step.function));
      if (!before.empty()) {
        bool called = false;
        for (const std::string& other : before) called = called || names(other, step.function);
        CHECK(called);
      }
      before.push_back(text);
    }
  }
}
