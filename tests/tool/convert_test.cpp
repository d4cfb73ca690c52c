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

namespace convert_test {

using namespace cli_testing;
using Catch::Contains;
using Catch::Matchers::Contains;
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
    const auto run = ran({"convert", sample("knot.ply"), out(name), "--json"});
    CHECK(run.json()["kind"] == "surface");
    CHECK(std::filesystem::file_size(out(name)) > 1000);
  }
  const auto knot = plexway::io::read_triangles(sample("knot.ply"));
  CHECK(plexway::io::read_triangles(out("a.obj")).positions == knot.positions);
  CHECK(plexway::io::read_triangles(out("a.ply")).triangles == knot.triangles);

  auto run = ran({"convert", sample("elbow.mesh"), out("b.msh"), "--quiet"});
  CHECK(run.out.empty());
  CHECK(plexway::io::read_tets(out("b.msh")).tets ==
        plexway::io::read_tets(sample("elbow.mesh")).tets);
  run = ran({"convert", sample("elbow.mesh"), out("b.stl")});
  CHECK_THAT(run.out, Contains("the solid's surface"));
  // The L of three unit cubes: by the divergence theorem.
  double six = 0;
  const auto skin = plexway::io::read_triangles(out("b.stl"));
  for (const auto& [a, b, c] : skin.triangles)
    six += samples::dot(samples::cross(skin.positions[a], skin.positions[b]), skin.positions[c]);
  CHECK(six / 6 == Approx(3).epsilon(1e-6));

  ran({"convert", sample("vessels.obj"), out("v.edges"), "-q"});
  ran({"convert", sample("vessels.obj"), out("v.vtu"), "-q"});
  ran({"convert", sample("roll.xyz"), out("r.ply"), "-q"});
  ran({"convert", sample("knot.ply"), out("k.xyz"), "-q"});

  check_refused({"convert", sample("knot.ply"), out("a.nonsense")}, 2);
  check_refused({"convert", sample("vessels.obj"), out("v.stl")}, 2);
  check_refused({"convert", sample("roll.xyz"), out("r.stl")}, 2);
  check_refused({"convert", sample("knot.ply")}, 2);
  check_refused({"convert", sample("knot.ply"), out("a.obj"), "--grid", "x"}, 2);
  check_refused({"convert", sample("elbow.mesh"), out("c.vtu"), "--repair"}, 2);
  check_refused({"convert", sample("knot.ply"), out("a.obj"), "--repair", "--voxel", "-1"}, 2);
  const auto help = run_tool({"convert", "--help"});
  CHECK_THAT(help.out, Contains("Examples:") && Contains("--repair"));
}

TEST_CASE("NumPy reads the matrix of pairs") {
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import numpy' >/dev/null 2>&1").c_str()) != 0) return;
  const Folder folder;
  for (const char* name : {"m.npy", "m.csv"})
    ran({"pairs", sample("knot.ply"), "-s", "vertex:0", "-s", "vertex:9", "-s", "vertex:99", "-q",
         "-o", (folder.path() / name).string()});
  const std::string peer = python + " -B '" PLEXWAY_SOURCE_DIR "/tests/io/gltf_peer.py' matrix '";
  const std::string both =
      (folder.path() / "m.npy").string() + "' '" + (folder.path() / "m.csv").string() + "'";
  CHECK(std::system((peer + both).c_str()) == 0);
}

#ifdef PLEXWAY_HAS_OPENVDB
TEST_CASE("a level set goes out, comes in and is solved in, and its field is a volume") {
  const Folder folder;
  const auto out = [&](const char* name) { return (folder.path() / name).string(); };
  auto run = ran({"convert", sample("elbow.off"), out("e.vdb"), "--voxel", "0.05", "--json"});
  CHECK(run.json()["voxels"] == "voxel 0.05");
  run = ran({"distance", out("e.vdb"), "-s", "point:2,0.5,0.5", "--json", "-o", out("d.csv")});
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

  run = ran({"distance", out("e.vdb"), "-s", "point:2,0.5,0.5", "-s", "point:0.5,2,0.5", "-q", "-o",
             out("field.vdb"), "--voxel", "0.1"});
  CHECK(bytes_of(out("field.vdb")).substr(1, 3) == "BDV");
  run = ran({"convert", out("e.vdb"), out("e.obj"), "--json"});
  CHECK(run.json()["kind"] == "surface");
  run = ran({"tetrahedralize", out("e.vdb"), "-o", out("e.mesh"), "--json", "--voxel", "0.1"});
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
  auto run = ran({"distance", file, "--as", "solid", "--repair", "-s", "vertex:0", "--json", "-o",
                  out("d.vtu")});
  CHECK_THAT(run.json()["voxels"].get<std::string>(), Contains("2 holes closed"));
  CHECK(run.json()["components"] == 1);
  run = ran({"tetrahedralize", file, "--repair", "--voxel", "0.08", "-o", out("t.vtu"), "--json"});
  // Two unit balls 1 apart less the lens: 4.1888 * 2 - 1.3090.
  CHECK(run.json()["volume"].get<double>() == Approx(7.0686).epsilon(0.04));
  run = ran({"convert", file, out("clean.ply"), "--repair"});
#ifdef PLEXWAY_HAS_TETGEN
  run = ran({"tetrahedralize", out("clean.ply"), "-o", out("u.vtu"), "--json"});
  CHECK(run.json()["volume"].get<double>() == Approx(7.0686).epsilon(0.04));
  run = ran(
      {"tetrahedralize", file, "--repair", "--max-volume", "0.01", "-o", out("w.vtu"), "--json"});
  CHECK(run.json()["largest_volume"].get<double>() <= 0.01);
#endif
  run = run_tool({"convert", sample("hills.off"), out("h.ply"), "--repair"});
  CHECK(run.code == 3);
  CHECK_THAT(run.err, Contains("cannot be repaired") && Contains("encloses nothing"));
}
#endif

