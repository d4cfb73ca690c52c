#include "tets_testing.hpp"

namespace solids_text_test {

using namespace io_testing;
using Catch::Contains;

namespace {

constexpr auto parse_gmsh = io_testing::tets<plexway::io::parse_gmsh>;

/// Tags of the vertices, in no order.
constexpr std::array<int, 6> sparse = {17, 3, 900000000, 5, 4, 1};

std::string ascii2(const std::string& elements) {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"all # of it\"\n"
      "$EndPhysicalNames\n$Nodes\n6\n";
  for (std::size_t i = 0; i < 6; ++i) text += std::to_string(sparse[i]) + " " + two_rows[i] + "\n";
  return text + "$EndNodes\n$Elements\n" + elements + "$EndElements\n$NodeData\n1\n";
}

std::string ascii4(const std::string& elements) {
  std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 1\n1 0 0 0 0\n"
      "$EndEntities\n$Nodes\n3 6 1 900000000\n2 1 1 2\n17\n3\n";
  text += two_rows[0] + " .5 .25\n" + two_rows[1] + " 0 0\n0 4 0 0\n3 1 0 4\n900000000\n5\n4\n1\n";
  for (std::size_t i = 2; i < 6; ++i) text += two_rows[i] + "\n";
  return text + "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
}

std::string binary2(bool big) {
  Packer nodes(big);
  for (std::size_t i = 0; i < 6; ++i) {
    nodes.put(std::int32_t{sparse[i]});
    for (const double c : two_positions[i]) nodes.put(c);
  }
  Packer elements(big);
  const auto put = [&](std::initializer_list<std::int32_t> numbers) {
    for (const std::int32_t n : numbers) elements.put(n);
  };
  put({2, 1, 2, /**/ 1, 0, 0, 17, 3, 5});                          // a triangle
  put({4, 1, 2, /**/ 2, 0, 0, 17, 3, 900000000, 5});               // a tetrahedron
  put({11, 1, 0, /**/ 3, 3, 17, 900000000, 1, 4, 4, 4, 4, 4, 4});  // a quadratic one
  return "$MeshFormat\n2.2 1 8\n" + Packer(big).put(std::int32_t{1}).bytes() +
         "\n$EndMeshFormat\n$Nodes\n6\n" + nodes.bytes() + "\n$EndNodes\n$Elements\n3\n" +
         elements.bytes() + "\n$EndElements\n";
}

std::string binary4(bool big) {
  Packer p(big);
  const auto ints = [&](std::initializer_list<std::int32_t> numbers) {
    for (const std::int32_t n : numbers) p.put(n);
  };
  const auto sizes = [&](std::initializer_list<std::uint64_t> numbers) {
    for (const std::uint64_t n : numbers) p.put(n);
  };
  sizes({2, 6, 1, 900000000});
  ints({1, 7, 1});
  sizes({1, 17});
  for (const double c : two_positions[0]) p.put(c);
  p.put(0.5);  // its place on the curve
  ints({3, 1, 0});
  sizes({5, 3, 900000000, 5, 4, 1});
  for (std::size_t i = 1; i < 6; ++i)
    for (const double c : two_positions[i]) p.put(c);
  const std::string nodes = p.bytes();
  Packer q(big);
  for (const std::uint64_t n : {3u, 3u, 1u, 3u}) q.put(n);
  for (const std::int32_t n : {2, 1, 2}) q.put(n);
  for (const std::uint64_t n : {1u, 1u, 17u, 3u, 5u}) q.put(n);
  for (const std::int32_t n : {3, 1, 4}) q.put(n);
  for (const std::uint64_t n : {1u, 2u, 17u, 3u, 900000000u, 5u}) q.put(n);
  for (const std::int32_t n : {3, 2, 11}) q.put(n);
  for (const std::uint64_t n : {1u, 3u, 3u, 17u, 900000000u, 1u, 4u, 4u, 4u, 4u, 4u, 4u}) q.put(n);
  return "$MeshFormat\n4.1 1 8\n" + Packer(big).put(std::int32_t{1}).bytes() +
         "\n$EndMeshFormat\n$Entities\n" + Packer(big).put(std::uint64_t{0}).bytes() +
         "\n$EndEntities\n$Nodes\n" + nodes + "\n$EndNodes\n$Elements\n" + q.bytes() +
         "\n$EndElements\n";
}

const std::string elements2 =
    "4\n1 15 2 0 1 17\n2 2 3 0 1 4 17 3 5\n3 4 2 0 1 17 3 900000000 5\n"
    "4 11 0 3 17 900000000 1 4 4 4 4 4 4\n";
const std::string elements4 =
    "3 3 1 9\n0 1 15 1\n1 17\n3 1 4 1\n3 17 3 900000000 5\n"
    "3 2 11 1\n4 3 17 900000000 1 4 4 4 4 4 4\n";

std::string gmsh_complaint(std::string_view bytes) { return complaint(parse_gmsh, bytes); }

}  // namespace

TEST_CASE("gmsh: ascii, sparse tags, other elements, quadratic tetrahedra") {
  check_two(parse_gmsh(ascii2(elements2), "mesh"));
  check_two(parse_gmsh(ascii4(elements4), "mesh"));
}

TEST_CASE("gmsh: binary of either byte order") {
  for (const bool big : {false, true}) {
    check_two(parse_gmsh(binary2(big), "mesh"));
    check_two(parse_gmsh(binary4(big), "mesh"));
  }
}

TEST_CASE("gmsh: binary files cut off anywhere are refused") {
  for (const std::string& whole : {binary2(false), binary4(true)}) {
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
      const std::string message = gmsh_complaint(whole.substr(0, size));
      REQUIRE_THAT(message, Catch::StartsWith("mesh:"));
    }
  }
}

