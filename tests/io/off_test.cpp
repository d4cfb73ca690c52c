#include "io_testing.hpp"

namespace off_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::parse_off;

namespace {

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const Positions corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string off_complaint(std::string_view text) { return complaint(parse_off, text); }

}  // namespace

TEST_CASE("off: header, comments, blank lines, optional counts") {
  for (const std::string head :
       {"OFF\n4 2 0\n", "OFF 4 2 5\n", "off\n4 2\n", "4 2 0\n", "\xEF\xBB\xBFOFF\n4 2 0\n",
        "# first\n\nOFF # kind\n# more\n\n 4 2 0 # counts\n", "OFF\r\n4 2 0\r\n"}) {
    INFO(head);
    const auto mesh = parse_off(head + square + "# faces\n3 0 1 2\n\n3 0 2 3\n\n", "mesh");
    CHECK(mesh.positions == corners);
    CHECK(mesh.triangles == Faces{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("off: polygons become fans, colours and normals are passed over") {
  const auto polygon = parse_off("OFF\n4 2 0\n" + square + "4 3 2 1 0 255 0 0\n3 0 1 2 0.5\n", "m");
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
  const auto mesh = parse_off("OFF\n5 1 0\n9 9 9\n" + square + "3 1 2 3\n", "mesh");
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
  CHECK_THAT(off_complaint("OFF\n4 99999999999 0\n" + square), Contains("mesh:2:"));
  CHECK_THAT(off_complaint("OFF\n99999999999999999999 1 0\n"), Contains("mesh:2:"));
}

TEST_CASE("off: truncated files and bad lines are named") {
  CHECK_THAT(off_complaint("OFF\n4 1 0\n0.000 0.000 0.000\n1 0 0\n"),
             Contains("mesh:2: the header says"));
  CHECK(off_complaint("OFF\n3 1 0\n0.000 0.000 0.000\n1.000 0.000 0.000\n") ==
        "mesh:5: the file ends after 2 of 3 vertices");
  CHECK(off_complaint("OFF\n4 2 0\n" + square + "3 0 1 2 128 128 128\n") ==
        "mesh:8: the file ends after 1 of 2 faces");
  CHECK(off_complaint("OFF\n4 1 0\n" + square + "3 0 1 # 2\n") ==
        "mesh:7: the line ends before a vertex of the face");
  CHECK(off_complaint("OFF\n4 1 0\n0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n") ==
        "mesh:3: the line ends before coordinate z");
  CHECK(off_complaint("OFF\n4 1 0\n0 0 inf\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n") ==
        "mesh:3: coordinate z is not finite: 'inf'");
  CHECK(off_complaint("OFF\n4 1 0\n" + square + "3 0 1 4\n") ==
        "mesh:7: face 0 names vertex 4, but the file has 4 vertices");
  CHECK(off_complaint("OFF\n4 1 0\n" + square + "3 0 1 -1\n") ==
        "mesh:7: face 0 names vertex -1, but the file has 4 vertices");
  CHECK(off_complaint("OFF\n4 1 0\n" + square + "2 0 1 3\n") ==
        "mesh:7: face 0 has 2 corners; it needs at least 3");
  CHECK(off_complaint("OFF\n4 1 0\n" + square + "3 0 1 2\n3 0 2 3\n") ==
        "mesh:8: the header says 1 faces, but the file goes on with '3'");
  CHECK(off_complaint("OFF\n4 0 0\n" + square) ==
        "mesh: has no faces; a surface needs at least one triangle");
}

}  // namespace off_test
