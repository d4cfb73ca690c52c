#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/triangles.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace sampling_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

double least_distance(const std::string& csv) {
  const auto x = csv_column(csv, "x"), y = csv_column(csv, "y"), z = csv_column(csv, "z");
  double least = 1e30;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, std::hypot(x[i] - x[j], y[i] - y[j], z[i] - z[j]));
  return least;
}

}  // namespace

TEST_CASE("poisson writes darts on a square that keep their distance") {
  const Folder folder;
  const std::string input = folder.write("square.off", square_off(30)).string();
  const std::string out = (folder.path() / "darts.csv").string();
  const auto run = ran({"poisson", input, "--radius", "0.1", "--out", out, "--json"});
  const auto darts = run.json()["darts"].get<std::size_t>();
  CHECK(run.json()["maximal"].get<bool>());
  CHECK(csv_column(bytes_of(out), "x").size() == darts);
  CHECK(least_distance(bytes_of(out)) >= 0.1 * (1 - 1e-3));
  // 0.547 of the plane by disks of half the radius, and more at the rim.
  CHECK(darts > 65);
  CHECK(darts < 110);

  const std::string again = (folder.path() / "again.csv").string();
  run_tool({"poisson", input, "--radius", "0.1", "--out", again, "--quiet"});
  CHECK(bytes_of(again) == bytes_of(out));
  run_tool({"poisson", input, "--radius", "0.1", "--seed", "2", "--out", again, "--quiet"});
  CHECK(bytes_of(again) != bytes_of(out));
}

TEST_CASE("poisson takes solids and counts and writes every format") {
  const Folder folder;
  for (const std::string extension : {".csv", ".npy", ".obj", ".ply"}) {
    const std::string out = (folder.path() / ("darts" + extension)).string();
    const auto run =
        ran({"poisson", sample("elbow.mesh"), "--count", "40", "--out", out, "--json"});
    CHECK(run.json()["darts"] == 40);
    CHECK(std::filesystem::file_size(out) >= 40 * 3);
    if (extension == ".npy") CHECK(std::filesystem::file_size(out) == 128 + 40 * 3 * 8);
  }
}

TEST_CASE("cvt lowers the energy and writes cells and a surface that reads back") {
  const Folder folder;
  const std::string cells = (folder.path() / "cells.csv").string(),
                    dual = (folder.path() / "dual.obj").string();
  const auto run = ran({"cvt", sample("torus.obj"), "--count", "60", "--iterations", "15",
                        "--cells", cells, "--dual", dual, "--json"});
  const auto steps = run.json()["steps"];
  for (std::size_t n = 1; n < steps.size(); ++n)
    CHECK(steps[n]["energy"].get<double>() < steps[n - 1]["energy"].get<double>());
  const auto labels = csv_column(bytes_of(cells), "label");
  CHECK(*std::max_element(labels.begin(), labels.end()) == 59);
  const auto surface = plexway::io::read_triangles(dual);
  CHECK(surface.positions.size() == 60);
  if (run.json()["dual"]["manifold"].get<bool>())
    CHECK(surface.triangles.size() == 120);  // Euler, for a torus
}

TEST_CASE("farthest starts where it is told and its distances fall") {
  const Folder folder;
  const std::string input = folder.write("square.off", square_off(20)).string();
  const std::string out = (folder.path() / "points.csv").string();
  const auto run = ran({"farthest", input, "--count", "20", "--source", "vertex:0", "--out", out});
  const auto distance = csv_column(bytes_of(out), "distance");
  REQUIRE(distance.size() == 20);
  CHECK(distance[1] == Approx(std::sqrt(2.)));
  for (std::size_t n = 2; n < 20; ++n) CHECK(distance[n] <= distance[n - 1]);
}

TEST_CASE("pairs writes a symmetric matrix") {
  const Folder folder;
  const std::string input = folder.write("square.off", square_off(20)).string();
  const std::string out = (folder.path() / "matrix.csv").string();
  const auto run = ran({"pairs", input, "-s", "vertex:0", "-s", "vertex:399", "-s",
                        "point:0.5,0.5,0", "--out", out});
  std::istringstream in(bytes_of(out));
  double d[3][3];
  char comma = 0;
  for (auto& row : d) in >> row[0] >> comma >> row[1] >> comma >> row[2];
  CHECK(d[0][0] == 0);
  CHECK(d[0][1] == Approx(std::sqrt(2.)).epsilon(1e-3));
  CHECK(d[0][2] == Approx(std::sqrt(0.5)).epsilon(1e-3));
  CHECK(d[1][0] == d[0][1]);
}

TEST_CASE("commands that choose points say what is wrong with what they are given") {
  const Folder folder;
  const std::string torus = sample("torus.obj");
  const auto fails = [&](const Words& arguments, int code) { check_refused(arguments, code); };
  fails({"poisson", torus}, 2);
  fails({"poisson", torus, "--radius", "0.1", "--count", "5"}, 2);
  fails({"poisson", torus, "--radius", "-1"}, 2);
  fails({"poisson", torus, "--radius", "1", "--out", (folder.path() / "darts.xyzzy").string()}, 2);
  fails({"poisson", torus, "--radius", "1", "--spacing", (folder.path() / "missing.txt").string()},
        3);
  const auto spacing = [&](const std::string& text) {
    return std::vector<std::string>{
        "poisson", torus, "--radius", "1", "--spacing", folder.write("spacing.txt", text).string()};
  };
  fails(spacing(""), 3);
  fails(spacing("1 2\n"), 3);
  fails(spacing("1\n0\n"), 3);
  fails(spacing("1\n2\n"), 3);
  fails({"poisson", torus, "--radius", "1", "--spacing", folder.path()}, 3);
  fails({"poisson", sample("vessels.obj"), "--radius", "1"}, 2);
  fails({"poisson", torus, "--radius", "1e-6"}, 2);  // would fill all memory
  fails({"poisson", sample("elbow.mesh"), "--radius", "1e-4"}, 2);
  fails({"cvt", torus, "--count", "0"}, 2);
  fails({"cvt", torus, "--count", "5", "--centre", "left"}, 2);
  fails({"cvt", sample("elbow.mesh"), "--count", "5", "--dual", (folder.path() / "d.obj").string()},
        2);
  fails({"farthest", torus}, 2);
  fails({"pairs", torus, "-s", "vertex:99999999"}, 3);
}

}  // namespace sampling_test
