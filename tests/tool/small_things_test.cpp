// What people trip over: where results go, what time is told, slips of the hand.

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace small_things_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;

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
    const auto run = run_tool(command);
    INFO(command[0] << ": " << run.err);
    REQUIRE(run.code == 0);
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
    const auto run = run_tool(arguments);
    INFO(arguments[0] << ": " << run.err);
    REQUIRE(run.code == 0);
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

  const auto fails = [](const std::vector<std::string>& arguments, const std::string& why) {
    const auto run = run_tool(arguments);
    CHECK(run.code == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Contains(why));
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
  const auto one = run_tool({"cvt", file, "--count", "1", "--iterations", "2"});
  INFO(one.err);
  REQUIRE(one.code == 0);
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
  const auto text = run_tool(arguments);
  INFO(text.err);
  REQUIRE(text.code == 0);
  CHECK_THAT(text.out, Contains("point:0.5,0.5,0.25 (vertex 12, 0.25 away)"));
  auto json = arguments;
  json.push_back("--json");
  const auto told = run_tool(json).json()["paths"][0];
  CHECK(told["from_snapped"].get<double>() == Approx(0.25));
  CHECK(told["to_snapped"].is_null());
}

TEST_CASE("isolines in JSON have their values") {
  const Folder folder;
  const auto run = run_tool({"distance", sample("torus.obj"), "-s", "vertex:0", "--isoline-step",
                             "0.5", "--isolines-out", folder.at("l.json").string()});
  REQUIRE(run.code == 0);
  const auto lines = nlohmann::json::parse(bytes_of(folder.at("l.json")))["paths"];
  REQUIRE(lines.size() > 1);
  for (const auto& line : lines)
    CHECK(line["value"].get<double>() == 0.5 * (line["source"].get<int>() + 1));
}

TEST_CASE("what was probably meant is asked") {
  const std::string torus = sample("torus.obj");
  const auto said = [](const std::vector<std::string>& arguments, int code = 2) {
    const auto run = run_tool(arguments);
    CHECK(run.code == code);
    CHECK(run.complaints() == 1);
    return run.err;
  };
  CHECK_THAT(said({"distnace", torus}), Contains("did you mean 'distance'?"));
  CHECK_THAT(said({"distance", torus, "--sorce", "vertex:0"}),
             Contains("did you mean '--source'?"));
  CHECK_THAT(said({"distance", torus, "--radus=2"}), Contains("did you mean '--radius'?"));
  CHECK_THAT(said({"distance", torus, "-s", "vertex:0", "-o", "d.cvs"}),
             Contains("did you mean '.csv'?"));
  CHECK_THAT(said({"info", "mesh.olf"}, 3), Contains("did you mean '.off'?"));
  CHECK(said({"distance", torus, "--quux"}).find("did you mean") == std::string::npos);
  CHECK_THAT(said({"info", "part.3mf"}, 3), Contains("save the surface as .stl, .ply or .glb"));
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
    REQUIRE(run_tool({"distance", torus, "-s", "vertex:0", "-o", folder.at(name).string()}).code ==
            0);
    CHECK(kind(name) == "surface");
  }
  REQUIRE(run_tool({"poisson", torus, "--count", "60", "-o", folder.at("c.csv").string()}).code ==
          0);
  CHECK(kind("c.csv") == "cloud");
  REQUIRE(run_tool({"path", torus, "-f", "vertex:0", "-t", "vertex:99", "-o",
                    folder.at("p.vtp").string()})
              .code == 0);
  CHECK(kind("p.vtp") == "wireframe");
  // The same distances.
  const auto first = run_tool({"distance", torus, "-s", "vertex:0", "-o", "-", "-q"});
  const auto again =
      run_tool({"distance", folder.at("s.vtu").string(), "-s", "vertex:0", "-o", "-", "-q"});
  CHECK(first.out == again.out);
}

}  // namespace small_things_test
