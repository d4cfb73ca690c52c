// Solids, wireframes, mixed domains and simplices of any dimension from files, through the tool.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace kinds_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

using Point = std::array<double, 3>;

double between(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// The distance inside the elbow: around the edge x = y = 1 where the straight line leaves the L.
double in_elbow(const Point& a, const Point& b) {
  const double side_a = a[0] - 1, up_a = a[1] - 1, side_b = b[0] - 1, up_b = b[1] - 1;
  const bool opposite = (side_a > 0 && up_b > 0) || (up_a > 0 && side_b > 0);
  const double turn = side_a * up_b - up_a * side_b;
  const bool cut = opposite && (side_a > 0 ? turn > 0 : turn < 0);
  if (!cut) return between(a, b);
  return std::hypot(std::hypot(side_a, up_a) + std::hypot(side_b, up_b), a[2] - b[2]);
}

std::vector<double> distances(const std::string& file, const std::string& source) {
  return cli_testing::distances({file, "--source", source, "--precision", "double"});
}

}  // namespace

TEST_CASE("a point source is in the solid, or on its boundary where the point is outside") {
  const auto solid = plexway::io::read_tets(sample("elbow.mesh"));
  struct Case {
    const char* point;
    Point at;
  };
  // All of the L is in sight of these.
  for (const Case& one :
       {Case{"point:0.5,0.52,0.47", {0.5, 0.52, 0.47}},
        Case{"point:0.25,0.5,0.75", {0.25, 0.5, 0.75}}, Case{"point:-1,0.3,0.6", {0, 0.3, 0.6}},
        Case{"point:0.3,0.4,17", {0.3, 0.4, 1}}, Case{"point:-2,-3,0.3", {0, 0, 0.3}},
        Case{"point:-2,-3,-4", {0, 0, 0}}, Case{"point:1.2,1.2,0.3", {1, 1.2, 0.3}}}) {
    const auto distance = distances(sample("elbow.mesh"), one.point);
    for (std::size_t v = 0; v < distance.size(); ++v) {
      const double exact = in_elbow(one.at, solid.positions[v]);
      CHECK(distance[v] == Approx(exact).epsilon(one.at[1] > 1 ? 0.03 : 1e-9).margin(1e-12));
    }
  }
  const auto told = run_tool({"distance", sample("elbow.mesh"), "-s", "point:0.5,0.52,0.47"});
  CHECK(told.out.find("(tetrahedron ") != std::string::npos);
  CHECK(told.out.find(", 0 away)") != std::string::npos);
}

TEST_CASE("info tells what a solid is made of") {
  const auto run = ran({"info", sample("elbow.mesh"), "--json"});
  const auto info = run.json();
  CHECK(info["kind"] == "solid");
  CHECK(info["vertices"] == 9 * 9 * 5 - 4 * 4 * 5);
  CHECK(info["simplices"] == 3 * 4 * 4 * 4 * 6);
  CHECK(info["faces"] == (4 * 1152 + 448) / 2);
  CHECK(info["boundary_faces"] == 2 * (2 * 48 + 4 * 2 * 16));
  CHECK(info["edges"] == 325 + 2528 - 1152 - 1);  // Euler
  CHECK(info["reflex_edges"] == 4);
  CHECK(info["components"] == 1);
  CHECK(info["inverted_simplices"] == 0);
  CHECK(info["volume"].get<double>() == Approx(3));
  CHECK(info["edge_length"]["max"].get<double>() == Approx(0.25 * std::sqrt(3.0)));
  CHECK(info["bounding_box"]["max"] == nlohmann::json{2.0, 2.0, 1.0});
  CHECK(info["warnings"].empty());
  CHECK(info["component_sizes"] == nlohmann::json::array({325}));
}

