#include "tets_testing.hpp"

namespace medit_test {

using namespace io_testing;

namespace {

constexpr auto parse_medit = io_testing::tets<plexway::io::parse_medit>;

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";

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
  check_two(parse_medit(head + vertices() + tetrahedra + "End\n", "mesh"));
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
  check_two(parse_medit(head +
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
      head + vertices() + "Tetrahedra 1\n1 2 3 4 0\nTetrahedraP2 1\n2 1 3 6 5 5 5 5 5 5 0\n", "m");
  check_two(solid);
}

TEST_CASE("medit: without tetrahedra it says what there is") {
  CHECK(medit_complaint(head + vertices() + "Triangles 1\n1 2 3 0\nEdges 2\n1 2 0 2 3 0\nEnd\n") ==
        "mesh: has no tetrahedra; it has 1 triangles, 2 lines");
  CHECK(medit_complaint(head + vertices() + "Tetrahedra 0\n") ==
        "mesh: has no tetrahedra; it has no cells at all");
}

TEST_CASE("medit: what is wrong is named with its line") {
  CHECK(medit_complaint("") == "mesh:1: expected MeshVersionFormatted, found ''");
  CHECK(medit_complaint("solid x\n") == "mesh:1: expected MeshVersionFormatted, found 'solid'");
  CHECK(medit_complaint("MeshVersionFormatted 1\nDimension 4\n") ==
        "mesh:2: the dimension is 4; 2 and 3 are read");
  CHECK(medit_complaint(head + tetrahedra) == "mesh:7: the file ends without a section Vertices");
  CHECK(medit_complaint(head + vertices() + "Tetrahedra\n1\n1 2 3 7 0\n") ==
        "mesh:13: tetrahedron 1 names vertex 7, but the file has 6 vertices");
  CHECK(medit_complaint(head + "Tetrahedra\n1\n1 2 3 0 0\n" + vertices()) ==
        "mesh:5: tetrahedron 1 names vertex 0, but the file has 6 vertices");
  CHECK(medit_complaint(head + "Vertices 2\n0 0 0 0\n1 inf 0 0\n") ==
        "mesh:5: coordinate y is not finite: 'inf'");
  CHECK(medit_complaint(head + "Vertices 2\n0 0 0 0\n10 20\n") ==
        "mesh:6: the file ends before coordinate z");
  CHECK(medit_complaint(head + "Vertices\n999999999\n0 0 0 0\n") ==
        "mesh:4: there should be 999999999 vertices, but only 9 bytes follow");
  CHECK(medit_complaint(head + "Vertices\n-1\n") ==
        "mesh:4: the number of vertices is negative: -1");
  CHECK(medit_complaint(head + vertices() + vertices()) == "mesh:11: a second section Vertices");
  CHECK(medit_complaint(head + vertices() + "Triangles\n2\n1 2 3 0\nTetrahedra\n1\n1 2 3 4 0\n") ==
        "mesh:14: expected the last of the Triangles, found 'Tetrahedra'");
  CHECK(medit_complaint(head + vertices() + "Triangles\n1\n1 2 3 0\n1 2 4 0\n") ==
        "mesh:14: expected a keyword, found '1'; the section before it holds more than its count "
        "says");
  CHECK(medit_complaint(head + vertices() + "Tetrahedra\n1\n1 2 3.5 4 0\n") ==
        "mesh:13: a vertex of the tetrahedron is not a whole number: '3.5'");
}

}  // namespace medit_test
