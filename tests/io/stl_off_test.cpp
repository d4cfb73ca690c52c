#include <cmath>
#include <limits>

#include "io_testing.hpp"

namespace stl_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::parse_off;
using plexway::io::parse_stl;

namespace {

std::string stl_complaint(std::string_view bytes) { return complaint(parse_stl, bytes); }

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal nan 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " +
         c + "\n endloop\nendfacet\n";
}

const std::string two_facets = facet("0 0 0", "1 0 0", "0 1 0") + facet("0 1 0", "1 0 -0", "1 1 0");

std::string binary(const std::string& start, const std::vector<std::array<float, 9>>& facets) {
  Packer p(false);
  p.put(static_cast<std::uint32_t>(facets.size()));
  for (const auto& corners : facets) {
    for (int i = 0; i < 3; ++i) p.put(std::numeric_limits<float>::quiet_NaN());  // the normal
    for (const float c : corners) p.put(c);
    p.put(std::uint16_t{0xABCD});
  }
  std::string head = start;
  head.resize(80, '\0');
  return head + p.bytes();
}

const std::vector<std::array<float, 9>> square = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                  {0, 1, 0, 1, 0, -0.F, 1, 1, 0}};

}  // namespace

TEST_CASE("stl: corners with equal coordinates become one vertex, first come first numbered") {
  const std::string ascii = "solid a name # x\n" + two_facets + "endsolid a name\n";
  for (const std::string& bytes : {ascii, binary("made by hand", square)}) {
    const auto mesh = parse_stl(bytes, "mesh");
    CHECK(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
    CHECK(mesh.triangles == Faces{{0, 1, 2}, {2, 1, 3}});
  }
}

TEST_CASE("stl: corners that differ in the last bit stay apart, collapsed facets are kept") {
  const float next = std::nextafter(1.F, 2.F);
  const auto mesh =
      parse_stl(binary("", {{0, 0, 0, 1, 0, 0, next, 0, 0}, {0, 0, 0, 0, 0, 0, 1, 0, 0}}), "mesh");
  CHECK(mesh.positions.size() == 3);
  CHECK(mesh.triangles == Faces{{0, 1, 2}, {0, 0, 1}});
}

TEST_CASE("stl: many vertices are merged") {
  std::vector<std::array<float, 9>> strip;
  for (int i = 0; i < 5000; ++i) {
    const auto x = static_cast<float>(i);
    strip.push_back({x, 0, 0, x + 1, 0, 0, x, 1, 0});
    strip.push_back({x, 1, 0, x + 1, 0, 0, x + 1, 1, 0});
  }
  const auto mesh = parse_stl(binary("", strip), "mesh");
  CHECK(mesh.positions.size() == 2 * 5001);
  for (std::size_t f = 0; f < strip.size(); ++f)
    for (std::size_t c = 0; c < 9; ++c)
      REQUIRE(mesh.positions[mesh.triangles[f][c / 3]][c % 3] == static_cast<double>(strip[f][c]));
}

TEST_CASE("stl: a binary file may start with 'solid'") {
  CHECK(parse_stl(binary("solid but binary", square), "mesh").triangles.size() == 2);
  const std::string cut = binary("solid but binary", square).substr(0, 150);
  CHECK(stl_complaint(cut) == "mesh: binary STL of 2 facets takes 184 bytes, but the file has 150");
}

TEST_CASE("stl: ascii in capitals, CRLF, polygons, several solids") {
  const auto mesh = parse_stl(
      "SOLID\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\n"
      "VERTEX 1 1 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\n"
      "solid b\n" +
          facet("0 0 0", "0 1 0", "0 0 1") + "endsolid b",
      "mesh");
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.triangles == Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("stl: bad ascii files are named with their line") {
  CHECK(stl_complaint("solid\n" + two_facets) == "mesh:16: the file ends before 'endsolid'");
  CHECK(stl_complaint("solid\n" + two_facets.substr(0, 50)) ==
        "mesh:5: the file ends inside facet 0");
  CHECK(stl_complaint("solid\n" + facet("0 0 0", "1 0", "0 1 0") + "endsolid") ==
        "mesh:5: the line ends before coordinate z");
  CHECK(stl_complaint("solid\n" + facet("0 0 0", "1 0 inf", "0 1 0") + "endsolid") ==
        "mesh:5: coordinate z is not finite: 'inf'");
  CHECK(stl_complaint("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"
                      "endfacet\nendsolid\n") ==
        "mesh:6: face 0 has 2 corners; it needs at least 3");
  CHECK(stl_complaint("solid\nfacet normal 0 0 1\nouter ring\n") ==
        "mesh:3: expected 'loop', found 'ring'");
  CHECK(stl_complaint("solid\nhello\n") == "mesh:2: expected 'facet' or 'endsolid', found 'hello'");
  CHECK(stl_complaint("solid a\nendsolid a\n") ==
        "mesh: has no faces; a surface needs at least one triangle");
}

TEST_CASE("stl: bad binary files are named") {
  CHECK_THAT(stl_complaint("hello"), Contains("mesh: neither ascii STL"));
  CHECK_THAT(stl_complaint(binary("", square).substr(0, 183)),
             Contains("takes 184 bytes, but the file has 183"));
  std::string huge = binary("", square);
  for (std::size_t i = 80; i < 84; ++i) huge[i] = '\xFF';
  CHECK(stl_complaint(huge) ==
        "mesh: binary STL of 4294967295 facets takes 214748364834 bytes, but the file has 184");
  auto bad = square;
  bad[1][4] = std::numeric_limits<float>::quiet_NaN();
  CHECK(stl_complaint(binary("", bad)) == "mesh: facet 1 (byte 162): coordinate y is not finite");
  CHECK(stl_complaint(binary("", {})) ==
        "mesh: has no faces; a surface needs at least one triangle");
}

namespace {

const std::string four = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const Positions corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string off_complaint(std::string_view text) { return complaint(parse_off, text); }

}  // namespace

TEST_CASE("off: header, comments, blank lines, optional counts") {
  for (const std::string head :
       {"OFF\n4 2 0\n", "OFF 4 2 5\n", "off\n4 2\n", "4 2 0\n", "\xEF\xBB\xBFOFF\n4 2 0\n",
        "# first\n\nOFF # kind\n# more\n\n 4 2 0 # counts\n", "OFF\r\n4 2 0\r\n"}) {
    INFO(head);
    const auto mesh = parse_off(head + four + "# faces\n3 0 1 2\n\n3 0 2 3\n\n", "mesh");
    CHECK(mesh.positions == corners);
    CHECK(mesh.triangles == Faces{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("off: polygons become fans, colours and normals are passed over") {
  const auto polygon = parse_off("OFF\n4 2 0\n" + four + "4 3 2 1 0 255 0 0\n3 0 1 2 0.5\n", "m");
  CHECK(polygon.triangles == Faces{{3, 2, 1}, {3, 1, 0}, {0, 1, 2}});
  for (const std::string kind : {"COFF", "NOFF", "STOFF", "CNOFF", "NCOFF", "STCNOFF"}) {
    INFO(kind);
    const auto mesh =
        parse_off(kind + "\n3 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 2 1 0\n", "mesh");
    CHECK(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == Faces{{2, 1, 0}});
  }
}

TEST_CASE("off: vertices that no face uses are kept") {
  const auto mesh = parse_off("OFF\n5 1 0\n9 9 9\n" + four + "3 1 2 3\n", "mesh");
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.positions[0] == std::array<double, 3>{9, 9, 9});
}

TEST_CASE("off: a bad header is named with its line") {
  CHECK(off_complaint("") == "mesh:1: expected OFF, found the end of the file");
  CHECK(off_complaint("ply\n") == "mesh:1: expected OFF, found 'ply'");
  CHECK(off_complaint("XOFF\n1 1 1\n") == "mesh:1: expected OFF, found 'XOFF'");
  CHECK_THAT(off_complaint("4OFF\n1 1 1\n"), Contains("mesh:1: '4OFF' is not three-dimensional") ||
                                                 Contains("mesh:1: the number of vertices"));
  CHECK_THAT(off_complaint("nOFF\n4\n"), Contains("'nOFF' is not three-dimensional"));
  CHECK(off_complaint("OFF BINARY\n") == "mesh:1: binary OFF is not read; save it as ascii");
  CHECK(off_complaint("OFF\n") == "mesh:2: the file ends before the number of vertices");
  CHECK(off_complaint("OFF\n\n3\n") == "mesh:3: the line ends before the number of faces");
  CHECK(off_complaint("OFF\n-3 1 0\n") == "mesh:2: the number of vertices is negative: -3");
  CHECK(off_complaint("OFF\n3 -1 0\n") == "mesh:2: the number of faces is negative: -1");
  CHECK(off_complaint("OFF\n3.5 1 0\n") ==
        "mesh:2: the number of vertices is not a whole number: '3.5'");
  CHECK_THAT(off_complaint("OFF\n3 1 0 7\n"), Contains("mesh:2: expected three counts"));
}

TEST_CASE("off: counts that the file cannot hold are refused before any room is made") {
  CHECK(off_complaint("OFF\n999999999 1 0\n0 0 0\n") ==
        "mesh:2: the header says 999999999 vertices and 1 faces, but only 7 bytes follow");
  CHECK_THAT(off_complaint("OFF\n9223372036854775807 9223372036854775807 0\n"),
             Contains("mesh:2: the header says"));
  CHECK_THAT(off_complaint("OFF\n4 99999999999 0\n" + four), Contains("mesh:2:"));
  CHECK_THAT(off_complaint("OFF\n99999999999999999999 1 0\n"), Contains("mesh:2:"));
}

TEST_CASE("off: truncated files and bad lines are named") {
  CHECK_THAT(off_complaint("OFF\n4 1 0\n0.000 0.000 0.000\n1 0 0\n"),
             Contains("mesh:2: the header says"));
  CHECK(off_complaint("OFF\n3 1 0\n0.000 0.000 0.000\n1.000 0.000 0.000\n") ==
        "mesh:5: the file ends after 2 of 3 vertices");
  CHECK(off_complaint("OFF\n4 2 0\n" + four + "3 0 1 2 128 128 128\n") ==
        "mesh:8: the file ends after 1 of 2 faces");
  CHECK(off_complaint("OFF\n4 1 0\n" + four + "3 0 1 # 2\n") ==
        "mesh:7: the line ends before a vertex of the face");
  CHECK(off_complaint("OFF\n4 1 0\n0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n") ==
        "mesh:3: the line ends before coordinate z");
  CHECK(off_complaint("OFF\n4 1 0\n0 0 inf\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n") ==
        "mesh:3: coordinate z is not finite: 'inf'");
  CHECK(off_complaint("OFF\n4 1 0\n" + four + "3 0 1 4\n") ==
        "mesh:7: face 0 names vertex 4, but the file has 4 vertices");
  CHECK(off_complaint("OFF\n4 1 0\n" + four + "3 0 1 -1\n") ==
        "mesh:7: face 0 names vertex -1, but the file has 4 vertices");
  CHECK(off_complaint("OFF\n4 1 0\n" + four + "2 0 1 3\n") ==
        "mesh:7: face 0 has 2 corners; it needs at least 3");
  CHECK(off_complaint("OFF\n4 1 0\n" + four + "3 0 1 2\n3 0 2 3\n") ==
        "mesh:8: the header says 1 faces, but the file goes on with '3'");
  CHECK(off_complaint("OFF\n4 0 0\n" + four) ==
        "mesh: has no faces; a surface needs at least one triangle");
}

}  // namespace stl_test
