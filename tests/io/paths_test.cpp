#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/paths.hpp>

#include "io/io_testing.hpp"

namespace plexway::paths_test {

using io_testing::bytes_of;
using io_testing::Folder;

namespace {

// Two lines, and one target that is not reached.
std::vector<Path> two_paths() {
  std::vector<Path> paths(3);
  paths[0].points = {{4, {1, 0, 0, 0}}, {7, {.25, .25, .5, 0}}, {7, {0, 1, 0, 0}}};
  paths[0].positions = {{0, 0, 0}, {1, 0, 0.5}, {1, 2, 0.5}};
  paths[0].length = 3.25;
  paths[0].source = 1;
  paths[2].points = {{2, {0.5, 0.5, 0, 0}}, {2, {0, 1, 0, 0}}};
  paths[2].positions = {{5, 5, 5}, {5, 5, 6}};
  paths[2].length = 1;
  paths[2].source = 0;
  return paths;
}

}  // namespace

TEST_CASE("paths as lines of an OBJ file are read back as edges") {
  const Folder folder;
  const auto file = folder.path() / "paths.OBJ";
  io::write_paths(file, two_paths());
  const io::Edges edges = io::read_edges(file);
  CHECK(edges.vertices == 5);
  CHECK(edges.edges == std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}, {3, 4}});
  CHECK(edges.positions[2] == std::array<double, 3>{1, 2, 0.5});
}

TEST_CASE("paths as JSON keep simplices, and null where none leads") {
  const Folder folder;
  const auto file = folder.path() / "paths.json";
  io::write_paths(file, two_paths());
  const auto json = nlohmann::json::parse(bytes_of(file.string()));
  REQUIRE(json["paths"].size() == 3);
  CHECK(json["paths"][0]["length"] == 3.25);
  CHECK(json["paths"][0]["points"][1]["simplex"] == 7);
  CHECK(json["paths"][0]["points"][1]["barycentric"][2] == 0.5);
  CHECK(json["paths"][0]["positions"][2][1] == 2.0);
  CHECK(json["paths"][1]["length"].is_null());
  CHECK(json["paths"][1]["points"].empty());
  CHECK(json["paths"][2]["source"] == 0);
}

TEST_CASE("paths as PLY and VTP have all points and lines") {
  const Folder folder;
  io::write_paths(folder.path() / "p.ply", two_paths());
  const std::string ply = bytes_of((folder.path() / "p.ply").string());
  CHECK(ply.find("element vertex 5\n") != ply.npos);
  CHECK(ply.find("element edge 3\n") != ply.npos);
  CHECK(ply.find("\n1 2 0.5\n") != ply.npos);
  CHECK(ply.find("\n3 4\n") != ply.npos);
  io::write_paths(folder.path() / "p.vtp", two_paths());
  const std::string vtp = bytes_of((folder.path() / "p.vtp").string());
  CHECK(vtp.find("NumberOfPoints=\"5\"") != vtp.npos);
  CHECK(vtp.find("NumberOfLines=\"2\"") != vtp.npos);
  CHECK(vtp.find("3 5 ") != vtp.npos);
  CHECK(vtp.find("3.25 1 ") != vtp.npos);
}

TEST_CASE("paths that a format cannot hold are refused") {
  const Folder folder;
  auto paths = two_paths();
  CHECK_THROWS_AS(io::write_paths(folder.path() / "p.stl", paths), UsageError);
  for (Path& path : paths) path.positions.clear();
  CHECK_THROWS_AS(io::write_paths(folder.path() / "p.obj", paths), UsageError);
  CHECK(folder.files() == 0);
  io::write_paths(folder.path() / "p.json", paths);
  CHECK(folder.files() == 1);
}

}  // namespace plexway::paths_test