// Prepared files are an input like any other: same answers, and one line for what is wrong.

namespace {

const std::string data = std::string(PLEXWAY_SOURCE_DIR) + "/data/";

}  // namespace

TEST_CASE("commands answer from a prepared file as from its input") {
  const testing::Folder folder;
  for (const std::string name : {"knot.ply", "elbow.mesh", "vessels.obj"}) {
    CAPTURE(name);
    const std::string input = data + name, prepared = folder.at("one.plexway").string();
    const auto made = ran({"prepare", input, "--out", prepared});
    CHECK_THAT(made.out, Contains("written") && Contains("bytes"));
    const auto field = [&](const std::string& of) {
      const auto run = run_tool({"distance", of, "--source", "vertex:7", "--out", "-", "--quiet"});
      CHECK(run.code == 0);
      return run.out;
    };
    CHECK(!field(input).empty());
    CHECK(field(prepared) == field(input));
    const auto rows = [&](const std::string& of) {
      const auto out = folder.at(of == input ? "rows.npy" : "other.npy").string();
      CHECK(run_tool({"pairs", of, "--sources", "all", "--out", out, "--quiet"}).code == 0);
      return bytes_of(out);
    };
    if (name != "knot.ply") CHECK(rows(prepared) == rows(input));
    const auto path = [&](const std::string& of) {
      const auto out = folder.at(of == input ? "path.json" : "other.json").string();
      CHECK(
          run_tool({"path", of, "--from", "vertex:0", "--to", "vertex:9", "--out", out, "--quiet"})
              .code == 0);
      return bytes_of(out);
    };
    CHECK(path(prepared) == path(input));
    CHECK(run_tool({"info", prepared}).code == 0);
    const auto precise = [&](const std::string& of) {
      return run_tool({"distance", of, "-s", "vertex:7", "--precision", "double", "-o", "-"}).out;
    };
    CHECK(precise(prepared) == precise(input));
  }
}

TEST_CASE("what is no prepared file, or asks for another one, is one line and its exit code") {
  const testing::Folder folder;
  const std::string prepared = folder.at("one.plexway").string(), input = data + "elbow.mesh";
  ran({"prepare", input, "--out", prepared, "--quiet"});
  const auto refused = [&](const Words& words, int code, const char* why) {
    check_refused(words, code, why);
  };
  refused({"prepare", input, "--out", folder.at("one.ply").string()}, 2, ".plexway");
  refused(
      {"prepare", input, "--out", folder.at("b.plexway").string(), "--triangulation", "delaunay"},
      2, "only a surface has triangles to flip");
  refused({"distance", prepared, "--as", "wireframe", "--source", "vertex:0"}, 2,
          "prepared already");
  std::string bytes = bytes_of(prepared);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  refused({"distance", folder.write("bad.plexway", bytes).string(), "--source", "vertex:0"}, 3,
          "bad.plexway: is damaged");
  refused({"info", folder.write("cut.plexway", bytes.substr(0, 700)).string()}, 3, "cut short");
  refused({"info", folder.write("off.plexway", "OFF\n").string()}, 3, "no prepared domain");
  refused({"info", folder.at("none.plexway").string()}, 3, "no such file");
  refused({"info", "/dev/null.plexway"}, 3, "no such file");
  // Over itself: the old one is mapped while the new one is written.
  CHECK(run_tool({"prepare", prepared, "--out", folder.at("again.plexway").string(), "--quiet"})
            .code == 0);
  CHECK(bytes_of(folder.at("again.plexway")) == bytes_of(prepared));
}

}  // namespace convert_test
