#include <fcntl.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <catch2/catch.hpp>
#include <cstdio>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/pcl/files.hpp>

#include "message_of.hpp"
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

namespace {

const std::string triangle_body = "0 0 0\n1 0 0\n0 1 0\n";

/// The message for a file of these bytes, from behind its folder on.
std::string complaint(std::string_view bytes, const std::string& name = "a.pcd") {
  const Folder folder;
  const std::string message =
      plexway::testing::message_of([&] { read_points(folder.write(name, bytes)); });
  if (message.empty()) return {};
  const std::string start = folder.path().string() + "/";
  REQUIRE(message.rfind(start, 0) == 0);
  return message.substr(start.size());
}

template <class Change>
std::string header_complaint(Change change) {
  Header header;
  change(header);
  return complaint(header.text() + triangle_body);
}

/// The three points above as LZF has them when nothing can be compressed: field after field.
std::string compressed(std::uint32_t stated, std::uint32_t plain) {
  const std::vector<float> fields = {0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::string bytes = packed(fields);
  std::string lzf;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::string piece = bytes.substr(i, 32);
    lzf += static_cast<char>(piece.size() - 1) + piece;
  }
  Header header;
  header.data = "binary_compressed";
  return header.text() +
         packed<std::uint32_t>(
             {stated == 0 ? static_cast<std::uint32_t>(lzf.size()) : stated, plain}) +
         lzf;
}

}  // namespace

TEST_CASE("bad pcd: what is wrong with the header is named with its line") {
  CHECK_THAT(complaint(std::string(100, '\1') + "\n"), Contains("a.pcd:1: unknown word"));
  CHECK(complaint("") == "a.pcd: is empty");
  CHECK_THAT(complaint("ply\nformat ascii 1.0\n"), Contains("a.pcd:1: unknown word 'ply'"));
  CHECK(complaint("VERSION 0.7\nFIELDS x y z\n") == "a.pcd:2: the file ends before 'DATA'");
  CHECK(complaint("VERSION 0.7\nDATA ascii\n0 0 0\n") == "a.pcd:2: the header has no FIELDS");
  CHECK(header_complaint([](Header& h) { h.size = "4 4"; }) ==
        "a.pcd:4: SIZE has 2 values for 3 fields");
  CHECK_THAT(header_complaint([](Header& h) { h.size = "3 3 3"; }),
             Contains("field 'x' has type 'F' of 3 bytes"));
  CHECK_THAT(header_complaint([](Header& h) { h.type = "X X X"; }), Contains("has type 'X'"));
  CHECK_THAT(header_complaint([](Header& h) { h.count = "1 0 1"; }),
             Contains("a.pcd:6: the count must be a whole number above 0, not '0'"));
  CHECK_THAT(header_complaint([](Header& h) { h.count = "1 1 1000000000"; }),
             Contains("more bytes than any point type"));
  CHECK_THAT(header_complaint([](Header& h) { h.fields = "x y w"; }),
             Contains("one field 'z' with one number"));
  CHECK_THAT(header_complaint([](Header& h) { h.fields = "x x y"; }), Contains("one field 'x'"));
  CHECK_THAT(header_complaint([](Header& h) { h.width = "-3"; }), Contains("not '-3'"));
  CHECK_THAT(header_complaint([](Header& h) { h.width = "99999999999999999999"; }),
             Contains("a.pcd:7: the width"));
  CHECK(header_complaint([](Header& h) { h.height = "2"; }) ==
        "a.pcd:11: WIDTH 3 times HEIGHT 2 is not POINTS 3");
  CHECK(header_complaint([](Header& h) { h.points = "10"; }) ==
        "a.pcd:11: WIDTH 3 times HEIGHT 1 is not POINTS 10");
  CHECK_THAT(header_complaint([](Header& h) { h.data = "zebra"; }), Contains("DATA must be"));
  CHECK(header_complaint([](Header& h) { h.points = "3\nPOINTS 3"; }) ==
        "a.pcd:11: a second 'POINTS'");
}

TEST_CASE("bad pcd: no memory is asked for on the word of a header") {
  const auto huge = [](const char* data) {
    return [data](Header& h) {
      h.points = h.width = "4000000000";
      h.data = data;
    };
  };
  for (const char* data : {"ascii", "binary"})
    CHECK(header_complaint(huge(data)) ==
          "a.pcd:11: the header says 4000000000 points, but only 18 bytes follow");
  CHECK_THAT(header_complaint(huge("binary_compressed")), Contains("a.pcd:11: the compressed"));
  Header header;
  header.width = header.points = "300000000";
  header.data = "binary_compressed";
  CHECK_THAT(complaint(header.text() + packed<std::uint32_t>({4, 3600000000u}) + "abcd"),
             Contains("too short for 300000000 points"));
}