TEST_CASE("info warns of what may surprise in a solid") {
  const Folder folder;
  // Two tetrahedra apart, one of them turned over; a third without volume; a lone vertex.
  const std::string file = folder.write(
      "parts.mesh",
      "MeshVersionFormatted 2\nDimension 3\nVertices\n10\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "5 0 0 0\n6 0 0 0\n5 1 0 0\n5 0 1 0\n7 0 0 0\n9 9 9 0\n"
      "Tetrahedra\n3\n1 2 3 4 0\n5 7 6 8 0\n6 7 8 9 0\nEnd\n");
  const auto run = ran({"info", file, "--json"});
  const auto info = run.json();
  CHECK(info["components"] == 2);
  CHECK(info["unreferenced_vertices"] == 1);
  CHECK(info["inverted_simplices"] == 1);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(info["component_sizes"] == nlohmann::json::array({5, 4}));
#endif
  const std::string warnings = info["warnings"].dump();
  CHECK(warnings.find("2 components") != std::string::npos);
  CHECK(warnings.find("1 unreferenced vertex") != std::string::npos);
  CHECK(warnings.find("1 inverted tetrahedron") != std::string::npos);

  const auto distance = run_tool({"distance", file, "-s", "vertex:0", "--json"});
  CHECK(distance.code == 0);
  CHECK(distance.json()["reached"] == 4);
  CHECK(distance.err.find("the solid has 2 components") != std::string::npos);
  CHECK(run_tool({"distance", file, "-s", "vertex:9"}).code == 5);
}

