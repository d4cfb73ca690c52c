#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace tetrahedralize_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

// A cube of side 1, its 12 triangles; `shift` moves it along x.
std::string cube_off(double shift = 0, bool open = false) {
  std::string text = open ? "OFF\n8 11 0\n" : "OFF\n8 12 0\n";
  for (int i = 0; i < 8; ++i)
    text.append(std::to_string((i & 1) + shift))
        .append(" ")
        .append(std::to_string(i >> 1 & 1))
        .append(" ")
        .append(std::to_string(i >> 2))
        .append("\n");
  text +=
      "3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3\n3 0 4 6\n"
      "3 0 6 2\n3 1 3 7\n";
  return open ? text : text + "3 1 7 5\n";
}

}  // namespace

#ifdef PLEXWAY_HAS_TETGEN

TEST_CASE("tetrahedralize does not overwrite points that its input reads") {
  const Folder folder;
  folder.write("part.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
  const auto poly = folder.write(
      "part.poly", "0 3 0 0\n4 0\n1\n3 0 1 2\n1\n3 0 1 3\n1\n3 0 2 3\n1\n3 1 2 3\n0\n");
  check_refused({"tetrahedralize", poly.string(), "--out", (folder.path() / "part.ele").string()},
                2, "would overwrite");
}

TEST_CASE("tetrahedralize writes every format, the surface's vertices first") {
  const Folder folder;
  const auto surface = plexway::io::read_triangles(sample("elbow.off"));
  for (const char* name : {"s.node", "t.ele", "s.mesh", "s.msh", "s.vtu", "s.vtk", "S.MESH"}) {
    const std::string out = (folder.path() / name).string();
    const auto run = ran(
        {"tetrahedralize", sample("elbow.off"), "--out", out, "--json", "--max-volume", "0.01"});
    CHECK(run.err.empty());
    const auto json = run.json();
    CHECK(json["kind"] == "solid");
    CHECK(json["out"] == out);
    CHECK(json["volume"].get<double>() == Approx(3));
    CHECK(json["largest_volume"].get<double>() <= 0.01 * (1 + 1e-9));
    CHECK(json["seconds"]["mesh"].get<double>() > 0);
    const auto solid = plexway::io::read_tets(out);
    CHECK(json["vertices"] == solid.positions.size());
    CHECK(json["simplices"] == solid.tets.size());
    CHECK(solid.tets.size() >= 300);
    REQUIRE(solid.positions.size() > 12);
    CHECK(std::equal(surface.positions.begin(), surface.positions.end(), solid.positions.begin()));
  }
}

TEST_CASE("a surface is filled on the way to its distances") {
  const Folder folder;
  const std::string cube = folder.write("cube.off", cube_off());
  const std::string out = (folder.path() / "d.csv").string();
  const auto run = ran({"distance", cube, "--as", "solid", "-s", "vertex:0", "--max-volume", "0.01",
                        "--json", "-o", out});
  const auto json = run.json();
  CHECK(json["kind"] == "solid");
  CHECK(json["simplices"].get<int>() >= 100);
  CHECK(json["max_distance"].get<double>() == Approx(std::sqrt(3.0)).epsilon(1e-5));
  std::vector<std::string> phases;
  const auto ordered = nlohmann::ordered_json::parse(run.out);
  for (const auto& item : ordered["seconds"].items()) phases.push_back(item.key());
  CHECK(phases == std::vector<std::string>{"load", "mesh", "build", "solve"});
  const auto distance = csv_column(bytes_of(out), "distance");
  CHECK(distance.size() == json["vertices"].get<std::size_t>());
  CHECK(distance[7] == Approx(std::sqrt(3.0)).epsilon(1e-5));  // the corner across

  const auto bench = run_tool({"bench", cube, "--as", "solid", "-s", "vertex:0", "--json"});
  CHECK(bench.code == 0);
  CHECK(bench.json()["seconds"]["mesh"].get<double>() > 0);
  const auto info = run_tool({"info", cube, "--as", "solid", "--json"});
  CHECK(info.code == 0);
  CHECK(info.json()["volume"].get<double>() == Approx(1));
}

TEST_CASE("tetrahedralize keeps the surface, leaves holes and heeds quality") {
  const Folder folder;
  const std::string out = (folder.path() / "s.mesh").string();
  const auto counts = [&](std::vector<std::string> more) {
    return ran(joined({"tetrahedralize", sample("torus.obj"), "-o", out, "--json"}, more))
        .json()["vertices"]
        .get<int>();
  };
  CHECK(counts({"--quality", "0"}) < counts({}));
  CHECK(counts({}) < counts({"--quality", "1.3"}));
  counts({"--keep-surface"});
  const auto info = run_tool({"info", out, "--json"}).json();
  CHECK(info["boundary_faces"] == 2304);

  // Two cubes beside each other; a hole point empties one.
  const auto surface = folder.write("a.obj",
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0"
                                    "\nv 5 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 "
                                    "8\nf 6 7 8\nf 5 8 7\n");
  const auto one = ran(
      {"tetrahedralize", surface, "-o", out, "--json", "--hole", "5.1,0.1,0.1", "--quality", "0"});
  CHECK(one.json()["volume"].get<double>() == Approx(1.0 / 6));
  CHECK(one.json()["simplices"] == 1);
}

TEST_CASE("TetGen's own boundaries are filled too") {
  const Folder folder;
  const std::string poly = folder.write("tent.poly",
                                        "# four walls\n4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 "
                                        "0\n1\n3 1 2 3\n1\n3 1 2 4\n1\n3 2 3 "
                                        "4\n1\n3 1 3 4\n0\n");
  const std::string out = (folder.path() / "tent.vtk").string();
  const auto run = ran({"tetrahedralize", poly, "-o", out, "--json", "--quality", "0"});
  CHECK(run.json()["volume"].get<double>() == Approx(1.0 / 6));
  CHECK(run_tool({"distance", poly, "-s", "vertex:0", "--json"}).json()["kind"] == "solid");
  check_refused({"info", folder.write("bad.poly", "4 3\n1 0 0 zero\n")}, 3,
                "bad.poly:2: coordinate z of the point is not a number: 'zero'");
}

TEST_CASE("surfaces that cannot be filled are bad input with the reason") {
  const Folder folder;
  const std::string out = (folder.path() / "s.mesh").string();
  const std::string open = folder.write("open.off", cube_off(0, true));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"tetrahedralize", open, "-o", out},
        {"distance", open, "--as", "solid", "-s", "vertex:0"},
        {"info", open, "--as", "solid"}})
    check_refused(command, 3, open + ": cannot be filled: the surface is open: 3 edges");

  std::string two = "OFF\n16 24 0\n";
  std::string points, faces;
  for (const double shift : {0.0, 0.5}) {
    const std::string cube = cube_off(shift);
    const std::size_t first = cube.find('\n', 4) + 1;
    const std::size_t split = cube.find("3 0 2 3\n");
    points += cube.substr(first, split - first);
    const int offset = shift == 0.0 ? 0 : 8;
    for (std::size_t at = split; at < cube.size(); at = cube.find('\n', at) + 1) {
      faces += "3";
      for (std::size_t c = 2; c < 8; c += 2)
        faces.append(" ").append(std::to_string(cube[at + c] - '0' + offset));
      faces += "\n";
    }
  }
  const std::string crossing = folder.write("crossing.off", two + points + faces);
  check_refused({"tetrahedralize", crossing, "-o", out}, 3,
                crossing + ": cannot be filled: triangles ");
  check_refused({"tetrahedralize", sample("hills.off"), "-o", out}, 3, "is open: 144 edges");
  check_refused({"tetrahedralize", sample("elbow.mesh"), "-o", out}, 3, "is a solid already");
  check_refused({"tetrahedralize", sample("vessels.obj"), "-o", out}, 3,
                "is a wireframe, which cannot be taken as a solid");
  check_refused({"tetrahedralize", (folder.path() / "missing.off").string(), "-o", out}, 3,
                "no such file");
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("tetrahedralize has usage errors of its own") {
  const Folder folder;
  const std::string out = (folder.path() / "s.mesh").string();
  const std::string elbow = sample("elbow.off");
  check_refused({"tetrahedralize", elbow}, 2, "--help'");
  check_refused({"tetrahedralize", elbow, "-o", (folder.path() / "s.obj").string()}, 2,
                "unknown extension; those written are .node .ele .mesh .msh .vtu .vtk");
  check_refused({"tetrahedralize", elbow, "-o", out, "--max-volume", "-1"}, 2, "--max-volume");
  check_refused({"tetrahedralize", elbow, "-o", out, "--max-volume", "nan"}, 2, "--max-volume");
  check_refused({"tetrahedralize", elbow, "-o", out, "--quality", "0.5"}, 2, "--quality");
  check_refused({"tetrahedralize", elbow, "-o", out, "--max-seconds", "-1"}, 2, "--max-seconds");
  check_refused(
      {"tetrahedralize", elbow, "-o", out, "--max-seconds", "0.3", "--max-volume", "1e-8"}, 1,
      elbow + ": cannot be filled: TetGen was stopped at the time limit");
  check_refused({"tetrahedralize", elbow, "-o", out, "--hole", "1,2"}, 2, "--hole '1,2'");
  check_refused({"tetrahedralize", elbow, "-o", (folder.path() / "no" / "s.mesh").string()}, 1,
                "there is no folder");
  check_refused({"distance", elbow, "-s", "vertex:0", "--max-volume", "1"}, 2, "--as solid");
  check_refused({"distance", sample("elbow.mesh"), "-s", "vertex:0", "--keep-surface"}, 2,
                "need a surface to fill");
  CHECK(folder.files() == 0);
}

