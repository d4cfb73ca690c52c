#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/io/triangles.hpp>

#include "folder.hpp"
#include "io/base64.hpp"
#include "io/readers.hpp"

namespace plexway::brain_surfaces_test {

using namespace plexway::io;

namespace {

template <class Number>
void add_big(std::string& bytes, Number number) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof raw);
  for (std::size_t i = sizeof raw; i-- > 0;) bytes += raw[i];
}

std::string freesurfer(std::int32_t vertices, const std::vector<float>& coordinates,
                       std::int32_t faces, const std::vector<std::int32_t>& corners) {
  std::string bytes = "\xFF\xFF\xFE";
  bytes += "created by hand\n\n";
  add_big(bytes, vertices);
  add_big(bytes, faces);
  for (const float x : coordinates) add_big(bytes, x);
  for (const std::int32_t v : corners) add_big(bytes, v);
  return bytes;
}

const std::vector<std::array<double, 3>> tetrahedron = {
    {0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, -2}};
const std::vector<std::array<std::uint32_t, 3>> its_faces = {
    {0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

std::string array(const std::string& intent, const std::string& type, const std::string& dims,
                  const std::string& encoding, const std::string& data,
                  const std::string& more = "") {
  return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
         "\" ArrayIndexingOrder=\"RowMajorOrder\" " + dims + " Encoding=\"" + encoding +
         "\" Endian=\"LittleEndian\" " + more + "><MetaData/><Data>" + data +
         "</Data></DataArray>\n";
}
std::string gifti(const std::string& arrays) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<GIFTI Version=\"1.0\">\n" + arrays +
         "</GIFTI>\n";
}

const std::string points_dims = R"(Dimensionality="2" Dim0="4" Dim1="3")";

}  // namespace

TEST_CASE("base64 is decoded whole or not at all") {
  std::string bytes;
  CHECK((decode_base64("aGVsbG8=", bytes) && bytes == "hello"));
  CHECK((decode_base64(" aGVs\nbG8h ", bytes) && bytes == "hello!"));
  CHECK((decode_base64("", bytes) && bytes.empty()));
  for (const char* bad : {"aGVsbG8", "aGVs=G8=", "a===", "aG?s", "aGVsbG8=a"})
    CHECK_FALSE(decode_base64(bad, bytes));
}

