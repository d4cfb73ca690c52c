// Mixed domains and simplices of any dimension from files, through the tool.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace mixed_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::Folder;

namespace {

std::vector<double> distances(std::vector<std::string> words) {
  words.insert(words.begin(), "distance");
  for (const char* word : {"--precision", "double", "--quiet", "--out", "-"})
    words.emplace_back(word);
  const auto run = run_tool(words);
  INFO(run.err);
  REQUIRE(run.code == 0);
  return csv_column(run.out, "distance");
}

// Two triangles that make the unit square in the plane z = 0, and from its corner (1, 1) a line of
// length 4 upwards; vertex 6 is in no cell.
const std::string flag =
    "# vtk DataFile Version 3.0\nflag\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 1 2\n1 1 4\n9 9 9\n"
    "CELLS 3 12\n3 0 1 2\n3 0 2 3\n3 2 4 5\nCELL_TYPES 3\n5 5 4\n";

// An OFF file of the square [x, x + 1] x [0, 1] in the plane z = 0, n x n vertices.
std::string square_at(double x, int n) {
  std::string text =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string(2 * (n - 1) * (n - 1)) + " 0\n";
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      text += std::to_string(x + double(j) / (n - 1)) + " " + std::to_string(double(i) / (n - 1)) +
              " 0\n";
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      text += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
              std::to_string(a + n + 1) + "\n3 " + std::to_string(a) + " " +
              std::to_string(a + n + 1) + " " + std::to_string(a + n) + "\n";
    }
  return text;
}

}  // namespace

