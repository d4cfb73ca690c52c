#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace mask_test {

// `--mask` of every command: what masks may be, and what is refused. (What is solved behind one:
// tests/shape.)

namespace {

using namespace cli_testing;

}  // namespace

TEST_CASE("labels and regions are masks: of vertices, of the file's own cells, in every command") {
  const testing::Folder folder;
  const std::string square = folder.write("square.off", square_off(7));
  // Labels 3 and 7 make a wall with a door; 0 elsewhere.
  std::string labels, closed, annotation;
  const auto add = [](std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255);
  };
  add(annotation, 49);
  for (int v = 0; v < 49; ++v) {
    const int label = v % 7 != 3 || v / 7 == 5 ? 0 : v / 7 < 3 ? 3 : 7;
    labels += std::to_string(label) + "\n";
    if (label != 0) closed += std::to_string(v) + "\n";
    add(annotation, static_cast<std::uint32_t>(v));
    add(annotation, static_cast<std::uint32_t>(label == 0 ? 1 : 256 * label));
  }
  for (const std::uint32_t n : {1U, ~1U, 8U}) add(annotation, n);  // a table: which colour is which
  for (const std::uint32_t n : {0U, 3U}) add(annotation, n);
  for (const std::uint32_t n : {0U, 3U, 7U})
    for (const std::uint32_t part : {n, 0U, n == 0 ? 1U : 0U, n, 0U, 0U}) add(annotation, part);
  std::string list =
      "#!ascii label\n" + std::to_string(std::count(closed.begin(), closed.end(), '\n')) + "\n";
  for (const char c : closed) list += c == '\n' ? std::string(" 0 0 0 0\n") : std::string(1, c);
  const std::string wall = "vertices:" + folder.write("wall.txt", closed).string(),
                    text = folder.write("l.txt", labels), out = folder.at("d.npy"),
                    mtx = folder.at("d.mtx");
  const std::string of_list = folder.write("l.label", list).string() + ":1",
                    of_annotation = folder.write("l.annot", annotation).string() + ":7,3",
                    of_text = text + ":3,7";
  const auto run = [&](std::vector<std::string> words, const std::string& input,
                       const std::string& mask, const std::string& file) {
    words.insert(words.begin() + 1, input);
    words.insert(words.end(), {"--mask", mask, "--out", file, "--quiet"});
    ran(words);
    return io_testing::bytes_of(file);
  };
  const std::vector<std::string> distance = {"distance", "--source", "vertex:8"},
                                 pairs = {"pairs", "--sources", "all"},
                                 near = {"pairs", "--sources", "all", "--radius", "0.7"},
                                 path = {"path", "--from", "vertex:8", "--to", "vertex:13"};
  for (const std::string& mask : {of_text, of_list, of_annotation}) {
    CAPTURE(mask);
    CHECK(run(distance, square, mask, out) == run(distance, square, wall, out));
    CHECK(run(pairs, square, mask, out) == run(pairs, square, wall, out));
    CHECK(run(near, square, mask, mtx) == run(near, square, wall, mtx));
    CHECK(run(path, square, mask, folder.at("p.obj")) ==
          run(path, square, wall, folder.at("p.obj")));
  }
  // A file with regions: three squares in a row, the middle one a region of two triangles.
  std::string vtk =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n";
  for (int v = 0; v < 8; ++v) vtk += std::to_string(v % 4) + " " + std::to_string(v / 4) + " 0\n";
  vtk += "CELLS 6 24\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\nCELL_TYPES 6\n";
  for (int f = 0; f < 6; ++f) vtk += "5\n";
  vtk += "CELL_DATA 6\nSCALARS region int 1\nLOOKUP_TABLE default\n1 1 2 5 1 1\n";
  const std::string squares = folder.write("squares.vtk", vtk);
  const std::string middle = "simplices:" + folder.write("middle.txt", "2\n3\n").string(),
                    half = "simplices:" + folder.write("half.txt", "3\n").string();
  const std::vector<std::string> corner = {"distance", "--source", "vertex:4", "--precision",
                                           "double"};
  CHECK(run(corner, squares, "regions:2,5", out) == run(corner, squares, middle, out));
  const std::string csv = folder.at("d.csv");
  const auto d = csv_column(run(corner, squares, "regions:5", csv), "distance");
  CHECK(io_testing::bytes_of(csv) == run(corner, squares, half, csv));
  CHECK(d[6] == Approx(2 * std::sqrt(2)).epsilon(1e-12));  // around the corner at (1, 0)
  CHECK(d[1] == Approx(std::sqrt(2)).epsilon(1e-12));

  for (const auto& [mask, code, what] :
       {std::tuple<std::string, int, std::string>{text + ":3,8", 3, "nothing has the label 8"},
        {text + ":", 2, "vertices:FILE"},
        {text + ":3,", 2, "vertices:FILE"},
        {text + ":3,x", 2, "vertices:FILE"},
        {"regions:2", 3, "square.off"},
        {text + ":0,3,7", 3, "closes all"},
        {folder.at("none.annot").string() + ":1", 3, "none.annot"}}) {
    CAPTURE(mask);
    check_refused({"distance", square, "--source", "vertex:8", "--mask", mask, "--out", out}, code,
                  what);
  }
}

