#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <plexway/io/points.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace cloud_files_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

// One line on standard error, the exit code, and no data.
void check_refused(const Outcome& run, int code, const std::string& part) {
  INFO(run.err);
  CHECK(run.code == code);
  CHECK(run.out.empty());
  CHECK(run.complaints() == 1);
  CHECK_THAT(run.err, Contains(part));
}

Outcome distance(const std::string& file, const std::vector<std::string>& more = {}) {
  std::vector<std::string> command = {"distance", file, "--source", "vertex:0"};
  command.insert(command.end(), more.begin(), more.end());
  return run_tool(command);
}

const std::string few = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0.5 0.5 0\n";

}  // namespace

#ifdef PLEXWAY_HAS_FLANN
TEST_CASE("clouds that are hardly any: a defined result or a clear error each") {
  const Folder folder;
  const auto cloud = [&](const std::string& text) { return folder.write("a.xyz", text); };
  check_refused(distance(cloud("")), 3, "a.xyz: is empty");
  check_refused(distance(cloud("# nothing\n")), 3, "a.xyz: has no points");
  const auto one = distance(cloud("1 2 3\n"), {"--quiet"});
  CHECK(one.code == 5);
  const auto two = distance(cloud("0 0 0\n3 4 0\n"), {"--quiet", "--out", "-"});
  CHECK(two.code == 0);
  CHECK(csv_column(two.out, "distance") == std::vector<double>{0, 5});
  std::string equal, line;
  for (int i = 0; i < 40; ++i) {
    equal += "1 1 1\n";
    line += std::to_string(i) + " 0 0\n";
  }
  const auto same = distance(cloud(equal), {"--quiet", "--out", "-"});
  CHECK(same.code == 0);
  for (const double d : csv_column(same.out, "distance")) CHECK(d == 0);
  const auto collinear = distance(cloud(line), {"--quiet", "--out", "-"});
  CHECK(collinear.code == 0);
  const auto along = csv_column(collinear.out, "distance");
  for (std::size_t i = 0; i < along.size(); ++i) CHECK(along[i] == Approx(static_cast<double>(i)));
  CHECK(distance(cloud(few), {"--k", "1000", "--json"}).json()["reached"] == 5);
}

TEST_CASE("bad clouds are refused with file, line and cause") {
  const Folder folder;
  const std::string nan = folder.write("nan.xyz", "0 0 0\n1 nan 0\n");
  for (const char* command : {"distance", "bench"})
    check_refused(run_tool({command, nan, "-s", "vertex:0"}), 3, "nan.xyz:2: y of point 1");
  check_refused(run_tool({"info", nan}), 3, "nan.xyz:2: y of point 1");
  check_refused(distance(folder.path() / "none.xyz"), 3, "no such file");
  check_refused(run_tool({"distance", folder.write("a.xyz", few), "-s", "vertex:5"}), 3,
                "out of range: the vertices are 0 to 4");
}

TEST_CASE("what a cloud can be taken as, and what not") {
  const Folder folder;
  const std::string xyz = folder.write("a.xyz", few);
  for (const char* kind : {"surface", "solid", "wireframe"})
    check_refused(distance(xyz, {"--as", kind}), 3, "is a cloud, which cannot be taken as a");
  check_refused(distance(sample("elbow.mesh"), {"--as", "cloud"}), 3, "is a solid, which cannot");
  check_refused(distance(sample("vessels.obj"), {"--as", "cloud"}), 3, "is a wireframe, which");
  const std::string ply = folder.path() / "a.ply";
  plexway::io::write_points(ply, plexway::io::read_points(xyz));
  CHECK(distance(ply, {"--json"}).json()["kind"] == "cloud");
  check_refused(distance(ply, {"--as", "surface"}), 3, "is a cloud, which cannot be taken as a");
}

TEST_CASE("options of clouds: values that cannot be, and domains that are none") {
  const Folder folder;
  const std::string xyz = folder.write("a.xyz", few);
  const std::vector<std::vector<std::string>> bad = {{"--k", "0"},
                                                     {"--k", "-1"},
                                                     {"--neighbour-radius", "0"},
                                                     {"--voxel", "nan"},
                                                     {"--voxel", "-1"},
                                                     {"--max-normal-angle", "200"},
                                                     {"--deviations", "3"},
                                                     {"--max-normal-angle", "0"},
                                                     {"--neighbour-radius", "inf"}};
  for (const auto& option : bad) check_refused(distance(xyz, option), 2, option[0]);
  check_refused(distance(xyz, {"--denoise", "--deviations", "0"}), 2, "--deviations");
  check_refused(distance(sample("knot.ply"), {"--k", "8"}), 2, "--as cloud");
  check_refused(distance(sample("knot.ply"), {"--smooth"}), 2, "--as cloud");
  check_refused(distance(sample("knot.ply"), {"--out", folder.path() / "d.pcd"}), 2, "d.pcd");
}
#else
TEST_CASE("a build without FLANN says what to install") {
  const Folder folder;
  check_refused(distance(folder.write("a.xyz", few)), 4, "libflann-dev");
  check_refused(distance(sample("knot.ply"), {"--as", "cloud"}), 4, "libflann-dev");
}
#endif

