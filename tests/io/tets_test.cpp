#include <algorithm>
#include <limits>

#include <plexway/io/labels.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>

#include "exact_data.hpp"
#include "io/io_testing.hpp"
#include "tets_testing.hpp"

namespace tets_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::read_tets;
using plexway::io::Tets;
using plexway::io::write_tets;

namespace {

std::string refusal(const std::filesystem::path& file) {
  return message_of([&] { read_tets(file); });
}

/// Reads, unless this build cannot read that format.
bool read_if_built(const std::filesystem::path& file, Tets& solid) {
  try {
    solid = read_tets(file);
  } catch (const plexway::NotBuiltError&) {
    return false;
  }
  return true;
}

bool same_bits(const Positions& a, const Positions& b) {
  const auto bits = [](const std::array<double, 3>& p) {
    return std::array{std::bit_cast<std::uint64_t>(p[0]), std::bit_cast<std::uint64_t>(p[1]),
                      std::bit_cast<std::uint64_t>(p[2])};
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const auto& p, const auto& q) { return bits(p) == bits(q); });
}

}  // namespace

TEST_CASE("tets: what is written reads back to the last bit") {
  Tets large;  // more than a buffer's worth
  for (std::uint32_t i = 0; i < 20000; ++i) {
    large.positions.push_back({i * 0.1, i % 2 * 1.0, 1.0 / (i + 1)});
    if (i >= 3) large.tets.push_back({i - 3, i - 2, i - 1, i});
  }
  for (const Tets& solid : {awkward_solid(), large})
    for (const char* name : {"a.node", "a.ele", "A.NODE", "A.ELE", "a.mesh", "a.msh", "a.vtu",
                             "a.vtk", "A.MESH", "A.Vtk"}) {
      INFO(name);
      const Folder folder;
      write_tets(folder.path() / name, solid);
      Tets back;
      if (!read_if_built(folder.path() / name, back)) continue;
      CHECK(same_bits(back.positions, solid.positions));
      CHECK(back.tets == solid.tets);
      const bool pair = std::string_view(name).substr(2, 1).find_first_of("nNeE") == 0;
      CHECK(folder.files() == (pair ? 2 : 1));
    }
  CHECK(plexway::io::tet_extensions().size() == 6);
}

