// What may be meant in two ways, and slips of a newcomer: said with what to write.

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "folder.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace cli_conventions_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;
using testing::Folder;

namespace {

// Two triangles that are a square, but share no vertex.
const char* const soup = "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 3 5 4\n";

}  // namespace

TEST_CASE("options of other commands and bare places are answered with the right ones") {
  const std::string torus = sample("torus.obj");
  check_refused({"path", torus, "-s", "vertex:0", "--to", "vertex:9"}, 2, "did you mean '--from'?");
  check_refused({"path", torus, "--source", "vertex:0", "--to", "vertex:9"}, 2,
                "did you mean '--from'?");
  check_refused({"distance", torus, "--from", "vertex:0"}, 2, "did you mean '--source'?");
  check_refused({"pairs", torus, "--source", "all", "-o", "m.npy"}, 2,
                "did you mean '--sources all'?");
  check_refused({"distance", torus, "-s", "0"}, 2, "did you mean 'vertex:0'?");
  check_refused({"distance", torus, "-s", "1,0,0.5"}, 2, "did you mean 'point:1,0,0.5'?");
  check_refused({"path", torus, "--from", "12", "--to", "vertex:9"}, 2,
                "did you mean 'vertex:12'?");
  check_refused({"distance", torus, "-s", "vertex:0", "-o", "dist"}, 2, "the extension is missing");
}

TEST_CASE("a path from A to B is reported so") {
  const auto run = ran({"path", sample("torus.obj"), "--from", "vertex:0", "--to", "vertex:9"});
  CHECK_THAT(run.out, Contains("vertex:0 to vertex:9: length"));
}

TEST_CASE("the summary in JSON has the sources and the farthest vertex") {
  const auto run =
      ran({"distance", sample("torus.obj"), "-s", "vertex:3", "-s", "point:100,0,0", "--json"});
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
    const auto run = ran(all);
    return run.err.find("from the surface (") != std::string::npos;
  };
  CHECK(note({"distance", "-s", "point:0,0,100"}));
  CHECK(note({"distance", "-s", "circle:0,0,100,0.1"}));
  CHECK(note({"path", "--from", "vertex:0", "--to", "point:0,0,100"}));
  CHECK(note({"pairs", "-s", "vertex:0", "-s", "point:0,0,100"}));
  CHECK(note({"farthest", "--count", "2", "-s", "point:0,0,100"}));
  const auto found = run_tool({"path", torus, "--from", "vertex:0", "--to", "vertex:9", "-o", "-"});
  const auto at = nlohmann::json::parse(found.out)["paths"][0]["points"][0];
  if (at.is_array() && at.size() == 3) {
    const auto text = [&](std::size_t k) { return std::to_string(at[k].get<double>()); };
    CHECK_FALSE(note({"distance", "-s", "point:" + text(0) + "," + text(1) + "," + text(2)}));
  }
}

TEST_CASE("twins in a soup are named where they keep parts apart") {
  const Folder folder;
  const std::string file = folder.write("s.off", soup).string();
  const auto run = ran({"distance", file, "-s", "vertex:0"});
  CHECK_THAT(run.err, Contains("2 components, and 4 vertices lie exactly where another does; "
                               "--merge 0 joins them"));
  const auto info = run_tool({"info", file});
  CHECK_THAT(info.out, Contains("4 vertices exactly where another one lies"));
  CHECK_THAT(info.out, Contains("--merge 0 joins them"));
  const auto merged = run_tool({"distance", file, "-s", "vertex:0", "--merge", "0", "--json"});
  CHECK(merged.json()["merged_vertices"] == 2);
  CHECK(merged.json()["reached"] == merged.json()["vertices"]);
  CHECK(merged.json()["notes"].empty());
  check_refused({"distance", file, "-s", "vertex:0", "--merge=-1"}, 2,
                "--merge must be a number >= 0");
}

TEST_CASE("a vertex far off is blamed, not the faces beside it") {
  const Folder folder;
  const std::string file =
      folder.write("far.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1e308\n3 0 1 2\n3 1 3 2\n")
          .string();
  for (const char* precision : {"float", "double"}) {
    check_refused({"distance", file, "-s", "vertex:0", "--precision", precision}, 3,
                  "look for a vertex far off");
  }
}

// What people trip over: where results go, what time is told, slips of the hand.

namespace {

// Two squares of four triangles that do not touch.
std::string two_squares() {
  std::string off = "OFF\n10 8 0\n";
  for (const char* x : {"0", "5"})
    for (const char* at : {" 0 0", " 1 0", " 2 0", " 3 1", " 4 1"})
      off += std::string(x) + at + "\n";
  // A strip each.
  for (const int first : {0, 5})
    for (const auto& t : {std::array{0, 1, 3}, {1, 2, 3}, {2, 4, 3}, {0, 3, 4}}) {
      off += "3";
      for (const int v : t) off.append(" ").append(std::to_string(first + v));
      off += "\n";
    }
  return off;
}

}  // namespace