#if defined(PLEXWAY_HAS_PCL) && defined(PLEXWAY_HAS_FLANN)
TEST_CASE("a scan in PCD: points that are not finite are dropped, counted and told") {
  const std::string scan = sample("scan.pcd");
  const auto run = distance(scan, {"--json"});
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["points_in_file"] == 64 * 48);
  CHECK(json["vertices"].get<int>() + json["not_finite"].get<int>() == 64 * 48);
  CHECK(json["reached"] == json["vertices"]);
  CHECK_THAT(run.err, Contains("not finite, and dropped"));
  CHECK(run.complaints() == 1);  // around the source there is one row: no plane, and no notch
  CHECK_THAT(distance(scan).out, Contains("kept"));
}

TEST_CASE("points that were left out keep their numbers in every output") {
  const Folder folder;
  std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 120\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 120\nDATA ascii\n";
  std::vector<double> kept, x;
  for (int i = 0; i < 120; ++i) {
    if (i % 7 == 3) {
      pcd += "nan nan nan\n";
      continue;
    }
    pcd += std::to_string(i % 12) + " " + std::to_string(i / 12) + " 0\n";
    kept.push_back(i);
    x.push_back(i % 12);
  }
  const std::string file = folder.write("holes.pcd", pcd);
  const auto shown = distance(file, {"--quiet", "--out", "-"});
  REQUIRE(shown.code == 0);
  CHECK(csv_column(shown.out, "original") == kept);
  const std::string csv = folder.path() / "d.csv";
  const auto run = distance(file, {"--json", "--out", csv});
  REQUIRE(run.code == 0);
  CHECK(csv_column(bytes_of(csv), "original") == kept);
  CHECK(csv_column(bytes_of(csv), "x") == x);
  CHECK(run.json()["dropped"][0] == 3);
  CHECK(run.json()["dropped"].size() == 120 - kept.size());
  CHECK_THAT(run.err, Contains("the column original"));
  const std::size_t n = kept.size();
  for (const auto& [name, part] : std::vector<std::pair<std::string, std::string>>{
           {"d.ply", "property int original\n"},
           {"d.vtu", "Name=\"original\""},
           {"d.vtk", "original 1 " + std::to_string(n) + " unsigned_int"},
           {"d.npy", "[('distance', '<f8'), ('original', '<u4')]"},
           {"d.gltf", "_ORIGINAL"},
           {"d.pcd", "original"}}) {
    const std::string out = folder.path() / name;
    REQUIRE(distance(file, {"--quiet", "--out", out}).code == 0);
    CHECK_THAT(bytes_of(out), Contains(part));
  }
  const std::string npy = bytes_of(folder.path() / "d.npy");
  REQUIRE(npy.size() >= 12 * n);
  std::uint32_t last = 0;
  std::memcpy(&last, npy.data() + npy.size() - 4, 4);
  CHECK(last == kept.back());
  // Whoever loses nothing gets no column.
  CHECK_THAT(distance(sample("roll.xyz"), {"--quiet", "--out", "-"}).out, !Contains("original"));
}

TEST_CASE("thinned and denoised through PCL, distances back as a PCD") {
  const Folder folder;
  const std::string out = folder.path() / "d.pcd";
  std::string points = bytes_of(sample("roll.xyz"));
  points += "5 5 5\n";
  const std::string file = folder.write("roll.xyz", points);
  const auto denoised = distance(file, {"--denoise", "--json"});
  REQUIRE(denoised.code == 0);
  CHECK(denoised.json()["outliers"] >= 1);
  CHECK(denoised.json()["outliers"] < 50);
  CHECK(denoised.json()["unreached"] == 0);
  const std::string roll = sample("roll.xyz");
  const auto some = distance(roll, {"--denoise", "--json"});
  const auto more = distance(roll, {"--denoise", "--deviations", "1", "--json"});
  CHECK(more.json()["outliers"] > some.json()["outliers"]);
  const auto thinned = distance(file, {"--denoise", "--voxel", "0.1", "--out", out, "--json"});
  REQUIRE(thinned.code == 0);
  CHECK(thinned.json()["vertices"] < 1600);
  CHECK(thinned.json()["vertices"] > 400);
  const auto back = run_tool({"info", out, "--json"});
  REQUIRE(back.code == 0);
  CHECK(back.json()["vertices"] == thinned.json()["vertices"]);
  check_refused(distance(file, {"--voxel", "1e-9"}), 2, "--voxel: the cloud's box has more cubes");
}

TEST_CASE("bad PCD files are refused, and PCL prints nothing") {
  const Folder folder;
  const std::string scan = bytes_of(sample("scan.pcd"));
  const auto file = [&](const std::string& bytes) { return folder.write("a.pcd", bytes); };
  check_refused(distance(file(scan.substr(0, scan.size() / 2))), 3, "a.pcd:11: the header says");
  check_refused(distance(file("nonsense\n")), 3, "a.pcd:1: unknown word");
  check_refused(distance(file("")), 3, "a.pcd: is empty");
  check_refused(distance(folder.path() / "none.pcd"), 3, "no such file");
}
#else
TEST_CASE("a build without PCL says what to install") {
  const Folder folder;
  const char* const needed =
#ifdef PLEXWAY_HAS_FLANN
      "libpcl-dev";
#else
      "libflann-dev";
#endif
  const std::string xyz = folder.write("a.xyz", few);
  check_refused(distance(sample("scan.pcd")), 4, needed);
  check_refused(distance(xyz, {"--voxel", "0.1"}), 4, needed);
  check_refused(distance(xyz, {"--denoise"}), 4, needed);
}
#endif

}  // namespace cloud_files_test