TEST_CASE("bad solids are refused with file and cause") {
  const Folder folder;
  const auto refused = [&](const std::string& file, const std::string& start) {
    check_refused({"distance", file, "-s", "vertex:0"}, 3, "plexway: error: " + start);
    check_refused({"info", file}, 3, "plexway: error: " + start);
  };
  const std::string lonely = folder.write("lonely.ele", "0 4 0\n");
  refused(lonely, lonely + ": ");
  const std::string thrice =
      folder.write("thrice.mesh",
                   "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                   "0 0 1 0\n0 0 2 0\n0 0 -1 0\nTetrahedra\n3\n1 2 3 4 0\n1 2 3 5 0\n1 2 3 6 0\n");
  refused(thrice, thrice + ": ");

  check_refused({"info", sample("elbow.mesh"), "--as", "surface"}, 3,
                "is a solid, which cannot be taken as a surface");
  check_refused({"distance", sample("elbow.mesh"), "-s", "vertex:325"}, 3, "0 to 324");
}

namespace {

std::vector<double> distances(const Words& more) {
  return cli_testing::distances(joined(more, {"--precision", "double"}));
}

}  // namespace

TEST_CASE("a list of edges needs no positions") {
  const Folder folder;
  const std::string file = folder.write("net.edges", "0 1 1\n1 2 2.5\n2 0 9\n3 4 1\n");
  const auto distance = distances({file, "-s", "vertex:0"});
  CHECK(distance[1] == Approx(1));
  CHECK(distance[2] == Approx(3.5));
  CHECK(std::isinf(distance[3]));

  const auto run = ran({"distance", file, "-s", "vertex:0", "--json"});
  CHECK(run.json()["kind"] == "wireframe");
  CHECK(run.json()["simplices"] == 4);
  CHECK(run.json()["components"] == 2);
  CHECK(run.json()["unreached"] == 2);
  CHECK(run.err.find("the wireframe has 2 components") != std::string::npos);

  const auto point = run_tool({"distance", file, "-s", "point:0,0,0"});
  CHECK(point.code == 3);
  CHECK(point.complaints() == 1);
  CHECK(point.err.find(file + ": source point:0,0,0: the vertices have no positions") !=
        std::string::npos);
  check_refused({"distance", file, "-s", "vertex:0", "-o", (folder.path() / "d.vtu").string()}, 2);
}

TEST_CASE("a point source is the closest point of the edges") {
  const Folder folder;
  const std::string file = folder.write("bent.obj", "v 0 0 0\nv 4 0 0\nv 4 3 0\nl 1 2 3\n");
  CHECK(distances({file, "-s", "point:1,-2,5"}) == std::vector<double>{1, 3, 6});
  CHECK(distances({file, "-s", "point:9,1,0"}) == std::vector<double>{5, 1, 2});
  CHECK(distances({file, "-s", "point:9,-9,0"}) == std::vector<double>{4, 0, 3});
  const auto told = run_tool({"distance", file, "-s", "point:1,-2,0"});
  CHECK(told.out.find("(edge 0, 2 away)") != std::string::npos);
}

TEST_CASE("a surface and a solid can be taken as wireframes") {
  const Folder folder;
  const int n = 7;
  const std::string square = folder.write("square.off", square_off(n));
  const auto distance = distances({square, "--as", "wireframe", "-s", "vertex:0"});
  // The diagonals run across the way from this corner: along edges it is the city block's distance.
  for (int v = 0; v < n * n; ++v)
    CHECK(distance[static_cast<std::size_t>(v)] == Approx((v % n + v / n) / (n - 1.0)));

  const auto solid = ran({"info", sample("elbow.mesh"), "--as", "wireframe", "--json"});
  CHECK(solid.json()["kind"] == "wireframe");
  CHECK(solid.json()["edges"] == 1700);
}

TEST_CASE("an OBJ with faces is a surface, and its lines count when asked for") {
  const Folder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string both = folder.write("both.obj", vertices + "f 1 2 3\nl 1 4\nl 4 3\n");
  CHECK(run_tool({"info", both, "--json"}).json()["kind"] == "surface");
  const auto lines = run_tool({"info", both, "--as", "wireframe", "--json"});
  CHECK(lines.json()["edges"] == 2);
  const std::string faces = folder.write("faces.obj", vertices + "f 1 2 3\n");
  CHECK(run_tool({"info", faces, "--as", "wireframe", "--json"}).json()["edges"] == 3);
  const std::string only = folder.write("only.obj", vertices + "l 1 2 3 4\n");
  CHECK(run_tool({"info", only, "--json"}).json()["kind"] == "wireframe");
  for (const char* kind : {"surface", "solid"}) {
    const auto run = run_tool({"info", only, "--as", kind});
    CHECK(run.code == 3);
    CHECK(run.complaints() == 1);
  }
}

TEST_CASE("info tells what a wireframe is made of") {
  const auto run = ran({"info", sample("vessels.obj"), "--json"});
  const auto info = run.json();
  CHECK(info["kind"] == "wireframe");
  CHECK(info["vertices"] == 763);
  CHECK(info["edges"] == 762);
  CHECK(info["components"] == 1);
  CHECK(info["ends"] == 65);  // the root, and 2^6 tips
  CHECK(info["branches"] == 63);
  CHECK(info["warnings"].empty());

  const Folder folder;
  const std::string odd = folder.write("odd.edges", "vertices 8\n0 1 1\n1 2 0\n3 3 1\n4 5 2\n");
  const auto warned = run_tool({"info", odd, "--json"}).json();
  CHECK(warned["bounding_box"].is_null());
  CHECK(warned["loops"] == 1);
  CHECK(warned["degenerate_simplices"] == 1);
  CHECK(warned["unreferenced_vertices"] == 2);
  CHECK(warned["length"].get<double>() == Approx(4));
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(warned["component_sizes"] == nlohmann::json::array({3, 2, 1}));
#endif
  CHECK(run_tool({"info", odd}).out.find("lengths only") != std::string::npos);
}

// Mixed domains and simplices of any dimension from files, through the tool.

namespace {

// Two triangles that make the unit square in the plane z = 0, and from its corner (1, 1) a line of
// length 4 upwards; vertex 6 is in no cell.
const std::string flag =
    "# vtk DataFile Version 3.0\nflag\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 1 2\n1 1 4\n9 9 9\n"
    "CELLS 3 12\n3 0 1 2\n3 0 2 3\n3 2 4 5\nCELL_TYPES 3\n5 5 4\n";

// An OFF file of the square [x, x + 1] x [0, 1] in the plane z = 0, n x n vertices.
std::string square_at(double x, int n) {
  std::string text =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string(2 * (n - 1) * (n - 1)) + " 0\n";
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      text += std::to_string(x + double(j) / (n - 1)) + " " + std::to_string(double(i) / (n - 1)) +
              " 0\n";
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      text += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
              std::to_string(a + n + 1) + "\n3 " + std::to_string(a) + " " +
              std::to_string(a + n + 1) + " " + std::to_string(a + n) + "\n";
    }
  return text;
}

}  // namespace

