#include <catch2/catch.hpp>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>

#include "io/io_testing.hpp"

namespace plexway::mixed_field_test {

namespace {

const std::vector<std::array<double, 3>> block = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::array<double, 3>> plate = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
const std::vector<std::array<double, 3>> rod = {{2, 0, 0}, {3, 0, 0}};
const std::vector<std::array<std::uint32_t, 4>> tets = {{0, 1, 2, 3}};
const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}};
const std::vector<double> distance = {
    0, 1, 1, 1, 1, 2, 2, 2, std::numeric_limits<double>::infinity()};

}  // namespace

TEST_CASE("the parts of a mixed domain lie in one file") {
  const io_testing::Folder folder;
  const io::MixedPart parts[] = {{.positions = block, .tets = tets},
                                 {.positions = plate, .triangles = triangles},
                                 {.positions = rod, .edges = edges}};
  for (const char* extension : {".vtu", ".vtk"}) {
    const auto file = folder.path() / (std::string("mixed") + extension);
    io::write_field(file, parts, distance);
    const io::Tets back = io::read_tets(file);  // passes over what is no tetrahedron
    REQUIRE(back.positions.size() == 9);
    CHECK(back.positions[4] == plate[0]);
    CHECK(back.positions[8] == rod[1]);
    CHECK(back.tets == tets);
  }
  const auto text = folder.path() / "mixed.ply";
  io::write_field(text, parts, distance);
  const io::Triangles faces = io::read_triangles(text);
  CHECK(faces.positions.size() == 9);
  CHECK(faces.triangles == std::vector<std::array<std::uint32_t, 3>>{{4, 5, 6}});
}

TEST_CASE("a part of a mixed domain that names a vertex it lacks is refused") {
  const io_testing::Folder folder;
  const std::vector<std::array<std::uint32_t, 2>> wrong = {{0, 2}};
  const io::MixedPart parts[] = {{.positions = rod, .edges = wrong}};
  const std::vector<double> two = {0, 1};
  CHECK_THROWS_AS(io::write_field(folder.path() / "x.vtu", parts, two), UsageError);
  const io::MixedPart right[] = {{.positions = rod, .edges = edges}};
  CHECK_THROWS_AS(io::write_field(folder.path() / "x.vtu", right, distance), UsageError);
}

}  // namespace plexway::mixed_field_test
