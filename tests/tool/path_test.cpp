#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/io/edges.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace path_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

TEST_CASE("paths across a square, as numbers and as files") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(9)).string();
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  for (const char* name : {"p.obj", "p.ply", "p.vtp", "p.json"}) {
    const auto run = run_tool({"path", square, "--from", "vertex:0", "--to", "vertex:80", "--to",
                               "point:0.3,0.8,0", "--out", path(name), "--json", "--quiet"});
    INFO(name << ": " << run.err);
    REQUIRE(run.code == 0);
    const auto json = run.json();
    CHECK(json["kind"] == "surface");
    CHECK(json["paths"][0]["length"].get<double>() == Approx(std::sqrt(2.0)).epsilon(1e-9));
    CHECK(json["paths"][1]["length"].get<double>() == Approx(std::hypot(.3, .8)).epsilon(1e-9));
    CHECK(json["paths"][1]["to"] == "point:0.3,0.8,0");
    CHECK(json["paths"][1]["from"] == "vertex:0");
  }
  const auto edges = plexway::io::read_edges(path("p.obj"));
  double length = 0;
  for (const auto& [a, b] : edges.edges)
    length += std::hypot(edges.positions[a][0] - edges.positions[b][0],
                         edges.positions[a][1] - edges.positions[b][1]);
  CHECK(length == Approx(std::sqrt(2.0) + std::hypot(.3, .8)).epsilon(1e-9));
}

TEST_CASE("a search finds the same path after fewer expansions") {
  const auto full = run_tool({"path", sample("knot.ply"), "--from", "vertex:0", "--to",
                              "vertex:100", "--json", "--quiet"});
  const auto search = run_tool({"path", sample("knot.ply"), "--from", "vertex:0", "--to",
                                "vertex:100", "--astar", "--json", "--quiet"});
  REQUIRE(full.code == 0);
  REQUIRE(search.code == 0);
  const double length = full.json()["paths"][0]["length"];
  CHECK(search.json()["paths"][0]["length"].get<double>() == Approx(length).epsilon(1e-4));
  CHECK(search.json()["expansions"].get<int>() * 5 < full.json()["expansions"].get<int>());
}

TEST_CASE("paths in solids and on wireframes") {
  const auto solid = run_tool({"path", sample("elbow.mesh"), "--from", "vertex:0", "--to",
                               "vertex:30", "--json", "--quiet"});
  INFO(solid.err);
  REQUIRE(solid.code == 0);
  CHECK(solid.json()["kind"] == "solid");
  CHECK(solid.json()["paths"][0]["length"].get<double>() > 0);
  const auto distance = run_tool(
      {"distance", sample("vessels.obj"), "--source", "vertex:0", "--quiet", "--out", "-"});
  const auto wires = run_tool({"path", sample("vessels.obj"), "--from", "vertex:0", "--to",
                               "vertex:50", "--json", "--quiet"});
  REQUIRE(wires.code == 0);
  CHECK(wires.json()["paths"][0]["length"].get<double>() ==
        Approx(csv_column(distance.out, "distance")[50]).epsilon(1e-5));
}

TEST_CASE("paths that cannot be are said so") {
  const std::string parts = sample("two_parts.obj");
  const auto apart =
      run_tool({"path", parts, "--from", "vertex:0", "--to", "vertex:414", "--json", "--quiet"});
  CHECK(apart.code == 5);
  CHECK(apart.json()["paths"][0]["length"].is_null());
  CHECK(run_tool({"path", parts, "--from", "vertex:0"}).code == 2);
  CHECK(run_tool({"path", parts, "--from", "vertex:0", "--to", "here"}).code == 2);
  CHECK(run_tool({"path", parts, "--from", "vertex:0", "--to", "vertex:9999"}).code == 3);
  CHECK(
      run_tool({"path", parts, "--from", "vertex:0", "--to", "vertex:1", "--out", "x.stl"}).code ==
      2);
  CHECK(
      run_tool({"path", sample("vessels.obj"), "--from", "vertex:0", "--to", "vertex:1", "--astar"})
          .code == 2);
}

TEST_CASE("path takes targets from a file") {
  const Folder folder;
  const std::string input = folder.write("square.off", square_off(5)).string();
  const std::string targets = folder.write("targets.txt", "24\n4\n").string();
  const auto run = run_tool({"path", input, "--from", "vertex:0", "--to", "vertices:" + targets,
                             "--to", "vertex:20", "--json"});
  REQUIRE(run.code == 0);
  const auto paths = run.json()["paths"];
  REQUIRE(paths.size() == 3);
  CHECK(paths[0]["to"] == "vertex:24");
  CHECK(paths[0]["length"] == Approx(std::sqrt(2.)).epsilon(1e-6));
  CHECK(paths[1]["length"] == Approx(1).epsilon(1e-6));
  const auto beyond = run_tool({"path", input, "--from", "vertex:0", "--to",
                                "vertices:" + folder.write("beyond.txt", "25\n").string()});
  CHECK(beyond.code == 3);
  CHECK(beyond.complaints() == 1);
}

}  // namespace path_test
