// Nothing but the table (support.hpp, domain/support.hpp, shape/support.hpp) decides what goes with
// what. Looks for other places: refusals whose words are those of such a decision.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "house/source_tree.hpp"

namespace one_table_test {

namespace {

// Refusals that sound like the table's and decide something else.
struct Other {
  const char* place;  // how the file begins
  const char* text;   // a part of what it says
  const char* why;
};
constexpr std::array others = {
    // Files: empty, of another format, or what a format does not hold.
    Other{"src/io/", "needs at least one", "an empty file"},
    Other{"src/io/", "single precision only", "numbers that do not fit a format"},
    Other{"src/io/field/field.cpp", "do without", "which formats hold what has no positions"},
    Other{"src/io/surface/mesh_writers.cpp", "does without",
          "which formats hold what has no positions"},
    Other{"src/io/field/paths.cpp", "only .json can hold",
          "which formats hold what has no positions"},
    Other{"src/io/", "the dimension is", "a file of the plane"},
    Other{"src/io/surface/freesurfer.cpp", "is no surface", "another format"},
    Other{"src/io/surface/freesurfer_labels.cpp", "has no table of colours",
          "a part that is not there"},
    Other{"src/io/surface/gifti.cpp", "has no points and triangles", "a part that is not there"},
    Other{"src/io/field/labels.cpp", "is no label of FreeSurfer", "another format"},
    Other{"src/io/simplices.cpp", "coordinates a vertex", "a count"},
    Other{"src/io/surface/stl.cpp", "neither ascii STL", "another format"},
    Other{"src/io/solid/cells.cpp", "has no tetrahedra", "what a file holds"},
    Other{"src/io/solid/cells.cpp", "half a face", "cells that do not fit together"},
    Other{"src/io/solid/tetgen_files.cpp", "has no tetrahedra", "what a file holds"},
    Other{"src/io/formats.cpp", "with coordinates", "what a file holds"},
    Other{"src/io/solid/tets.cpp", "must lie beside it", "a second file that is not there"},
    Other{"complexes/solid/tetgen/src/poly_file.cpp", "the dimension is not 3",
          "a file of the plane"},
    // What is to be filled, cut or written encloses nothing or is empty.
    Other{"complexes/solid/tetgen/src/surface_check.cpp", "no solid to fill", "an empty list"},
    Other{"complexes/solid/tetgen/src/surface_check.cpp", "the surface is open", "its shape"},
    Other{"complexes/solid/openvdb/src/closing.cpp", "there is no surface", "an empty list"},
    Other{"complexes/solid/openvdb/src/closing.cpp", "it encloses nothing", "its shape"},
    Other{"complexes/solid/openvdb/src/write.cpp", "a solid with tetrahedra", "an empty list"},
    Other{"complexes/solid/openvdb/src/write.cpp", "names no vertex", "a number out of range"},
    Other{"complexes/cloud/pcl/include/plexway/pcl/cloud.hpp", "no finite point", "an empty list"},
    // Devices.
    Other{"src/executors/gl/context.cpp", "there is no GL device", "which devices there are"},
    Other{"src/executors/gl/run.cpp", "2^27 sources", "a count"},
    // Something is empty or out of range.
    Other{"complexes/", "has no", "an empty domain"},
    Other{"src/executors/parts/deal_faces.cpp", "has no", "an empty domain"},
    Other{"complexes/mixed/mixed_complex.cpp", "came without positions",
          "one call, which has another"},
    Other{"src/paths/", "positions for", "a count"},
    Other{"src/fields/tuning.cpp", "there is no surface", "an empty list"},
    Other{"src/paths/path_search.cpp", "the straight line is no lower bound", "a bound"},
    Other{"src/shape/measure.cpp", "different speeds", "a count"},
    Other{"src/shape/pairs/pair_tables.cpp", "label", "what a file of labels holds"},
    Other{"src/shape/prepared.cpp", "is in no simplex", "a vertex that nothing leads to"},
    Other{"src/shape/convert.cpp", "does not go into", "what formats hold: lists of extensions"},
    Other{"src/shape/shape.cpp", "coordinates a vertex", "a count"},
    Other{"src/shape/shape.cpp", "number their vertices through", "numbers"},
    Other{"src/shape/shape.cpp", "no voxel has its centre", "a voxel that is too large"},
    Other{"src/shape/arguments/mask_argument.cpp", "no path passes", "a vertex that is masked"},
    // The grammar of the command line: words that mean nothing without another.
    Other{"src/tool/options/executor_argument.cpp", "--device needs", "grammar"},
    Other{"src/tool/options/input.cpp", "no such kind", "a word that is unknown"},
    Other{"src/tool/options/isoline_options.cpp", "would hold nothing", "an empty file"},
    Other{"src/tool/options/solve_options.cpp", "goes with", "grammar"},
    Other{"src/tool/commands/pairs_matrix.cpp", "leave out --labels", "grammar"},
    Other{"web/module/module.cpp", "is not known", "a word that is unknown"},
    Other{"python/src/build.cpp", "as many simplices as vertices", "an array that could be either"},
};

// What the table is about, and how refusals of its kind are put.
const std::regex& subject() {
  static const std::regex words(
      R"(\b(surfaces?|solids?|wireframes?|clouds?|mixed|simplices|complex(es)?|tetrahedr\w+|Serial|)"
      R"(OpenMP|GL|gl|serial|openmp|precision|double|float|accurac\w+|visibility|saddles|schedule|)"
      R"(windows|labels?|positions|lengths|triangulation|metric|mask|isolines)\b)");
  return words;
}
const std::regex& refusal() {
  static const std::regex words(
      R"(\b(needs?|only|cannot|does not|do not|are for|is for|goes? with|knows|takes?|leave|use|no|)"
      R"(none|without|instead|alone|made of|already)\b)");
  return words;
}

bool is_table(const std::string& file) { return file.ends_with("/support.hpp"); }

std::vector<std::string> sources() {
  std::vector<std::string> all;
  for (const char* dir : {"include", "src", "complexes", "python/src", "web/module"})
    for (const std::string& file : house::files_under(dir))
      if ((file.ends_with(".hpp") || file.ends_with(".cpp")) && !is_table(file))
        all.push_back(file);
  return all;
}

std::string text_of(const std::string& file) {
  std::ifstream in(house::root() / file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The string literals between a parenthesis and its end, after each other.
std::string words_in_call(const std::string& text, std::size_t open) {
  std::string words;
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) break;
    if (text[i] == '\'') {  // a character
      i += text[i + 1] == '\\' ? 3 : 2;
      continue;
    }
    if (text[i] != '"') continue;
    for (++i; i < text.size() && text[i] != '"'; ++i) {
      if (text[i] == '\\') ++i;
      words += text[i];
    }
    words += ' ';
  }
  return words;
}

struct Refusal {
  std::string words;
  std::size_t line;
};

std::vector<Refusal> refusals_of(const std::string& text) {
  static const std::array names = {
      "UsageError(", "InputError(", "value_error(", "invalid_argument(",
      "fail(",       "fail_at(",    "refuse("};
  std::vector<Refusal> all;
  for (const std::string name : names)
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
      const std::string words = words_in_call(text, at + name.size() - 1);
      if (std::regex_search(words, subject()) && std::regex_search(words, refusal()))
        all.push_back(
            {words, 1 + static_cast<std::size_t>(std::count(
                            text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'))});
    }
  return all;
}

}  // namespace

TEST_CASE("what goes together is decided in one table") {
  std::set<std::size_t> needed;
  for (const std::string& file : sources())
    for (const Refusal& found : refusals_of(text_of(file))) {
      bool known = false;
      for (std::size_t i = 0; i < others.size(); ++i)
        if (file.starts_with(others[i].place) &&
            found.words.find(others[i].text) != std::string::npos) {
          known = true;
          needed.insert(i);
        }
      INFO(file << ':' << found.line << ": \"" << found.words
                << "\": a decision for support.hpp, or tell here what else it is");
      CHECK(known);
    }
  for (std::size_t i = 0; i < others.size(); ++i) {
    INFO(others[i].place << " \"" << others[i].text << "\" is nowhere: leave it out here");
    CHECK(needed.count(i) == 1);
  }
}

TEST_CASE("reasons are given by the table alone") {
  static const std::regex giving(R"((return|Support\(|Support\{|require\(|\?|: )\s*Refusal::)");
  for (const std::string& file : sources()) {
    std::size_t line = 0;
    for (const std::string& text : house::lines_of(file)) {
      ++line;
      if (text.find("Refusal::") == text.npos) continue;
      INFO(file << ':' << line << ": " << text);
      CHECK_FALSE(std::regex_search(text, giving));
    }
  }
}

// The search finds what it is made for.
TEST_CASE("a decision outside of the table is found") {
  CHECK(refusals_of(R"(if (is_cloud) throw UsageError("a cloud has no isolines");)").size() == 1);
  CHECK(refusals_of("throw InputError(name +\n \": needs\" + x(1) + \" a surface\");").size() == 1);
  CHECK(refusals_of(R"(throw UsageError("the radius must be >= 0");)").empty());
}

}  // namespace one_table_test
