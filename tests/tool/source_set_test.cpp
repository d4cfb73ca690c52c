#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>

#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace source_set_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

// Distances on a square of n x n vertices, row by row, against a closed form.
double largest_error(const std::vector<double>& found, int n,
                     const std::function<double(double, double)>& rule) {
  REQUIRE(found.size() == static_cast<std::size_t>(n * n));
  double worst = 0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    const double x = static_cast<double>(v % static_cast<std::size_t>(n)) / (n - 1);
    const double y = static_cast<double>(v / static_cast<std::size_t>(n)) / (n - 1);
    worst = std::max(worst, std::abs(found[v] - rule(x, y)));
  }
  return worst;
}

}  // namespace

TEST_CASE("the tool starts fields from lines, triangles, circles and sets") {
  const Folder folder;
  const int n = 21;
  const std::string square = folder.write("square.off", square_off(n)).string();
  const std::string line =
      folder.write("line.txt", "0.2 0.5 0\n0.5 0.5 0 # on\n0.8,0.5,0\n").string();
  const std::string some = folder.write("some.txt", "# corners\n0\n20 0.25\n").string();
  const auto to_line = [](double x, double y) {
    return std::hypot(std::max({0.2 - x, x - 0.8, 0.0}), y - 0.5);
  };
  // The half of the first cell below its diagonal.
  const auto to_triangle = [h = 1.0 / (n - 1)](double x, double y) {
    if (x + y <= h * (1 + 1e-9)) return 0.0;
    const double along = std::clamp((x - y + h) / 2, 0.0, h);  // on the diagonal, its x
    return std::hypot(x - along, y - (h - along));
  };
  struct {
    std::string source;
    std::function<double(double, double)> rule;
    double bound;
  } const cases[] = {
      {"segment:0.2,0.5,0,0.8,0.5,0", to_line, 1e-12},
      {"segment:0.2,0.5,0,0.8,0.5,0+1.5", [&](double x, double y) { return to_line(x, y) + 1.5; },
       1e-12},
      {"polyline:" + line, to_line, 1e-12},
      {"boundary",
       [](double x, double y) {
         return std::min({x, y, 1 - x, 1 - y});
       },
       1e-12},
      // Its own corners are 0; single corners near the strip's border have the way from its end.
      {"triangle:0", [&](double x, double y) { return to_triangle(x, y); }, 1e-2},
      // The others in single precision.
      {"circle:0.5,0.5,0,0.25",
       [](double x, double y) { return std::abs(std::hypot(x - 0.5, y - 0.5) - 0.25); }, 1e-6},
      {"vertices:" + some,
       [](double x, double y) { return std::min(std::hypot(x, y), std::hypot(x - 1, y) + 0.25); },
       2e-6},
      {"vertex:0+1e-1", [](double x, double y) { return std::hypot(x, y) + 0.1; }, 2.5e-6},
  };
  for (const auto& [source, rule, bound] : cases) {
    const std::string precision = bound < 1e-9 ? "double" : "float";
    INFO(source);
    CHECK(largest_error(distances({square, "--source", source, "--precision", precision}), n,
                        rule) < bound);
  }
  const auto precision = [&](const std::string& source, const std::string& accuracy) {
    return run_tool({"distance", square, "--source", source, "--accuracy", accuracy, "--json"})
        .json()["precision"];
  };
  CHECK(precision("boundary", "accurate") == "float");
  CHECK(precision("boundary", "fast") == "double");
  CHECK(precision("boundary", "exact") == "double");
  CHECK(precision("vertex:0", "fast") == "float");
  const auto both = ran({"distance", square, "--source", "boundary+0.3", "--source", "vertex:220",
                         "--out", "-", "--executor", "auto", "--quiet"});
  const auto label = csv_column(both.out, "label");
  CHECK(label[220] == 1);
  CHECK(label[0] == 0);
}

