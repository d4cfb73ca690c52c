#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <plexway/io/edges.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace wireframe_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

std::vector<double> distances(const std::vector<std::string>& more) {
  std::vector<std::string> command = {"distance"};
  command.insert(command.end(), more.begin(), more.end());
  for (const char* word : {"--precision", "double", "--quiet", "--out", "-"})
    command.emplace_back(word);
  const auto run = run_tool(command);
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  return csv_column(run.out, "distance");
}

}  // namespace

TEST_CASE("distances in a tree of vessels add up along the branches") {
  const auto tree = plexway::io::read_edges(sample("vessels.obj"));
  // The file has each edge after those on the way to it.
  std::vector<double> exact(tree.vertices, 0);
  for (const auto& [from, to] : tree.edges) {
    const auto& a = tree.positions[from];
    const auto& b = tree.positions[to];
    exact[to] = exact[from] + std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }
  const auto distance = distances({sample("vessels.obj"), "-s", "vertex:0"});
  REQUIRE(distance.size() == exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v) CHECK(distance[v] == Approx(exact[v]));
}

TEST_CASE("a list of edges needs no positions") {
  const Folder folder;
  const std::string file = folder.write("net.edges", "0 1 1\n1 2 2.5\n2 0 9\n3 4 1\n");
  const auto distance = distances({file, "-s", "vertex:0"});
  CHECK(distance[1] == Approx(1));
  CHECK(distance[2] == Approx(3.5));
  CHECK(std::isinf(distance[3]));

  const auto run = run_tool({"distance", file, "-s", "vertex:0", "--json"});
  REQUIRE(run.code == 0);
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
  const auto vtu =
      run_tool({"distance", file, "-s", "vertex:0", "-o", (folder.path() / "d.vtu").string()});
  CHECK(vtu.code == 2);
  CHECK(vtu.complaints() == 1);
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

  const auto solid = run_tool({"info", sample("elbow.mesh"), "--as", "wireframe", "--json"});
  REQUIRE(solid.code == 0);
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
  const auto run = run_tool({"info", sample("vessels.obj"), "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
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

TEST_CASE("a wireframe's distances go to every format") {
  const Folder folder;
  for (const char* name : {"d.csv", "d.npy", "d.vtu", "d.vtk", "d.ply"}) {
    const std::string out = (folder.path() / name).string();
    const auto run = run_tool({"distance", sample("vessels.obj"), "-s", "vertex:0", "-o", out});
    INFO(name << run.err);
    CHECK(run.code == 0);
    CHECK(std::filesystem::file_size(out) > 763 * 8);
  }
}

TEST_CASE("bench measures wireframes, and both sides agree with the truth") {
  const Folder folder;
  std::string edges, truth = "0\n";
  for (int v = 0; v < 50; ++v) {
    edges += std::to_string(v) + " " + std::to_string(v + 1) + " 0.5\n";
    truth += std::to_string(0.5 * (v + 1)) + "\n";
  }
  const auto run =
      run_tool({"bench", folder.write("path.edges", edges), "-s", "vertex:0", "--truth",
                folder.write("truth.txt", truth), "--repeats", "3", "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.json()["compared"] == 50);
  CHECK(run.json()["max"].get<double>() < 1e-6);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(run.json()["ratio"].get<double>() > 0);
#endif
  const auto point = run_tool({"bench", sample("vessels.obj"), "-s", "point:0,0,0.4", "--json"});
  CHECK(point.code == 0);
}

TEST_CASE("bad wireframes are refused with file, line and cause") {
  const Folder folder;
  struct Bad {
    const char* name;
    const char* bytes;
    const char* start;
  };
  for (const Bad& bad :
       {Bad{"a.edges", "0 1 1\n1 x 1\n", ":2: "}, Bad{"b.edges", "0 1 nan\n", ":1: "},
        Bad{"c.edges", "0 1 -1\n", ":1: "}, Bad{"d.edges", "# nothing\n", ": "},
        Bad{"e.obj", "v 0 0 0\nv 1 0 0\nl 1 3\n", ":3: "},
        Bad{"f.obj", "v 0 0 0\nv 1 nan 0\nl 1 2\n", ":2: "}}) {
    const std::string file = folder.write(bad.name, bad.bytes);
    const auto run = run_tool({"distance", file, "-s", "vertex:0"});
    INFO(run.err);
    CHECK(run.code == 3);
    CHECK(run.out.empty());
    CHECK(run.complaints() == 1);
    CHECK(run.err.rfind("plexway: error: " + file, 0) == 0);
    const bool whole_file = std::string(bad.start) == ": ";
    if (!whole_file) CHECK(run.err.find(file + bad.start) != std::string::npos);
  }
}

}  // namespace wireframe_test
