// What may be meant in two ways, and slips of a newcomer: said with what to write.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "folder.hpp"
#include "tool/tool.hpp"

namespace cli_conventions_test {

using namespace cli_testing;
using Catch::Contains;
using testing::Folder;

namespace {

void fails(const std::vector<std::string>& arguments, const std::string& why) {
  const auto run = run_tool(arguments);
  CAPTURE(run.err);
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains(why));
}

// Two triangles that are a square, but share no vertex.
const char* const soup = "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 3 5 4\n";

}  // namespace

TEST_CASE("options of other commands and bare places are answered with the right ones") {
  const std::string torus = sample("torus.obj");
  fails({"path", torus, "-s", "vertex:0", "--to", "vertex:9"}, "did you mean '--from'?");
  fails({"path", torus, "--source", "vertex:0", "--to", "vertex:9"}, "did you mean '--from'?");
  fails({"distance", torus, "--from", "vertex:0"}, "did you mean '--source'?");
  fails({"pairs", torus, "--source", "all", "-o", "m.npy"}, "did you mean '--sources all'?");
  fails({"distance", torus, "-s", "0"}, "did you mean 'vertex:0'?");
  fails({"distance", torus, "-s", "1,0,0.5"}, "did you mean 'point:1,0,0.5'?");
  fails({"path", torus, "--from", "12", "--to", "vertex:9"}, "did you mean 'vertex:12'?");
  fails({"distance", torus, "-s", "vertex:0", "-o", "dist"}, "the extension is missing");
}

TEST_CASE("a path from A to B is reported so") {
  const auto run =
      run_tool({"path", sample("torus.obj"), "--from", "vertex:0", "--to", "vertex:9"});
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("vertex:0 to vertex:9: length"));
}

TEST_CASE("the summary in JSON has the sources and the farthest vertex") {
  const auto run = run_tool(
      {"distance", sample("torus.obj"), "-s", "vertex:3", "-s", "point:100,0,0", "--json"});
  REQUIRE(run.code == 0);
  const auto json = nlohmann::json::parse(run.out);
  REQUIRE(json["sources"].size() == 2);
  CHECK(json["sources"][0]["source"] == "vertex:3");
  CHECK(json["sources"][0]["vertex"] == 3);
  CHECK(json["sources"][0]["snapped"].is_null());
  CHECK(json["sources"][1]["snapped"].get<double>() > 90);
  CHECK(json["farthest"].get<std::size_t>() < json["vertices"].get<std::size_t>());
  bool noted = false;
  for (const auto& note : json["notes"])
    noted |= note.get<std::string>().find("the closest point was taken") != std::string::npos;
  CHECK(noted);
}

TEST_CASE("a point beside the domain is no matter, one far away is noted") {
  const std::string torus = sample("torus.obj");
  const auto note = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {more[0], torus};
    all.insert(all.end(), more.begin() + 1, more.end());
    const auto run = run_tool(all);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    return run.err.find("from the surface (") != std::string::npos;
  };
  CHECK(note({"distance", "-s", "point:0,0,100"}));
  CHECK(note({"distance", "-s", "circle:0,0,100,0.1"}));
  CHECK(note({"path", "--from", "vertex:0", "--to", "point:0,0,100"}));
  CHECK(note({"pairs", "-s", "vertex:0", "-s", "point:0,0,100"}));
  const auto found = run_tool({"path", torus, "--from", "vertex:0", "--to", "vertex:9", "-o", "-"});
  const auto at = nlohmann::json::parse(found.out)["paths"][0]["points"][0];
  if (at.is_array() && at.size() == 3) {
    const auto text = [&](std::size_t k) { return std::to_string(at[k].get<double>()); };
    CHECK_FALSE(note({"distance", "-s", "point:" + text(0) + "," + text(1) + "," + text(2)}));
  }
}

TEST_CASE("twins in a soup are named where they keep parts apart") {
  const Folder folder;
  const auto run = run_tool({"distance", folder.write("s.off", soup).string(), "-s", "vertex:0"});
  REQUIRE(run.code == 0);
  CHECK_THAT(run.err, Contains("2 components, and 4 vertices lie exactly where another does"));
}

TEST_CASE("a vertex far off is blamed, not the faces beside it") {
  const Folder folder;
  const std::string file =
      folder.write("far.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1e308\n3 0 1 2\n3 1 3 2\n")
          .string();
  for (const char* precision : {"float", "double"}) {
    const auto run = run_tool({"distance", file, "-s", "vertex:0", "--precision", precision});
    CHECK(run.code == 3);
    CHECK_THAT(run.err, Contains("look for a vertex far off"));
  }
}

TEST_CASE("the manual page has no escapes of its own") {
  const std::string page = run_tool({"--help-page", "man"}).out;
  CHECK(page.find("\\e") == page.npos);
  CHECK_THAT(page, Contains("\\fB\\-\\-source\\fR, \\fB\\-s\\fR"));
}

}  // namespace cli_conventions_test