TEST_CASE("surfaces of FreeSurfer are read, and what is wrong with them is told") {
  const std::vector<float> coordinates = {0, 0, 0, 1, 0, 0, 0, 1.5F, 0, 0, 0, -2};
  const std::vector<std::int32_t> corners = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  const std::string good = freesurfer(4, coordinates, 4, corners);
  const Triangles surface = parse_freesurfer(good + "more", "lh.white");
  CHECK(surface.positions == tetrahedron);
  CHECK(surface.triangles == its_faces);
  const ::testing::Folder folder;
  CHECK(read_triangles(folder.write("lh.pial", good)).triangles == its_faces);
  for (std::size_t length = 0; length < good.size(); ++length)
    CHECK_THROWS_AS(parse_freesurfer(good.substr(0, length), "lh.white"), InputError);
  CHECK_THROWS_AS(parse_freesurfer(freesurfer(4, coordinates, 0, {}), "lh"), InputError);
  CHECK_THROWS_AS(parse_freesurfer(freesurfer(3, coordinates, 4, corners), "lh"), InputError);
  CHECK_THROWS_AS(parse_freesurfer(freesurfer(-1, coordinates, 4, corners), "lh"), InputError);
  auto nan = coordinates;
  nan[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_AS(parse_freesurfer(freesurfer(4, nan, 4, corners), "lh"), InputError);
}

TEST_CASE("GIfTI surfaces are read in all their encodings") {
  const std::string ascii_points =
      array("POINTSET", "FLOAT32", points_dims, "ASCII", "0 0 0\n1 0 0\n0 1.5 0\n0 0 -2\n");
  const std::string ascii_faces =
      array("TRIANGLE", "INT32", points_dims, "ASCII", "0 1 2 0 3 1 0 2 3 1 3 2");
  // By numpy: base64 of the bytes, of zlib's bytes.
  const std::string packed_points =
      array("POINTSET", "FLOAT32", points_dims, "GZipBase64Binary", "eJxjYEAGDfYoXIYDaHyGAwArvgJ/");
  const std::string plain_faces =
      array("TRIANGLE", "INT32", points_dims, "Base64Binary",
            "AAAAAAEAAAACAAAAAAAAAAMAAAABAAAAAAAAAAIAAAADAAAAAQAAAAMAAAACAAAA");
  for (const std::string& file :
       {gifti(ascii_points + ascii_faces), gifti(ascii_faces + packed_points),
        gifti(packed_points + plain_faces)}) {
    const Triangles surface = parse_gifti(file, "a.surf.gii");
    CHECK(surface.positions == tetrahedron);
    CHECK(surface.triangles == its_faces);
  }
  const ::testing::Folder folder;
  CHECK(read_triangles(folder.write("a.surf.gii", gifti(ascii_points + ascii_faces))).triangles ==
        its_faces);
  const std::string labels =
      array("LABEL", "INT32", R"(Dimensionality="1" Dim0="4")", "ASCII", "0 7 -1 7");
  CHECK(read_gifti_labels(folder.write("a.label.gii", gifti(labels))) ==
        std::vector<std::int32_t>{0, 7, -1, 7});

  const std::string bad[] = {
      "",
      "<GIFTI>",
      "<svg/>",
      gifti(""),
      gifti(ascii_points),
      gifti(ascii_points + array("TRIANGLE", "INT32", points_dims, "ASCII", "0 1 2")),
      gifti(ascii_points +
            array("TRIANGLE", "INT32", points_dims, "ASCII", "0 1 2 0 3 1 0 2 3 1 3 4")),
      gifti(ascii_points +
            array("TRIANGLE", "INT32", points_dims, "ASCII", "0 1 2 0 3 1 0 2 3 1 3 -1")),
      gifti(ascii_points + array("TRIANGLE", "INT32", points_dims, "Base64Binary", "AAAA")),
      gifti(ascii_points + array("TRIANGLE", "INT32", points_dims, "GZipBase64Binary", "AAAA")),
      gifti(ascii_points + array("TRIANGLE", "INT32", points_dims, "ExternalFileBinary", "")),
      gifti(ascii_points + array("TRIANGLE", "COMPLEX64", points_dims, "ASCII", "0 1 2")),
      gifti(ascii_points + array("TRIANGLE", "INT32",
                                 R"(Dimensionality="2" Dim0="4294967294" Dim1="3")",
                                 "GZipBase64Binary", "AAAA")),
      gifti(ascii_points + array("TRIANGLE", "INT32", R"(Dimensionality="2" Dim0="x" Dim1="3")",
                                 "ASCII", "0 1 2"))};
  for (const std::string& file : bad) {
    CAPTURE(file);
    CHECK_THROWS_AS(parse_gifti(file, "a.surf.gii"), InputError);
  }
}

namespace {

using Labels = std::vector<std::int64_t>;

std::string big(std::initializer_list<std::int64_t> numbers) {
  std::string bytes;
  for (const std::int64_t number : numbers)
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>(static_cast<std::uint32_t>(number) >> shift & 255);
  return bytes;
}
std::string text(const std::string& letters) {
  return big({static_cast<std::int64_t>(letters.size())}) + letters;
}

constexpr std::int64_t red = 200, blue = 7 + 256 * 9 + 65536 * 250, unknown = 25 + 256 * 5;

// Five vertices, in another order than their numbers.
const std::string coloured = big({5, 4, red, 0, blue, 1, unknown, 2, blue, 3, 0});

std::string entry(const std::string& name, std::int64_t colour) {
  return text(name) + big({colour & 255, colour >> 8 & 255, colour >> 16 & 255, 0});
}

}  // namespace

TEST_CASE("labels of annotations are the numbers of their colours") {
  const std::string numbered =  // the newer table: numbers may have gaps
      coloured + big({1, -2, 36}) + text("lut.txt") + big({3, 0}) + entry("unknown", unknown) +
      big({35}) + entry("insula", red) + big({12}) + entry("cuneus", blue);
  const std::string plain = coloured + big({1, 3}) + text("lut.txt") + entry("unknown", unknown) +
                            entry("cuneus", blue) + entry("insula", red);
  CHECK(parse_freesurfer_annotation(numbered, "a") == Labels{12, 0, 12, -1, 35});
  CHECK(parse_freesurfer_annotation(plain, "a") == Labels{1, 0, 1, -1, 2});
  for (const std::string& whole : {numbered, plain})
    for (std::size_t size = 0; size < whole.size(); ++size)
      CHECK_THROWS_AS(parse_freesurfer_annotation(whole.substr(0, size), "a"), InputError);
  for (const std::string& bad :
       {big({-1}), big({1, 1, 0}), coloured + big({0}), coloured + big({1, -3, 1}),
        coloured + big({1, -2, 5}) + text("") + big({-7}),
        coloured + big({1, 1}) + text("") + text("a") + big({256, 0, 0, 0})})
    CHECK_THROWS_AS(parse_freesurfer_annotation(bad, "a"), InputError);
  const testing::Folder folder;
  const auto file = folder.write("lh.aparc.annot", numbered);
  CHECK(read_vertex_labels(file, 5) == Labels{12, 0, 12, -1, 35});
  CHECK_THROWS_AS(read_vertex_labels(file, 6), InputError);
}

TEST_CASE("labels that list vertices, and lists of labels") {
  const testing::Folder folder;
  const auto label = folder.write(
      "lh.V1.label", "#!ascii label  , from subject bert\n2\n3 -1.5 2 3e1 0.0\n0 1 1 1 0.5\n");
  CHECK(read_vertex_labels(label, 5) == Labels{1, 0, 0, 1, 0});
  CHECK_THROWS_AS(read_vertex_labels(label, 3), InputError);
  for (const char* bad : {"#!ascii\n3\n0 1 1 1 0\n", "0 1 1 1 0\n", ""})
    CHECK_THROWS_AS(read_vertex_labels(folder.write("bad.label", bad), 5), InputError);
  CHECK(read_vertex_labels(folder.write("l.txt", "# parcels\n3\n-1\n7\n"), 3) == Labels{3, -1, 7});
  CHECK_THROWS_AS(read_vertex_labels(folder.write("half.txt", "3\n0.5\n"), 2), InputError);
  CHECK_THROWS_AS(read_vertex_labels(folder.at("none.txt"), 2), InputError);
}

}  // namespace plexway::brain_surfaces_test
