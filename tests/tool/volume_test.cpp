// convert, --repair and .vdb.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "data/shapes.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace volume_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

#ifdef PLEXWAY_HAS_OPENVDB
/// Two spheres that cross, and lack a cap each.
std::string broken(const Folder& folder) {
  const samples::Shape sphere = samples::geodesic_sphere(8);
  plexway::io::Triangles surface;
  for (const double x : {0.0, 1.0}) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (const auto& [px, py, pz] : sphere.points) surface.positions.push_back({px + x, py, pz});
    for (const auto& [a, b, c] : sphere.faces)
      if (sphere.points[a][2] < 0.95)
        surface.triangles.push_back({a + first, b + first, c + first});
  }
  const auto file = folder.path() / "broken.obj";
  plexway::io::write_triangles(file, surface);
  return file.string();
}
#endif

}  // namespace

TEST_CASE("convert: surfaces, solids, wireframes and clouds into other formats") {
  const Folder folder;
  const auto out = [&](const char* name) { return (folder.path() / name).string(); };
  for (const char* name :
       {"a.obj", "a.off", "a.ply", "a.stl", "a.vtu", "a.vtk", "a.glb", "a.gltf"}) {
    const auto run = run_tool({"convert", sample("knot.ply"), out(name), "--json"});
    INFO(name << run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["kind"] == "surface");
    CHECK(std::filesystem::file_size(out(name)) > 1000);
  }
  const auto knot = plexway::io::read_triangles(sample("knot.ply"));
  CHECK(plexway::io::read_triangles(out("a.obj")).positions == knot.positions);
  CHECK(plexway::io::read_triangles(out("a.ply")).triangles == knot.triangles);

  auto run = run_tool({"convert", sample("elbow.mesh"), out("b.msh"), "--quiet"});
  REQUIRE(run.code == 0);
  CHECK(run.out.empty());
  CHECK(plexway::io::read_tets(out("b.msh")).tets ==
        plexway::io::read_tets(sample("elbow.mesh")).tets);
  run = run_tool({"convert", sample("elbow.mesh"), out("b.stl")});
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("the solid's surface"));
  // The L of three unit cubes: by the divergence theorem.
  double six = 0;
  const auto skin = plexway::io::read_triangles(out("b.stl"));
  for (const auto& [a, b, c] : skin.triangles)
    six += samples::dot(samples::cross(skin.positions[a], skin.positions[b]), skin.positions[c]);
  CHECK(six / 6 == Approx(3).epsilon(1e-6));

  CHECK(run_tool({"convert", sample("vessels.obj"), out("v.edges"), "-q"}).code == 0);
  CHECK(run_tool({"convert", sample("vessels.obj"), out("v.vtu"), "-q"}).code == 0);
  CHECK(run_tool({"convert", sample("roll.xyz"), out("r.ply"), "-q"}).code == 0);
  CHECK(run_tool({"convert", sample("knot.ply"), out("k.xyz"), "-q"}).code == 0);

  CHECK(run_tool({"convert", sample("knot.ply"), out("a.nonsense")}).code == 2);
  CHECK(run_tool({"convert", sample("vessels.obj"), out("v.stl")}).code == 2);
  CHECK(run_tool({"convert", sample("roll.xyz"), out("r.stl")}).code == 2);
  CHECK(run_tool({"convert", sample("knot.ply")}).code == 2);
  CHECK(run_tool({"convert", sample("knot.ply"), out("a.obj"), "--grid", "x"}).code == 2);
  CHECK(run_tool({"convert", sample("elbow.mesh"), out("c.vtu"), "--repair"}).code == 2);
  CHECK(run_tool({"convert", sample("knot.ply"), out("a.obj"), "--repair", "--voxel", "-1"}).code ==
        2);
  const auto help = run_tool({"convert", "--help"});
  CHECK_THAT(help.out, Contains("Examples:") && Contains("--repair"));
}

TEST_CASE("NumPy reads the matrix of pairs") {
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import numpy' >/dev/null 2>&1").c_str()) != 0) return;
  const Folder folder;
  for (const char* name : {"m.npy", "m.csv"})
    REQUIRE(run_tool({"pairs", sample("knot.ply"), "-s", "vertex:0", "-s", "vertex:9", "-s",
                      "vertex:99", "-q", "-o", (folder.path() / name).string()})
                .code == 0);
  const std::string peer = python + " -B '" PLEXWAY_SOURCE_DIR "/tests/io/gltf_peer.py' matrix '";
  const std::string both =
      (folder.path() / "m.npy").string() + "' '" + (folder.path() / "m.csv").string() + "'";
  CHECK(std::system((peer + both).c_str()) == 0);
}

