#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <plexway/io/edges.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

#ifdef PLEXWAY_HAS_RENDER
#include <plexway/render/picture.hpp>
#endif

namespace path_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

TEST_CASE("paths across a square, as numbers and as files") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(9)).string();
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  for (const char* name : {"p.obj", "p.ply", "p.vtp", "p.csv", "p.json"}) {
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

#ifdef PLEXWAY_HAS_RENDER

TEST_CASE("every command with --picture draws") {
#ifdef PLEXWAY_SANITIZED
  return;  // drivers keep memory
#endif
  const Folder folder;
  const auto file = (folder.path() / "a.png").string();
  const std::vector<std::vector<std::string>> commands = {
      {"distance", sample("torus.obj"), "--source", "vertex:0"},
      {"distance", sample("torus.obj"), "--source", "vertex:0", "--source", "vertex:500",
       "--colour", "cells"},
      {"distance", sample("two_parts.obj"), "--source", "vertex:0", "--map", "magma"},
      {"distance", sample("elbow.mesh"), "--source", "vertex:0", "--clip", "z"},
      {"distance", sample("elbow.mesh"), "--source", "vertex:0", "--isosurfaces", "0.5,1,1.5"},
      {"distance", sample("vessels.obj"), "--source", "vertex:0", "--view", "-30,10"},
#ifdef PLEXWAY_HAS_FLANN
      {"distance", sample("roll.xyz"), "--source", "vertex:0", "--range", "0,5"},
#endif
      {"path", sample("torus.obj"), "--from", "vertex:0", "--to", "vertex:300"},
      {"path", sample("torus.obj"), "--from", "vertex:0", "--to", "vertex:300", "--astar"},
      {"path", sample("elbow.mesh"), "--from", "vertex:0", "--to", "vertex:300"},
      {"poisson", sample("torus.obj"), "--count", "50"},
      {"cvt", sample("torus.obj"), "--count", "20", "--iterations", "3"},
      {"cvt", sample("elbow.mesh"), "--count", "8", "--iterations", "3", "--clip", "z"},
      {"farthest", sample("torus.obj"), "--count", "10", "--transparent"}};
  for (const auto& command : commands) {
    std::filesystem::remove(file);
    const auto run = run_tool(joined(command, {"--picture", file, "--size", "160x120", "--quiet"}));
    if (run.code == 4) return;  // no driver here
    INFO(command[0] << ' ' << command[1] << ": " << run.err);
    REQUIRE(run.code == 0);
    const auto image = plexway::render::read_png(file);
    CHECK(image.width == 160);
    CHECK(image.height == 120);
    std::size_t drawn = 0;
    for (const auto& p : image.pixels) drawn += p[3] > 0 && p[0] + p[1] + p[2] < 700;
    CHECK(drawn > 300);
  }
}

TEST_CASE("a path in an .svg goes under once, where something is in front of it") {
#ifdef PLEXWAY_SANITIZED
  return;  // drivers keep memory
#endif
  // Along the inner rim of a knotted tube: behind the rim by less than the line is wide, it shows.
  const Folder folder;
  const auto file = (folder.path() / "a.svg").string();
  const auto run =
      run_tool({"path", sample("knot.ply"), "--from", "vertex:0", "--to", "vertex:2500", "--quiet",
                "--out", (folder.path() / "p.obj").string(), "--picture", file});
  if (run.code == 4) return;  // no driver here
  REQUIRE(run.code == 0);
  const std::string svg = io_testing::bytes_of(file);
  std::size_t at = svg.find("<g id=\"paths\"");
  REQUIRE(at != svg.npos);
  std::vector<long> pieces;  // of each line of the group: the hidden parts, the rim, the open parts
  for (const std::size_t end = svg.find("</g>", at); (at = svg.find("<path d=\"", at)) < end;) {
    const std::size_t begin = at + 9;
    at = svg.find('"', begin);
    pieces.push_back(std::count(svg.begin() + static_cast<long>(begin),
                                svg.begin() + static_cast<long>(at), 'M'));
  }
  // Open at the target, hidden, open around the hole, hidden up to the source.
  CHECK(pieces == std::vector<long>{2, 2, 2});
}

TEST_CASE("what a picture cannot be is said before any work") {
  const Folder folder;
  const auto file = (folder.path() / "a.png").string();
  const std::vector<std::string> base = {"distance", sample("torus.obj"), "--source", "vertex:0"};
  const std::vector<std::vector<std::string>> wrong = {
      {"--view", "top"},
      {"--picture", (folder.path() / "a.jpg").string()},
      {"--picture", (folder.path() / "no" / "a.png").string()},
      {"--picture", file, "--view", "above"},
      {"--picture", file, "--view", "10"},
      {"--picture", file, "--view", "10,95"},
      {"--picture", file, "--size", "800"},
      {"--picture", file, "--size", "0x600"},
      {"--picture", file, "--size", "800x600x3"},
      {"--picture", file, "--size", "99999x600"},
      {"--picture", file, "--range", "2,1"},
      {"--picture", file, "--range", "1"},
      {"--picture", file, "--map", "jet"},
      {"--picture", file, "--clip", "w"},
      {"--picture", file, "--clip", "0,0,0,1"},
      {"--picture", file, "--isosurfaces", "1,,2"},
      {"--picture", file, "--up", "w"},
      {"--picture", file, "--colour", "labels"},
      {"--picture", file, "--isolines", "-3"}};
  for (const auto& more : wrong) {
    const auto run = run_tool(joined(base, more));
    INFO(more[0] << ' ' << more.back() << ": " << run.err);
    CHECK((run.code == 2 || (run.code == 1 && more[1].find("/no/") != std::string::npos)));
    CHECK(run.complaints() == 1);
  }
  CHECK(folder.files() == 0);
  // A wireframe of lengths alone is nowhere.
  const auto lengths = folder.write("a.edges", "0 1 2.5\n1 2 1\n");
  const auto nowhere = run_tool(
      {"distance", lengths.string(), "--source", "vertex:0", "--quiet", "--picture", file});
  CHECK(nowhere.code == 2);
  CHECK(nowhere.err.find("positions") != std::string::npos);
}

TEST_CASE("without EGL a picture is exit code 4, and it says what to install") {
  const Folder folder;
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
  const auto run = run_tool({"distance", sample("torus.obj"), "--source", "vertex:0", "--quiet",
                             "--picture", (folder.path() / "a.png").string()});
  ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  if (run.code == 0) return;  // not the dispatcher that knows this variable
  CHECK(run.code == 4);
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("install") != std::string::npos);
  CHECK(folder.files() == 0);
}

#else

TEST_CASE("a build without pictures says so") {
  check_refused({"distance", sample("torus.obj"), "--source", "vertex:0", "--picture", "a.png"}, 4,
                "libpng-dev");
}

#endif

}  // namespace path_test
