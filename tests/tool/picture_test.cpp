#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

#ifdef PLEXWAY_HAS_RENDER
#include <plexway/render/picture.hpp>
#endif

namespace picture_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {}  // namespace

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

}  // namespace picture_test