TEST_CASE("gmsh: without tetrahedra it says what there is") {
  CHECK(gmsh_complaint(ascii2("3\n1 2 0 17 3 5\n2 9 0 17 3 5 4 4 4\n3 15 0 1\n")) ==
        "mesh: has no tetrahedra; it has 2 triangles");
  CHECK(gmsh_complaint(ascii4("1 2 1 2\n2 1 3 2\n1 17 3 4 5\n2 17 3 4 5\n")) ==
        "mesh: has no tetrahedra; it has 4 triangles");
  for (const std::string& unknown :
       {ascii2("1\n9 999 2 0 1 8 8 8\n"), ascii4("1 1 1 9\n2 1 999 1\n7 1 2 3 4 5 6\n")})
    CHECK(
        gmsh_complaint(unknown) ==
        "mesh: has 1 elements of an unknown type, which are not read: a domain without them would "
        "have holes");
}

TEST_CASE("gmsh: what is wrong is named with its line") {
  CHECK(gmsh_complaint("") == "mesh:1: expected $MeshFormat, found the end of the file");
  CHECK(gmsh_complaint("$NOD\n") ==
        "mesh:1: version 1 of .msh is not read; save it as version 4.1 or 2.2");
  CHECK(gmsh_complaint("$MeshFormat\n4 0 8\n") ==
        "mesh:2: this version of .msh is not read; save it as version 4.1 or 2.2");
  CHECK(gmsh_complaint("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n") ==
        "mesh:4: the file ends before its section $Nodes");
  CHECK(gmsh_complaint("$MeshFormat\n2.2 1 8\nabcd\n$EndMeshFormat\n") ==
        "mesh: byte 24: the number that tells the order of bytes is not 1");
  CHECK(gmsh_complaint(ascii2("1\n1 4 0 17 3 5 6\n")) ==
        "mesh:19: tetrahedron 1 names node 6, which is not among the 6 nodes");
  CHECK(gmsh_complaint(ascii4("1 1 1 1\n3 1 4 1\n1 17 3 5 18\n")) ==
        "mesh:29: tetrahedron 1 names node 18, which is not among the 6 nodes");
  CHECK(gmsh_complaint(ascii2("2\n1 4 0 17 3 5 1\n")) ==
        "mesh:20: the element's number is not a whole number: '$EndElements'");
  CHECK(gmsh_complaint(ascii2("1\n1 4 0 17 3 5 1\n2 4 0 17 3 5 1\n")) ==
        "mesh:20: expected $EndElements, found '2'");
  CHECK(gmsh_complaint(ascii2("1\n1 4 0 17 3 5 1 1\n")) == "mesh:19: the line goes on with '1'");
  CHECK(gmsh_complaint(replaced(ascii2(elements2), "\n3 1 0 0", "\n17 1 0 0")) ==
        "mesh:16: two nodes have the tag 17");
  CHECK(gmsh_complaint(replaced(ascii2(elements2), "\n3 1 0 0", "\n3 1 nan 0")) ==
        "mesh:11: coordinate y is not finite: 'nan'");
  CHECK(gmsh_complaint(replaced(ascii2(elements2), "$Nodes\n6", "$Nodes\n60000000")) ==
        "mesh:9: there should be 60000000 nodes, but only 210 bytes follow");
  CHECK(gmsh_complaint(replaced(ascii4(elements4), "\n3 6 1 9", "\n3 7 1 9")) ==
        "mesh:25: the blocks hold 6 nodes, but the section states 7");
  CHECK(gmsh_complaint(replaced(ascii4(elements4), "3 3 1 9", "3 2 1 9")) ==
        "mesh:32: the blocks hold more than the 2 elements that the section states");
  CHECK(gmsh_complaint(replaced(ascii4(elements4), "3 3 1 9", "2 3 1 9")) ==
        "mesh:32: the blocks hold 2 elements, but the section states 3");
  CHECK(gmsh_complaint(replaced(ascii2(elements2), "$Nodes", "$ParametricNodes")) ==
        "mesh:8: $ParametricNodes are not read; save the file without parametric coordinates");
  CHECK_THAT(gmsh_complaint(replaced(ascii2(elements2), "$PhysicalNames", "$Names")),
             Contains("the file ends before '$EndNames'"));
}