TEST_CASE("bad pcd: what is wrong with the data is named, where PCL would read zeros") {
  const std::string header = Header{}.text();
  CHECK(complaint(header + "0 0 0\n1 0\n0 10 0\n") ==
        "a.pcd:13: point 1 has 2 numbers, but the fields take 3");
  CHECK(complaint(header + "0 0 0\n1 abc 0\n0 1 0\n") == "a.pcd:13: not a number: 'abc'");
  CHECK(complaint(header + "0 0 0\n1 1e999 0\n0 1 0\n") ==
        "a.pcd:13: a number is too large: '1e999'");
  CHECK(complaint(header + "0,0,0\n1,0,0\n0,1,0\n") ==
        "a.pcd:12: point 0 has 1 numbers, but the fields take 3");
  CHECK(complaint(header + "100 200 300\n1 0 0\n") ==
        "a.pcd:13: the file ends after 2 of 3 points");
  CHECK(complaint(header + triangle_body + "7 7 7\n") ==
        "a.pcd:15: the file goes on after its last point with '7'");
  Header binary;
  binary.data = "binary";
  CHECK(complaint(binary.text() + std::string(20, '\0')) ==
        "a.pcd:11: the header says 3 points, but only 20 bytes follow");
  CHECK(complaint(binary.text() + std::string(36, '\1') + std::string(36, '\1')) ==
        "a.pcd:11: the file goes on for 36 bytes after its last point");
}

TEST_CASE("bad pcd: compressed data") {
  CHECK(complaint(compressed(0, 36)).empty());
  CHECK_THAT(complaint(compressed(0, 9)), Contains("says that it holds 9 bytes"));
  CHECK_THAT(complaint(compressed(1000, 36)), Contains("only 46 bytes follow"));
  CHECK_THAT(complaint(compressed(0, 36).substr(0, compressed(0, 36).size() - 10)),
             Contains("only 36 bytes follow"));
  std::string junk = compressed(0, 36);
  junk.replace(junk.size() - 38, 38, 38, '\xFF');
  CHECK(complaint(junk) == "a.pcd: PCL cannot read it: it is malformed or ends too soon");
  std::string zeros = compressed(0, 36);
  zeros.replace(zeros.size() - 46, 8, 8, '\0');
  CHECK_THAT(complaint(zeros), Contains("says that it holds 0 bytes"));
}

TEST_CASE("bad ply through PCL") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  CHECK(complaint(header + triangle_body, "a.ply").empty());
  CHECK_THAT(complaint(header + "0 0 0\n1 0\n0 1 0\n", "a.ply"), Contains("a.ply: PCL cannot"));
  CHECK_THAT(complaint(header + "0 0 0\n", "a.ply"), Contains("a.ply: PCL cannot"));
  CHECK_THAT(complaint("nonsense\n", "a.ply"), Contains("a.ply: is no PLY file"));
  std::string huge = header;
  huge.replace(huge.find("vertex 3"), 8, "vertex 4000000000");
  CHECK_THAT(complaint(huge + triangle_body, "a.ply"), Contains("number of vertices"));
}

TEST_CASE("files that are none") {
  const Folder folder;
  CHECK_THROWS_WITH(read_points(folder.at("none.pcd")), Contains("no such file"));
  CHECK_THROWS_WITH(read_points(folder.at("none.xyz")), Contains("unknown extension"));
  std::filesystem::create_directory(folder.at("dir.pcd"));
  CHECK_THROWS_WITH(read_points(folder.at("dir.pcd")), Contains("is a directory"));
}

TEST_CASE("PCL prints nothing, and its level of verbosity is put back") {
  const Folder folder;
  const auto file = folder.write("a.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 2\n"
                                 "property float x\nproperty float y\n"
                                 "property float z\nend_header\n0 0\n");
  // What is written to both streams meanwhile.
  const auto log = folder.at("log");
  std::fflush(stdout);
  std::fflush(stderr);
  const int sink = ::open(log.c_str(), O_CREAT | O_WRONLY, 0600);
  const int out = ::dup(1), err = ::dup(2);
  ::dup2(sink, 1);
  ::dup2(sink, 2);
  bool thrown = false;
  try {
    read_points(file);
  } catch (const plexway::InputError&) {
    thrown = true;
  }
  std::fflush(stdout);
  std::fflush(stderr);
  ::dup2(out, 1);
  ::dup2(err, 2);
  for (const int end : {sink, out, err}) ::close(end);
  CHECK(thrown);
  CHECK(std::filesystem::file_size(log) == 0);
}

}  // namespace files_test
