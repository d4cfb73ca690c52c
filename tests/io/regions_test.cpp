#include <plexway/io/labels.hpp>

#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>

#include "io/io_testing.hpp"

namespace regions_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::read_regions;
using plexway::io::Regions;

namespace {

using Numbers = std::vector<std::int64_t>;

// A line, two triangles of which one is in no group, and a tetrahedron.
const std::string nodes2 = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n";
const std::string gmsh2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes2 +
    "$Elements\n5\n1 15 2 9 1 1\n2 1 2 4 1 1 2\n3 2 2 7 3 1 2 3\n4 2 0 2 3 4\n"
    "5 4 3 11 5 6 1 2 3 4\n$EndElements\n";
const std::string nodes4 =
    "$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n";
// Curve 1 in group 4, surface 3 in groups 7 and 8, surface 5 in none, volume 2 in group 11.
const std::string gmsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 2 1\n1 0 0 0 1 9\n"
    "1 0 0 0 1 0 0 1 4 2 1 -1\n3 0 0 0 1 1 0 2 7 8 1 1\n5 0 0 0 1 1 1 0 0\n"
    "2 0 0 0 1 1 1 1 11 2 3 -5\n$EndEntities\n" +
    nodes4 +
    "$Elements\n5 5 1 5\n0 1 15 1\n1 1\n1 1 1 1\n2 1 2\n2 3 2 1\n3 1 2 3\n2 5 2 1\n4 2 3 4\n"
    "3 2 4 1\n5 1 2 3 4\n$EndElements\n";

// A polyline of two edges, a triangle and a tetrahedron; `data` behind them.
std::string legacy(const std::string& data) {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
         "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 3 13\n3 0 1 2\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 3\n"
         "4 5 10\n" +
         data;
}

std::string vtu(const std::string& data) {
  const auto array = [](const char* type, const char* name, const std::string& text) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">" +
           text + "</DataArray>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"3\">\n<Points>\n<DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray>\n"
         "</Points>\n<Cells>\n" +
         array("Int32", "connectivity", "0 1 2 0 1 2 0 1 2 3") +
         array("Int32", "offsets", "3 6 10") + array("UInt8", "types", "4 5 10") + "</Cells>\n" +
         data + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void check(const Regions& regions, const Numbers& edges, const Numbers& triangles,
           const Numbers& tets) {
  CHECK(regions.edges == edges);
  CHECK(regions.triangles == triangles);
  CHECK(regions.tets == tets);
}

}  // namespace

TEST_CASE("regions of a .msh are the first physical groups") {
  const Folder folder;
  for (const std::string& text : {gmsh2, gmsh4}) {
    const std::string file = folder.write("a.msh", text);
    check(read_regions(file), {4}, {7, 0}, {11});
    const auto mixed = plexway::io::read_cells(file);
    CHECK(mixed.triangles.size() == 2);
    CHECK(plexway::io::read_tets(file).tets.size() == 1);
  }
}

TEST_CASE("regions of a .vtk are cell data, in scalars and fields") {
  const Folder folder;
  const auto read = [&](const std::string& data) {
    return read_regions(folder.write("a.vtk", legacy(data)));
  };
  check(read("POINT_DATA 4\nSCALARS region int\nLOOKUP_TABLE default\n9 9 9 9\n"
             "CELL_DATA 3\nSCALARS MaterialIDs int 1\nLOOKUP_TABLE default\n5 6 7\n"),
        {5, 5}, {6}, {7});
  // The better name counts, wherever it stands; real numbers that are whole are read.
  check(read("CELL_DATA 3\nVECTORS v double\n0 0 0 1 1 1 2 2 2\nFIELD f 2\n"
             "MaterialIDs 1 3 int\n5 6 7\nregion 1 3 double\n1 2 -3\n"),
        {1, 1}, {2}, {-3});
  CHECK_THROWS_WITH(read("CELL_DATA 3\nFIELD f 1\nregion 1 3 double\n1 2 2.5\n"),
                    Contains("no whole number"));
  CHECK_THROWS_WITH(read("CELL_DATA 2\nFIELD f 1\nregion 1 2 int\n1 2\n"), Contains("there are 3"));
  CHECK_THROWS_WITH(read("CELL_DATA 3\nFIELD f 1\nregion 1 3 int\n1 2\n"),
                    Contains("ends before the region of a cell"));
  CHECK_THROWS_WITH(read("POINT_DATA 4\nFIELD f 1\nregion 1 4 int\n1 2 3 4\n"),
                    Contains("has no regions"));
  CHECK_THROWS_WITH(read(""), Contains("has no regions"));
}

TEST_CASE("regions of a .vtu are cell data") {
  const Folder folder;
  const auto read = [&](const std::string& data) {
    return read_regions(folder.write("a.vtu", vtu(data)));
  };
  try {
    check(read("<CellData><DataArray type=\"Float32\" Name=\"heat\" format=\"ascii\">1 2 3"
               "</DataArray><DataArray type=\"Int64\" Name=\"gmsh:physical\" format=\"ascii\">"
               "8 9 10</DataArray></CellData>"),
          {8, 8}, {9}, {10});
  } catch (const plexway::NotBuiltError&) {
    return;
  }
  CHECK_THROWS_WITH(read(""), Contains("has no regions"));
  CHECK_THROWS_WITH(read("<CellData><DataArray type=\"Int64\" Name=\"region\" format=\"ascii\">"
                         "8 9</DataArray></CellData>"),
                    Contains("region"));
}

}  // namespace regions_test
