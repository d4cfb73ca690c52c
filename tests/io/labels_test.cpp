#include <plexway/io/labels.hpp>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>

#include "folder.hpp"
#include "io/surface/freesurfer_labels.hpp"

namespace plexway::labels_test {

namespace {

using namespace plexway::io;
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

}  // namespace plexway::labels_test