TEST_CASE("cells of several dimensions in one file are a mixed domain") {
  const Folder folder;
  const std::string file = folder.write("flag.vtk", flag);
  const auto distance = distances({file, "--as", "mixed", "-s", "vertex:5"});
  REQUIRE(distance.size() == 7);
  CHECK(distance[5] == 0);
  CHECK(distance[4] == Approx(2));
  CHECK(distance[2] == Approx(4));
  CHECK(distance[1] == Approx(5));
  CHECK(distance[3] == Approx(5));
  CHECK(distance[0] == Approx(4 + std::sqrt(2)));
  CHECK(std::isinf(distance[6]));
  // From a point of the line, and from a point of a triangle.
  CHECK(distance == distances({file, "--as", "mixed", "-s", "vertex:5", "--executor", "openmp",
                               "--threads", "2"}));
  CHECK(distances({file, "--as", "mixed", "-s", "point:1,1,3"})[0] == Approx(3 + std::sqrt(2)));
  CHECK(distances({file, "--as", "mixed", "-s", "point:0.5,0.25,0"})[5] ==
        Approx(4 + std::hypot(0.5, 0.75)));

  const auto run = run_tool({"distance", file, "--as", "mixed", "-s", "vertex:5", "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["kind"] == "mixed");
  CHECK(run.json()["simplices"] == 4);
  CHECK(run.json()["components"] == 1);
  CHECK(run.json()["unreached"] == 1);
  CHECK_THAT(run.err, Contains("the mixed domain has 1 component"));
  const std::string out = folder.write("out.vtu", "");
  CHECK(run_tool({"distance", file, "--as", "mixed", "-s", "vertex:5", "-o", out}).code == 0);
  CHECK_THAT(io_testing::bytes_of(out), Contains("NumberOfPoints=\"7\""));

  const auto info = run_tool({"info", file, "--as", "mixed", "--json"});
  REQUIRE(info.code == 0);
  CHECK(info.json()["edges"] == 2);
  CHECK(info.json()["triangles"] == 2);
  CHECK(info.json()["tetrahedra"] == 0);
  CHECK(info.json()["pieces"] == 2);
  CHECK(info.json()["hinges"][0] == 1);
  CHECK(run_tool({"bench", file, "--as", "mixed", "-s", "vertex:5", "--repeats", "2"}).code == 0);
}

TEST_CASE("speeds by the regions of the file, and lines of equal distance on a mixed domain") {
  const Folder folder;
  const std::string file =
      folder.write("flag.vtk", flag + "CELL_DATA 3\nFIELD f 1\nregion 1 3 int\n7 7 3\n");
  const auto by = [&](const std::string& name, const std::string& text) {
    return std::string(name) + ":" + folder.write(name + ".txt", text).string();
  };
  // The line twice as fast as the square.
  const auto distance = distances(
      {file, "--as", "mixed", "-s", "vertex:5", "--metric", by("regions", "3 2\n7 1\n9 5\n")});
  CHECK(distance[2] == Approx(2));
  CHECK(distance[1] == Approx(3));
  CHECK(distance[0] == Approx(2 + std::sqrt(2)));
  CHECK(distance == distances({file, "--as", "mixed", "-s", "vertex:5", "--metric",
                               by("speed", "2\n2\n1\n1\n")}));
  const auto fails = [&](const std::string& text, int code, const std::string& why) {
    const auto run = run_tool(
        {"distance", file, "--as", "mixed", "-s", "vertex:5", "--metric", by("regions", text)});
    CHECK(run.code == code);
    CHECK_THAT(run.err, Contains(why));
  };
  fails("3 2\n", 3, "no speed for region 7");
  fails("3 2\n7 0\n", 3, "above 0");
  fails("3 2\n3 1\n", 3, "already");
  const auto none = run_tool({"distance", folder.write("square.off", square_at(0, 4)), "-s",
                              "vertex:0", "--metric", by("regions", "1 1\n")});
  CHECK(none.code == 3);
  CHECK_THAT(none.err, Contains("square.off"));  // a format that has no regions

  // From the corner of a square about as far as a circle, and each point in a triangle there.
  const std::string left = folder.write("left.off", square_at(0, 21));
  const std::string right = folder.write("right.off", square_at(1, 21));
  const std::string lines = folder.write("lines.json", "");
  CHECK(run_tool({"distance", left, right, "--weld", "1e-6", "-s", "vertex:0", "--isoline-step",
                  "0.8", "--isolines-out", lines, "--quiet"})
            .code == 0);
  const auto json = nlohmann::json::parse(io_testing::bytes_of(lines));
  double length = 0;
  for (const auto& line : json["paths"]) {
    if (line["source"] != 0) continue;
    length += line["length"].get<double>();
    for (std::size_t i = 0; i < line["points"].size(); ++i) {
      const auto& at = line["positions"][i];
      CHECK(std::hypot(at[0].get<double>(), at[1].get<double>()) == Approx(0.8).epsilon(3e-3));
      CHECK(line["points"][i]["simplex"].get<int>() < 2 * 800);
    }
  }
  CHECK(length == Approx(0.8 * std::acos(0.)).epsilon(3e-3));
}

TEST_CASE("paths on mixed domains: over welds, along lines, refracted, in pictures") {
  const Folder folder;
  const std::string file = folder.write("flag.vtk", flag);
  const std::string out = folder.write("paths.json", ""), picture = folder.write("paths.png", "");
  const auto run = run_tool({"path", file, "--as", "mixed", "-f", "vertex:5", "-t", "vertex:0",
                             "-t", "point:0.5,0.25,0", "-t", "vertex:6", "-t", "vertex:5", "-o",
                             out, "--picture", picture, "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto paths = run.json()["paths"];
  CHECK(paths[0]["length"].get<double>() == Approx(4 + std::sqrt(2)).epsilon(1e-6));
  CHECK(paths[0]["distance"].get<double>() == Approx(4 + std::sqrt(2)).epsilon(1e-6));
  CHECK(paths[1]["length"].get<double>() == Approx(4 + std::hypot(.5, .75)).epsilon(1e-6));
  CHECK(paths[1]["distance"].get<double>() == Approx(4 + std::hypot(.5, .75)).epsilon(1e-6));
  CHECK(paths[2]["from"].is_null());
  CHECK(paths[3]["length"] == 0);
  CHECK_THAT(run.err, Contains("1 target not reached"));
  CHECK(io_testing::bytes_of(picture).size() > 1000);
  const auto written = nlohmann::json::parse(io_testing::bytes_of(out))["paths"][0];
  CHECK(written["positions"].back()[2].get<double>() == 4);
  CHECK(written["points"][0]["simplex"].get<int>() == 2);      // the second triangle
  CHECK(written["points"].back()["simplex"].get<int>() == 1);  // the upper edge

  // Up the line at twice the speed: the length is a time.
  const std::string regions = "regions:" + folder.write("r.txt", "0 2\n1 1\n").string();
  const std::string fast =
      folder.write("fast.vtk", flag + "CELL_DATA 3\nFIELD f 1\nregion 1 3 int\n1 1 0\n");
  const auto timed = run_tool({"path", fast, "--as", "mixed", "-f", "vertex:5", "-t", "vertex:0",
                               "--metric", regions, "--json"});
  INFO(timed.err);
  REQUIRE(timed.code == 0);
  CHECK(timed.json()["paths"][0]["length"].get<double>() == Approx(2 + std::sqrt(2)).epsilon(1e-6));
  CHECK(timed.json()["paths"][0]["length_in_space"].get<double>() ==
        Approx(4 + std::sqrt(2)).epsilon(1e-6));

  // Two squares in two files, the second at half the speed.
  const std::string left = folder.write("left.off", square_at(0, 6));
  const std::string right = folder.write("right.off", square_at(1, 6));
  std::string speeds;
  for (int s = 0; s < 100; ++s) speeds += s < 50 ? "1\n" : "0.5\n";
  const auto both = run_tool(
      {"path", left, right, "--weld", "1e-9", "-f", "vertex:0", "-t", "vertex:71", "--metric",
       "speed:" + folder.write("s.txt", speeds).string(), "--json", "--precision", "double"});
  INFO(both.err);
  REQUIRE(both.code == 0);
  double least = 1e9;  // over any point of the line between
  for (int i = 0; i <= 100000; ++i) {
    const double y = i / 1e5;
    least = std::min(least, std::hypot(1, y) + 2 * std::hypot(1, 1 - y));
  }
  const auto one = both.json()["paths"][0];
  CHECK(one["length"].get<double>() == Approx(least).epsilon(1e-9));
  CHECK(one["distance"].get<double>() == Approx(least).epsilon(2e-3));
}

TEST_CASE("several files are welded to a mixed domain") {
  const Folder folder;
  const std::string left = folder.write("left.off", square_at(0, 6));
  const std::string right = folder.write("right.off", square_at(1 + 1e-4, 6));
  const auto distance = distances({left, right, "--weld", "1e-3", "-s", "vertex:0"});
  REQUIRE(distance.size() == 72);
  // Two squares side by side: straight, but for the gap.
  double worst = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto at = static_cast<std::size_t>(36 + 6 * i + j);
      const double exact = std::hypot(1 + j / 5., i / 5.);
      worst = std::max(worst, std::abs(distance[at] / exact - 1));
    }
  CHECK(worst < 3e-4);
  // Not near enough to be one.
  CHECK(std::isinf(distances({left, right, "--weld", "1e-5", "-s", "vertex:0"})[40]));

  const auto fails = [&](std::vector<std::string> words, int code, const std::string& why) {
    words.insert(words.begin(), "distance");
    words.insert(words.end(), {"-s", "vertex:0"});
    const auto run = run_tool(words);
    INFO(run.err);
    CHECK(run.code == code);
    CHECK_THAT(run.err, Contains(why));
    CHECK(run.complaints() == 1);
  };
  fails({left, right}, 2, "--weld TOLERANCE");
  fails({left, "--weld", "1"}, 2, "--weld needs several files");
  fails({left, right, "--weld", "-1"}, 2, "--weld must be a number >= 0");
  fails({left, right, "--weld", "0", "--as", "solid"}, 2, "--as");
  fails({left, right, "--weld", "0.3"}, 2, "which lie apart");
  fails({left, sample("roll.xyz"), "--weld", "0"}, 3, "roll.xyz");
  fails({left, right, "--weld", "0", "--executor", "gl"}, 2, "the executor GL takes");
  const std::string third = folder.write("third.vtk", flag);
  fails({left, third, "--weld", "0", "-o", third}, 2, "overwrite");
  fails({left, "--as", "mixed"}, 3, "cannot be taken as a mixed domain");
}

TEST_CASE("simplices of four dimensions come from a file") {
  const Folder folder;
  // The corner simplex of the unit cube of space-time, and one with lengths alone.
  const std::string file = folder.write(
      "corner.simplices",
      "dimension 4\nvertices 5 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\nsimplices 1\n"
      "0 1 2 3 4\n");
  const auto distance = distances({file, "-s", "vertex:1"});
  CHECK(distance[1] == 0);
  CHECK(distance[0] == Approx(1));
  for (const std::size_t v : {2, 3, 4}) CHECK(distance[v] == Approx(std::sqrt(2)));
  const std::string path = folder.write(
      "path.simplices", "dimension 1\nvertices 4\nsimplices 3\n0 1 2\n1 2 0.5\n2 3 1\n");
  CHECK(distances({path, "-s", "vertex:0"}) == std::vector<double>{0, 2, 2.5, 3.5});
  const auto info = run_tool({"info", file, "--json"});
  REQUIRE(info.code == 0);
  CHECK(info.json()["kind"] == "simplices");
  CHECK(info.json()["dimension"] == 4);
  CHECK(info.json()["flat"] == true);
  for (const std::string& one : {file, path}) {
    const auto bench = run_tool({"bench", one, "-s", "vertex:0", "--repeats", "2", "--json"});
    INFO(bench.err);
    REQUIRE(bench.code == 0);
    CHECK(bench.json()["kind"] == "simplices");
  }
  CHECK_THAT(run_tool({"distance", file, "-s", "vertex:1"}).out,
             Contains("1 simplex, 1 component"));
  const auto written = run_tool({"convert", file, folder.write("x.obj", "")});
  CHECK(written.code == 2);
  CHECK_THAT(written.err, Contains("are converted"));
  const auto point = run_tool({"distance", file, "-s", "point:0,0,0"});
  CHECK(point.code == 3);
  CHECK_THAT(point.err, Contains("no positions"));
  const auto traced = run_tool({"path", file, "--from", "vertex:0", "--to", "vertex:1"});
  CHECK(traced.code == 2);
  CHECK_THAT(traced.err, Contains("paths are traced on"));
}

}  // namespace mixed_test
