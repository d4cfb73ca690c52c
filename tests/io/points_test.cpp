#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include <plexway/io/field.hpp>
#include <plexway/io/points.hpp>

#include "io_testing.hpp"

namespace plexway::points_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::parse_ply_points;
using plexway::io::parse_point_table;
using plexway::io::Points;
using plexway::io::read_points;
using plexway::io::write_points;

namespace {

std::string xyz_complaint(std::string_view text) { return complaint(parse_point_table, text); }
std::string ply_complaint(std::string_view text) { return complaint(parse_ply_points, text); }

std::string ply_header(const std::string& format, int vertices, const std::string& properties) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" +
         properties + "end_header\n";
}

const std::string floats = "property float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("xyz: three columns are positions, six are positions and normals") {
  const Points three = parse_point_table("0 0 0\n1 0.5 -2e-3\n+3\t4 5", "mesh");
  CHECK(three.positions == Positions{{0, 0, 0}, {1, 0.5, -2e-3}, {3, 4, 5}});
  CHECK(three.normals.empty());
  const Points six = parse_point_table("0 0 0 0 0 1\n1 0 0 0.6 0 0.8\n2 0 0 0 0 0\n", "mesh");
  CHECK(six.positions == Positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  CHECK(six.normals == Positions{{0, 0, 1}, {0.6, 0, 0.8}, {0, 0, 0}});
}

