#include <fcntl.h>
#include <catch2/catch.hpp>
#include <cstdio>

#include <plexway/error.hpp>
#include <plexway/pcl/files.hpp>

#include "pcl/pcl_testing.hpp"

namespace bad_files_test {

using namespace pcl_testing;
using Catch::Contains;
using plexway::pcl::read_points;

namespace {

const std::string body = "0 0 0\n1 0 0\n0 1 0\n";

/// The message for a file of these bytes, from behind its folder on.
std::string complaint(std::string_view bytes, const std::string& name = "a.pcd") {
  const Folder folder;
  try {
    read_points(folder.write(name, bytes));
  } catch (const plexway::InputError& error) {
    const std::string message = error.what();
    const std::string start = folder.path().string() + "/";
    REQUIRE(message.rfind(start, 0) == 0);
    return message.substr(start.size());
  }
  return "no complaint";
}

template <class Change>
std::string header_complaint(Change change) {
  Header header;
  change(header);
  return complaint(header.text() + body);
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
  CHECK(complaint(header + body + "7 7 7\n") ==
        "a.pcd:15: the file goes on after its last point with '7'");
  Header binary;
  binary.data = "binary";
  CHECK(complaint(binary.text() + std::string(20, '\0')) ==
        "a.pcd:11: the header says 3 points, but only 20 bytes follow");
  CHECK(complaint(binary.text() + std::string(36, '\1') + std::string(36, '\1')) ==
        "a.pcd:11: the file goes on for 36 bytes after its last point");
}

TEST_CASE("bad pcd: compressed data") {
  CHECK(complaint(compressed(0, 36)) == "no complaint");
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
  CHECK(complaint(header + body, "a.ply") == "no complaint");
  CHECK_THAT(complaint(header + "0 0 0\n1 0\n0 1 0\n", "a.ply"), Contains("a.ply: PCL cannot"));
  CHECK_THAT(complaint(header + "0 0 0\n", "a.ply"), Contains("a.ply: PCL cannot"));
  CHECK_THAT(complaint("nonsense\n", "a.ply"), Contains("a.ply: is no PLY file"));
  std::string huge = header;
  huge.replace(huge.find("vertex 3"), 8, "vertex 4000000000");
  CHECK_THAT(complaint(huge + body, "a.ply"), Contains("number of vertices"));
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

}  // namespace bad_files_test
