#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/points.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace cloud_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;
using io_testing::Positions;

#ifdef PLEXWAY_HAS_FLANN

namespace {

/// Where the points of data/roll.xyz are on the paper, unrolled: see data/scan_shapes.hpp.
std::vector<std::array<double, 2>> unrolled(const Positions& points) {
  std::vector<std::array<double, 2>> flat;
  for (const auto& [x, y, z] : points) {
    const double turn = 18 * std::hypot(x, y);
    flat.push_back({(turn * std::sqrt(1 + turn * turn) + std::asinh(turn)) / 36, z});
  }
  return flat;
}

std::vector<double> roll_distances(const std::vector<std::string>& more, const std::string& file) {
  return distances(joined({file, "--source", "vertex:0"}, more));
}

struct Error {
  double mean = 0, max = 0;  // beyond three spacings
};

Error error_on_roll(const std::vector<double>& distance, const Positions& points) {
  const auto flat = unrolled(points);
  Error error;
  double count = 0;
  REQUIRE(distance.size() == flat.size());
  for (std::size_t i = 1; i < flat.size(); ++i) {
    const double exact = std::hypot(flat[i][0] - flat[0][0], flat[i][1] - flat[0][1]);
    if (exact < 0.18) continue;
    const double off = std::abs(distance[i] - exact) / exact;
    error.mean += off;
    error.max = std::max(error.max, off);
    ++count;
  }
  error.mean /= count;
  return error;
}

/// n x n points of the unit square, moved.
std::string square_points(int n, double dx, double dz = 0) {
  std::ostringstream text;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      text << x / (n - 1.0) + dx << ' ' << y / (n - 1.0) << ' ' << dz << '\n';
  return text.str();
}

}  // namespace

TEST_CASE("distances on a rolled-up cloud are those on the paper") {
  const std::string file = sample("roll.xyz");
  const auto points = plexway::io::read_points(file).positions;
  for (const char* precision : {"float", "double"}) {
    const Error error = error_on_roll(roll_distances({"--precision", precision}, file), points);
    CHECK(error.mean < 2e-3);
    CHECK(error.max < 2e-2);
  }
}

TEST_CASE("a noisy cloud is measured along a smooth surface with --smooth") {
  const Folder folder;
  auto points = plexway::io::read_points(sample("roll.xyz"));
  const auto clean = points.positions;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, 0.015);
  for (auto& p : points.positions) {
    const double length = std::hypot(p[0], p[1]), off = noise(random);
    for (std::size_t k = 0; k < 2; ++k) p[k] += off * p[k] / length;
  }
  const std::string file = folder.path() / "noisy.ply";
  plexway::io::write_points(file, points);
  const Error rough = error_on_roll(roll_distances({}, file), clean);
  const Error smooth = error_on_roll(roll_distances({"--smooth"}, file), clean);
  CHECK(smooth.mean < rough.mean / 2);
  CHECK(smooth.mean < 1e-2);
  const auto info = run_tool({"info", file, "--json"}).json();
  CHECK(info["noise"] > 0.1);
  CHECK_THAT(info["warnings"].dump(), Contains("--smooth"));
}