TEST_CASE("seconds is an object whose parts are all of the time") {
  const Folder folder;
  const std::string torus = sample("torus.obj");
  const std::vector<std::vector<std::string>> commands = {
      {"poisson", torus, "--count", "20"},
      {"cvt", torus, "--count", "10", "--iterations", "3"},
      {"farthest", torus, "--count", "5"},
      {"pairs", torus, "-s", "vertex:0", "-s", "vertex:9"},
      {"pairs", torus, "--sources", folder.write("rows.txt", "0\n5\n").string(), "--out",
       folder.at("m.npy").string()},
      {"path", torus, "-f", "vertex:0", "-t", "vertex:9"},
      {"distance", torus, "-s", "vertex:0"},
      {"convert", torus, folder.at("t.ply").string()}};
  for (std::vector<std::string> command : commands) {
    command.push_back("--json");
    const auto run = ran(command);
    const auto seconds = run.json()["seconds"];
    REQUIRE(seconds.is_object());
    CHECK(seconds.contains("load"));
    CHECK(seconds.size() >= 2);
    for (const auto& part : seconds) CHECK(part.get<double>() >= 0);
  }
  const auto cvt = run_tool({"cvt", torus, "--count", "10", "--iterations", "3", "--cells",
                             folder.at("c.csv").string(), "--json"});
  std::vector<std::string> parts;
  const auto ordered = nlohmann::ordered_json::parse(cvt.out)["seconds"];
  for (const auto& part : ordered.items()) parts.push_back(part.key());
  CHECK(parts == std::vector<std::string>{"load", "build", "start", "move", "cells", "write"});
}

TEST_CASE("every command writes to standard output, and then reports to standard error") {
  const std::string torus = sample("torus.obj");
  const auto check = [](const std::vector<std::string>& arguments, const std::string& begins) {
    const auto run = ran(arguments);
    CHECK(run.out.substr(0, begins.size()) == begins);
    CHECK_THAT(run.err, Contains("torus.obj"));
    CHECK(run.err.find("written") == run.err.npos);
    return run.out;
  };
  check({"distance", torus, "-s", "vertex:0", "-o", "-"}, "vertex,distance,error\n0,0,0\n");
  check({"distance", torus, "-s", "vertex:0", "-o", "ply:-"}, "ply\n");
  check({"distance", torus, "-s", "vertex:0", "-o", "csv:-"}, "vertex,x,y,z,distance,error\n");
  check({"path", torus, "-f", "vertex:0", "-t", "vertex:9", "-o", "-"}, "{\"paths\"");
  check({"path", torus, "-f", "vertex:0", "-t", "vertex:9", "-o", "obj:-"}, "# geodesic");
  check({"poisson", torus, "--count", "9", "-o", "-"}, "x,y,z,vertex");
  check({"farthest", torus, "--count", "3", "-o", "obj:-"}, "v ");
  check({"cvt", torus, "--count", "9", "--iterations", "1", "--dual", "-"}, "v ");
  check({"pairs", torus, "-s", "vertex:0", "-s", "vertex:9", "-o", "-"}, "0,");
  check({"convert", torus, "off:-"}, "OFF\n");
  check({"distance", torus, "-s", "vertex:0", "--isoline-step", "0.5", "--isolines-out", "-"},
        "# geodesic");
  check({"distance", torus, "-s", "vertex:0", "--html", "-"}, "<!doctype html>");
  // What it writes so it reads so.
  const Folder folder;
  const auto off = run_tool({"convert", torus, "off:-", "--quiet"});
  CHECK(run_tool({"info", folder.write("t.off", off.out).string()}).code == 0);

  const auto fails = [](const Words& arguments, const std::string& why) {
    check_refused(arguments, 2, why);
  };
  fails({"distance", torus, "-s", "vertex:0", "-o", "-", "--html", "-"}, "two results");
  fails({"distance", torus, "-s", "vertex:0", "-o", "xyzzy:-"}, "unknown extension");
  fails({"distance", torus, "-s", "vertex:0", "-o", "vdb:-"}, "standard output");
  fails({"pairs", torus, "--sources", "all", "-o", "npy:-"}, "not standard output");
  CHECK(run_tool_into_closed_pipe({"convert", torus, "obj:-"}).code == 0);
}

TEST_CASE("parts of a domain that get no seed, dart or point are told") {
  const Folder folder;
  const std::string file = folder.write("two.off", two_squares()).string();
  const auto one = ran({"cvt", file, "--count", "1", "--iterations", "2"});
  CHECK_THAT(one.err, Contains("no seed in 1 part of the surface (5 vertices)"));
  CHECK_THAT(run_tool({"farthest", file, "--count", "1"}).err, Contains("no point in 1 part"));
  CHECK(run_tool({"farthest", file, "--count", "2"}).err.empty());
  CHECK(run_tool({"cvt", file, "--count", "1", "--iterations", "2", "--quiet"}).err.empty());
}