TEST_CASE("tetrahedralize is quiet when told, and shows progress on a terminal") {
  const Folder folder;
  const std::string out = (folder.path() / "s.mesh").string();
  const std::vector<std::string> command = {"tetrahedralize", sample("elbow.off"), "-o", out};
  auto quiet = command;
  quiet.emplace_back("--quiet");
  const auto silent = run_tool_on_terminal(quiet);
  CHECK(silent.code == 0);
  CHECK(silent.out.empty());
  CHECK(silent.err.empty());
  const auto shown = run_tool_on_terminal(command);
  CHECK(shown.err.find("filling") != std::string::npos);
  CHECK(run_tool(command).err.empty());
}

#else

TEST_CASE("without TetGen filling a surface is not built in, and the package is named") {
  const Folder folder;
  const std::string out = (folder.path() / "s.mesh").string();
  check_refused({"tetrahedralize", sample("elbow.off"), "-o", out}, 4, "libtet1.5-dev");
  check_refused({"distance", sample("elbow.off"), "--as", "solid", "-s", "vertex:0"}, 4,
                "--as solid: filling a surface needs TetGen");
  const std::string poly = folder.write("a.poly", cube_off());
  check_refused({"info", poly}, 4, "libtet1.5-dev");
}

#endif

}  // namespace tetrahedralize_test