TEST_CASE("the summary of a cloud") {
  const std::string file = sample("roll.xyz");
  const auto run = ran({"distance", file, "--source", "point:0.4,0,0.6", "--json"});
  const auto json = run.json();
  CHECK(json["kind"] == "cloud");
  CHECK(json["vertices"] == 2400);
  CHECK(json["simplices"] > 2400);
  CHECK(json["components"] == 1);
  CHECK(json["reached"] == 2400);
  CHECK(json["points_in_file"] == 2400);
  CHECK(json["not_finite"] == 0);
  CHECK(json["seconds"]["neighbours"] > 0);
  // The nearest point to a place is the source.
  const std::array<double, 3> place = {0.31, -0.27, 0.44};
  const auto points = plexway::io::read_points(file).positions;
  std::size_t nearest = 0;
  const auto away = [&](std::size_t i) {
    return std::hypot(points[i][0] - place[0], points[i][1] - place[1], points[i][2] - place[2]);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (away(i) < away(nearest)) nearest = i;
  CHECK(distances({file, "-s", "point:0.31,-0.27,0.44"})[nearest] == 0);
  const auto text = run_tool({"distance", file, "--source", "point:9,9,9"});
  CHECK_THAT(text.out, Contains("cloud") && Contains("(vertex ") && Contains("away)"));
  CHECK_THAT(text.err, Contains("note: --source point:9,9,9 is ") && Contains(" from the "));
}

TEST_CASE("two clusters: the note names components and a k that connects them") {
  const Folder folder;
  const std::string file = folder.write("two.xyz", square_points(12, 0) + square_points(12, 1.5));
  const auto run = ran({"distance", file, "--source", "vertex:0", "--k", "6", "--json"});
  CHECK(run.json()["reached"] == 144);
  CHECK(run.json()["components"] == 2);
  CHECK(run.complaints() == 1);
  CHECK_THAT(run.err, Contains("plexway: note: 144 vertices not reached (inf): the cloud has 2 "
                               "components; --k "));
  const auto info = run_tool({"info", file, "--k", "6", "--json"}).json();
  CHECK(info["components"] == 2);
  CHECK(info["component_sizes"] == nlohmann::json({144, 144}));
  CHECK(info["largest_share"] == 0.5);
  const std::size_t k = info["connecting_k"];
  CHECK_THAT(run.err, Contains("--k " + std::to_string(k) + " "));
  CHECK_THAT(info["warnings"].dump(), Contains("2 components"));
  // One less leaves them apart; a radius does as well, and no k is offered then.
  const auto apart = run_tool({"info", file, "--k", std::to_string(k - 1), "--json"}).json();
  CHECK(apart["components"] == 2);
  const auto radius =
      run_tool({"distance", file, "-s", "vertex:0", "--neighbour-radius", "0.3", "--json"});
  CHECK(radius.json()["reached"] == 144);
  CHECK_THAT(radius.err, Contains("--neighbour-radius"));
}

TEST_CASE("no path leads from one of two close sheets to the other, unless the angle allows it") {
  const Folder folder;
  for (const double gap : {0.035, 0.05}) {  // the points are 0.034 apart
    const std::string file =
        folder.write("sheets.xyz", square_points(30, 0) + square_points(30, 0.01, gap));
    const auto run = ran({"distance", file, "--source", "vertex:450", "-q", "-o", "-"});
    const auto distance = csv_column(run.out, "distance");
    for (std::size_t i = 0; i < 1800; ++i) CHECK(std::isfinite(distance[i]) == (i < 900));
    const auto info = run_tool({"info", file, "--json"}).json();
    CHECK(info["component_sizes"] == nlohmann::json({900, 900}));
    CHECK(info["refused_pairs"] > 900);
    const auto any = run_tool({"info", file, "--max-normal-angle", "180", "--json"}).json();
    CHECK(any["refused_pairs"] < info["refused_pairs"]);
    CHECK(any["component_sizes"] == nlohmann::json({1800}));
  }
}

TEST_CASE("normals of the file are used where they tell inside from outside") {
  const Folder folder;
  plexway::io::Points ball;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 3> p = {normal(random), normal(random), normal(random)};
    const double length = std::hypot(p[0], p[1], p[2]);
    ball.normals.push_back({p[0] / length, p[1] / length, p[2] / length});
  }
  ball.positions = ball.normals;
  const std::string good = folder.path() / "good.ply", bad = folder.path() / "bad.ply";
  plexway::io::write_points(good, ball);
  for (std::size_t i = 0; i < ball.normals.size(); i += 2)
    for (double& c : ball.normals[i]) c = -c;
  plexway::io::write_points(bad, ball);
  for (const std::string& file : {good, bad}) {
    const auto info = run_tool({"info", file, "--json"}).json();
    CHECK(info["normals"] == true);
    CHECK(info["components"] == 1);
    const auto told = info["warnings"].dump().find("one side");
    CHECK((told != std::string::npos) == (file == bad));
  }
}

TEST_CASE("a surface as a cloud: its vertices alone") {
  const auto knot =
      ran({"distance", sample("knot.ply"), "--as", "cloud", "-s", "vertex:0", "--json"});
  CHECK(knot.json()["kind"] == "cloud");
  CHECK(knot.json()["reached"] == 5120);
  const auto surface = run_tool({"distance", sample("knot.ply"), "-s", "vertex:0", "--json"});
  const double apart =
      knot.json()["max_distance"].get<double>() / surface.json()["max_distance"].get<double>();
  CHECK(std::abs(apart - 1) < 0.01);
  const auto torus = run_tool({"info", sample("torus.obj"), "--as", "cloud", "--json"});
  CHECK(torus.json()["component_sizes"] == nlohmann::json({1152}));
}

