#ifdef PLEXWAY_HAS_FLANN
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <plexway/io/points.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace cloud_paths_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

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
  const auto run = run_tool({"path", sample("roll.xyz"), "--from", "vertex:0", "--to", "vertex:700",
                             "--to", "vertex:1500", "--out", out, "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto at = [&](std::size_t i) { return unrolled(points[i][0], points[i][1], points[i][2]); };
  const auto paths = run.json()["paths"];
  CHECK(paths[0]["length"].get<double>() == Approx(apart(at(0), at(700))).epsilon(2e-2));
  CHECK(paths[1]["length"].get<double>() == Approx(apart(at(0), at(1500))).epsilon(2e-2));
  CHECK_FALSE(bytes_of(out).empty());

  const auto astar =
      run_tool({"path", sample("roll.xyz"), "--astar", "--from", "vertex:0", "--to", "vertex:700"});
  CHECK(astar.code == 2);
  CHECK(astar.err.find("--astar") != std::string::npos);
}

TEST_CASE("points of a cloud are chosen by distance along it") {
  const Folder folder;
  const std::string out = (folder.path() / "points.csv").string();
  const auto chosen = [&](const std::vector<std::string>& command, double least) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--out", out, "--json"});
    const auto run = run_tool(words);
    INFO(command[0] << ": " << run.err);
    REQUIRE(run.code == 0);
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

}  // namespace cloud_paths_test
#endif
