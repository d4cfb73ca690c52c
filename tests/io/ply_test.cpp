#include <cmath>
#include <limits>

#include "io_testing.hpp"

namespace ply_test {

using namespace io_testing;
using Catch::Contains;

namespace {

constexpr auto parse_ply = io_testing::triangles<plexway::io::parse_ply>;

std::string ply_complaint(std::string_view bytes) { return complaint(parse_ply, bytes); }

std::string simple_header(const std::string& format, const std::string& vertices,
                          const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string three = "0 0 0\n1 0 0\n0 1 0\n";

/// Every scalar type, properties in an unusual order, things to skip before, between and after.
std::string rich_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment any\nobj_info any\n"
         "element camera 2\nproperty double a\nproperty list ushort float b\n"
         "element vertex 4\nproperty uchar red\nproperty double z\nproperty list int char tags\n"
         "property short x\nproperty uint16 id\nproperty float32 y\n"
         "element nothing 1000000000000\n"
         "element face 2\nproperty int8 flag\nproperty list uint8 uint32 vertex_index\n"
         "property list int32 float64 texcoord\n"
         "element tail 1\nproperty uint u\nproperty int i\nproperty ushort s\nend_header\n";
}

const Positions rich_positions = {{-3, 0.5, 7}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, -1e100}};
const Faces rich_faces = {{0, 1, 2}, {3, 2, 0}, {2, 1, 0}};

std::string rich_binary(bool big) {
  Packer p(big);
  p.put(1.0).put(std::uint16_t{2}).put(1.0F).put(2.0F);
  p.put(2.0).put(std::uint16_t{0});
  for (std::size_t i = 0; i < rich_positions.size(); ++i) {
    const auto& [x, y, z] = rich_positions[i];
    p.put(std::uint8_t{255}).put(z).put(static_cast<std::int32_t>(i));
    for (std::size_t k = 0; k < i; ++k) p.put(std::int8_t{-1});
    p.put(static_cast<std::int16_t>(x)).put(std::uint16_t{9}).put(static_cast<float>(y));
  }
  p.put(std::int8_t{0}).put(std::uint8_t{3});
  for (const std::uint32_t v : {0U, 1U, 2U}) p.put(v);
  p.put(std::int32_t{1}).put(0.5);
  p.put(std::int8_t{0}).put(std::uint8_t{4});
  for (const std::uint32_t v : {3U, 2U, 1U, 0U}) p.put(v);
  p.put(std::int32_t{0});
  p.put(std::uint32_t{1}).put(std::int32_t{-1}).put(std::uint16_t{1});
  return rich_header(big ? "binary_big_endian" : "binary_little_endian") + p.bytes();
}

std::string simple_binary(bool big, std::uint32_t last_index = 2, float last_z = 0) {
  Packer p(big);
  for (const float c : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, last_z}) p.put(c);
  p.put(std::uint8_t{3}).put(std::int32_t{0}).put(std::int32_t{1}).put(last_index);
  return simple_header(big ? "binary_big_endian" : "binary_little_endian", "3", "1") + p.bytes();
}

}  // namespace

TEST_CASE("ply: ascii, binary little endian and big endian hold the same surface") {
  const std::string ascii = rich_header("ascii") +
                            "1 2 1 2\n2 0\n"
                            "255 7 0 -3 9 0.5\n255 0 1 -1 1 9 0\n255 0.25 2 -1 -1 1 9 1\n"
                            "255 -1e100 3 -1 -1 -1 0 9 1\n"
                            "0 3 0 1 2 1 0.5\n0 4 3 2 1 0 0\n1 -1 1\n";
  for (const std::string& bytes : {ascii, rich_binary(false), rich_binary(true)}) {
    const auto mesh = parse_ply(bytes, "mesh");
    CHECK(mesh.positions == rich_positions);
    CHECK(mesh.triangles == rich_faces);
  }
}