TEST_CASE("gmsh: what is wrong in bytes is named with the byte") {
  const std::string good = binary2(false);
  const auto nodes = good.find("$Nodes\n6\n") + 9;
  std::string bad = good;
  bad.replace(nodes + 4, 8, Packer(false).put(0.0 / 0.0).bytes());
  CHECK(gmsh_complaint(bad) ==
        "mesh: byte " + std::to_string(nodes + 4) + ": coordinate x is not finite");
  const auto elements = good.find("$Elements\n3\n") + 12;
  bad = good;
  bad.replace(elements, 4, Packer(false).put(std::int32_t{999}).bytes());
  CHECK(gmsh_complaint(bad) == "mesh: byte " + std::to_string(elements + 4) +
                                   ": elements of type 999, whose size is not known; save the "
                                   "file as ascii");
}

namespace {

constexpr auto parse_medit = io_testing::tets<plexway::io::parse_medit>;

const std::string medit_head = "MeshVersionFormatted 2\nDimension 3\n";

std::string vertices() {
  std::string text = "Vertices\n6\n";
  for (const std::string& row : two_rows) text += row + " 7\n";
  return text;
}

const std::string tetrahedra = "Tetrahedra\n2\n1 2 3 4 1\n2 1 3 6 2\n";

std::string medit_complaint(std::string_view text) { return complaint(parse_medit, text); }

}  // namespace

TEST_CASE(
    "medit: dimension on the same line or the next, comments, any order, with or without end") {
  check_two(parse_medit(medit_head + vertices() + tetrahedra + "End\n", "mesh"));
  check_two(parse_medit("# by hand\nMeshVersionFormatted\n1\n\nDimension\n3\n# points\n" +
                            vertices() + "# cells\n" + tetrahedra,
                        "mesh"));
  check_two(parse_medit(" MeshVersionFormatted 2 Dimension 3 " + tetrahedra + vertices() + "\nEnd",
                        "mesh"));
  check_two(parse_medit("MeshVersionFormatted 3\r\n" + vertices() +
                            "\tTetrahedra 2 1 2 3 4 1 2\n"
                            "1 3 6 2\n",
                        "mesh"));
}

