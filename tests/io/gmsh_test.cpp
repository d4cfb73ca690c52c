#include "tets_testing.hpp"

namespace gmsh_test {

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

}  // namespace gmsh_test