TEST_CASE("cells of several dimensions in one file are a mixed domain") {
  const Folder folder;
  const std::string file = folder.write("flag.vtk", flag);
  const auto distance = distances({file, "--as", "mixed", "-s", "vertex:5"});
  REQUIRE(distance.size() == 7);
  CHECK(distance[5] == 0);
  CHECK(distance[4] == Approx(2));
  CHECK(distance[2] == Approx(4));
  CHECK(distance[1] == Approx(5));
  CHECK(distance[3] == Approx(5));
  CHECK(distance[0] == Approx(4 + std::sqrt(2)));
  CHECK(std::isinf(distance[6]));
  // From a point of the line, and from a point of a triangle.
  CHECK(distance == distances({file, "--as", "mixed", "-s", "vertex:5", "--executor", "openmp",
                               "--threads", "2"}));
  CHECK(distances({file, "--as", "mixed", "-s", "point:1,1,3"})[0] == Approx(3 + std::sqrt(2)));
  CHECK(distances({file, "--as", "mixed", "-s", "point:0.5,0.25,0"})[5] ==
        Approx(4 + std::hypot(0.5, 0.75)));

  const auto run = ran({"distance", file, "--as", "mixed", "-s", "vertex:5", "--json"});
  CHECK(run.json()["kind"] == "mixed");
  CHECK(run.json()["simplices"] == 4);
  CHECK(run.json()["components"] == 1);
  CHECK(run.json()["unreached"] == 1);
  CHECK_THAT(run.err, Contains("the mixed domain has 1 component"));
  const std::string out = folder.write("out.vtu", "");
  CHECK(run_tool({"distance", file, "--as", "mixed", "-s", "vertex:5", "-o", out}).code == 0);
  CHECK_THAT(io_testing::bytes_of(out), Contains("NumberOfPoints=\"7\""));

  const auto info = ran({"info", file, "--as", "mixed", "--json"});
  CHECK(info.json()["edges"] == 2);
  CHECK(info.json()["triangles"] == 2);
  CHECK(info.json()["tetrahedra"] == 0);
  CHECK(info.json()["pieces"] == 2);
  CHECK(info.json()["hinges"][0] == 1);
  CHECK(run_tool({"bench", file, "--as", "mixed", "-s", "vertex:5", "--repeats", "2"}).code == 0);
}

TEST_CASE("speeds by the regions of the file, and lines of equal distance on a mixed domain") {
  const Folder folder;
  const std::string file =
      folder.write("flag.vtk", flag + "CELL_DATA 3\nFIELD f 1\nregion 1 3 int\n7 7 3\n");
  const auto by = [&](const std::string& name, const std::string& text) {
    return std::string(name) + ":" + folder.write(name + ".txt", text).string();
  };
  // The line twice as fast as the square.
  const auto distance = distances(
      {file, "--as", "mixed", "-s", "vertex:5", "--metric", by("regions", "3 2\n7 1\n9 5\n")});
  CHECK(distance[2] == Approx(2));
  CHECK(distance[1] == Approx(3));
  CHECK(distance[0] == Approx(2 + std::sqrt(2)));
  CHECK(distance == distances({file, "--as", "mixed", "-s", "vertex:5", "--metric",
                               by("speed", "2\n2\n1\n1\n")}));
  const auto fails = [&](const std::string& text, int code, const std::string& why) {
    check_refused(
        {"distance", file, "--as", "mixed", "-s", "vertex:5", "--metric", by("regions", text)},
        code, why);
  };
  fails("3 2\n", 3, "no speed for region 7");
  fails("3 2\n7 0\n", 3, "above 0");
  fails("3 2\n3 1\n", 3, "already");
  const auto none = run_tool({"distance", folder.write("square.off", square_at(0, 4)), "-s",
                              "vertex:0", "--metric", by("regions", "1 1\n")});
  CHECK(none.code == 3);
  CHECK_THAT(none.err, Contains("square.off"));  // a format that has no regions

  // From the corner of a square about as far as a circle, and each point in a triangle there.
  const std::string left = folder.write("left.off", square_at(0, 21));
  const std::string right = folder.write("right.off", square_at(1, 21));
  const std::string lines = folder.write("lines.json", "");
  CHECK(run_tool({"distance", left, right, "--weld", "1e-6", "-s", "vertex:0", "--isoline-step",
                  "0.8", "--isolines-out", lines, "--quiet"})
            .code == 0);
  const auto json = nlohmann::json::parse(io_testing::bytes_of(lines));
  double length = 0;
  for (const auto& line : json["paths"]) {
    if (line["source"] != 0) continue;
    length += line["length"].get<double>();
    for (std::size_t i = 0; i < line["points"].size(); ++i) {
      const auto& at = line["positions"][i];
      CHECK(std::hypot(at[0].get<double>(), at[1].get<double>()) == Approx(0.8).epsilon(3e-3));
      CHECK(line["points"][i]["simplex"].get<int>() < 2 * 800);
    }
  }
  CHECK(length == Approx(0.8 * std::acos(0.)).epsilon(3e-3));
}