TEST_CASE("masks that leave a source or a target nowhere to go are refused in one line") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(6));
  const std::string mask = folder.write("mask.txt", "14\n"),
                    faces = folder.write("faces.txt", "20\n");
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& text) {
    words.insert(words.begin() + 1, input);
    check_refused(words, code, text);
  };
  const std::string closed = "vertices:" + mask, face = "simplices:" + faces;
  refused({"distance", "--source", "vertex:14", "--mask", closed}, 3, "vertex 14 is masked");
  refused({"distance", "--source", "triangle:20", "--mask", face}, 3, "simplex 20 is masked");
  refused({"distance", "--source", "vertices:" + mask, "--mask", closed}, 3, "vertex 14 is masked");
  refused({"path", "--from", "vertex:0", "--to", "vertex:14", "--mask", closed}, 3, "is masked");
  refused({"path", "--from", "vertex:0", "--to", "vertex:1", "--mask", "14"}, 2, "vertices:FILE");
  refused({"distance", "--source", "vertex:0", "--as", "cloud", "--mask", closed}, 2, "--mask");
  CHECK(folder.files() == 3);
}

using io_testing::Folder;

namespace {

constexpr int n = 21;  // vertices a side of square_off

// One line for each triangle: its own for those left of x = 1/2, another for the others.
std::string halves(const std::string& off, const std::string& left, const std::string& right) {
  std::string rows;
  std::size_t at = 0;
  for (int line = 0; at < off.size(); ++line) {
    const std::size_t end = off.find('\n', at);
    const std::string text = off.substr(at, end - at);
    at = end + 1;
    if (line < 2 + n * n) continue;
    int count = 0, a = 0, b = 0, c = 0;
    REQUIRE(std::sscanf(text.c_str(), "%d %d %d %d", &count, &a, &b, &c) == 4);
    rows += (a % n + b % n + c % n > 3 * (n - 1) / 2 ? right : left) + "\n";
  }
  return rows;
}

std::vector<double> distances(const Words& extra, const std::string& mesh) {
  return cli_testing::distances(
      joined({mesh, "--source", "vertex:0", "--precision", "double"}, extra));
}

}  // namespace

TEST_CASE("a constant tensor measures a plane") {
  const Folder folder;
  const std::string mesh = folder.write("square.off", square_off(n));
  const std::string one = folder.write("one.txt", "# in the plane\n4, 1.5, 9\n");
  std::string each;
  for (int v = 0; v < n * n; ++v) each += "4 1.5 0 9 0 1\n";
  const std::string vertices = folder.write("vertices.csv", each);
  for (const std::string& metric : {"tensor:" + one, "vertex-tensor:" + vertices}) {
    const auto found = distances({"--metric", metric, "--triangulation", "delaunay"}, mesh);
    REQUIRE(found.size() == n * n);
    for (int v = 0; v < n * n; ++v) {
      const double x = v % n / (n - 1.0), y = v / n / (n - 1.0);
      CHECK(found[static_cast<std::size_t>(v)] ==
            Approx(std::sqrt(4 * x * x + 3 * x * y + 9 * y * y)).epsilon(1e-12).margin(1e-12));
    }
  }
}

