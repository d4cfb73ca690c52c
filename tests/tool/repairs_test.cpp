#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace repairs_test {

using namespace cli_testing;
using io_testing::Folder;

// What the tool says and does about distances that are cheap to see to be wrong.
namespace {

double chance(std::uint32_t& state) {
  state = state * 1664525u + 1013904223u;
  return static_cast<double>(state >> 8) / 16777216;
}

struct Spike {
  std::string off;
  std::vector<std::array<double, 3>> positions;
};

/// An 8 x 8 grid of jittered points with one far up.
Spike spike(double height, std::uint32_t seed) {
  Spike s;
  s.off = "OFF\n64 98 0\n";
  for (int v = 0; v < 64; ++v) {
    std::array<double, 3> p = {v % 8 + 0.7 * chance(seed), v / 8 + 0.7 * chance(seed),
                               0.7 * chance(seed)};
    if (v == 27) p[2] = height;
    for (double& x : p) x = std::round(x * 1e6) * 1e-6;
    s.positions.push_back(p);
    s.off += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 7; ++i) {
      const std::string a = std::to_string(j * 8 + i), b = std::to_string(j * 8 + i + 1);
      const std::string c = std::to_string(j * 8 + i + 9), d = std::to_string(j * 8 + i + 8);
      s.off += "3 " + a + " " + b + " " + c + "\n3 " + a + " " + c + " " + d + "\n";
    }
  return s;
}

}  // namespace

TEST_CASE("the tool never gives a distance below the straight line through space") {
  const Folder folder;
  for (const double height : {100., 10000.})
    for (const char* triangles : {"auto", "delaunay", "refined", "input"}) {
      const Spike s = spike(height, 5);
      CAPTURE(height, triangles);
      const auto run = run_tool({"distance", folder.write("spike.off", s.off), "--source",
                                 "vertex:63", "--triangulation", triangles, "--out", "-"});
      REQUIRE(run.code == 0);
      const std::vector<double> d = csv_column(run.out, "distance");
      REQUIRE(d.size() == 64);
      for (std::size_t v = 0; v < 63; ++v) {
        const auto &p = s.positions[v], &q = s.positions[63];
        CHECK(d[v] >= std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) * (1 - 1e-6));
      }
    }
}

TEST_CASE("path and distance tell of each other, and counts of repairs are in the summary") {
  const Folder folder;
  const std::string file = folder.write("spike.off", spike(3, 9).off);
  const auto field = run_tool({"distance", file, "--source", "vertex:0", "--triangulation",
                               "delaunay", "--out", "-", "--quiet"});
  const auto summary =
      run_tool({"distance", file, "--source", "vertex:0", "--triangulation", "delaunay", "--json"});
  REQUIRE(summary.code == 0);
  CHECK(summary.json()["lowered_vertices"].is_number_unsigned());
  CHECK(summary.json()["raised_vertices"].is_number_unsigned());
  const std::vector<double> d = csv_column(field.out, "distance");
  for (const char* to : {"63", "50", "7"}) {
    const auto run =
        run_tool({"path", file, "--from", "vertex:0", "--to", std::string("vertex:") + to,
                  "--triangulation", "delaunay", "--json"});
    REQUIRE(run.code == 0);
    const auto path = run.json()["paths"][0];
    CAPTURE(to);
    CHECK(run.json()["triangulation"] == "delaunay");
    CHECK(path["distance"].get<double>() == Approx(d[std::stoul(to)]).epsilon(1e-6));
    CHECK(path["length"].get<double>() == Approx(path["distance"].get<double>()).epsilon(0.05));
    CHECK_FALSE(path["capped"].get<bool>());
  }
  const auto refused = run_tool({"path", file, "--from", "vertex:0", "--to", "vertex:9", "--astar",
                                 "--triangulation", "delaunay"});
  CHECK(refused.code == 2);
}

}  // namespace repairs_test
