#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace triangulation_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

// A flat strip of n by n cells, 40 times as long as wide and sheared, so that the diagonals are
// wrong: thin triangles that are far from Delaunay.
std::string sheared_off(int n) {
  std::string text =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string(2 * (n - 1) * (n - 1)) + " 0\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      text += std::to_string(i + 3.0 * j) + " " + std::to_string(0.025 * j) + " 0\n";
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i, b = a + n;
      text += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(b + 1) +
              "\n3 " + std::to_string(a) + " " + std::to_string(b + 1) + " " + std::to_string(b) +
              "\n";
    }
  return text;
}

}  // namespace

TEST_CASE("triangulation is chosen by shape, and planes stay exact") {
  const Folder folder;
  constexpr int n = 12;
  const std::string strip = folder.write("strip.off", sheared_off(n));
  const auto info = run_tool({"info", strip, "--json"});
  REQUIRE(info.code == 0);
  CHECK(info.json()["triangulation"]["needle_share"].get<double>() > 0.9);
  CHECK(info.json()["triangulation"]["auto"] == "refined");
  for (const std::string name : {"input", "delaunay", "refined", "auto"}) {
    for (const auto& [accuracy, off] :
         {std::pair("fast", 1e-9), {"exact", 1e-9}, {"accurate", 1e-6}}) {
      const auto run =
          run_tool({"distance", strip, "--source", "vertex:0", "--triangulation", name,
                    "--accuracy", accuracy, "--out", "-", "--quiet", "--precision", "double"});
      REQUIRE(run.code == 0);
      const auto distance = csv_column(run.out, "distance");
      REQUIRE(distance.size() == n * n);
      // The strip is convex: straight lines.
      for (int v = 0; v < n * n; ++v) {
        const int i = v % n, j = v / n;
        CHECK(distance[static_cast<std::size_t>(v)] ==
              Approx(std::hypot(i + 3.0 * j, 0.025 * j)).epsilon(off).margin(1e-12));
      }
    }
    const auto report = run_tool(
        {"distance", strip, "--source", "point:17,0.125,0", "--json", "--triangulation", name});
    REQUIRE(report.code == 0);
    CHECK(report.json()["triangulation"] == (name == "auto" ? "refined" : name));
    CHECK(report.json()["simplices"] == 2 * (n - 1) * (n - 1));
    // The farther end of the strip from the point: both ends are corners.
    const double ends[2] = {std::hypot(17, 0.125), std::hypot(11 + 33 - 17.0, 0.275 - 0.125)};
    CHECK(report.json()["max_distance"].get<double>() ==
          Approx(std::max(ends[0], ends[1])).epsilon(1e-5));
  }
}

TEST_CASE("triangulation leaves good meshes alone, and says what it knows") {
  const auto knot = run_tool({"distance", sample("knot.ply"), "--source", "vertex:0", "--json"});
  REQUIRE(knot.code == 0);
  CHECK(knot.json()["triangulation"] == "input");
  const auto flips = run_tool({"bench", sample("hills.off"), "--source", "vertex:0", "--repeats",
                               "1", "--json", "--quiet", "--triangulation", "delaunay"});
  REQUIRE(flips.code == 0);
  CHECK(flips.json()["triangulation"] == "delaunay");
  CHECK(flips.json()["flips"].get<int>() > 0);
  const auto other =
      run_tool({"distance", sample("knot.ply"), "--source", "vertex:0", "--triangulation", "good"});
  CHECK(other.code == 2);
  CHECK(other.complaints() == 1);
  const auto wires = run_tool(
      {"distance", sample("vessels.obj"), "--source", "vertex:0", "--triangulation", "delaunay"});
  CHECK(wires.code == 2);
  CHECK(wires.err.find("only a surface") != std::string::npos);
}

TEST_CASE("labels and unreached vertices survive a refinement") {
  const auto run =
      run_tool({"distance", sample("two_parts.obj"), "--source", "vertex:0", "--source", "vertex:1",
                "--triangulation", "refined", "--out", "-", "--quiet"});
  REQUIRE(run.code == 0);
  const auto plain =
      run_tool({"distance", sample("two_parts.obj"), "--source", "vertex:0", "--source", "vertex:1",
                "--triangulation", "input", "--out", "-", "--quiet"});
  const auto a = csv_column(run.out, "distance"), b = csv_column(plain.out, "distance");
  REQUIRE(a.size() == b.size());
  for (std::size_t v = 0; v < a.size(); ++v) CHECK(std::isinf(a[v]) == std::isinf(b[v]));
  CHECK(csv_column(run.out, "label").size() == b.size());
}

}  // namespace triangulation_test