TEST_CASE("the boundary of a solid and of a wireframe, and one of its edges") {
  const auto from = [](const std::string& mesh, const std::string& source) {
    return distances({mesh, "-s", source});
  };
  // The L of [0, 2]^2 less [1, 2]^2, from z = 0 to 1: its six walls.
  const std::string elbow = sample("elbow.mesh");
  const auto solid = from(elbow, "boundary");
  const auto places = plexway::io::read_tets(elbow).positions;
  REQUIRE(solid.size() == places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    const auto& [x, y, z] = places[v];
    CHECK((solid[v] == 0) == (x == 0 || x == 2 || y == 0 || y == 2 || z == 0 || z == 1 ||
                              (x == 1 && y >= 1) || (y == 1 && x >= 1)));
    // The faces, not their vertices: exact.
    const double far_x = std::hypot(x - 1, std::max(1 - y, 0.)),
                 far_y = std::hypot(y - 1, std::max(1 - x, 0.));
    const double exact = std::min({x, y, z, 1 - z, 2 - x, 2 - y, far_x, far_y});
    CHECK(solid[v] == Approx(exact).margin(1e-6));
  }
  const Folder folder;
  const std::string wires = folder.write("y.edges", "0 1 1\n1 2 2\n1 3 4\n");
  CHECK(from(wires, "boundary") == std::vector<double>{0, 1, 0, 0});
  CHECK(from(wires, "simplex:1+0.5") == std::vector<double>{1.5, 0.5, 0.5, 4.5});
}

TEST_CASE("a byte order mark before numbers, points or a grid is passed over") {
  const Folder folder;
  const std::string mark = "\xEF\xBB\xBF";
  const std::string points =
      folder.write("points.csv", mark + "x,y,z\r\n0,0,0\r\n3,0,0\r\n0,4,0\r\n");
  const std::string grid =
      folder.write("grid.vtk", mark +
                                   "# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET POLYDATA\n"
                                   "POINTS 3 float\n0 0 0 3 0 0 0 4 0\nPOLYGONS 1 4\n3 0 1 2\n");
  const std::string sources = folder.write("sources.txt", mark + "1\r\n");
  for (const std::string& file : {points, grid}) {
    const auto distance = distances({file, "-s", "vertices:" + sources});
    REQUIRE(distance.size() == 3);
    CHECK(distance[0] == Approx(3));
    CHECK(distance[1] == 0);
    CHECK(distance[2] == Approx(5));
  }
  const std::string twice = folder.write("twice.txt", "+-1\n");
  CHECK_THAT(run_tool({"distance", grid, "-s", "vertices:" + twice}).err,
             Catch::Contains("not a number: '+-1'"));
}

TEST_CASE("sources that are none or not there are told by name") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(5)).string();
  const std::string bad = folder.write("bad.txt", "0\nx\n").string();
  const std::string far = folder.write("far.txt", "1234567\n").string();
  const std::string below = folder.write("below.txt", "0 1\n1 -1\n").string();
  const struct {
    std::vector<std::string> arguments;
    int code;
    const char* why;
  } cases[] = {
      {{square, "--source", "segment:1,2"}, 2, "segment:X,Y,Z,X,Y,Z"},
      {{square, "--source", "circle:0,0,0,-1"}, 2, "radius"},
      {{square, "--source", "line:1"}, 2, "write vertex:ID"},
      {{square, "--source", "triangle:32"}, 3, "triangles are 0 to 31"},
      {{square, "--source", "vertices:" + bad}, 3, "bad.txt:2: not a number"},
      {{square, "--source", "vertex:0+-1"}, 2, "+OFFSET"},
      {{square, "--source", "vertices:" + far}, 3, "far.txt:1: vertex 1234567 is out of range"},
      {{square, "--source", "vertices:" + below}, 3, "below.txt:2: an offset below 0"},
      {{square, "--source", "polyline:" + far}, 3, "far.txt:1: write a point"},
      {{square, "--source", "boundary", "--executor", "openmp", "--accuracy", "fast"}, 2, "Serial"},
      {{square, "--source", "boundary", "--precision", "float", "--accuracy", "fast"}, 2, "double"},
      {{sample("knot.ply"), "--source", "boundary"}, 3, "has none"},
      {{sample("elbow.mesh"), "--source", "triangle:0"}, 2, "surfaces and wireframes"},
      {{sample("two_parts.obj"), "--source", "segment:-9,0,0,9,0,0"}, 3, "there is no path"},
  };
  for (const auto& [arguments, code, why] : cases) {
    check_refused(joined({"distance"}, arguments), code, why);
  }
}

