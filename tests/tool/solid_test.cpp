#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace solid_test {

using namespace cli_testing;
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
  const auto run = run_tool(
      {"distance", file, "--source", source, "--precision", "double", "--quiet", "--out", "-"});
  INFO(source << ": " << run.err);
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  return csv_column(run.out, "distance");
}

std::size_t vertex_at(const plexway::io::Tets& solid, const Point& p) {
  const auto found = std::find(solid.positions.begin(), solid.positions.end(), p);
  REQUIRE(found != solid.positions.end());
  return static_cast<std::size_t>(found - solid.positions.begin());
}

}  // namespace

TEST_CASE("distances through a solid bend at its inner edge") {
  const auto solid = plexway::io::read_tets(sample("elbow.mesh"));
  const std::size_t from = vertex_at(solid, {2, 0.5, 0});
  const auto distance = distances(sample("elbow.mesh"), "vertex:" + std::to_string(from));
  REQUIRE(distance.size() == solid.positions.size());
  CHECK(distance[from] == 0);
  double sum = 0;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    if (v == from) continue;
    const double exact = in_elbow(solid.positions[from], solid.positions[v]);
    sum += std::abs(distance[v] - exact) / exact;
    CHECK(distance[v] == Approx(exact).epsilon(0.03));
  }
  CHECK(sum / static_cast<double>(distance.size()) < 0.004);
}

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

TEST_CASE("a solid's distances go to every format, with labels for several sources") {
  const Folder folder;
  for (const char* name : {"d.csv", "d.npy", "d.vtu", "d.vtk", "d.ply"}) {
    const std::string out = (folder.path() / name).string();
    const auto run = run_tool({"distance", sample("elbow.mesh"), "-s", "vertex:0", "-s",
                               "point:2,1,1", "--json", "-o", out});
    INFO(name << run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["kind"] == "solid");
    CHECK(run.json()["vertices"] == 325);
    CHECK(run.json()["simplices"] == 1152);
    CHECK(run.json()["components"] == 1);
    CHECK(run.json()["reached"] == 325);
    CHECK_FALSE(run.json()["seconds"].contains("mesh"));
    CHECK(std::filesystem::file_size(out) > 325 * 8);
  }
  const auto label = csv_column(bytes_of(folder.path() / "d.csv"), "label");
  CHECK(label.front() == 0);
  CHECK(std::count(label.begin(), label.end(), 1) > 50);
  const auto again = plexway::io::read_tets(folder.path() / "d.vtk");
  CHECK(again.tets.size() == 1152);
}

TEST_CASE("info tells what a solid is made of") {
  const auto run = run_tool({"info", sample("elbow.mesh"), "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
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
  const auto run = run_tool({"info", file, "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
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

TEST_CASE("bench measures solids") {
  const auto solid = plexway::io::read_tets(sample("elbow.mesh"));
  const Folder folder;
  std::ostringstream truth;
  for (const Point& p : solid.positions) truth << in_elbow(solid.positions[0], p) << '\n';
  const auto run = run_tool({"bench", sample("elbow.mesh"), "-s", "vertex:0", "--truth",
                             folder.write("truth.txt", truth.str()), "--repeats", "3", "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["kind"] == "solid");
  CHECK(json["compared"] == 324);
  CHECK(json["mean"].get<double>() < 1e-4);  // all is in sight of the corner
  CHECK(json["ns_per_vertex"].get<double>() > 0);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(json["dijkstra_ns_per_vertex"].get<double>() > 0);
#endif
}

TEST_CASE("bad solids are refused with file and cause") {
  const Folder folder;
  const auto refused = [&](const std::string& file, int code, const std::string& start) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"distance", file, "-s", "vertex:0"}, {"info", file}}) {
      const auto run = run_tool(command);
      INFO(run.err);
      CHECK(run.code == code);
      CHECK(run.out.empty());
      CHECK(run.complaints() == 1);
      CHECK(run.err.rfind("plexway: error: " + start, 0) == 0);
    }
  };
  const std::string lonely = folder.write("lonely.ele", "0 4 0\n");
  refused(lonely, 3, lonely + ": ");
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n";
  const std::string nan = folder.write("nan.mesh", head + "0 nan 0 0\n0 0 1 0\n");
  refused(nan, 3, nan + ":7: ");
  const std::string index =
      folder.write("index.mesh", head + "0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 9 0\nEnd\n");
  refused(index, 3, index + ":11: ");
  const std::string thrice =
      folder.write("thrice.mesh",
                   "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                   "0 0 1 0\n0 0 2 0\n0 0 -1 0\nTetrahedra\n3\n1 2 3 4 0\n1 2 3 5 0\n1 2 3 6 0\n");
  refused(thrice, 3, thrice + ": ");

  const auto as_surface = run_tool({"info", sample("elbow.mesh"), "--as", "surface"});
  CHECK(as_surface.code == 3);
  CHECK(as_surface.err.find("is a solid, which cannot be taken as a surface") != std::string::npos);
  const auto far = run_tool({"distance", sample("elbow.mesh"), "-s", "vertex:325"});
  CHECK(far.code == 3);
  CHECK(far.err.find("0 to 324") != std::string::npos);
}

}  // namespace solid_test
