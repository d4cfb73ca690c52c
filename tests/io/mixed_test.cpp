// Cells of several dimensions in one file, the same in every format.

#include <catch2/catch.hpp>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/io/tets.hpp>

#include "io_testing.hpp"

namespace plexway::mixed_test {

using Catch::Contains;

namespace {

const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n2 1 0\n3 1 0\n";

// A tetrahedron, two triangles, a line, a polyline of two, and a single point.
void check_cells(const io::Mixed& cells) {
  REQUIRE(cells.positions.size() == 7);
  CHECK(cells.positions[4] == std::array<double, 3>{1, 1, 0});
  CHECK(cells.tets == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
  CHECK(cells.triangles == std::vector<std::array<std::uint32_t, 3>>{{1, 4, 2}, {0, 1, 3}});
  CHECK(cells.edges == std::vector<std::array<std::uint32_t, 2>>{{4, 5}, {4, 5}, {5, 6}});
}

std::string vtk(const std::string& cells, const std::string& types) {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n" +
         points + cells + types;
}

std::string gmsh(const std::string& elements) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n";
  std::size_t at = 0;
  for (int i = 0; i < 7; ++i) {
    const std::size_t end = points.find('\n', at);
    text += std::to_string(10 + i) + " " + points.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return text + "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
}

}  // namespace

TEST_CASE("lines, triangles and tetrahedra come from one .vtk") {
  const std::string file = vtk("CELLS 6 22\n3 1 4 2\n4 0 1 2 3\n2 4 5\n3 4 5 6\n3 0 1 3\n1 6\n",
                               "CELL_TYPES 6\n5 10 3 4 5 1\n");
  check_cells(io::parse_vtk_cells(file, "f"));
  // As a solid, as before.
  CHECK(io::parse_vtk(file, "f").tets.size() == 1);
}

TEST_CASE("lines, triangles and tetrahedra come from one .vtu") {
  const std::string file =
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"7\" "
      "NumberOfCells=\"6\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
      points +
      "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\">"
      "1 4 2 0 1 2 3 4 5 4 5 6 0 1 3 6</DataArray><DataArray type=\"Int64\" Name=\"offsets\">"
      "3 7 9 12 15 16</DataArray><DataArray type=\"UInt8\" Name=\"types\">5 10 3 4 5 1</DataArray>"
      "</Cells></Piece></UnstructuredGrid></VTKFile>";
  try {
    check_cells(io::parse_vtu_cells(file, "f"));
    CHECK(io::parse_vtu(file, "f").tets.size() == 1);
  } catch (const NotBuiltError&) {
  }
}

TEST_CASE("lines, triangles and tetrahedra come from one .msh") {
  const std::string file = gmsh(
      "7\n1 2 2 1 1 11 14 12\n2 4 2 1 1 10 11 12 13\n3 1 2 1 1 14 15\n4 1 0 14 15\n5 1 0 15 16\n"
      "6 2 0 10 11 13\n7 15 0 16\n");
  check_cells(io::parse_gmsh_cells(file, "f"));
  CHECK(io::parse_gmsh(file, "f").tets.size() == 1);
  CHECK_THROWS_WITH(io::parse_gmsh_cells(gmsh("1\n7 2 0 10 11 99\n"), "f.msh"),
                    Contains("triangle 7 names node 99"));
}

TEST_CASE("cells of kinds that are not known are refused, as a domain would have holes") {
  CHECK_THROWS_WITH(
      io::parse_vtk_cells(vtk("CELLS 2 9\n2 4 5\n5 0 1 4 2 3\n", "CELL_TYPES 2\n3 42\n"), "f.vtk"),
      Contains("f.vtk: has 1 polyhedra, which are not read"));
  CHECK_THROWS_WITH(io::parse_gmsh_cells(gmsh("1\n1 777 0 10 11 14 12 13\n"), "f.msh"),
                    Contains("elements of an unknown type"));
}

TEST_CASE("simplices of any dimension come from a text") {
  const auto flat = io::parse_simplices(
      "# two triangles\ndimension 2\nvertices 4 2\n0 0\n1 0\n0 1 # here\n1 1\nsimplices 2\n0 1 2\n"
      "1 3 2\n",
      "f");
  CHECK(flat.dimension == 2);
  CHECK(flat.axes == 2);
  CHECK(flat.positions == std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1});
  CHECK(flat.corners == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2});
  const auto lengths =
      io::parse_simplices("dimension 1\nvertices 3\nsimplices 2\n0 1 2.5\n1 2 1\n", "f");
  CHECK(lengths.axes == 0);
  CHECK(lengths.lengths == std::vector<double>{2.5, 1});
  const auto fails = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(io::parse_simplices(text, "f.simplices"), Contains(why));
  };
  fails("dimension 5\n", "f.simplices:1: simplices of dimension 5");
  fails("dimension 2\nvertices 3 1\n", "need at least 2 coordinates");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 2 1\n", "f.simplices:4: simplex 0 names vertex 2");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1\n", "ends before the length");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1 -1\n", "negative");
  fails("dimension 1\nvertices 2\nsimplices 2\n0 1 1\n", "ends before simplex 1");
  fails("dimension 1\nvertices 99999999999\nsimplices 1\n0 1 1\n", "too short");
  fails("dimension 1\nvertices 2\nsimplices 99999999999\n0 1 1\n", "ends before simplex 1");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1 1\n0 1 1\n", "behind the last simplex");
}

}  // namespace plexway::mixed_test