TEST_CASE("medit: other sections are passed over") {
  check_two(parse_medit(medit_head +
                            "Geometry\n\"Vertices 3\"\n"
                            "Corners 2\n1\n2\nRidges\n1\n1\nRequiredVertices 1 3\n"
                            "Normals\n1\n0 0 1\nNormalAtVertices 1\n1 1\n" +
                            vertices() +
                            "Edges 1\n1 2 0\nTriangles\n2\n1 2 3 5\n1 2 4 5\nQuadrilaterals 1\n"
                            "1 2 3 4 0\nSomethingNew\n2\n1 2 nan\n-3 4 .5\n" +
                            tetrahedra + "Hexahedra 0\nPrisms\n0\nEnd\n",
                        "mesh"));
}

TEST_CASE("medit: several sections of tetrahedra, quadratic ones among them") {
  const auto solid = parse_medit(
      medit_head + vertices() + "Tetrahedra 1\n1 2 3 4 0\nTetrahedraP2 1\n2 1 3 6 5 5 5 5 5 5 0\n",
      "m");
  check_two(solid);
}

TEST_CASE("medit: without tetrahedra it says what there is") {
  CHECK(medit_complaint(medit_head + vertices() +
                        "Triangles 1\n1 2 3 0\nEdges 2\n1 2 0 2 3 0\nEnd\n") ==
        "mesh: has no tetrahedra; it has 1 triangles, 2 lines");
  CHECK(medit_complaint(medit_head + vertices() + "Tetrahedra 0\n") ==
        "mesh: has no tetrahedra; it has no cells at all");
}

TEST_CASE("medit: what is wrong is named with its line") {
  CHECK(medit_complaint("") == "mesh:1: expected MeshVersionFormatted, found ''");
  CHECK(medit_complaint("solid x\n") == "mesh:1: expected MeshVersionFormatted, found 'solid'");
  CHECK(medit_complaint("MeshVersionFormatted 1\nDimension 4\n") ==
        "mesh:2: the dimension is 4; 2 and 3 are read");
  CHECK(medit_complaint(medit_head + tetrahedra) ==
        "mesh:7: the file ends without a section Vertices");
  CHECK(medit_complaint(medit_head + vertices() + "Tetrahedra\n1\n1 2 3 7 0\n") ==
        "mesh:13: tetrahedron 1 names vertex 7, but the file has 6 vertices");
  CHECK(medit_complaint(medit_head + "Tetrahedra\n1\n1 2 3 0 0\n" + vertices()) ==
        "mesh:5: tetrahedron 1 names vertex 0, but the file has 6 vertices");
  CHECK(medit_complaint(medit_head + "Vertices 2\n0 0 0 0\n1 inf 0 0\n") ==
        "mesh:5: coordinate y is not finite: 'inf'");
  CHECK(medit_complaint(medit_head + "Vertices 2\n0 0 0 0\n10 20\n") ==
        "mesh:6: the file ends before coordinate z");
  CHECK(medit_complaint(medit_head + "Vertices\n999999999\n0 0 0 0\n") ==
        "mesh:4: there should be 999999999 vertices, but only 9 bytes follow");
  CHECK(medit_complaint(medit_head + "Vertices\n-1\n") ==
        "mesh:4: the number of vertices is negative: -1");
  CHECK(medit_complaint(medit_head + vertices() + vertices()) ==
        "mesh:11: a second section Vertices");
  CHECK(medit_complaint(medit_head + vertices() +
                        "Triangles\n2\n1 2 3 0\nTetrahedra\n1\n1 2 3 4 0\n") ==
        "mesh:14: expected the last of the Triangles, found 'Tetrahedra'");
  CHECK(medit_complaint(medit_head + vertices() + "Triangles\n1\n1 2 3 0\n1 2 4 0\n") ==
        "mesh:14: expected a keyword, found '1'; the section before it holds more than its count "
        "says");
  CHECK(medit_complaint(medit_head + vertices() + "Tetrahedra\n1\n1 2 3.5 4 0\n") ==
        "mesh:13: a vertex of the tetrahedron is not a whole number: '3.5'");
}

