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

}  // namespace ply_test
