#include <plexway/pcl/files.hpp>

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <catch2/catch.hpp>
#include <limits>

#include <plexway/error.hpp>

#include "pcl/pcl_testing.hpp"

namespace files_test {

using namespace pcl_testing;
using Catch::Contains;
using plexway::pcl::FilePoints;
using plexway::pcl::PcdForm;
using plexway::pcl::read_points;
using plexway::pcl::write_field;
using plexway::pcl::write_points;

namespace {

const std::string body = "0 0 0\n1 0.5 0\n-1e-3 1 2\n";
const Rows as_read = {{0, 0, 0}, {1, 0.5, 0}, {static_cast<double>(-1e-3f), 1, 2}};
const std::vector<float> numbers = {0, 0, 0, 1, 0.5f, 0, -1e-3f, 1, 2};

constexpr PcdForm forms[] = {PcdForm::ascii, PcdForm::binary, PcdForm::compressed};

}  // namespace

TEST_CASE("pcd: ascii and binary files written by hand") {
  const Folder folder;
  CHECK(read_points(folder.write("a.pcd", Header{}.text() + body)).positions == as_read);
  std::string windows;
  for (const char c : Header{}.text() + body) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(read_points(folder.write("b.PCD", windows)).positions == as_read);
  Header binary;
  binary.data = "binary";
  CHECK(read_points(folder.write("c.pcd", binary.text() + packed(numbers))).positions == as_read);
}

TEST_CASE("pcd: coordinates of any type, among other fields") {
  const Folder folder;
  Header mixed;
  mixed.fields = "rgb y hist z x";
  mixed.size = "4 8 4 2 1";
  mixed.type = "F F F I U";
  mixed.count = "1 1 3 1 1";
  mixed.points = mixed.width = "2";
  const auto file = folder.write(
      "a.pcd", mixed.text() + "nan 1000000.123456 1 2 3 -7 200\n0 0.1 1 2 3 32767 0\n");
  CHECK(read_points(file).positions == Rows{{200, 1000000.123456, -7}, {0, 0.1, 32767}});
  CHECK(read_points(file).dropped == 0);
}

TEST_CASE("pcd: points that are not finite are dropped and counted") {
  const Folder folder;
  Header organised;
  organised.width = organised.height = "2";
  organised.points = "4";
  const auto read =
      read_points(folder.write("a.pcd", organised.text() + "1 2 3\nnan nan nan\n0 inf 0\n4 5 6\n"));
  CHECK(read.positions == Rows{{1, 2, 3}, {4, 5, 6}});
  CHECK(read.dropped == 2);
  organised.fields += " normal_x normal_y normal_z";
  organised.size += " 4 4 4";
  organised.type += " F F F";
  organised.count += " 1 1 1";
  const auto normals = read_points(
      folder.write("b.pcd", organised.text() + "1 2 3 0 0 1\nnan nan nan 1 0 0\n4 5 6 nan nan nan\n"
                                               "7 8 9 0 -1 0\n"));
  CHECK(normals.normals == Rows{{0, 0, 1}, {0, 0, 0}, {0, -1, 0}});
  CHECK(normals.dropped == 1);
  CHECK_THROWS_WITH(
      read_points(folder.write("c.pcd", Header{}.text() + "nan 0 0\nnan 0 0\n0 0 inf\n")),
      Contains("none of its 3 points is finite"));
}

TEST_CASE("what is written reads back, in PCL's own types too") {
  const Folder folder;
  const Rows points = sphere(1000), normals = sphere(1000, 2);
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  for (const PcdForm form : forms) {
    const auto file = folder.at("a.pcd");
    write_points(file, points, normals, form);
    const FilePoints read = read_points(file);
    REQUIRE(read.positions.size() == points.size());
    REQUIRE(read.normals.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(read.positions[i][k] == single(points[i][k]));
        CHECK(read.normals[i][k] == single(normals[i][k]));
      }
    pcl::PointCloud<pcl::PointNormal> cloud;
    pcl::console::setVerbosityLevel(pcl::console::L_ERROR);  // it misses the curvature, aloud
    REQUIRE(pcl::io::loadPCDFile(file.string(), cloud) == 0);
    REQUIRE(cloud.size() == points.size());
    CHECK(cloud[7].y == static_cast<float>(points[7][1]));
    CHECK(cloud[7].normal_z == static_cast<float>(normals[7][2]));
    CHECK_FALSE(std::filesystem::exists(folder.at("a.pcd.part")));
  }
  write_points(folder.at("a.ply"), points);
  const FilePoints read = read_points(folder.at("a.ply"));
  REQUIRE(read.positions.size() == points.size());
  CHECK(read.positions[999][0] == single(points[999][0]));
  CHECK(read.normals.empty());
}

TEST_CASE("distances are an intensity that PCL reads") {
  const Folder folder;
  const double inf = std::numeric_limits<double>::infinity();
  const Rows points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  for (const PcdForm form : forms) {
    write_field(folder.at("d.pcd"), points, std::vector<double>{0, 1.25, inf}, form);
    pcl::PointCloud<pcl::PointXYZI> cloud;
    REQUIRE(pcl::io::loadPCDFile(folder.at("d.pcd").string(), cloud) == 0);
    REQUIRE(cloud.size() == 3);
    CHECK(cloud[1].intensity == 1.25f);
    CHECK(std::isinf(cloud[2].intensity));
    CHECK(cloud[2].x == 2.0f);
  }
  CHECK_THROWS_AS(write_field(folder.at("e.pcd"), points, std::vector<double>{0, 1}),
                  plexway::UsageError);
  CHECK_THROWS_AS(write_points(folder.at("e.xyz"), points), plexway::UsageError);
  CHECK_THROWS_AS(write_points(folder.at("e.pcd"), {}), plexway::UsageError);
  CHECK_THROWS_AS(write_points(folder.at("no/e.pcd"), points), plexway::Error);
  CHECK_THROWS_AS(write_points(folder.path(), points), plexway::UsageError);
  std::filesystem::create_directory(folder.at("dir.pcd"));
  CHECK_THROWS_WITH(write_points(folder.at("dir.pcd"), points), Contains("Is a directory"));
}

}  // namespace files_test