#ifdef PLEXWAY_HAS_OPENVDB
TEST_CASE("a level set goes out, comes in and is solved in, and its field is a volume") {
  const Folder folder;
  const auto out = [&](const char* name) { return (folder.path() / name).string(); };
  auto run = run_tool({"convert", sample("elbow.off"), out("e.vdb"), "--voxel", "0.05", "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.json()["voxels"] == "voxel 0.05");
  run = run_tool({"distance", out("e.vdb"), "-s", "point:2,0.5,0.5", "--json", "-o", out("d.csv")});
  REQUIRE(run.code == 0);
  CHECK(run.json()["kind"] == "solid");
  CHECK_THAT(run.json()["voxels"].get<std::string>(), Contains("level set 'surface', voxel 0.05"));
  // Round the inner edge at 1, 1 to the other end of the L: sqrt(1.25) twice, by about a voxel.
  const auto solved = csv_column(bytes_of(out("d.csv")), "distance");
  const auto x = csv_column(bytes_of(out("d.csv")), "x");
  const auto y = csv_column(bytes_of(out("d.csv")), "y");
  const auto z = csv_column(bytes_of(out("d.csv")), "z");
  std::size_t seen = 0;
  for (std::size_t v = 0; v < solved.size(); ++v) {
    if (std::hypot(x[v] - 0.5, y[v] - 1.98, z[v] - 0.5) > 0.06) continue;
    ++seen;
    CHECK(solved[v] == Approx(2 * std::sqrt(1.25)).margin(0.12));
  }
  CHECK(seen > 0);

  run = run_tool({"distance", out("e.vdb"), "-s", "point:2,0.5,0.5", "-s", "point:0.5,2,0.5", "-q",
                  "-o", out("field.vdb"), "--voxel", "0.1"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(bytes_of(out("field.vdb")).substr(1, 3) == "BDV");
  run = run_tool({"convert", out("e.vdb"), out("e.obj"), "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["kind"] == "surface");
  run = run_tool({"tetrahedralize", out("e.vdb"), "-o", out("e.mesh"), "--json", "--voxel", "0.1"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["volume"].get<double>() == Approx(3).epsilon(0.03));

  run = run_tool({"convert", out("e.vdb"), out("e.stl"), "--grid", "nothing"});
  CHECK(run.code == 3);
  CHECK_THAT(run.err, Contains("no grid 'nothing'"));
  run = run_tool({"distance", sample("knot.ply"), "-s", "vertex:0", "-o", out("k.vdb")});
  CHECK(run.code == 2);
  std::filesystem::resize_file(out("e.vdb"), std::filesystem::file_size(out("e.vdb")) / 2);
  run = run_tool({"info", out("e.vdb")});
  CHECK(run.code == 3);
  CHECK_THAT(run.err, Contains("e.vdb: "));
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

TEST_CASE("a broken surface is refused as a solid, and repaired when asked") {
  const Folder folder;
  const auto out = [&](const char* name) { return (folder.path() / name).string(); };
  const std::string file = broken(folder);
  CHECK(run_tool({"distance", file, "--as", "solid", "-s", "vertex:0"}).code == 3);
  auto run = run_tool({"distance", file, "--as", "solid", "--repair", "-s", "vertex:0", "--json",
                       "-o", out("d.vtu")});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.json()["voxels"].get<std::string>(), Contains("2 holes closed"));
  CHECK(run.json()["components"] == 1);
  run = run_tool(
      {"tetrahedralize", file, "--repair", "--voxel", "0.08", "-o", out("t.vtu"), "--json"});
  REQUIRE(run.code == 0);
  // Two unit balls 1 apart less the lens: 4.1888 * 2 - 1.3090.
  CHECK(run.json()["volume"].get<double>() == Approx(7.0686).epsilon(0.04));
  run = run_tool({"convert", file, out("clean.ply"), "--repair"});
  REQUIRE(run.code == 0);
#ifdef PLEXWAY_HAS_TETGEN
  run = run_tool({"tetrahedralize", out("clean.ply"), "-o", out("u.vtu"), "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["volume"].get<double>() == Approx(7.0686).epsilon(0.04));
  run = run_tool(
      {"tetrahedralize", file, "--repair", "--max-volume", "0.01", "-o", out("w.vtu"), "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["largest_volume"].get<double>() <= 0.01);
#endif
  run = run_tool({"convert", sample("hills.off"), out("h.ply"), "--repair"});
  CHECK(run.code == 3);
  CHECK_THAT(run.err, Contains("cannot be repaired") && Contains("encloses nothing"));
}
#endif

}  // namespace volume_test
