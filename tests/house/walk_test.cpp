#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "house/source_tree.hpp"

namespace walk_test {

namespace {

// A row of the page: a file, and its function that the walk goes through.
struct Step {
  std::string file, function;
};

// The tables of docs/contributing/architecture.md whose second column is `through`.
std::vector<std::vector<Step>> walks() {
  std::vector<std::vector<Step>> found;
  const std::regex row(R"(\| `([a-z_/]+\.[a-z]+)` \| `([A-Za-z_]+)` \|.*)");
  bool inside = false;
  for (const std::string& line : house::lines_of("docs/contributing/architecture.md")) {
    if (line.rfind("| file | through |", 0) == 0) {
      found.emplace_back();
      inside = true;
      continue;
    }
    inside = inside && !line.empty() && line.front() == '|';
    if (!inside || line == "|---|---|---|") continue;
    INFO(line);
    std::smatch match;
    REQUIRE(std::regex_match(line, match, row));
    found.back().push_back({match[1], match[2]});
  }
  return found;
}

// Without comments.
std::string text_of(const std::string& file) {
  std::string text;
  for (const std::string& line : house::lines_of(file))
    text += line.substr(0, line.find("//")) + '\n';
  return text;
}

// Behind the parenthesis that closes the one at `open`.
std::size_t behind(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i + 1;
  }
  return text.size();
}

enum class Use { defined, called };

// Is a function, or the constructor of a class, defined or called in a text? What comes before and
// behind its name and parentheses tells.
bool has(const std::string& text, const std::string& function, Use use) {
  static const std::regex type(
      R"((^|[^\w])(?!return |else |do )\w[\w:]*\s$|[^-]>\s$|[^&]&\s$|\*\s$)");
  static const std::regex body(R"(^\s*(const|noexcept|override|\s)*(\{|:\s*\w+\())");
  const std::regex name("\\b" + function + "(<[^;{}()]*>)?( \\w+)?\\(");
  for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at) {
    const auto first = static_cast<std::size_t>(at->position());
    const std::string before = text.substr(first < 40 ? 0 : first - 40, first < 40 ? first : 40);
    const std::string after = text.substr(behind(text, first + at->str().size() - 1), 80);
    const bool object = (*at)[2].matched;  // Class object(...)
    const bool defined = !object && std::regex_search(after, body);
    const bool called = object || (!defined && !std::regex_search(before, type));
    if (use == Use::defined ? defined : called) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a vertex source walks through the files that the page lists") {
  const auto found = walks();
  REQUIRE(found.size() == 2);
  CHECK(found[0].size() == 8);   // by windows, the default
  CHECK(found[1].size() == 13);  // by labels
  for (const auto& walk : found) {
    std::vector<std::string> before;
    for (const Step& step : walk) {
      CAPTURE(step.file, step.function);
      const std::string text = text_of("src/" + step.file);
      CHECK(has(text, step.function, Use::defined));
      if (!before.empty()) {
        bool called = false;
        for (const std::string& other : before)
          called = called || has(other, step.function, Use::called);
        CHECK(called);
      }
      before.push_back(text);
    }
  }
}

TEST_CASE("calls are told from definitions and declarations") {
  const auto found = [](const char* text) {
    return std::pair(has(text, "go", Use::defined), has(text, "go", Use::called));
  };
  CHECK(found("void go(int a) {") == std::pair(true, false));
  CHECK(found("std::vector<int> Runner<T>::go(const Map& m) const {") == std::pair(true, false));
  CHECK(found("  bool go(int);") == std::pair(false, false));
  CHECK(found("template void go(const E&, double);") == std::pair(false, false));
  CHECK(found("const std::vector<int>& go(int);") == std::pair(false, false));
  CHECK(found("  go<true>(1, f(2));") == std::pair(false, true));
  CHECK(found("if (a && runner_.go(1)) {") == std::pair(false, true));
  CHECK(found("return go(1);") == std::pair(false, true));
  CHECK(found("auto x = p->go(1) + 1;") == std::pair(false, true));
  CHECK(found("house::go(1);") == std::pair(false, true));
  CHECK(found("going(1); let_go(2);") == std::pair(false, false));
  CHECK(has("const Lanes<Real> step(1, 2);", "Lanes", Use::called));
  CHECK(has("  explicit Lanes(int a) : a_(a) {}", "Lanes", Use::defined));
}

}  // namespace walk_test