TEST_CASE("tets: either file of TetGen's pair finds the other") {
  const Folder folder;
  folder.write("a.1.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
  folder.write("a.1.ele", "1 4 0\n1 4 3 2 1\n");
  for (const char* name : {"a.1.node", "a.1.ele"}) {
    const Tets solid = read_tets(folder.path() / name);
    CHECK(solid.positions.size() == 4);
    CHECK(solid.tets == TetList{{3, 2, 1, 0}});
  }
  const auto node = folder.write("b.node", "1 3\n");
  const auto ele = folder.write("c.ele", "1 4\n");
  CHECK(refusal(node) == node.string() + ": holds only the vertices; the tetrahedra must lie " +
                             "beside it in " + (folder.path() / "b.ele").string());
  CHECK(refusal(ele) == ele.string() + ": holds only the tetrahedra; the vertices must lie " +
                            "beside it in " + (folder.path() / "c.node").string());
  CHECK(refusal(folder.path() / "d.ele") == (folder.path() / "d.ele").string() + ": no such file");
}

TEST_CASE("tets: files that cannot be read at all") {
  const Folder folder;
  const auto path = folder.path().string();
  CHECK(refusal(folder.path() / "none.mesh") == path + "/none.mesh: no such file");
  CHECK(refusal(folder.write("a.stl", "x")) ==
        path +
            "/a.stl: neither ascii STL (no 'solid' at its start) nor binary (1 bytes; the header "
            "alone takes 84)");
  CHECK(refusal(folder.write("a.meshb", "x")) ==
        path +
            "/a.meshb: a .meshb is not read; save it as ascii .mesh, with 'transmesh' of libMeshb");
  CHECK(refusal(folder.write("a.msh", "")) == path + "/a.msh: is empty");
  CHECK(refusal(folder.path()) == path + ": is a directory, not a file");
}

TEST_CASE("tets: what cannot be written") {
  const Folder folder;
  const auto misuse = [&](const char* name, const Tets& solid) {
    return message_of<plexway::UsageError>([&] { write_tets(folder.path() / name, solid); });
  };
  CHECK_THAT(misuse("a.off", awkward_solid()), Contains("unknown extension '.off'"));
  Tets solid = awkward_solid();
  solid.tets[1][2] = 5;
  CHECK(misuse("a.mesh", solid) == "write_tets: tetrahedron 1 names vertex 5 of 5");
  solid = awkward_solid();
  solid.positions[3][1] = std::numeric_limits<double>::infinity();
  CHECK(misuse("a.vtu", solid) == "write_tets: vertex 3 has a coordinate that is not finite");
  CHECK(folder.files() == 0);

  // If one of the pair cannot be written, the other is not either.
  std::filesystem::create_directory(folder.path() / "p.ele");
  CHECK(message_of<plexway::Error>([&] {
          write_tets(folder.path() / "p.node", awkward_solid());
        }) == "cannot write " + (folder.path() / "p.ele").string() + ": Is a directory");
  CHECK(folder.files() == 1);
}

TEST_CASE("tets: the solids with known answers") {
  struct Known {
    const char* name;
    std::size_t vertices;
    std::size_t tets;
    double volume;  ///< of what was meshed; 0: not a simple number
  };
  for (const Known& known :
       {Known{"cube_10k", 2822, 11608, 1}, Known{"maze_10k", 4757, 17579, 0},
        Known{"notch_10k", 3193, 12726, 0.97}, Known{"notch_100k", 18591, 91892, 0.97},
        Known{"cavity_10k", 3681, 14963, 0}, Known{"cavity_100k", 21157, 103023, 0}}) {
    INFO(known.name);
    const auto file = plexway::testing::exact_file("solids", std::string(known.name) + ".ele");
    if (file.empty()) continue;
    const Tets solid = read_tets(file);
    CHECK(solid.positions.size() == known.vertices);
    CHECK(solid.tets.size() == known.tets);
    double volume = 0;
    for (const auto& [a, b, c, d] : solid.tets) {
      std::array<std::array<double, 3>, 3> m{};
      for (std::size_t k = 0; k < 3; ++k)
        m[k] = {solid.positions[b][k] - solid.positions[a][k],
                solid.positions[c][k] - solid.positions[a][k],
                solid.positions[d][k] - solid.positions[a][k]};
      volume += std::abs(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])) /
                6;
    }
    if (known.volume != 0) CHECK(volume == Approx(known.volume).epsilon(1e-9));
  }
}

namespace {

/// `items` lines, numbered from `base`, each with `tail` at its end.
std::string numbered(const std::vector<std::string>& items, int base, const std::string& tail) {
  std::string text;
  for (const std::string& item : items) text += std::to_string(base++) + "  " + item + tail + "\n";
  return text;
}

std::string node_text(int base, const std::string& head = "6 3 0 0\n",
                      const std::string& tail = "") {
  return head + numbered({two_rows.begin(), two_rows.end()}, base, tail);
}

std::string ele_text(int base, const std::string& head = "2 4 0\n", const std::string& tail = "") {
  return head + numbered(base == 0 ? std::vector<std::string>{"0 1 2 3", "1 0 2 5"}
                                   : std::vector<std::string>{"1 2 3 4", "2 1 3 6"},
                         base, tail);
}

plexway::io::Tets parse(const std::string& node, const std::string& ele) {
  return plexway::io::parse_node_ele({node, "a.node"}, {ele, "a.ele"});
}

std::string pair_complaint(const std::string& node, const std::string& ele) {
  return complaint([&](std::string_view, std::string_view) { return parse(node, ele); }, "");
}

}  // namespace

TEST_CASE("node and ele: numbered from 0 or 1, attributes, markers and comments") {
  for (const int base : {0, 1}) {
    check_two(parse(node_text(base), ele_text(base)));
    check_two(parse(node_text(base, "# solid\n\n 6 3 2 1 # head\n", " 0.5 nan 1 # end"),
                    ele_text(base, "2  4  1\r\n", " -7\r") + "# Generated by hand\n"));
    check_two(parse(node_text(base, "6\n"), ele_text(base, "2\n")));
  }
  check_two(parse(node_text(0), "2 4 0\n1 0 1 2 3\n2 1 0 2 5\n"));  // each file counts by itself
}