TEST_CASE("xyz: comments, blank lines, line ends of Windows, a byte order mark") {
  const Points points = parse_point_table(
      "\xEF\xBB\xBF# one\r\n% two 2 2\r\n// X Y Z\r\n\r\n  1 2 3 # end\r\n4 5 6\r\n", "mesh");
  CHECK(points.positions == Positions{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("xyz: a first line with one number is a promise") {
  CHECK(parse_point_table("2\n1 2 3\n4 5 6\n\n# end\n", "mesh").positions.size() == 2);
  CHECK(xyz_complaint("3\n100 200 300\n4 5 6\n") == "mesh:3: the file ends after 2 of 3 points");
  CHECK(xyz_complaint("1\n1 2 3\n4 5 6\n") ==
        "mesh:3: the file goes on after its 1 points with '4'");
  CHECK(xyz_complaint("4000000000\n1 2 3\n") ==
        "mesh:1: the first line says 4000000000 points, but only 6 bytes follow");
  CHECK(xyz_complaint("2.5\n1 2 3\n") ==
        "mesh:1: a first line with one number must say how many points follow");
  CHECK(xyz_complaint("-1\n1 2 3\n") ==
        "mesh:1: a first line with one number must say how many points follow");
  CHECK(xyz_complaint("1\n1\n") == "mesh:1: the first line says 1 points, but only 2 bytes follow");
}

TEST_CASE("xyz: what is wrong is named with its line") {
  CHECK(xyz_complaint("0 0 0\n1 nan 2\n") == "mesh:2: y of point 1 is no finite number: 'nan'");
  CHECK(xyz_complaint("0 0 0\n1 1e999 2\n") == "mesh:2: y of point 1 is no finite number: '1e999'");
  CHECK(xyz_complaint("0 0 0\n\n1 2\n") == "mesh:3: point 1 has 2 columns, those before it have 3");
  CHECK(xyz_complaint("0 0 0\n7\n") == "mesh:2: point 1 has 1 column, those before it have 3");
  CHECK(xyz_complaint("0 0 0 0 0 1 4\n") ==
        "mesh:1: has 7 columns and no header before it that says which of them are x, y and z");
  CHECK(xyz_complaint("0 0 0\n0 0 1 0 0 1\n") ==
        "mesh:2: point 1 has 6 columns, those before it have 3");
  CHECK(xyz_complaint("H 0 0 0\n") == "mesh:1: names no column x; the first is 'H'");
  CHECK(xyz_complaint("# nothing\n") == "mesh: has no points; a cloud needs at least one");
}

TEST_CASE("ply cloud: vertices and normals of any type, the rest passed over") {
  const Points points = parse_ply_points(
      "ply\nformat ascii 1.0\ncomment scan\nelement vertex 2\nproperty float nx\nproperty uchar x\n"
      "property double y\nproperty list uchar int l\nproperty float z\nproperty float ny\n"
      "property float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 1 2.5 2 7 8 3 0 1\n0 4 5 0 6 1 0\n3 0 1 99\n",
      "mesh");
  CHECK(points.positions == Positions{{1, 2.5, 3}, {4, 5, 6}});
  CHECK(points.normals == Positions{{0, 0, 1}, {0, 1, 0}});
  const std::string two = "property float nx\nproperty float ny\n";
  CHECK(parse_ply_points(ply_header("ascii", 1, floats + two) + "1 2 3 0 1\n", "mesh")
            .normals.empty());
}

TEST_CASE("ply cloud: both byte orders") {
  for (const bool big : {false, true}) {
    Packer body(big);
    body.put(1.5f).put(-2.0f).put(3.0f).put(0.0).put(0.0).put(-1.0);
    body.put(4.0f).put(5.0f).put(6.25f).put(1.0).put(0.0).put(0.0);
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    const std::string normals = "property double nx\nproperty double ny\nproperty double nz\n";
    const Points points =
        parse_ply_points(ply_header(format, 2, floats + normals) + body.bytes(), "mesh");
    CHECK(points.positions == Positions{{1.5, -2, 3}, {4, 5, 6.25}});
    CHECK(points.normals == Positions{{0, 0, -1}, {1, 0, 0}});
  }
}

TEST_CASE("ply cloud: what is wrong is named") {
  const std::string ascii = ply_header("ascii", 2, floats);
  CHECK(ply_complaint(ascii + "10 10 10\n1 2\n") == "mesh:9: the line ends before coordinate z");
  CHECK(ply_complaint(ascii + "10.5 10.5 10.5\n") ==
        "mesh:9: the file ends after 1 of 2 'vertex' elements");
  CHECK(ply_complaint(ascii + "0 0 0\n1 nan 2\n") == "mesh:9: coordinate y is not finite: 'nan'");
  CHECK(ply_complaint(ply_header("binary_little_endian", 2, floats) + std::string(20, '\0')) ==
        "mesh: byte 115: the header says 2 'vertex' elements, but only 20 bytes follow");
  CHECK(
      ply_complaint("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n") ==
      "mesh:3: element 'vertex' has no number 'y'");
  CHECK(ply_complaint(ply_header("ascii", 0, floats) + "\n") ==
        "mesh: has no vertices; a cloud needs at least one point");
}

TEST_CASE("points: what is written reads back to the last bit") {
  const Folder folder;
  const double third = 1.0 / 3, tiny = std::numeric_limits<double>::denorm_min();
  const Points plain = {{{third, -1e300, tiny}, {1e6 + third, -0.0, 7}}, {}};
  const Points full = {plain.positions, {{0.6, 0, 0.8}, {0, 0, 0}}};
  for (const char* name : {"a.xyz", "a.ply", "A.XYZ", "A.PLY"}) {
    for (const Points* points : {&plain, &full}) {
      write_points(folder.path() / name, *points);
      const Points read = read_points(folder.path() / name);
      CHECK(read.positions == points->positions);
      CHECK(std::signbit(read.positions[1][1]));
      CHECK(read.normals == points->normals);
    }
  }
}

TEST_CASE("points: names and contents that cannot be") {
  const Folder folder;
  const Points one = {{{0, 0, 0}}, {}};
  const auto file = [&](const char* name) { return folder.path() / name; };
  CHECK_THROWS_AS(read_points(file("none.xyz")), plexway::InputError);
  CHECK_THROWS_AS(read_points(folder.write("a.unknown", "0 0 0\n")), plexway::InputError);
  CHECK_THROWS_AS(read_points(folder.write("empty.xyz", "")), plexway::InputError);
  CHECK_THROWS_AS(read_points(folder.path()), plexway::InputError);
  CHECK_THROWS_WITH(read_points(folder.write("a.pcd", "0 0 0\n")), Contains("libpcl-dev"));
  CHECK_THROWS_AS(read_points(file("a.pcd")), plexway::NotBuiltError);
  CHECK_THROWS_AS(write_points(file("b.pcd"), one), plexway::NotBuiltError);
  CHECK_THROWS_AS(write_points(file("b.obj"), one), plexway::UsageError);
  CHECK_THROWS_AS(write_points(file("b.xyz"), {{{0, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}}),
                  plexway::UsageError);
  const double inf = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(write_points(file("b.ply"), {{{0, inf, 0}}, {}}), plexway::UsageError);
  CHECK_FALSE(std::filesystem::exists(file("b.ply")));
  CHECK_THROWS_AS(write_points(file("no/b.ply"), one), plexway::Error);
}

TEST_CASE("points: a ply without faces is a cloud") {
  using plexway::io::is_ply_cloud;
  const Folder folder;
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string none = "element face 0\nproperty list uchar int vertex_indices\n";
  CHECK(is_ply_cloud(folder.write("a.ply", ply_header("ascii", 1, floats) + "0 0 0\n")));
  CHECK(is_ply_cloud(folder.write("A.PLY", ply_header("ascii", 1, floats + none) + "0 0 0\n")));
  CHECK_FALSE(is_ply_cloud(folder.write("b.ply", ply_header("ascii", 1, floats + faces) + "0\n")));
  CHECK_FALSE(is_ply_cloud(folder.write("c.ply", ply_header("ascii", 0, floats))));
  CHECK_FALSE(is_ply_cloud(folder.write("d.ply", "nonsense")));
  CHECK_FALSE(is_ply_cloud(folder.write("a.xyz", ply_header("ascii", 1, floats) + "0 0 0\n")));
  CHECK_FALSE(is_ply_cloud(folder.path() / "none.ply"));
  CHECK_FALSE(is_ply_cloud(folder.path()));
}

TEST_CASE("field of a cloud: every format holds one value a point") {
  const Folder folder;
  const Points cloud = {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {}};
  const std::vector<double> distance = {0, 1, std::numeric_limits<double>::infinity()};
  const std::vector<std::int32_t> label = {0, 0, -1};
  for (const auto extension : plexway::io::field_extensions()) {
    const auto file = folder.path() / ("field" + std::string(extension));
    plexway::io::write_field(file, cloud, distance, label);
    INFO(file);
    CHECK(std::filesystem::file_size(file) > 0);
  }
  CHECK(bytes_of(folder.path() / "field.csv") ==
        "vertex,x,y,z,distance,label\n0,0,0,0,0,0\n1,1,0,0,1,0\n2,0,2,0,inf,-1\n");
  CHECK(read_points(folder.path() / "field.ply").positions == cloud.positions);
  CHECK(plexway::io::is_ply_cloud(folder.path() / "field.ply"));
  const std::string vtk = bytes_of(folder.path() / "field.vtk");
  Packer cells(true);  // of one corner each, type 1
  for (int i = 0; i < 3; ++i) cells.put(1).put(i);
  CHECK_THAT(vtk, Contains("\nCELLS 3 6\n" + cells.bytes() + "\nCELL_TYPES 3\n"));
  CHECK_THAT(bytes_of(folder.path() / "field.vtu"),
             Contains("NumberOfPoints=\"3\" NumberOfCells=\"3\""));
  CHECK_THROWS_AS(plexway::io::write_field(folder.path() / "a.csv", cloud, {distance.data(), 2}),
                  plexway::UsageError);
}

// Clouds from .csv and .las.

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

}  // namespace plexway::points_test