namespace {

constexpr auto parse_vtk = io_testing::tets<plexway::io::parse_vtk>;

std::string points_text() {
  std::string text = "POINTS 6 double\n";
  for (const std::string& row : two_rows) text += row + " ";
  return text + "\n";
}

std::string head(const std::string& version, const std::string& mode) {
  return "# vtk DataFile Version " + version + "\nwhat: ever # it is\n" + mode +
         "\nDATASET UNSTRUCTURED_GRID\n";
}

const std::string cells3 = "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 0 2 5\n";
const std::string types3 = "CELL_TYPES 3\n5 10\n10\n";
const std::string cells5 =
    "CELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3 1 0\n2 "
    "5\n";

std::string ascii3() { return head("3.0", "ASCII") + points_text() + cells3 + types3; }
std::string ascii5() { return head("5.1", "ASCII") + points_text() + cells5 + types3; }

template <class Real, class Index>
std::string binary(bool version5, const std::string& real, const std::string& index) {
  Packer points(true);
  for (const auto& p : two_positions)
    for (const double c : p) points.put(static_cast<Real>(c));
  Packer types(true);
  for (const std::int32_t t : {5, 10, 10}) types.put(t);
  std::string text = head(version5 ? "5.1" : "2.0", "BINARY") +
                     "FIELD FieldData 2\nTIME 1 1 double\n" + Packer(true).put(0.5).bytes() +
                     "\nMETADATA\nINFORMATION 0\n\nCYCLE 3 2 short\n" + std::string(12, '\n') +
                     "\nPOINTS 6 " + real + "\n" + points.bytes() +
                     "\nMETADATA\nINFORMATION 1\nNAME L2_NORM LOCATION vtk\nDATA 2 0 1\n \n";
  Packer cells(true);
  if (version5) {
    for (const std::int64_t i : {0, 3, 7, 11}) cells.put(static_cast<Index>(i));
    text += "\nCELLS 4 11\nOFFSETS " + index + "\n" + cells.bytes();
    Packer connectivity(true);
    for (const std::int64_t i : {0, 1, 2, 0, 1, 2, 3, 1, 0, 2, 5})
      connectivity.put(static_cast<Index>(i));
    text += "\nCONNECTIVITY " + index + "\n" + connectivity.bytes();
  } else {
    for (const std::int32_t i : {3, 0, 1, 2, 4, 0, 1, 2, 3, 4, 1, 0, 2, 5}) cells.put(i);
    text += "\nCELLS 3 14\n" + cells.bytes();
  }
  return text + "\nCELL_TYPES 3\n" + types.bytes() + "\nCELL_DATA 3\n";
}

std::string vtk_complaint(std::string_view bytes) { return complaint(parse_vtk, bytes); }

}  // namespace

TEST_CASE("vtk: ascii, both layouts of cells, any case, data behind the grid") {
  for (const std::string& text : {ascii3(), ascii5()}) {
    check_two(parse_vtk(text, "mesh"));
    check_two(parse_vtk(text + "POINT_DATA 6\nSCALARS d float\nnan\n", "mesh"));
    check_two(parse_vtk(replaced(text, "DATASET UNSTRUCTURED_GRID", "dataset Unstructured_Grid"),
                        "mesh"));
    check_two(parse_vtk(replaced(text, "\nCELLS",
                                 "\nMETADATA\nINFORMATION 0\n\nFIELD f 1\nTIME 1 1 double\n7\n"
                                 "CELLS"),
                        "mesh"));
  }
}

TEST_CASE("vtk: binary, numbers of any size") {
  check_two(parse_vtk(binary<double, std::int64_t>(false, "double", ""), "mesh"));
  check_two(parse_vtk(binary<float, std::int64_t>(false, "float", ""), "mesh"));
  check_two(parse_vtk(binary<double, std::int64_t>(true, "double", "vtktypeint64"), "mesh"));
  check_two(parse_vtk(binary<float, std::int32_t>(true, "float", "int"), "mesh"));
  check_two(parse_vtk(binary<float, std::uint8_t>(true, "float", "unsigned_char"), "mesh"));
}

TEST_CASE("vtk: quadratic tetrahedra lend their corners") {
  const std::string text = head("3.0", "ASCII") + points_text() +
                           "CELLS 2 16\n4 0 1 2 3\n10 1 0 2 5 4 4 4 4 4 4\nCELL_TYPES 2\n10 24\n";
  check_two(parse_vtk(text, "mesh"));
}