TEST_CASE("making a cloud ready shows its progress on a terminal") {
  const auto run = run_tool_on_terminal({"info", sample("roll.xyz")});
  CHECK(run.code == 0);
  CHECK_THAT(run.err, Contains("looking for neighbours"));
}

#endif

#ifdef PLEXWAY_HAS_FLANN

namespace {

/// Where a point of data/roll.xyz is on the paper, unrolled: see data/scan_shapes.hpp.
std::array<double, 2> unrolled(double x, double y, double z) {
  const double turn = 18 * std::hypot(x, y);
  return {(turn * std::sqrt(1 + turn * turn) + std::asinh(turn)) / 36, z};
}
double apart(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

}  // namespace

TEST_CASE("path goes along a cloud and not through the air") {
  const Folder folder;
  const auto points = plexway::io::read_points(sample("roll.xyz")).positions;
  const std::string out = (folder.path() / "path.json").string();
  const auto run = ran({"path", sample("roll.xyz"), "--from", "vertex:0", "--to", "vertex:700",
                        "--to", "vertex:1500", "--out", out, "--json"});
  const auto at = [&](std::size_t i) { return unrolled(points[i][0], points[i][1], points[i][2]); };
  CHECK(run.json()["simplices"] > 2000);  // triangles that the points were made into
  const auto paths = run.json()["paths"];
  CHECK(paths[0]["length"].get<double>() == Approx(apart(at(0), at(700))).epsilon(2e-2));
  CHECK(paths[1]["length"].get<double>() == Approx(apart(at(0), at(1500))).epsilon(2e-2));
  CHECK_FALSE(bytes_of(out).empty());

  check_refused({"path", sample("roll.xyz"), "--astar", "--from", "vertex:0", "--to", "vertex:700"},
                2, "--astar");
}

TEST_CASE("points of a cloud are chosen by distance along it") {
  const Folder folder;
  const std::string out = (folder.path() / "points.csv").string();
  const auto chosen = [&](const std::vector<std::string>& command, double least) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--out", out, "--json"});
    const auto run = ran(words);
    CHECK(run.json()["kind"] == "cloud");
    const std::string csv = bytes_of(out);
    const auto x = csv_column(csv, "x"), y = csv_column(csv, "y"), z = csv_column(csv, "z"),
               vertex = csv_column(csv, "vertex");
    REQUIRE(x.size() > 4);
    double nearest = 1e9;
    for (std::size_t i = 0; i < x.size(); ++i) {
      CHECK(vertex[i] >= 0);
      for (std::size_t j = 0; j < i; ++j)
        nearest = std::min(nearest, apart(unrolled(x[i], y[i], z[i]), unrolled(x[j], y[j], z[j])));
    }
    CHECK(nearest >= least);
  };
  chosen({"poisson", sample("roll.xyz"), "--radius", "0.2"}, 0.2 * (1 - 2e-2));
  chosen({"poisson", sample("torus.obj"), "--as", "cloud", "--count", "9"}, 0);
  chosen({"farthest", sample("roll.xyz"), "--count", "8"}, 0.05);
  chosen({"cvt", sample("roll.xyz"), "--count", "12"}, 0.05);
  const auto order =
      run_tool({"poisson", sample("roll.xyz"), "--radius", "0.2", "--order", "simplices"});
  CHECK(order.code == 2);
  const auto matrix = run_tool({"pairs", sample("roll.xyz"), "-s", "vertex:0", "-s", "vertex:9",
                                "--out", (folder.path() / "matrix.csv").string(), "--json"});
  INFO(matrix.err);
  CHECK(matrix.code == 0);
  CHECK(matrix.json()["points"] == 2);
}

#endif

namespace {

Words distance(const std::string& file, const Words& more = {}) {
  return joined({"distance", file, "--source", "vertex:0"}, more);
}

const std::string few = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0.5 0.5 0\n";

}  // namespace

