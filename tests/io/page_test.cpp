// The page that shows a result in a browser: what is in the file. That it draws was looked at in a
// browser, from a disk.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/page.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/io/points.hpp>

#include "io/base64.hpp"
#include "io/io_testing.hpp"
#include "io_testing.hpp"

namespace plexway::page_test {

using namespace io_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

nlohmann::json data_of(const std::string& html) {
  const std::string begin = "const data = ";
  const auto from = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(from, html.find(";\nconst at") - from));
}

template <class Number>
std::vector<Number> numbers_of(const nlohmann::json& text) {
  std::string bytes;
  REQUIRE(io::decode_base64(text.get<std::string>(), bytes));
  REQUIRE(bytes.size() % sizeof(Number) == 0);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace

TEST_CASE("a page holds all that it shows, in a frame of its own, and loads nothing") {
  const Folder folder;
  // Far from the origin, where single precision is coarse.
  const double far = 1e9;
  const Positions at = {{far, 0, 0}, {far + 3, 0, 0}, {far + 3, 4, 0}, {far, 4, 0}, {0, 0, 0}};
  const std::vector<double> value = {0, 3, 5, 4, std::numeric_limits<double>::infinity()};
  io::Page page;
  page.title = "</script><script>alert(\"x\")";
  page.positions = at;
  page.triangles = {{0, 1, 2}, {0, 2, 3}};
  page.value = value;
  page.sources = {at[0]};
  page.paths = {{at[0], at[2]}};
  io::write_page(folder.at("p.html"), page);
  const std::string html = bytes_of(folder.at("p.html"));
  for (const char* loading : {"http:", "https:", "src=", "href=", "import ", "fetch("})
    CHECK(html.find(loading) == html.npos);
  CHECK(html.find("</script>") == html.rfind("</script>"));
  const auto data = data_of(html);
  CHECK(data["title"] == page.title);
  const auto positions = numbers_of<float>(data["positions"]);
  REQUIRE(positions.size() == 15);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      const double centre[3] = {far + 1.5, 2, 0};
      CHECK(double{positions[3 * v + k]} == Approx((at[v][k] - centre[k]) / 5).margin(1e-7));
    }
  CHECK(numbers_of<std::uint32_t>(data["triangles"]) ==
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  const auto values = numbers_of<float>(data["value"]);
  CHECK(values == std::vector<float>{0, 3, 5, 4, 3e38f});
  CHECK(data["range"] == nlohmann::json::array({0, 5}));
  CHECK(data["bar"] == true);
  CHECK(data["map"].size() == 256);
  CHECK(data["paths"][0].size() == 2);
  CHECK(numbers_of<float>(data["colour"]).empty());
}

TEST_CASE("pages of cells, wires and points") {
  const Folder folder;
  const Positions at = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::int32_t> label = {0, 9, -1};
  io::Page page;
  page.positions = at;
  page.label = label;
  page.edges = {{0, 1}};
  io::write_page(folder.at("p.html"), page);
  const auto data = data_of(bytes_of(folder.at("p.html")));
  CHECK(data["bar"] == false);
  CHECK(numbers_of<std::uint32_t>(data["edges"]).size() == 2);
  const auto colour = numbers_of<std::uint32_t>(data["colour"]);
  REQUIRE(colour.size() == 3);
  CHECK(colour[0] == (119u | 170u << 8 | 221u << 16 | 255u << 24));
  CHECK(colour[1] == (238u | 136u << 8 | 102u << 16 | 255u << 24));  // 9 is 1 of 8
  CHECK(colour[2] == (128u | 128u << 8 | 128u << 16 | 255u << 24));
}

TEST_CASE("pages that make no sense are refused, and leave no file") {
  const Folder folder;
  const Positions at = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto refused = [&](auto change) {
    io::Page page;
    page.positions = at;
    page.triangles = {{0, 1, 2}};
    change(page);
    CHECK_THROWS_AS(io::write_page(folder.at("p.html"), page), UsageError);
    CHECK(folder.files() == 0);
  };
  const std::vector<double> two = {1, 2};
  const Positions broken = {{0, 0, 0}, {1, 0, std::nan("")}, {0, 1, 0}};
  refused([&](io::Page& page) { page.value = two; });
  refused([&](io::Page& page) { page.triangles = {{0, 1, 3}}; });
  refused([&](io::Page& page) { page.positions = broken; });
  refused([&](io::Page& page) { page.map = "rainbow"; });
  refused([&](io::Page& page) { page.range = {{1, 1}}; });
  refused([&](io::Page& page) { page.up = 'w'; });
  refused([&](io::Page& page) { page.positions = {}, page.triangles = {}; });
}

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

TEST_CASE("paths as CSV are points that read back, each with its path") {
  const Folder folder;
  io::write_paths(folder.path() / "p.csv", two_paths());
  const std::string csv = bytes_of((folder.path() / "p.csv").string());
  CHECK(csv.starts_with("path,x,y,z\n0,"));
  CHECK(csv.find("\n2,") != csv.npos);  // the second is empty
  CHECK(csv.find("\n1,") == csv.npos);
  std::vector<std::array<double, 3>> points;
  for (const Path& path : two_paths())
    points.insert(points.end(), path.positions.begin(), path.positions.end());
  CHECK(io::read_points(folder.path() / "p.csv").positions == points);

  auto lines = two_paths();
  for (Path& line : lines) line.source = 0;
  io::write_isolines(folder.path() / "i.csv", lines, std::vector<double>{0.25});
  CHECK(bytes_of((folder.path() / "i.csv").string()).find("1,2,0.5,0.25\n") != csv.npos);
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

}  // namespace plexway::page_test
