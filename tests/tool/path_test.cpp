#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

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
    const auto run = ran({"path", square, "--from", "vertex:0", "--to", "vertex:80", "--to",
                          "point:0.3,0.8,0", "--out", path(name), "--json", "--quiet"});
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
  const auto solid = ran({"path", sample("elbow.mesh"), "--from", "vertex:0", "--to", "vertex:30",
                          "--json", "--quiet"});
  CHECK(solid.json()["kind"] == "solid");
  CHECK(solid.json()["paths"][0]["length"].get<double>() > 0);
  const auto distance = run_tool(
      {"distance", sample("vessels.obj"), "--source", "vertex:0", "--quiet", "--out", "-"});
  const auto wires = ran({"path", sample("vessels.obj"), "--from", "vertex:0", "--to", "vertex:50",
                          "--json", "--quiet"});
  CHECK(wires.json()["paths"][0]["length"].get<double>() ==
        Approx(csv_column(distance.out, "distance")[50]).epsilon(1e-5));
}

TEST_CASE("paths that cannot be are said so") {
  const std::string parts = sample("two_parts.obj");
  const auto apart =
      run_tool({"path", parts, "--from", "vertex:0", "--to", "vertex:414", "--json", "--quiet"});
  CHECK(apart.code == 5);
  CHECK(apart.json()["paths"][0]["length"].is_null());
  check_refused({"path", parts, "--from", "vertex:0"}, 2);
  check_refused({"path", parts, "--from", "vertex:0", "--to", "here"}, 2);
  check_refused({"path", parts, "--from", "vertex:0", "--to", "vertex:9999"}, 3);
  check_refused({"path", parts, "--from", "vertex:0", "--to", "vertex:1", "--out", "x.stl"}, 2);
  check_refused(
      {"path", sample("vessels.obj"), "--from", "vertex:0", "--to", "vertex:1", "--astar"}, 2);
}

TEST_CASE("path takes targets from a file") {
  const Folder folder;
  const std::string input = folder.write("square.off", square_off(5)).string();
  const std::string targets = folder.write("targets.txt", "24\n4\n").string();
  const auto run = ran({"path", input, "--from", "vertex:0", "--to", "vertices:" + targets, "--to",
                        "vertex:20", "--json"});
  const auto paths = run.json()["paths"];
  REQUIRE(paths.size() == 3);
  CHECK(paths[0]["to"] == "vertex:24");
  CHECK(paths[0]["length"] == Approx(std::sqrt(2.)).epsilon(1e-6));
  CHECK(paths[1]["length"] == Approx(1).epsilon(1e-6));
  check_refused({"path", input, "--from", "vertex:0", "--to",
                 "vertices:" + folder.write("beyond.txt", "25\n").string()},
                3);
}

// What the tool says and does about distances that are cheap to see to be wrong.
namespace {

double chance(std::uint32_t& state) {
  state = state * 1664525u + 1013904223u;
  return static_cast<double>(state >> 8) / 16777216;
}

struct Spike {
  std::string off;
  std::vector<std::array<double, 3>> positions;
};

/// An 8 x 8 grid of jittered points with one far up.
Spike spike(double height, std::uint32_t seed) {
  Spike s;
  s.off = "OFF\n64 98 0\n";
  for (int v = 0; v < 64; ++v) {
    std::array<double, 3> p = {v % 8 + 0.7 * chance(seed), v / 8 + 0.7 * chance(seed),
                               0.7 * chance(seed)};
    if (v == 27) p[2] = height;
    for (double& x : p) x = std::round(x * 1e6) * 1e-6;
    s.positions.push_back(p);
    s.off += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 7; ++i) {
      const std::string a = std::to_string(j * 8 + i), b = std::to_string(j * 8 + i + 1);
      const std::string c = std::to_string(j * 8 + i + 9), d = std::to_string(j * 8 + i + 8);
      s.off += "3 " + a + " " + b + " " + c + "\n3 " + a + " " + c + " " + d + "\n";
    }
  return s;
}

}  // namespace

TEST_CASE("path and distance tell of each other, and counts of repairs are in the summary") {
  const Folder folder;
  const std::string file = folder.write("spike.off", spike(3, 9).off);
  const auto field = run_tool({"distance", file, "--source", "vertex:0", "--triangulation",
                               "delaunay", "--out", "-", "--quiet"});
  const auto summary =
      ran({"distance", file, "--source", "vertex:0", "--triangulation", "delaunay", "--json"});
  CHECK(summary.json()["lowered_vertices"].is_number_unsigned());
  CHECK(summary.json()["raised_vertices"].is_number_unsigned());
  const std::vector<double> d = csv_column(field.out, "distance");
  for (const char* to : {"63", "50", "7"}) {
    const auto run = ran({"path", file, "--from", "vertex:0", "--to", std::string("vertex:") + to,
                          "--triangulation", "delaunay", "--json"});
    const auto path = run.json()["paths"][0];
    CAPTURE(to);
    CHECK(run.json()["triangulation"] == "delaunay");
    CHECK(path["distance"].get<double>() == Approx(d[std::stoul(to)]).epsilon(1e-6));
    CHECK(path["length"].get<double>() == Approx(path["distance"].get<double>()).epsilon(0.05));
    CHECK_FALSE(path["capped"].get<bool>());
  }
  const auto refused = run_tool({"path", file, "--from", "vertex:0", "--to", "vertex:9", "--astar",
                                 "--triangulation", "delaunay"});
  CHECK(refused.code == 2);
}

}  // namespace path_test
