#include <catch2/catch.hpp>
#include <string>

#include "io/io_testing.hpp"
#include "tetgen/solids.hpp"

namespace poly_file_test {

using namespace tetgen_testing;
using io_testing::Folder;
using plexway::tetgen::read_poly;

namespace {

// A cube of side 2 in six squares; numbers count from `first`.
std::string cube_points(int first) {
  std::string text = "# a cube\n8 3 0 0\n";
  for (int i = 0; i < 8; ++i) {
    text += std::to_string(i + first);
    for (const int k : {i & 1, i >> 1 & 1, i >> 2})
      text.append(" ").append(std::to_string(2 * k)).append(".0");
    text += "\n";
  }
  return text;
}

std::string square(const std::array<int, 4>& corners, int first) {
  std::string text = "4 ";
  for (const int v : corners) text.append(" ").append(std::to_string(v + first));
  return text + "\n";
}

const std::array<std::array<int, 4>, 6> squares = {
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

std::string cube_poly(int first) {
  std::string text = cube_points(first) + "\n6 1\n";
  for (const auto& corners : squares)
    text.append("1 0 1  # a facet\n").append(square(corners, first));
  return text + "0\n";
}

}  // namespace

TEST_CASE("a poly file is read, counted from 0 or 1, and filled") {
  const Folder folder;
  for (const int first : {0, 1}) {
    const auto complex = read_poly(folder.write("cube.poly", cube_poly(first)));
    CHECK(complex.positions.size() == 8);
    CHECK(complex.positions[5] == Point{2, 0, 2});
    REQUIRE(complex.facets.size() == 6);
    CHECK(complex.facets[3].polygons == std::vector<std::vector<Index>>{{2, 6, 7, 3}});
    const Solid solid = plexway::tetgen::tetrahedralize(complex);
    CHECK(volume(solid) == Approx(8));
    CHECK(solid.regions.empty());
  }
}

TEST_CASE("a smesh file has one polygon a facet, and its points may be beside it") {
  const Folder folder;
  folder.write("cube.node", cube_points(1));
  std::string text = "0 3 0 0\n6 0\n";
  for (const auto& corners : squares) text += square(corners, 1);
  const auto complex = read_poly(folder.write("cube.smesh", text + "0\n0\n"));
  CHECK(volume(plexway::tetgen::tetrahedralize(complex)) == Approx(8));
}

TEST_CASE("facets may have holes, and space holes and regions") {
  const Folder folder;
  // A wall between two halves with a window in it, and an attribute for each half.
  std::string text = "16 3\n";
  auto add = [&text, n = 0](double x, double y, double z) mutable {
    text += std::to_string(n++) + " " + std::to_string(x) + " " + std::to_string(y) + " " +
            std::to_string(z) + "\n";
  };
  for (const double x : {0.0, 1.0, 2.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) add(x, y, z);
  for (const double y : {0.25, 0.75})
    for (const double z : {0.25, 0.75}) add(1, y, z);
  text += "11 0\n";
  for (const char* corners : {"0 1 3 2", "8 9 11 10", "0 2 6 4", "4 6 10 8", "1 3 7 5", "5 7 11 9",
                              "0 1 5 4", "4 5 9 8", "2 3 7 6", "6 7 11 10"})
    text += std::string("1\n4 ") + corners + "\n";
  const std::string wall = "4 4 5 7 6\n4 12 13 15 14\n";
  const std::string with_window = text + "2 1\n" + wall + "1 1 0.5 0.5\n";
  const std::string with_pane = text + "2 0\n" + wall;
  const std::string regions = "2\n0 0.5 0.5 0.5 -7 0.01\n1 1.5 0.5 0.5 9 -1\n";

  const auto window = read_poly(folder.write("a.poly", with_window + "0\n"));
  REQUIRE(window.facets.back().holes.size() == 1);
  CHECK(window.facets.back().polygons.size() == 2);
  CHECK(volume(plexway::tetgen::tetrahedralize(window)) == Approx(2));

  const auto pane = read_poly(folder.write("b.poly", with_pane + "0\n" + regions));
  REQUIRE(pane.regions.size() == 2);
  CHECK(pane.regions[0].attribute == -7);
  CHECK(pane.regions[0].max_volume == 0.01);
  const Solid solid = plexway::tetgen::tetrahedralize(pane);
  REQUIRE(solid.regions.size() == solid.tets.size());
  double first = 0, second = 0;
  for (std::size_t t = 0; t < solid.tets.size(); ++t) {
    (solid.regions[t] == -7 ? first : second) += volume(solid, t);
    if (solid.regions[t] == -7)
      CHECK(volume(solid, t) <= 0.01 * (1 + 1e-9));
    else
      CHECK(solid.regions[t] == 9);
  }
  CHECK(first == Approx(1));
  CHECK(second == Approx(1));

  const auto half = read_poly(folder.write("c.poly", with_pane + "1\n0 0.5 0.5 0.5\n0\n"));
  CHECK(volume(plexway::tetgen::tetrahedralize(half)) == Approx(1));
}

TEST_CASE("bad poly files are refused with file, line and cause") {
  const Folder folder;
  struct Bad {
    std::string bytes;
    std::string complaint;
  };
  const std::string points = cube_points(0);  // lines 1 to 10
  const std::vector<Bad> files = {
      {"", ":0: the file ends before the number of points"},
      {"# nothing\n", ":1: the file ends before the number of points"},
      {"eight 3\n", ":1: the number of points is not a whole number: 'eight'"},
      {"-1 3\n", ":1: the number of points is negative: -1"},
      {"999999999999 3\n",
       ":1: the number of points is 999999999999, more than this file can hold"},
      {"3 2 0 0\n", ":1: the dimension is not 3; TetGen fills solids only"},
      {"2 3\n0 0 0 0\n1 0 nan 0\n", ":3: coordinate y of the point is not finite: 'nan'"},
      {"2 3\n0 0 0 0\n1 0 1e999 0\n", ":3: coordinate y of the point is not finite: '1e999'"},
      {"2 3\n0 0 0 0\n1 0 0\n", ":3: the line ends before coordinate z of the point"},
      {"2 3\n0 0 0 0\n2 0 0 0\n", ":3: point 2 is out of order; expected 1"},
      {"2 3\n5 0 0 0\n", ":2: the first point has the number 5; it is 0 or 1"},
      {"6 3\n0 0 0 0\n", ":2: the file ends before point 1 of 6"},
      {points, ":10: the file ends before the number of facets"},
      {points + "0\n", ":11: there are no facets"},
      {points + "1 0\n", ":11: the file ends before facet 0 of 1"},
      {points + "1 0\n0\n", ":12: facet 0 has no polygon"},
      {points + "1 0\n1\n3 0 1 8\n", ":13: a polygon names point 8, but the points are 0 to 7"},
      {points + "1 0\n1\n3 0 1 -1\n", ":13: a polygon names point -1, but the points are 0 to 7"},
      {points + "1 0\n1\n3 0 1\n", ":13: the file ends before all corners of the polygon"},
      {points + "1 0\n1\n3 0 1 2\n0\n0\nmore\n", ":16: expected the end of the file"},
  };
  for (const Bad& bad : files) {
    const auto file = folder.write("bad.poly", bad.bytes);
    CHECK(message_of([&] { (void)read_poly(file); }) == file.string() + bad.complaint);
  }
  const auto missing = folder.path() / "missing.poly";
  CHECK(message_of([&] { (void)read_poly(missing); }) == missing.string() + ": no such file");
  const auto no_node = folder.write("lonely.poly", "0 3\n");
  CHECK(message_of([&] { (void)read_poly(no_node); }).find("lonely.node: no such file") !=
        std::string::npos);
  CHECK(message_of([&] { (void)read_poly("solid.xyz"); }) ==
        "solid.xyz: unknown extension '.xyz'; known are .poly .smesh");
}

TEST_CASE("complexes that make no sense are refused") {
  using plexway::tetgen::PiecewiseLinearComplex;
  using plexway::tetgen::tetrahedralize;
  PiecewiseLinearComplex complex;
  CHECK(message_of([&] { (void)tetrahedralize(complex); }) ==
        "no facets: there is no solid to fill");
  complex.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  complex.facets = {{.polygons = {{0, 1, 3}}, .holes = {}}};
  CHECK(message_of([&] { (void)tetrahedralize(complex); }) ==
        "facet 0 names vertex 3, but there are 3");
  complex.facets = {{.polygons = {{0, 1, 2}}, .holes = {}}};
  CHECK_FALSE(message_of([&] { (void)tetrahedralize(complex); }).empty());
}

}  // namespace poly_file_test