TEST_CASE("vtk: binary files cut off anywhere are refused") {
  const std::string whole = binary<double, std::int64_t>(true, "double", "vtktypeint64");
  const auto end = whole.find("\nCELL_DATA");
  for (std::size_t size = 0; size < end; ++size)
    REQUIRE_THAT(vtk_complaint(whole.substr(0, size)), Catch::StartsWith("mesh:"));
}

TEST_CASE("vtk: without tetrahedra it says what there is") {
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10\n10", "\n5 9\n9")) ==
        "mesh: has no tetrahedra; it has 5 triangles");
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10\n10", "\n5 9\n41")) ==
        "mesh: has 1 sets of points, which are not read: a domain without them would have holes");
  CHECK(vtk_complaint("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n") ==
        "mesh:5: the file has no POINTS");
}

TEST_CASE("vtk: what is wrong is named with its line") {
  CHECK(vtk_complaint("") == "mesh:1: expected '# vtk DataFile Version', found ''");
  CHECK(vtk_complaint("# vtk DataFile Version 6.0\nx\nASCII\n") ==
        "mesh:1: this version of .vtk is not read; those up to 5.1 are");
  CHECK(vtk_complaint("# vtk DataFile Version 3.0\nx\nxml\n") ==
        "mesh:3: expected ASCII or BINARY, found 'xml'");
  CHECK(vtk_complaint(head("3.0", "ASCII")) == "mesh:5: the file has no POINTS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + points_text()) == "mesh:7: the file has no CELLS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + points_text() + cells3 + "POINT_DATA 6\n") ==
        "mesh:11: the file has no CELL_TYPES");
  CHECK(vtk_complaint(head("3.0", "ASCII") + cells3) == "mesh:5: CELLS come before POINTS");
  CHECK(vtk_complaint(head("3.0", "ASCII") + "VERTICES 3\n") ==
        "mesh:5: expected POINTS, CELLS or CELL_TYPES, found 'VERTICES'");
  CHECK(vtk_complaint(replaced(ascii3(), "9 9 9", "9 nan 9")) ==
        "mesh:6: coordinate y is not finite: 'nan'");
  CHECK(vtk_complaint(replaced(ascii3(), "4 1 0 2 5", "4 1 0 2 6")) ==
        "mesh:10: a cell names point 6, but there are 6 points");
  CHECK(vtk_complaint(replaced(ascii5(), "2 5\n", "2 -1\n")) ==
        "mesh:12: a cell names point -1, but there are 6 points");
  CHECK(vtk_complaint(replaced(ascii3(), "4 1 0 2 5", "5 1 0 2 5")) ==
        "mesh:10: cell 2 has 5 points, but only 4 are left for it");
  CHECK(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 15")) ==
        "mesh:10: the cells are made of 14 numbers, not of 15");
  CHECK(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 2")) ==
        "mesh:7: 3 cells cannot be made of 2 numbers");
  CHECK(vtk_complaint(replaced(ascii3(), "CELL_TYPES 3", "CELL_TYPES 2")) ==
        "mesh:11: there are 2 types for 3 cells");
  CHECK(vtk_complaint(replaced(ascii3(), "\n5 10", "\n10 10")) ==
        "mesh:12: cell 0, a tetrahedron of type 10, has 3 points");
  CHECK(vtk_complaint(replaced(ascii5(), "0 3 7 11", "0 7 3 11")) ==
        "mesh:9: offset 2 is 3 after 7, of 11");
  CHECK(vtk_complaint(replaced(ascii5(), "0 3 7 11", "0 3 7 10")) ==
        "mesh:9: the last offset is 10, but the cells have 11 points");
  CHECK(vtk_complaint(replaced(ascii3(), "POINTS 6 double", "POINTS 6 words")) ==
        "mesh:5: numbers of type 'words' are not read");
  CHECK(vtk_complaint(replaced(ascii3(), "POINTS 6 double", "POINTS 99999 double")) ==
        "mesh:5: there should be 99999 points, but only " +
            std::to_string(ascii3().size() - ascii3().find(" double")) + " bytes follow");
  CHECK_THAT(vtk_complaint(replaced(ascii3(), "CELLS 3 14", "CELLS 3 99999999999999")),
             Contains("mesh:7: there should be 99999999999999"));
}

}  // namespace solids_text_test
