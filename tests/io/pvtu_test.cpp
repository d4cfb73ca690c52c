#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/pvtu.hpp>

#include "folder.hpp"

namespace plexway::pvtu_test {

namespace {

/// As ParaView writes one: ids that its point data name, and the neighbour's cell as a ghost.
std::string part(const std::string& point_data, const std::string& cell_data,
                 const std::string& types = "5 9") {
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      )" +
         point_data +
         R"(
      )" +
         cell_data +
         R"(
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0 0 0  1 0 0  1 1 0  0 1 0  2 0 0
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii">1 4 2 0 1 2 3</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3 7</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">)" +
         types + R"(</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";
}
std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values +
         "</DataArray>";
}
using Corners = std::vector<std::array<Index, 3>>;

}  // namespace

TEST_CASE("a .pvtu names its files beside it") {
  const ::testing::Folder folder;
  const auto file = folder.write("d.pvtu", R"(<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="0.1">
  <PUnstructuredGrid GhostLevel="1">
    <PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>
    <Piece Source="d/d_0.vtu"/>
    <Piece Source="d/a&amp;b.vtu"/>
  </PUnstructuredGrid>
</VTKFile>
)");
  CHECK(io::read_pvtu(file) == std::vector{folder.at("d/d_0.vtu"), folder.at("d/a&b.vtu")});
  const auto refused = [&](const std::string& text, const std::string& why) {
    const auto wrong = folder.write("wrong.pvtu", text);
    CHECK_THROWS_WITH(io::read_pvtu(wrong), Catch::Contains("wrong.pvtu") && Catch::Contains(why));
    CHECK_THROWS_AS(io::read_pvtu(wrong), InputError);
  };
  refused("<VTKFile type=\"PPolyData\"/>", "'PPolyData'");
  refused("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid/></VTKFile>", "no pieces");
  refused(
      "<VTKFile "
      "type=\"PUnstructuredGrid\"><PUnstructuredGrid>\n<Piece/></PUnstructuredGrid></VTKFile>",
      "wrong.pvtu:2: a piece has no Source");
  refused(
      "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a.vtu\"/>\n"
      "<Piece Source=\"./a.vtu\"/></PUnstructuredGrid></VTKFile>",
      "wrong.pvtu:2: names './a.vtu' a second time");
  refused("<VTKFile", "the XML is broken");
  CHECK_THROWS_AS(io::read_pvtu(folder.at("none.pvtu")), InputError);
}

TEST_CASE("a part has the ids of its points, and not its neighbours' cells") {
  const ::testing::Folder folder;
  const auto read = [&](const std::string& text) {
    return io::read_surface_part(folder.write("part.vtu", text), 3);
  };
  const SurfaceFilePart plain = read(part("", ""));
  CHECK(plain.number == 3);
  CHECK(plain.name.ends_with("part.vtu"));
  CHECK(plain.ids.empty());
  CHECK(plain.positions.size() == 5);
  CHECK(plain.triangles == Corners{{1, 4, 2}, {0, 1, 2}, {0, 2, 3}});

  const std::vector<std::uint64_t> ids = {10, 11, 12, 13, 9'000'000'000};
  const std::string numbers = "10 11 12 13 9000000000";
  for (const std::string& data :
       {"<PointData GlobalIds=\"Ids\">" + array("Int64", "Ids", numbers) + "</PointData>",
        "<PointData>" + array("UInt32", "original", "0 1 2 3 4") +
            array("Int64", "GlobalPointIds", numbers) + "</PointData>",
        "<PointData>" + array("UInt64", "original", numbers) + "</PointData>"})
    CHECK(read(part(data, "")).ids == ids);
  CHECK(read(part("<PointData>" + array("UInt64", "original", numbers) + "</PointData>", ""))
            .ids_name == "original");
  // A duplicate cell (1), not one that is refined or hidden (8, 32); levels as they were.
  const auto with_ghosts = [&](const std::string& name, const std::string& marks) {
    return read(part("", "<CellData>" + array("UInt8", name, marks) + "</CellData>")).triangles;
  };
  CHECK(with_ghosts("vtkGhostType", "1 0") == Corners{{0, 1, 2}, {0, 2, 3}});
  CHECK(with_ghosts("vtkGhostType", "32 8").size() == 3);
  CHECK(with_ghosts("vtkGhostLevels", "0 2") == Corners{{1, 4, 2}});
  CHECK(with_ghosts("vtkGhostType", "1 1").empty());

  const auto refused = [&](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(read(text), Catch::Contains("part.vtu") && Catch::Contains(why));
  };
  refused(part("<PointData>" + array("Int64", "original", "0 1 2 -3 4") + "</PointData>", ""),
          "is -3");
  refused(part("<PointData>" + array("Int64", "original", "0 1 2") + "</PointData>", ""),
          "5 numbers of points");
  refused(part("", "", "5 10"), "cells besides polygons");
}

}  // namespace plexway::pvtu_test