TEST_CASE("two speeds refract, are told of, and a path goes the quicker way") {
  const Folder folder;
  const std::string off = square_off(n);
  const std::string mesh = folder.write("square.off", off);
  const std::string speeds = folder.write("speeds.txt", halves(off, "1", "3"));
  const auto report =
      ran({"distance", mesh, "--source", "vertex:0", "--metric", "speed:" + speeds, "--json"});
  CHECK(report.json()["metric"] == "speed:" + speeds);
  CHECK(report.json()["refracting_edges"] == n - 1);
  CHECK(report.json()["violated"] == 0);
  CHECK(report.complaints() == 0);
  // From the corner to the opposite one, by Fermat: crossing x = 1/2 at height y.
  double best = 1e9;
  for (int i = 0; i <= 100000; ++i) {
    const double y = i / 1e5;
    best = std::min(best, std::hypot(0.5, y) + std::hypot(0.5, 1 - y) / 3);
  }
  const auto found = distances({"--metric", "speed:" + speeds}, mesh);
  CHECK(found.back() == Approx(best).epsilon(1e-7));
  CHECK(distances({"--metric", "speed:" + speeds, "--executor", "openmp"}, mesh).back() ==
        Approx(best).epsilon(1e-7));
  // A* takes one length an edge, the mean of two: up to 0.23 % less.
  for (const bool astar : {false, true}) {
    std::vector<std::string> arguments = {"path",
                                          mesh,
                                          "--from",
                                          "vertex:0",
                                          "--to",
                                          "vertex:" + std::to_string(n * n - 1),
                                          "--metric",
                                          "speed:" + speeds,
                                          "--json",
                                          "--out",
                                          folder.at("way.obj").string()};
    if (astar) arguments.push_back("--astar");
    const auto path = ran(arguments);
    CHECK(path.json()["paths"][0]["length"].get<double>() ==
          Approx(best).epsilon(astar ? 5e-3 : 1e-7));
  }
}

TEST_CASE("solids and wireframes are measured as well") {
  const Folder folder;
  const std::string one = folder.write("speed.txt", "0.5\n");
  const auto slow = distances({"--metric", "speed:" + one}, sample("elbow.mesh"));
  const auto plain = distances({}, sample("elbow.mesh"));
  REQUIRE(slow.size() == plain.size());
  for (std::size_t v = 1; v < slow.size(); ++v)
    CHECK(slow[v] == Approx(2 * plain[v]).epsilon(1e-5));
  // As many speeds as tetrahedra: no regions.
  std::string many;
  for (int t = 0; t < 1152; ++t) many += std::to_string(1 + 1e-4 * t) + "\n";
  const auto mean = ran({"distance", sample("elbow.mesh"), "--source", "vertex:0", "--metric",
                         "speed:" + folder.write("many.txt", many).string()});
  CHECK_THAT(mean.err, Catch::Contains("at most 64 speeds"));
  const std::string edges = folder.write("streets.edges", "0 1 3\n1 2 4\n2 0 9\n");
  CHECK(distances({}, edges) == std::vector<double>{0, 3, 7});
  const std::string speeds = folder.write("limits.txt", "1\n1\n2\n");
  CHECK(distances({"--metric", "speed:" + speeds}, edges) == std::vector<double>{0, 3, 4.5});
  const std::string lengths = folder.write("lengths.txt", "2 0 1\n0 1 1\n1 2 5\n");
  CHECK(distances({"--metric", "lengths:" + lengths}, edges) == std::vector<double>{0, 1, 1});
}

TEST_CASE("broken triangle inequalities are counted, told of and survived") {
  const Folder folder;
  const std::string mesh = folder.write("two.off",
                                        "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                        "3 0 1 2\n3 0 2 3\n");
  const std::string lengths = folder.write("lengths.txt", "0 1 1\n1 2 1\n2 0 9\n2 3 8\n3 0 8\n");
  const auto run =
      ran({"distance", mesh, "--source", "vertex:0", "--metric", "lengths:" + lengths, "--json"});
  CHECK(run.json()["violated"] == 1);
  CHECK(run.json()["unreached"] == 0);
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("triangle inequality in 1 triangle of 2, such as triangle 0") != run.err.npos);
  // The diagonal is as long as the way around.
  const auto found = distances({"--metric", "lengths:" + lengths}, mesh);
  CHECK(found[2] == Approx(2));
}

