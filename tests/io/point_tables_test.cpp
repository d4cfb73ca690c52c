// Clouds from .csv and .las.

#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/io/points.hpp>

#include "io_testing.hpp"

namespace plexway::point_tables_test {

using namespace io_testing;
using Catch::Contains;

namespace {

const auto parse = [](std::string_view text, std::string_view name) {
  return io::parse_point_table(text, name);
};

struct LasPoint {
  std::int32_t x, y, z;
  bool withheld = false;
};

// A .las of points in this format, with `extra` bytes more a point than it needs.
std::string las(int minor, int format, const std::vector<LasPoint>& points, std::size_t extra = 0) {
  const std::size_t header = minor == 4 ? 375 : 227;
  constexpr std::size_t lengths[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const std::size_t length = lengths[format] + extra;
  std::string bytes = "LASF" + std::string(20, '\0');
  bytes += '\1';
  bytes += static_cast<char>(minor);
  bytes.resize(94, '\0');
  Packer head(false);
  head.put(static_cast<std::uint16_t>(header)).put(static_cast<std::uint32_t>(header + 5));
  head.put(std::uint32_t{0}).put(static_cast<std::uint8_t>(format));
  head.put(static_cast<std::uint16_t>(length));
  head.put(static_cast<std::uint32_t>(minor == 4 ? 0 : points.size()));
  bytes += head.bytes();
  bytes.resize(131, '\0');
  Packer numbers(false);
  for (const double scale : {0.01, 0.01, 0.5}) numbers.put(scale);
  for (const double shift : {1000., 2000., -3.}) numbers.put(shift);
  bytes += numbers.bytes();
  bytes.resize(227, '\0');
  if (minor == 4) {
    bytes.resize(247, '\0');
    bytes += Packer(false).put(std::uint64_t{points.size()}).bytes();
    bytes.resize(375, '\0');
  }
  bytes += "extra";  // a gap, as other writers leave
  for (const LasPoint& p : points) {
    std::string record = Packer(false).put(p.x).put(p.y).put(p.z).bytes();
    record.resize(length, '\0');
    if (p.withheld) record[15] = static_cast<char>(format < 6 ? 0x80 : 0x04);
    bytes += record;
  }
  return bytes;
}

}  // namespace

TEST_CASE("a .csv of points has a header that says which columns are which, or three") {
  const Positions two = {{1, 2, 3}, {-4.5, 0, 1e-3}};
  CHECK(io::parse_point_table("1,2,3\n-4.5,0,1e-3\n", "f").positions == two);
  CHECK(io::parse_point_table("# by hand\r\n1 2  3\r\n\r\n-4.5 0 1e-3 # here\r\n", "f").positions ==
        two);
  CHECK(io::parse_point_table("id;\"Z\";Y;X;name\n7;3;2;1;a\n8;1e-3;+0;-4.5;b", "f").positions ==
        two);
  const auto with = io::parse_point_table("x\ty\tz\tnx\tny\tnz\n1\t2\t3\t0\t0\t1\n", "f");
  CHECK(with.normals == Positions{{0, 0, 1}});
  CHECK(complaint(parse, "1,2,3,4\n") ==
        "mesh:1: has 4 columns and no header before it that says which of them are x, y and z");
  CHECK(complaint(parse, "x,y,w\n1,2,3\n") == "mesh:1: names no column z; the first is 'x'");
  CHECK(complaint(parse, "x,y,z\n1,2,3\n1,2\n") ==
        "mesh:3: point 1 has 2 columns, those before it have 3");
  CHECK(complaint(parse, "x,y,z\n1,2,inf\n") == "mesh:2: z of point 0 is no finite number: 'inf'");
  CHECK(complaint(parse, "x,y,z,x\n") == "mesh:1: names two columns 'x'");
  CHECK(complaint(parse, "x,y,z\n") == "mesh: has no points; a cloud needs at least one");
}

TEST_CASE("the tables of points that the tool writes read back") {
  const auto points = io::parse_point_table(
      "x,y,z,vertex,simplex,b0,b1,b2,b3,distance\n1,2,3,-1,5,0.5,0.5,0,0,inf\n", "f");
  CHECK(points.positions == Positions{{1, 2, 3}});
  const auto field = io::parse_point_table("vertex,x,y,z,distance\n0,1,2,3,inf\n", "f");
  CHECK(field.positions == points.positions);
}

TEST_CASE("a .las has whole numbers times a scale, in every version and format") {
  const std::vector<LasPoint> points = {{100, -200, 4}, {0, 0, 0, true}, {-1, 2147483647, 1}};
  for (const int minor : {0, 1, 2, 3, 4})
    for (const int format : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) {
      const io::Points found = io::parse_las(las(minor, format, points, minor == 2 ? 3 : 0), "f");
      REQUIRE(found.positions.size() == 2);
      CHECK(found.positions[0] == std::array<double, 3>{1001, 1998, -1});
      CHECK(found.positions[1][0] == Approx(999.99));
      CHECK(found.positions[1][1] == Approx(2000 + 21474836.47));
      CHECK(found.original == std::vector<std::uint32_t>{0, 2});  // one was withheld
    }
  CHECK(io::parse_las(las(2, 1, {{1, 2, 3}}), "f").original.empty());
}

TEST_CASE("a .las that is packed, cut off or of another kind is refused in one line") {
  const std::string good = las(2, 3, {{1, 2, 3}, {4, 5, 6}});
  const auto said = [](std::string bytes) { return complaint(io::parse_las, bytes); };
  std::string packed = good;
  packed[104] = static_cast<char>(0x83);
  CHECK_THAT(said(packed), Contains("is packed (.laz)"));
  CHECK_THAT(said(good.substr(0, good.size() - 1)), Contains("should have 2 points of 34 bytes"));
  CHECK_THAT(said(good.substr(0, 100)), Contains("ends inside its header"));
  CHECK_THAT(said("PK"), Contains("is no .las"));
  std::string other = good;
  other[104] = 11;
  CHECK_THAT(said(other), Contains("points of format 11"));
  CHECK_THAT(said(las(2, 0, {})), Contains("has no points"));
  CHECK_THAT(said(las(2, 0, {{1, 1, 1, true}})), Contains("withheld"));
  std::string huge = good;
  for (const std::size_t at : {107u, 108u, 109u, 110u}) huge[at] = static_cast<char>(0xFF);
  CHECK_THAT(said(huge), Contains("should have 4294967295 points"));
}

}  // namespace plexway::point_tables_test