#ifdef PLEXWAY_HAS_FLANN
TEST_CASE("clouds that are hardly any: a defined result or a clear error each") {
  const Folder folder;
  const auto cloud = [&](const std::string& text) { return folder.write("a.xyz", text); };
  check_refused(distance(cloud("")), 3, "a.xyz: is empty");
  check_refused(distance(cloud("# nothing\n")), 3, "a.xyz: has no points");
  const auto one = run_tool(distance(cloud("1 2 3\n"), {"--quiet"}));
  CHECK(one.code == 5);
  const auto two = ran(distance(cloud("0 0 0\n3 4 0\n"), {"--quiet", "--out", "-"}));
  CHECK(csv_column(two.out, "distance") == std::vector<double>{0, 5});
  std::string equal, line;
  for (int i = 0; i < 40; ++i) {
    equal += "1 1 1\n";
    line += std::to_string(i) + " 0 0\n";
  }
  const auto same = ran(distance(cloud(equal), {"--quiet", "--out", "-"}));
  for (const double d : csv_column(same.out, "distance")) CHECK(d == 0);
  const auto collinear = ran(distance(cloud(line), {"--quiet", "--out", "-"}));
  const auto along = csv_column(collinear.out, "distance");
  for (std::size_t i = 0; i < along.size(); ++i) CHECK(along[i] == Approx(static_cast<double>(i)));
  CHECK(ran(distance(cloud(few), {"--k", "1000", "--json"})).json()["reached"] == 5);
}

TEST_CASE("bad clouds are refused with file, line and cause") {
  const Folder folder;
  const std::string nan = folder.write("nan.xyz", "0 0 0\n1 nan 0\n");
  for (const char* command : {"distance", "bench"})
    check_refused({command, nan, "-s", "vertex:0"}, 3, "nan.xyz:2: y of point 1");
  check_refused({"info", nan}, 3, "nan.xyz:2: y of point 1");
  check_refused(distance(folder.path() / "none.xyz"), 3, "no such file");
  check_refused({"distance", folder.write("a.xyz", few), "-s", "vertex:5"}, 3,
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
  CHECK(ran(distance(ply, {"--json"})).json()["kind"] == "cloud");
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
  const auto run = ran(distance(scan, {"--json"}));
  const auto json = run.json();
  CHECK(json["points_in_file"] == 64 * 48);
  CHECK(json["vertices"].get<int>() + json["not_finite"].get<int>() == 64 * 48);
  CHECK(json["reached"] == json["vertices"]);
  CHECK_THAT(run.err, Contains("not finite, and dropped"));
  CHECK(run.complaints() == 1);  // around the source there is one row: no plane, and no notch
  CHECK_THAT(ran(distance(scan)).out, Contains("kept"));
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
  const auto shown = ran(distance(file, {"--quiet", "--out", "-"}));
  CHECK(csv_column(shown.out, "original") == kept);
  const std::string csv = folder.path() / "d.csv";
  const auto run = ran(distance(file, {"--json", "--out", csv}));
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
    ran(distance(file, {"--quiet", "--out", out}));
    CHECK_THAT(bytes_of(out), Contains(part));
  }
  const std::string npy = bytes_of(folder.path() / "d.npy");
  REQUIRE(npy.size() >= 12 * n);
  std::uint32_t last = 0;
  std::memcpy(&last, npy.data() + npy.size() - 4, 4);
  CHECK(last == kept.back());
  // Whoever loses nothing gets no column.
  CHECK_THAT(ran(distance(sample("roll.xyz"), {"--quiet", "--out", "-"})).out,
             !Contains("original"));
}

TEST_CASE("thinned and denoised through PCL, distances back as a PCD") {
  const Folder folder;
  const std::string out = folder.path() / "d.pcd";
  std::string points = bytes_of(sample("roll.xyz"));
  points += "5 5 5\n";
  const std::string file = folder.write("roll.xyz", points);
  const auto denoised = ran(distance(file, {"--denoise", "--json"}));
  CHECK(denoised.json()["outliers"] >= 1);
  CHECK(denoised.json()["outliers"] < 50);
  CHECK(denoised.json()["unreached"] == 0);
  const std::string roll = sample("roll.xyz");
  const auto some = ran(distance(roll, {"--denoise", "--json"}));
  const auto more = ran(distance(roll, {"--denoise", "--deviations", "1", "--json"}));
  CHECK(more.json()["outliers"] > some.json()["outliers"]);
  const auto thinned = ran(distance(file, {"--denoise", "--voxel", "0.1", "--out", out, "--json"}));
  CHECK(thinned.json()["vertices"] < 1600);
  CHECK(thinned.json()["vertices"] > 400);
  const auto back = ran({"info", out, "--json"});
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

}  // namespace cloud_test