TEST_CASE("several files are welded to a mixed domain") {
  const Folder folder;
  const std::string left = folder.write("left.off", square_at(0, 6));
  const std::string right = folder.write("right.off", square_at(1 + 1e-4, 6));
  const auto distance = distances({left, right, "--weld", "1e-3", "-s", "vertex:0"});
  REQUIRE(distance.size() == 72);
  // Two squares side by side: straight, but for the gap.
  double worst = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto at = static_cast<std::size_t>(36 + 6 * i + j);
      const double exact = std::hypot(1 + j / 5., i / 5.);
      worst = std::max(worst, std::abs(distance[at] / exact - 1));
    }
  CHECK(worst < 3e-4);
  // Not near enough to be one.
  CHECK(std::isinf(distances({left, right, "--weld", "1e-5", "-s", "vertex:0"})[40]));

  const auto fails = [&](std::vector<std::string> words, int code, const std::string& why) {
    words.insert(words.begin(), "distance");
    words.insert(words.end(), {"-s", "vertex:0"});
    check_refused(words, code, why);
  };
  fails({left, right}, 2, "--weld TOLERANCE");
  fails({left, "--weld", "1"}, 2, "--weld needs several files");
  fails({left, right, "--weld", "-1"}, 2, "--weld must be a number >= 0");
  fails({left, right, "--weld", "0", "--as", "solid"}, 2, "--as");
  fails({left, right, "--weld", "0.3"}, 2, "which lie apart");
  fails({left, sample("roll.xyz"), "--weld", "0"}, 3, "roll.xyz");
  fails({left, right, "--weld", "0", "--executor", "gl"}, 2, "the executor GL takes");
  const std::string third = folder.write("third.vtk", flag);
  fails({left, third, "--weld", "0", "-o", third}, 2, "overwrite");
  fails({left, "--as", "mixed"}, 3, "cannot be taken as a mixed domain");
}

TEST_CASE("simplices of four dimensions come from a file") {
  const Folder folder;
  // The corner simplex of the unit cube of space-time, and one with lengths alone.
  const std::string file = folder.write(
      "corner.simplices",
      "dimension 4\nvertices 5 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\nsimplices 1\n"
      "0 1 2 3 4\n");
  const auto distance = distances({file, "-s", "vertex:1"});
  CHECK(distance[1] == 0);
  CHECK(distance[0] == Approx(1));
  for (const std::size_t v : {2, 3, 4}) CHECK(distance[v] == Approx(std::sqrt(2)));
  const std::string path = folder.write(
      "path.simplices", "dimension 1\nvertices 4\nsimplices 3\n0 1 2\n1 2 0.5\n2 3 1\n");
  CHECK(distances({path, "-s", "vertex:0"}) == std::vector<double>{0, 2, 2.5, 3.5});
  const auto info = ran({"info", file, "--json"});
  CHECK(info.json()["kind"] == "simplices");
  CHECK(info.json()["dimension"] == 4);
  CHECK(info.json()["flat"] == true);
  for (const std::string& one : {file, path}) {
    const auto bench = ran({"bench", one, "-s", "vertex:0", "--repeats", "2", "--json"});
    CHECK(bench.json()["kind"] == "simplices");
  }
  CHECK_THAT(run_tool({"distance", file, "-s", "vertex:1"}).out,
             Contains("1 simplex, 1 component"));
  check_refused({"convert", file, folder.write("x.obj", "")}, 2, "are converted");
  check_refused({"distance", file, "-s", "point:0,0,0"}, 3, "no positions");
  check_refused({"path", file, "--from", "vertex:0", "--to", "vertex:1"}, 2, "paths are traced on");
}

}  // namespace kinds_test
