#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/ply_rows.hpp>
#include <plexway/io/triangles.hpp>

#include "folder.hpp"
#include "message_of.hpp"

namespace plexway::ply_rows_test {

namespace {

/// Numbers as bytes, lowest or highest first.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class Value>
  Bytes& add(Value value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_ == (std::endian::native == std::endian::little))
      std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
    return *this;
  }
  std::string text;

 private:
  bool big_;
};

constexpr int vertices = 7, faces = 9;

/// With properties that nobody asks for around those that count, and an element between.
std::string made(bool big, int corners_of_face_5 = 3) {
  Bytes body(big);
  for (int v = 0; v < vertices; ++v) {
    body.add(std::uint8_t{9}).add(static_cast<float>(v)).add(.5 * v).add(std::int16_t{3});
    body.add(static_cast<float>(-v));
  }
  for (int e = 0; e < 2; ++e) body.add(std::int32_t{e});
  for (int f = 0; f < faces; ++f) {
    body.add(float{7}).add(static_cast<std::uint8_t>(f == 5 ? corners_of_face_5 : 3));
    for (int i = 0; i < 3; ++i) body.add(static_cast<std::uint16_t>((f + i) % vertices));
    body.add(std::uint8_t{1});
  }
  return std::string("ply\nformat binary_") + (big ? "big" : "little") +
         "_endian 1.0\ncomment of ours\nelement vertex 7\nproperty uchar a\nproperty float x\n"
         "property double y\nproperty short b\nproperty float z\nelement mark 2\nproperty int m\n"
         "element face 9\nproperty float q\nproperty list uchar ushort vertex_indices\n"
         "property uchar c\nend_header\n" +
         body.text;
}

std::string complaint(const std::string& file, std::size_t first = 0, std::size_t count = 0) {
  return testing::message_of([&] {
    const io::PlyRows rows(file);
    std::vector<std::array<Index, 3>> corners(count);
    rows.read_faces(first, corners);
  });
}

}  // namespace

TEST_CASE("ranges of a binary .ply are rows of the whole") {
  const ::testing::Folder folder;
  for (const bool big : {false, true}) {
    const std::string file = folder.write("a.ply", made(big));
    const io::Triangles whole = io::read_triangles(file);
    const io::PlyRows rows(file);
    REQUIRE(rows.vertex_count() == vertices);
    REQUIRE(rows.face_count() == faces);
    for (std::size_t first = 0; first <= vertices; ++first)
      for (std::size_t count = 0; first + count <= vertices; ++count) {
        std::vector<std::array<double, 3>> some(count);
        rows.read_vertices(first, some);
        for (std::size_t i = 0; i < count; ++i) CHECK(some[i] == whole.positions[first + i]);
      }
    for (std::size_t first = 0; first <= faces; ++first)
      for (std::size_t count = 0; first + count <= faces; ++count) {
        std::vector<std::array<Index, 3>> some(count);
        rows.read_faces(first, some);
        for (std::size_t i = 0; i < count; ++i) CHECK(some[i] == whole.triangles[first + i]);
      }
  }
}

TEST_CASE("a .ply is read in parts whatever its header's length, and what comments say") {
  const ::testing::Folder folder;
  const std::string good = made(false), file = folder.at("a.ply").string();
  const std::string said = "comment of ours", last = "end_header";
  const auto check = [&](const std::string& comment) {
    std::string text = good;
    text.replace(text.find(said), said.size(), "comment " + comment);
    folder.write("a.ply", text);
    CAPTURE(text.find(last), text.size());
    const std::string cause = testing::message_of([&] {
      const io::PlyRows rows(file);
      CHECK(rows.face_count() == faces);
      std::vector<std::array<Index, 3>> corners(faces);
      rows.read_faces(0, corners);
      CHECK(corners[8] == std::array<Index, 3>{1, 2, 3});
    });
    CHECK(cause.substr(0, 200).empty());
  };
  // The header ends about where the first look at it does.
  const std::size_t at = good.find(last) + last.size() - said.size() + 8;
  for (std::size_t end = 65536 - 12; end <= 65536 + 60; ++end) check(std::string(end - at, 'c'));
  check("on the end_header line" + std::string(300'000, ' '));
}

TEST_CASE("a .ply that has no rows of one size, or not all of them, is refused") {
  const ::testing::Folder folder;
  const auto has = [](const std::string& text, const std::string& part) {
    INFO(text << " has " << part);
    CHECK(text.find(part) != std::string::npos);
  };
  const std::string good = made(false), file = folder.at("a.ply").string();
  folder.write("a.ply", made(false, 4));
  has(complaint(file, 3, 6), "'face' element 5: ");
  CHECK(complaint(file, 0, 5).empty());  // another's range
  for (const std::size_t cut : {1, 20, 104, 110, 200}) {
    folder.write("a.ply", good.substr(0, good.size() - cut));
    has(complaint(file), "elements, but only");
  }
  folder.write("a.ply", good.substr(0, good.find("element mark")));
  has(complaint(file), "end_header");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    folder.write("a.ply", text);
    return complaint(file, 0, 1);
  };
  has(changed("binary_little_endian", "ascii"), "is text");
  has(changed("property int m", "property list uchar int m"), "has a list 'm'");
  has(changed("vertex_indices", "corners"), "vertex_indices");
  has(changed("element face 9", "element face 0"), "has no faces");
  // More than the header says; what is blank, or not read but said, may follow.
  has(changed("element face 9", "element face 8"), "goes on after its last element");
  folder.write("a.ply", good + "x");
  has(complaint(file), "goes on after its last element");
  folder.write("a.ply", good + std::string(200'000, '\0') + "x");
  has(complaint(file), "byte " + std::to_string(good.size() + 200'000));
  folder.write("a.ply", good + std::string(200'000, '\0') + "\n \r\n");
  CHECK(complaint(file, 0, faces).empty());
  const auto with_more = [&](const std::string& element, const std::string& rows) {
    std::string text = good + rows;
    text.insert(text.find("end_header"), element);
    folder.write("a.ply", text);
    return complaint(file, 0, faces);
  };
  CHECK(with_more("element edge 2\nproperty short a\n", "1234").empty());
  has(with_more("element edge 2\nproperty short a\n", "12345"), "goes on");
  has(with_more("element edge 2\nproperty short a\n", "123"), "elements, but only 3");
  has(with_more("element strip 1\nproperty list uchar int a\n", "\1abcd"), "has a list 'a'");
  CHECK(with_more("element strip 0\nproperty list uchar int a\n", "").empty());
  folder.write("a.ply", "");
  has(complaint(file), "is empty");
  has(complaint(folder.at("none.ply").string()), "no such file");
  has(complaint(folder.path().string()), "is a directory");
  std::string nan = good;
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + nan.find("end_header\n") + 11 + 19 + 1, &bad, sizeof bad);
  folder.write("a.ply", nan);
  std::vector<std::array<double, 3>> some(vertices);
  CHECK_THROWS_AS(io::PlyRows(file).read_vertices(0, some), InputError);
}

}  // namespace plexway::ply_rows_test