TEST_CASE("isolines of a field go into files") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(11)).string();
  const std::string out = (folder.path() / "lines.obj").string();
  const auto run = ran({"distance", square, "--source", "segment:0,0,0,0,1,0", "--isoline-step",
                        "0.3", "--isolines-out", out, "--quiet"});
  const auto lines = plexway::io::read_edges(out);
  double length = 0;
  for (const auto& [a, b] : lines.edges)
    length += std::hypot(lines.positions[a][0] - lines.positions[b][0],
                         lines.positions[a][1] - lines.positions[b][1]);
  CHECK(length == Approx(3).epsilon(1e-6));  // at 0.3, 0.6 and 0.9, each 1 long
  CHECK(run_tool({"distance", square, "-s", "vertex:0", "--isoline-step", "1"}).code == 2);
  CHECK(run_tool(
            {"distance", square, "-s", "vertex:0", "--isoline-step", "-1", "--isolines-out", out})
            .code == 2);
  // What is wrong with the lines is told before anything is written; no line at all is told of.
  const std::string field = folder.at("field.ply");
  const auto fine = run_tool({"distance", square, "-s", "vertex:0", "--isoline-step", "1e-6",
                              "--isolines-out", out, "--out", field});
  CHECK(fine.code == 2);
  CHECK(!std::filesystem::exists(field));
  const auto coarse = run_tool(
      {"distance", square, "-s", "vertex:0", "--isoline-step", "9", "--isolines-out", out});
  CHECK(coarse.code == 0);
  CHECK(coarse.out.find("written  " + out) != std::string::npos);
  CHECK(coarse.err.find("no distance is as large as the step") != std::string::npos);
  // On clouds over their sheet.
  ran({"distance", sample("roll.xyz"), "-s", "vertex:0", "--isoline-step", "1", "--isolines-out",
       out, "--quiet"});
  CHECK(plexway::io::read_edges(out).edges.size() > 100);
}

TEST_CASE("isosurfaces of a solid go into files") {
  const Folder folder;
  const std::string elbow = sample("elbow.mesh");
  const std::string out = (folder.path() / "shells.ply").string();
  const auto run = ran({"distance", elbow, "-s", "vertex:0", "--isoline-step", "0.4",
                        "--isolines-out", out, "--quiet"});
  const auto shells = plexway::io::read_triangles(out);
  REQUIRE(!shells.triangles.empty());
  // The first of them is a piece of a sphere.
  const auto source = plexway::io::read_tets(elbow).positions[0];
  double nearest = 1e9;
  for (const auto& p : shells.positions)
    nearest = std::min(nearest, std::hypot(p[0] - source[0], p[1] - source[1], p[2] - source[2]));
  CHECK(nearest > 0.37);  // linear between corners, so a chord
  CHECK(nearest < 0.4);
  check_refused({"distance", elbow, "-s", "vertex:0", "--isoline-step", "9", "--isolines-out",
                 folder.at("none.glb")},
                2, "no distance is as large as the step");
  const std::string lines = (folder.path() / "lines.json").string();
  const auto refused = run_tool(
      {"distance", elbow, "-s", "vertex:0", "--isoline-step", "0.4", "--isolines-out", lines});
  CHECK(refused.code == 2);
  CHECK(refused.complaints() == 1);
}

}  // namespace source_set_test