TEST_CASE("path tells how far a point was from the domain") {
  const Folder folder;
  const std::string square = folder.write("s.off", square_off(5)).string();
  const std::vector<std::string> arguments = {"path", square,    "--from", "point:0.5,0.5,0.25",
                                              "--to", "vertex:0"};
  const auto text = ran(arguments);
  CHECK_THAT(text.out, Contains("point:0.5,0.5,0.25 (vertex 12, 0.25 away)"));
  auto json = arguments;
  json.push_back("--json");
  const auto told = run_tool(json).json()["paths"][0];
  CHECK(told["from_snapped"].get<double>() == Approx(0.25));
  CHECK(told["to_snapped"].is_null());
}

TEST_CASE("isolines in JSON have their values") {
  const Folder folder;
  const auto run = ran({"distance", sample("torus.obj"), "-s", "vertex:0", "--isoline-step", "0.5",
                        "--isolines-out", folder.at("l.json").string()});
  const auto lines = nlohmann::json::parse(bytes_of(folder.at("l.json")))["paths"];
  REQUIRE(lines.size() > 1);
  for (const auto& line : lines)
    CHECK(line["value"].get<double>() == 0.5 * (line["source"].get<int>() + 1));
}

TEST_CASE("what was probably meant is asked") {
  const std::string torus = sample("torus.obj");
  check_refused({"distnace", torus}, 2, "did you mean 'distance'?");
  check_refused({"distance", torus, "--sorce", "vertex:0"}, 2, "did you mean '--source'?");
  check_refused({"distance", torus, "--radus=2"}, 2, "did you mean '--radius'?");
  check_refused({"distance", torus, "-s", "vertex:0", "-o", "d.cvs"}, 2, "did you mean '.csv'?");
  check_refused({"info", "mesh.olf"}, 3, "did you mean '.off'?");
  CHECK(run_tool({"distance", torus, "--quux"}).err.find("did you mean") == std::string::npos);
  check_refused({"info", "part.dae"}, 3, "save the surface as .stl, .ply or .glb");
}

TEST_CASE("points in a line make a picture of their edges, and a note") {
  const Folder folder;
  const std::string file =
      folder.write("line.off", "OFF\n4 2 0\n0 0 0\n1 1 1\n2 2 2\n3 3 3\n3 0 1 2\n3 1 2 3\n")
          .string();
  const auto run = run_tool({"distance", file, "-s", "vertex:0", "--accuracy", "fast", "--picture",
                             folder.at("p.png").string()});
  INFO(run.err);
  if (run.code == 4) return;  // a build without pictures
  REQUIRE(run.code == 0);
  CHECK_THAT(run.err, Contains("all points lie in a line"));
  CHECK(std::filesystem::file_size(folder.at("p.png")) > 500);
}

TEST_CASE("what the tool writes it reads, as what it was") {
  const Folder folder;
  const std::string torus = sample("torus.obj");
  const auto kind = [&](const std::string& name) {
    const auto run = run_tool({"info", folder.at(name).string(), "--json"});
    INFO(name << ": " << run.err);
    CHECK(run.code == 0);
    return run.code == 0 ? run.json()["kind"].get<std::string>() : "";
  };
  for (const char* name : {"s.vtu", "s.vtk", "s.glb", "s.gltf", "s.ply"}) {
    ran({"distance", torus, "-s", "vertex:0", "-o", folder.at(name).string()});
    CHECK(kind(name) == "surface");
  }
  ran({"poisson", torus, "--count", "60", "-o", folder.at("c.csv").string()});
  CHECK(kind("c.csv") == "cloud");
  ran({"path", torus, "-f", "vertex:0", "-t", "vertex:99", "-o", folder.at("p.vtp").string()});
  CHECK(kind("p.vtp") == "wireframe");
  // The same distances.
  const auto first = run_tool({"distance", torus, "-s", "vertex:0", "-o", "-", "-q"});
  const auto again =
      run_tool({"distance", folder.at("s.vtu").string(), "-s", "vertex:0", "-o", "-", "-q"});
  CHECK(first.out == again.out);
}

// What the tool says of results that may be far off: a line each, and "notes" of its JSON.

#ifdef PLEXWAY_HAS_FLANN

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
      const auto run = ran(command);
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
  const auto run = ran({"distance", sample("torus.obj"), "--source", "vertex:0", "--json"});
  CHECK(run.err.empty());
  CHECK(run.json().at("notes") == nlohmann::json::array());
  const auto far = ran({"distance", sample("two_parts.obj"), "-s", "vertex:0", "--json"});
  REQUIRE(far.json().at("notes").size() == 1);
  CHECK_THAT(far.json().at("notes")[0].get<std::string>(), Contains("not reached (inf)"));
}

#endif

}  // namespace cli_conventions_test
