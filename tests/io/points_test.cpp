#include <plexway/io/points.hpp>

#include <bit>
#include <limits>

#include <plexway/io/field.hpp>

#include "io_testing.hpp"

namespace points_test {

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

}  // namespace points_test