TEST_CASE("node and ele: of ten nodes the first four are the corners") {
  check_two(parse(node_text(0), ele_text(0, "2 10 0\n", " 4 4 4 4 4 4")));
  CHECK(pair_complaint(node_text(0), ele_text(0, "2 10 0\n", " 4 4 4 4 4 6")) ==
        "a.ele:2: tetrahedron 0 names vertex 6, but the file has 6 vertices, numbered from 0");
  CHECK(pair_complaint(node_text(0), ele_text(0, "2 5 0\n")) ==
        "a.ele:1: cells have 5 nodes; a tetrahedron has 4, or 10 when it is quadratic");
}

TEST_CASE("node and ele: what is wrong is named with its file and line") {
  CHECK(pair_complaint("", ele_text(0)) ==
        "a.node:1: expected the number of vertices, found the end of the file");
  CHECK(pair_complaint(node_text(0), "# nothing\n") ==
        "a.ele:2: expected the number of tetrahedra, found the end of the file");
  CHECK(pair_complaint("6 2 0 0\n", "") == "a.node:1: the dimension is 2; a solid needs 3");
  CHECK(pair_complaint("-6 3 0 0\n", "") == "a.node:1: the number of vertices is negative: -6");
  CHECK(pair_complaint(node_text(2), ele_text(0)) ==
        "a.node:2: the number of the vertex is 2; the first must be 0 or 1");
  CHECK(pair_complaint("2 3 0 0\n0 0 0 0\n2 0 0 0\n", "") ==
        "a.node:3: the number of the vertex is 2, but it should count on to 1");
  CHECK(pair_complaint("2 3 0 0\n0 0 0 0\n1 0 nan 0\n", "") ==
        "a.node:3: coordinate y is not finite: 'nan'");
  CHECK(pair_complaint("2 3 0 0\n0 0 0 0\n1 0 0\n\n\n", "") ==
        "a.node:3: the line ends before coordinate z");
  CHECK(pair_complaint("2 3 0 0\n0 0.00 0.00 0.00\n", "") ==
        "a.node:3: the file ends after 1 of 2 vertices");
  CHECK(pair_complaint("1 3 0 0\n0 0 0 0\n1 0 0 0\n", "") ==
        "a.node:3: the first line says 1 vertices, but the file goes on with '1'");
  CHECK(pair_complaint(node_text(1), ele_text(0)) ==
        "a.ele:2: tetrahedron 0 names vertex 0, but the file has 6 vertices, numbered from 1");
  CHECK(pair_complaint(node_text(0), "2 4 0\n0 0 1 2 3\n1 0 1 2 -1\n") ==
        "a.ele:3: tetrahedron 1 names vertex -1, but the file has 6 vertices, numbered from 0");
  CHECK(pair_complaint(node_text(0), "2 4 0\n0 0 1 2 3\n") ==
        "a.ele:1: there should be 2 tetrahedra, but only 13 bytes follow");
  CHECK(pair_complaint(node_text(0), "1 4 0\n0 0 1 2\n0 0 0 0\n") ==
        "a.ele:2: the line ends before a vertex of the tetrahedron");
  CHECK(pair_complaint(node_text(0), "0 4 0\n") ==
        "a.ele: has no tetrahedra; it has no cells at all");
}

TEST_CASE("node and ele: counts that the file cannot hold are refused before any room is made") {
  CHECK_THAT(pair_complaint("4294967295 3 0 0\n0 0 0 0\n", ""),
             Contains("a.node:1: there should be 4294967295 vertices, but only 13 bytes follow"));
  CHECK_THAT(pair_complaint("9223372036854775807 3 0 0\n", ""), Contains("there should be"));
  CHECK_THAT(pair_complaint(node_text(0), "9223372036854775807 10 0\n"),
             Contains("there should be"));
}

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

}  // namespace tets_test
