#ifdef PLEXWAY_HAS_FLANN
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
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
  std::vector<std::string> command = {"distance", file, "--source", "vertex:0"};
  command.insert(command.end(), more.begin(), more.end());
  for (const char* word : {"--quiet", "--out", "-"}) command.emplace_back(word);
  const auto run = run_tool(command);
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  return csv_column(run.out, "distance");
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
  const auto run = run_tool({"distance", file, "--source", "point:0.4,0,0.6", "--json"});
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["kind"] == "cloud");
  CHECK(json["vertices"] == 2400);
  CHECK(json["simplices"] > 2400);
  CHECK(json["components"] == 1);
  CHECK(json["reached"] == 2400);
  CHECK(json["points_in_file"] == 2400);
  CHECK(json["not_finite"] == 0);
  CHECK(json["seconds"]["neighbours"] > 0);
  const auto text = run_tool({"distance", file, "--source", "point:9,9,9"});
  CHECK_THAT(text.out, Contains("cloud") && Contains("(vertex ") && Contains("away)"));
  CHECK_THAT(text.err, Contains("note: --source point:9,9,9 is ") && Contains(" from the "));
}

TEST_CASE("the nearest point to a place is the source") {
  const std::string file = sample("roll.xyz");
  const auto points = plexway::io::read_points(file).positions;
  const std::array<double, 3> place = {0.31, -0.27, 0.44};
  std::size_t nearest = 0;
  const auto away = [&](std::size_t i) {
    return std::hypot(points[i][0] - place[0], points[i][1] - place[1], points[i][2] - place[2]);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (away(i) < away(nearest)) nearest = i;
  const auto run = run_tool({"distance", file, "-s", "point:0.31,-0.27,0.44", "-q", "-o", "-"});
  REQUIRE(run.code == 0);
  CHECK(csv_column(run.out, "distance")[nearest] == 0);
}

TEST_CASE("fields of a cloud in every format") {
  const Folder folder;
  const auto points = plexway::io::read_points(sample("roll.xyz")).positions;
  for (const char* name : {"d.csv", "d.npy", "d.ply", "d.vtk", "d.vtu"}) {
    const std::string out = folder.path() / name;
    const auto run = run_tool(
        {"distance", sample("roll.xyz"), "-s", "vertex:0", "-s", "vertex:2399", "--out", out});
    INFO(run.err);
    CHECK(run.code == 0);
    CHECK(std::filesystem::file_size(out) > 2400 * 8);
  }
  CHECK(plexway::io::read_points(folder.path() / "d.ply").positions == points);
  const std::string csv = bytes_of(folder.path() / "d.csv");
  const auto label = csv_column(csv, "label");
  CHECK(label.front() == 0);
  CHECK(label.back() == 1);
}

TEST_CASE("two clusters: the note names components and a k that connects them") {
  const Folder folder;
  const std::string file = folder.write("two.xyz", square_points(12, 0) + square_points(12, 1.5));
  const auto run = run_tool({"distance", file, "--source", "vertex:0", "--k", "6", "--json"});
  REQUIRE(run.code == 0);
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
    const auto run = run_tool({"distance", file, "--source", "vertex:450", "-q", "-o", "-"});
    REQUIRE(run.code == 0);
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

TEST_CASE("bench on a cloud: errors against truth, time against Dijkstra on its neighbours") {
  const Folder folder;
  const auto flat = unrolled(plexway::io::read_points(sample("roll.xyz")).positions);
  std::ostringstream truth;
  truth.precision(17);
  for (const auto& [s, h] : flat) truth << std::hypot(s - flat[0][0], h - flat[0][1]) << '\n';
  const auto run = run_tool({"bench", sample("roll.xyz"), "--source", "vertex:0", "--truth",
                             folder.write("truth.txt", truth.str()), "--repeats", "3", "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["kind"] == "cloud");
  CHECK(json["compared"] == 2399);
  CHECK(json["mean"] < 3e-3);
  CHECK(json["ns_per_vertex"] > 0);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(json["dijkstra_ns_per_vertex"] > 0);
#endif
}

TEST_CASE("a surface as a cloud: its vertices alone") {
  const auto knot =
      run_tool({"distance", sample("knot.ply"), "--as", "cloud", "-s", "vertex:0", "--json"});
  REQUIRE(knot.code == 0);
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

}  // namespace cloud_test
#endif