TEST_CASE("a metric that makes no sense is refused in one line") {
  const Folder folder;
  const std::string mesh = folder.write("square.off", square_off(3));
  const auto file = [&](const char* name, const std::string& text) {
    return folder.write(name, text).string();
  };
  const auto refused = [&](const std::string& metric, int code, const std::string& part,
                           std::vector<std::string> extra = {}) {
    std::vector<std::string> all = {"distance", mesh, "--source", "vertex:0", "--metric", metric};
    all.insert(all.end(), extra.begin(), extra.end());
    check_refused(all, code, part);
  };
  refused("speed", 2, "write tensor:FILE");
  refused("colour:file", 2, "write tensor:FILE");
  refused("speed:" + folder.at("none.txt").string(), 3, "none.txt: no such file");
  refused("speed:" + file("a.txt", "1\n\n-2\n"), 3, "a.txt:3: a speed must be above 0");
  refused("speed:" + file("b.txt", "1\n2\n3\n"), 3, "3 rows for 8 triangles");
  refused("speed:" + file("c.txt", "1\nx\n"), 3, "c.txt:2: not a number");
  refused("tensor:" + file("d.txt", "1 2\n"), 3, "d.txt:1: write xx xy xz");
  refused("tensor:" + file("e.txt", "1 0 -1\n"), 3, "tensors must be positive definite");
  refused("lengths:" + file("f.txt", "0 1 1\n"), 3, "no length is given for the edge");
  refused("lengths:" + file("g.txt", "0 99 1\n"), 3, "g.txt:1: vertex 99 is out of range");
  refused("lengths:" + file("i.txt", "0 1 1\n1 2 1\n1 0 2\n"), 3,
          "i.txt:3: the edge has another length than in line 1");
  refused("speed:" + file("j.csv", "1\n"), 2, "would overwrite",
          {"--out", folder.at("j.csv").string()});
  std::string jump = "1\n";
  for (int i = 1; i < 8; ++i) jump += "5\n";
  const std::string speeds = folder.write("h.txt", jump);
  refused("speed:" + speeds, 2, "paths are refracted under", {"--visibility", "centroid"});
  const auto cloud = run_tool(
      {"distance", mesh, "--as", "cloud", "--source", "vertex:0", "--metric", "speed:" + speeds});
  CHECK((cloud.code == 2 || cloud.code == 4));  // 4 without FLANN
}

TEST_CASE("speeds by regions are speeds: refracted in solids and on surfaces, too") {
  const Folder folder;
  const std::string points =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
  const std::string regions = "CELL_DATA 2\nFIELD f 1\nregion 1 2 int\n4 7\n";
  const std::string by_region = "regions:" + folder.write("r.txt", "7 3\n4 1\n").string();
  const std::string by_cell = "speed:" + folder.write("s.txt", "1\n3\n").string();
  const std::string solid = folder.write(
      "solid.vtk", points + "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10\n10\n" + regions);
  const std::string sheet = folder.write(
      "sheet.vtk", points + "CELLS 2 8\n3 0 1 2\n3 1 4 2\nCELL_TYPES 2\n5\n5\n" + regions);
  for (const std::string& mesh : {solid, sheet}) {
    const auto found = distances({"--metric", by_region}, mesh);
    CHECK(found == distances({"--metric", by_cell}, mesh));
    // By symmetry through the middle of the face, or of the edge, between.
    const double before = mesh == solid ? 1 / std::sqrt(3.) : 1 / std::sqrt(2.);
    const double behind = mesh == solid ? 2 / std::sqrt(3.) : std::sqrt(1.5);
    CHECK(found[4] == Approx(before + behind / 3).epsilon(1e-6));
  }
}

}  // namespace mask_test
