// What the tool says of results that may be far off: a line each, and "notes" of its JSON.

#ifdef PLEXWAY_HAS_FLANN
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace notes_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::Folder;

namespace {

/// Two squares of points in one plane, corner to corner, that no triangles join.
std::string squares() {
  std::ostringstream text;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      text << i << ' ' << j << " 0\n" << 13.5 + i << ' ' << 13.5 + j << " 0\n";
  return text.str();
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("every command that solves says what is doubtful, once, and in JSON") {
  const Folder folder;
  const std::string cloud = folder.write("squares.xyz", squares()).string();
  const std::string words = "join parts that have no triangles between them";
  const std::vector<std::vector<std::string>> commands = {
      {"distance", cloud, "--source", "vertex:0"},
      {"path", cloud, "--from", "vertex:0", "--to", "vertex:7"},
      {"pairs", cloud, "--source", "vertex:0", "--source", "vertex:7"},
      {"pairs", cloud, "--sources", "all", "--stats", folder.at("stats.csv").string()},
      {"farthest", cloud, "--count", "5"},
      {"poisson", cloud, "--count", "5"},
      {"cvt", cloud, "--count", "3", "--iterations", "2"},
  };
  for (std::vector<std::string> command : commands) {
    INFO(command[0]);
    const auto said = run_tool(command);
    CHECK(said.code == 0);
    CHECK(count(said.err, words) == 1);
    CHECK(count(said.out, words) == 0);
    command.emplace_back("--json");
    for (const bool quiet : {false, true}) {
      if (quiet) command.emplace_back("--quiet");
      const auto run = run_tool(command);
      INFO(run.err);
      REQUIRE(run.code == 0);
      CHECK(count(run.err, words) == (quiet ? 0 : 1));
      const auto notes = run.json().at("notes");
      REQUIRE(notes.is_array());
      CHECK(count(notes.dump(), words) == 1);
      // All that was said on standard error, line by line.
      for (const auto& note : notes)
        CHECK((quiet || count(run.err, "plexway: note: " + note.get<std::string>() + "\n") == 1));
      if (!quiet) CHECK(count(run.err, "plexway: note: ") == notes.size());
    }
  }
}

TEST_CASE("where there is nothing to say notes are an empty list") {
  const auto run = run_tool({"distance", sample("torus.obj"), "--source", "vertex:0", "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  CHECK(run.json().at("notes") == nlohmann::json::array());
  const auto far = run_tool({"distance", sample("two_parts.obj"), "-s", "vertex:0", "--json"});
  REQUIRE(far.code == 0);
  REQUIRE(far.json().at("notes").size() == 1);
  CHECK_THAT(far.json().at("notes")[0].get<std::string>(), Contains("not reached (inf)"));
}

}  // namespace notes_test
#endif
