// Files as other programs write them: what is cut, left out, passed over and guessed is told.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "folder.hpp"
#include "tool/tool.hpp"

namespace files_test {

using namespace cli_testing;
using Catch::Contains;
using testing::Folder;

namespace {

// Distances from vertex 0, and what the summary says as JSON.
struct Solved {
  nlohmann::json json;
  std::vector<double> distance;
};

Solved solved(const std::string& file, const std::string& vertex = "vertex:0") {
  const auto run =
      run_tool({"distance", file, "--source", vertex, "--json", "--precision", "double"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const auto csv =
      run_tool({"distance", file, "-s", vertex, "-q", "-o", "-", "--precision", "double"});
  return {run.json(), csv_column(csv.out, "distance")};
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a face with a corner twice is left out and counted, and numbers stay") {
  const Folder folder;
  const std::string file = folder.write("a.obj", square + "f 1 2 3\nf 2 2 3\nf 1 3 4\n");
  const Solved found = solved(file);
  CHECK(found.json["dropped_simplices"] == 1);
  CHECK(found.json["simplices"] == 3);
  CHECK(found.distance[2] == Approx(std::sqrt(2)));
  CHECK_THAT(found.json["notes"].dump(),
             Contains("1 triangle (1) has a corner twice and is left out"));
  // A point on the edge that it has too, and one inside of the last.
  const auto path = run_tool({"path", file, "--from", "point:1,0.5,0", "--to", "simplex:2", "-q"});
  CHECK(solved(file, "point:1,0.5,0").distance[3] == Approx(std::hypot(1, .5)));
  const auto info = run_tool({"info", file, "--json"});
  CHECK(info.json()["dropped_simplices"] == 1);
  const auto strict = run_tool({"distance", file, "-s", "vertex:0", "--strict"});
  CHECK(strict.code == 3);
  CHECK_THAT(strict.err, Contains("has a corner twice and is left out, which --strict refuses"));
  const std::string none = folder.write("none.obj", square + "f 2 2 3\nf 1 1 1\n");
  const auto refused = run_tool({"distance", none, "-s", "vertex:0"});
  CHECK(refused.code == 3);
  CHECK_THAT(refused.err, Contains("all 2 triangles have a corner twice"));
  // What is written is what is open, and what is prepared as well.
  const std::string out = (folder.path() / "d.vtu").string(),
                    kept = (folder.path() / "a.plexway").string();
  CHECK(run_tool({"distance", file, "-s", "vertex:0", "-q", "-o", out}).code == 0);
  CHECK(run_tool({"info", out, "--json"}).json()["simplices"] == 2);
  CHECK(run_tool({"prepare", file, "-q", "-o", kept}).code == 0);
  CHECK(run_tool({"distance", kept, "-s", "vertex:0", "--json"}).json()["simplices"] == 2);
}

TEST_CASE("solids, simplices and mixed domains leave such cells out as well") {
  const Folder folder;
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n"
      "0 1 0 0\n0 0 1 0\n2 2 2 0\nTetrahedra 3\n1 2 3 4 0\n1 1 2 3 0\n"
      "2 3 4 5 0\nTriangles 2\n1 2 2 0\n1 2 3 0\nEnd\n";
  const std::string file = folder.write("a.mesh", medit);
  const Solved solid = solved(file);
  CHECK(solid.json["dropped_simplices"] == 1);
  CHECK(solid.json["passed_over"]["triangles"] == 2);
  CHECK(solid.distance[4] == Approx(std::sqrt(12)));
  const auto mixed = run_tool({"distance", file, "--as", "mixed", "-s", "vertex:0", "--json"});
  CHECK(mixed.code == 0);
  CHECK(mixed.json()["dropped_simplices"] == 2);
  CHECK(mixed.json()["max_distance"] == Approx(std::sqrt(12)).epsilon(1e-6));
  const std::string simplices = folder.write(
      "a.simplices",
      "dimension 2\nvertices 4 2\n0 0\n1 0\n1 1\n0 1\nsimplices 3\n0 1 2\n1 1 2\n0 2 3\n");
  CHECK(solved(simplices).json["dropped_simplices"] == 1);
}

TEST_CASE("polygons are cut with their notches, and counted") {
  const Folder folder;
  const std::string ell = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
  for (const char* face : {"f 1 2 3 4 5 6\n", "f 3 4 5 6 1 2\n", "f 6 5 4 3 2 1\n"}) {
    const std::string file = folder.write("ell.obj", ell + face);
    const Solved found = solved(file, "vertex:2");
    CHECK(found.json["split_polygons"] == 1);
    CHECK(found.distance[5] == Approx(1 + std::sqrt(2)));
    CHECK_THAT(run_tool({"info", file}).out,
               Contains("split") && Contains("1 polygon into triangles"));
  }
  const std::string closed = folder.write("closed.obj", square + "f 1 2 3 4 1\n");
  CHECK(solved(closed).json["simplices"] == 2);
  CHECK(solved(closed).json["dropped_simplices"] == 0);
}

TEST_CASE("a source in no triangle is named, with the nearest vertex that is in one") {
  const Folder folder;
  const std::string file = folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  const auto run = run_tool({"distance", file, "-s", "vertex:0", "--json"});
  CHECK(run.code == 5);
  CHECK_THAT(run.err, Contains("nothing reached: vertex 0 is in none of the triangles") &&
                          Contains("the nearest that is in one is vertex"));
}

TEST_CASE("what a file holds decides: wires, points, surfaces in files of solids") {
  const Folder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\n";
  const std::string wires = folder.write("w.ply", head +
                                                      "element edge 2\nproperty int vertex1\n"
                                                      "property int vertex2\nend_header\n"
                                                      "0 0 0\n3 0 0\n3 4 0\n0 1\n1 2\n");
  CHECK(solved(wires).json["kind"] == "wireframe");
  CHECK(solved(wires).distance[2] == Approx(7));
  const std::string strips = folder.write("s.ply", head +
                                                       "element tristrips 1\nproperty list int "
                                                       "int vertex_indices\nend_header\n"
                                                       "0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n");
  CHECK(solved(strips).json["kind"] == "surface");
  const std::string plane =
      folder.write("p.mesh",
                   "MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\n"
                   "Triangles\n1\n1 2 3 0\nEnd\n");
  CHECK(solved(plane).json["kind"] == "surface");
  CHECK(run_tool({"distance", plane, "--as", "surface", "-s", "vertex:0", "-q"}).code == 0);
  const std::string cloud =
      folder.write("c.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\n");
  const auto points = run_tool({"info", cloud, "--json"});
  if (points.code != 4) CHECK(points.json()["kind"] == "cloud");
  const std::string coloured = folder.write(
      "c.xyz", "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 9 9 9\n.5 .5 0 1 2 3\n");
  const auto noted = run_tool({"distance", coloured, "-s", "vertex:0"});
  if (noted.code != 4) CHECK_THAT(noted.err, Contains("note: columns 4 to 6 are colours"));
  if (noted.code != 4)
    CHECK(run_tool({"distance", coloured, "-s", "vertex:0", "--strict"}).code == 3);
  const std::string edges = folder.write("none.edges", "vertices 3\n");
  const auto empty = run_tool({"distance", edges, "-s", "vertex:1", "--json"});
  CHECK(empty.code == 5);
  CHECK(empty.json()["unreached"] == 2);
}

TEST_CASE("help lists every extension that is read") {
  const std::string help = run_tool({"distance", "--help"}).out;
  for (const char* extension : {".obj",  ".off", ".ply", ".stl",  ".gii", ".white",     ".node",
                                ".mesh", ".msh", ".vtu", ".vtk",  ".glb", ".edges",     ".xyz",
                                ".csv",  ".las", ".pcd", ".poly", ".vdb", ".simplices", ".plexway"})
    CHECK_THAT(help, Contains(extension));
}

}  // namespace files_test