TEST_CASE("ply: faces may come before vertices, lines may end in CRLF") {
  const auto mesh = parse_ply(
      "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n"
      "element vertex 3\r\nproperty int x\r\nproperty int y\r\nproperty int z\r\nend_header\r\n"
      "3 2 1 0\r\n0 0 0\r\n1 0 0\r\n\r\n0 1 0\r\n",
      "mesh");
  CHECK(mesh.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(mesh.triangles == Faces{{2, 1, 0}});
}

TEST_CASE("ply: a bad header is named with its line") {
  CHECK(ply_complaint("OFF\n") == "mesh:1: expected 'ply', found 'OFF'");
  CHECK(ply_complaint("ply\nformat ascii 1.0\n") == "mesh:3: the file ends before 'end_header'");
  CHECK(ply_complaint("ply\nformat text 1.0\n") == "mesh:2: unknown format 'text'");
  CHECK_THAT(ply_complaint("ply\nformat ascii 2.0\n"), Contains("mesh:2: unknown version '2.0'"));
  CHECK(ply_complaint("ply\nwhat\n") == "mesh:2: unknown word 'what' in the header");
  CHECK(ply_complaint("ply\nproperty int x\n") == "mesh:2: a property before the first element");
  CHECK(ply_complaint("ply\nelement vertex 1\nproperty half x\n") ==
        "mesh:3: unknown property type 'half'");
  CHECK_THAT(ply_complaint("ply\nelement vertex 1\nproperty list float int x\n"),
             Contains("mesh:3: a list's length must be of a whole type"));
  CHECK(ply_complaint("ply\nelement vertex -1\n") ==
        "mesh:2: the number of 'vertex' elements is negative: -1");
  CHECK(ply_complaint("ply\nelement vertex 1\nelement vertex 1\n") ==
        "mesh:3: a second element 'vertex'");
  CHECK(ply_complaint("ply\nelement vertex 1\nproperty int x\nproperty int x\n") ==
        "mesh:4: a second property 'x'");
  CHECK(ply_complaint("ply\nelement vertex 1\nend_header\n") ==
        "mesh:3: the header has no format line");
  CHECK(ply_complaint("ply\nformat ascii 1.0\nend_header\n0\n") ==
        "mesh:3: the header has no element 'vertex'");
  CHECK(ply_complaint("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
                      "end_header\n0 0\n") == "mesh:3: element 'vertex' has no number 'z'");
  CHECK(ply_complaint("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
                      "property int z\nelement face 1\nproperty int vertex_indices\nend_header\n"
                      "0 0 0\n1\n") ==
        "mesh:7: element 'face' has no list 'vertex_indices' or 'vertex_index'");
}

TEST_CASE("ply: counts that the file cannot hold are refused before any room is made") {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    INFO(format);
    CHECK_THAT(ply_complaint(simple_header(format, "4000000000", "1") + three),
               Contains("the header says 4000000000 'vertex' elements, but only 18 bytes follow"));
    CHECK_THAT(ply_complaint(simple_header(format, "9223372036854775807", "1") + three),
               Contains("mesh:3: more vertices than 32 bits count"));
    CHECK_THAT(ply_complaint(simple_header(format, "0", "9223372036854775807") + three),
               Contains("the header says 9223372036854775807 'face' elements"));
    CHECK_THAT(ply_complaint(simple_header(format, "99999999999999999999", "1") + three),
               Contains("mesh:3: the number of 'vertex' elements is too large"));
  }
}

TEST_CASE("ply: bad lines of an ascii file are named") {
  const auto with = [](const std::string& faces, const std::string& body) {
    return ply_complaint(simple_header("ascii", "3", faces) + body);
  };
  CHECK(with("1", "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n") ==
        "mesh:11: coordinate z is not finite: 'nan'");
  CHECK(with("1", "0 0 0\n1 0\n0 1 0\n3 0 1 2\n") == "mesh:11: the line ends before coordinate z");
  CHECK_THAT(with("1", "0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), Contains("mesh:10: the line goes on"));
  CHECK(with("1", three + "3 0 1 3\n") ==
        "mesh:13: face 0 names vertex 3, but the file has 3 vertices");
  CHECK(with("1", three + "3 0 1 -1\n") ==
        "mesh:13: face 0 names vertex -1, but the file has 3 vertices");
  CHECK(with("1", three + "2 0 1\n") == "mesh:13: face 0 has 2 corners; it needs at least 3");
  CHECK(with("1", three + "-3 0 1\n") == "mesh:13: the number of corners is negative: -3");
  CHECK(with("1", three + "9999999 0 1\n") == "mesh:13: the line ends before a vertex of the face");
  CHECK(with("2", three + "3 0 1 2\n") == "mesh:14: the file ends after 1 of 2 'face' elements");
  CHECK_THAT(with("1", three + "3 0 1 2\n3 0 1 2\n"),
             Contains("mesh:14: the file goes on after its last element"));
  CHECK(with("0", three) == "mesh: has no faces; a surface needs at least one triangle");
}

TEST_CASE("ply: bad binary bodies are named by element and byte") {
  for (const bool big : {false, true}) {
    const std::string good = simple_binary(big);
    CHECK(parse_ply(good, "mesh").triangles == Faces{{0, 1, 2}});
    CHECK(parse_ply(good + "\n", "mesh").triangles.size() == 1);
    CHECK_THAT(ply_complaint(good + "more"), Contains("the file goes on after its last element"));
    const std::size_t start = good.size() - 49;
    for (std::size_t kept = 0; kept < 49; ++kept) {
      INFO(kept << " of 49 bytes of data");
      const std::string message = ply_complaint(std::string_view(good).substr(0, start + kept));
      CHECK_THAT(message, Contains("mesh:"));
      CHECK_THAT(message, Contains("ends") || Contains("bytes follow"));
    }
    CHECK(ply_complaint(simple_binary(big, 3)) ==
          "mesh: 'face' element 0, byte " + std::to_string(good.size()) +
              ": face 0 names vertex 3, but the file has 3 vertices");
    CHECK_THAT(ply_complaint(simple_binary(big, 0xFFFFFFFFU)), Contains("names vertex -1"));
    CHECK(ply_complaint(simple_binary(big, 2, std::numeric_limits<float>::infinity())) ==
          "mesh: 'vertex' element 2, byte " + std::to_string(start + 32) +
              ": coordinate z is not finite");
  }
}

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

}  // namespace ply_test
