// `--mask` of distance and path: against closed forms, and against a file without what is closed.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "folder.hpp"
#include "tool/tool.hpp"

namespace mask_test {

namespace {

using namespace cli_testing;
using Point = std::array<double, 2>;

constexpr double inf = std::numeric_limits<double>::infinity();

std::string content(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A unit square of 16 x 16 cells. Where the wall 7 <= x <= 9 stands its corners keep their places;
// all others are moved.
struct Square {
  static constexpr int n = 16;
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  std::vector<int> closed;  // faces of the wall, which has a door 6 <= y <= 8

  Square() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> move(-0.3 / n, 0.3 / n);
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const bool rim = x == 0 || y == 0 || x == n || y == n || (x >= 7 && x <= 9);
        points.push_back({static_cast<double>(x) / n + (rim ? 0 : move(random)),
                          static_cast<double>(y) / n + (rim ? 0 : move(random))});
      }
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const int v = y * (n + 1) + x;
        if (x >= 7 && x < 9 && (y < 6 || y >= 8))
          for (const int half : {0, 1}) closed.push_back(static_cast<int>(faces.size()) + half);
        faces.push_back({v, v + 1, v + n + 1});
        faces.push_back({v + 1, v + n + 2, v + n + 1});
      }
  }

  [[nodiscard]] std::string off(bool whole) const {
    std::ostringstream text;
    text.precision(17);
    text << "OFF\n" << points.size() << ' ' << faces.size() - (whole ? 0 : closed.size()) << " 0\n";
    for (const Point& p : points) text << p[0] << ' ' << p[1] << " 0\n";
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (whole || !is_closed(static_cast<int>(f)))
        text << "3 " << faces[f][0] << ' ' << faces[f][1] << ' ' << faces[f][2] << '\n';
    return text.str();
  }
  [[nodiscard]] bool is_closed(int face) const {
    return std::find(closed.begin(), closed.end(), face) != closed.end();
  }
};

// Is the line from a to b outside of both halves of the wall?
bool sees(const Point& a, const Point& b) {
  for (const auto& [low, high] : {std::array{0., 6. / 16}, std::array{8. / 16, 1.}}) {
    double from = 0, to = 1;
    const auto clip = [&](double at, double step, double least, double most) {
      if (step == 0 && (at <= least || at >= most)) to = -1;
      if (step == 0) return;
      const double s = (least - at) / step, t = (most - at) / step;
      from = std::max(from, std::min(s, t));
      to = std::min(to, std::max(s, t));
    };
    clip(a[0], b[0] - a[0], 7. / 16, 9. / 16);
    clip(a[1], b[1] - a[1], low, high);
    if (to - from > 1e-9) return false;
  }
  return true;
}

// The shortest way over corners of the door: brute force.
double around(const Point& a, const Point& b) {
  const std::vector<Point> stops = {
      a, {7. / 16, 6. / 16}, {9. / 16, 6. / 16}, {7. / 16, 8. / 16}, {9. / 16, 8. / 16}, b};
  std::vector<double> best(stops.size(), inf);
  best[0] = 0;
  for (std::size_t round = 0; round < stops.size(); ++round)
    for (std::size_t i = 0; i < stops.size(); ++i)
      for (std::size_t j = 0; j < stops.size(); ++j)
        if (std::isfinite(best[i]) && sees(stops[i], stops[j]))
          best[j] = std::min(
              best[j], best[i] + std::hypot(stops[i][0] - stops[j][0], stops[i][1] - stops[j][1]));
  return best.back();
}

}  // namespace

TEST_CASE("distance goes through the door of a masked wall, and as if the wall had no triangles") {
  const testing::Folder folder;
  const Square square;
  const std::string whole = folder.write("whole.off", square.off(true)),
                    cut = folder.write("cut.off", square.off(false));
  std::string lines;
  for (const int f : square.closed) lines += std::to_string(f) + "\n";
  const std::string mask = "simplices:" + folder.write("mask.txt", lines).string();
  const std::string out = folder.at("d.csv"), of_cut = folder.at("cut.csv");
  for (const int source : {20, 3 * 17 + 2, 10 * 17 + 4, 15 * 17 + 6, 7 * 17 + 12}) {
    const std::string from = "vertex:" + std::to_string(source);
    for (const std::string accuracy : {"exact", "fast"}) {
      const auto run = [&](const std::string& file, const std::string& to, bool masked) {
        std::vector<std::string> words = {
            "distance",   file,     "--source", from,          "--out", to,
            "--accuracy", accuracy, "--quiet",  "--precision", "double"};
        if (masked) words.insert(words.end(), {"--mask", mask});
        REQUIRE(run_tool(words).code == 0);
      };
      run(whole, out, true);
      run(cut, of_cut, false);
      CHECK(content(out) == content(of_cut));
      if (accuracy != "exact") continue;
      const auto d = csv_column(content(out), "distance");
      REQUIRE(d.size() == square.points.size());
      double worst = 0;
      std::size_t closed = 0;
      for (std::size_t v = 0; v < d.size(); ++v) {
        if (std::isinf(d[v])) {  // in the middle of the wall
          CHECK(square.points[v][0] == 0.5);
          ++closed;
          continue;
        }
        worst =
            std::max(worst, std::abs(d[v] - around(square.points[static_cast<std::size_t>(source)],
                                                   square.points[v])));
      }
      CHECK(closed == 14);
      CHECK(worst < 1e-12);
    }
  }
}

TEST_CASE("paths go through the door of a masked wall, and tell triangles by the file's numbers") {
  const testing::Folder folder;
  const Square square;
  const std::string whole = folder.write("whole.off", square.off(true));
  std::string lines;
  for (const int f : square.closed) lines += std::to_string(f) + "\n";
  const std::string mask = "simplices:" + folder.write("mask.txt", lines).string();
  const std::string out = folder.at("p.json");
  for (const bool astar : {false, true})
    for (const auto& [a, b] : {std::array{2 * 17 + 3, 3 * 17 + 14}, {12 * 17 + 5, 1 * 17 + 12}}) {
      std::vector<std::string> words = {"path",   whole,
                                        "--from", "vertex:" + std::to_string(a),
                                        "--to",   "vertex:" + std::to_string(b),
                                        "--mask", mask,
                                        "--out",  out,
                                        "--json", "--precision",
                                        "double"};
      if (astar) words.push_back("--astar");
      const Outcome run = run_tool(words);
      INFO(run.err);
      REQUIRE(run.code == 0);
      const Point from = square.points[static_cast<std::size_t>(a)],
                  to = square.points[static_cast<std::size_t>(b)];
      CHECK(run.json()["paths"][0]["length"].get<double>() ==
            Approx(around(from, to)).epsilon(1e-9));
      CHECK_FALSE(sees(from, to));
      // Each point lies where its triangle of the file says.
      const auto paths = nlohmann::json::parse(content(out));
      std::size_t points = 0;
      const std::string text = paths.dump();
      CAPTURE(text);
      const auto& path = paths["paths"][0];
      for (std::size_t i = 0; i < path["points"].size(); ++i, ++points) {
        const auto& point = path["points"][i];
        const int simplex = point["simplex"].get<int>();
        CHECK_FALSE(square.is_closed(simplex));
        Point at = {0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t c = 0; c < 2; ++c)
            at[c] += point["barycentric"][k].get<double>() *
                     square.points[static_cast<std::size_t>(
                         square.faces[static_cast<std::size_t>(simplex)][k])][c];
        for (std::size_t c = 0; c < 2; ++c)
          CHECK(at[c] == Approx(path["positions"][i][c].get<double>()).margin(1e-9));
      }
      CHECK(points > 4);
    }
}

TEST_CASE("masks of solids and wireframes, and metrics under them") {
  const testing::Folder folder;
  const std::string out = folder.at("d.csv");
  const auto distances = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "distance");
    words.insert(words.end(), {"--source", "vertex:0", "--quiet", "--out", out});
    REQUIRE(run_tool(words).code == 0);
    return csv_column(content(out), "distance");
  };
  // A ring of four edges, and what is left of it.
  const std::string ring = folder.write("ring.edges", "0 1 1\n1 2 2\n2 3 3\n3 0 4\n");
  const std::string first = folder.write("first.txt", "0\n"),
                    third = folder.write("third.txt", "2\n");
  CHECK(distances({ring}) == std::vector<double>{0, 1, 3, 4});
  CHECK(distances({ring, "--mask", "simplices:" + first}) == std::vector<double>{0, 9, 7, 4});
  CHECK(distances({ring, "--mask", "vertices:" + third}) == std::vector<double>{0, 1, inf, 4});
  const std::string slow = folder.write("slow.txt", "1\n1\n0.5\n1\n");
  CHECK(distances({ring, "--mask", "simplices:" + first, "--metric", "speed:" + slow}) ==
        std::vector<double>{0, 12, 10, 4});

  // A solid whose vertices far along x are closed: its others as in the file without them.
  const std::string elbow = sample("elbow.mesh");
  const auto plain = distances({elbow});
  std::string some;
  for (std::size_t v = 0; v < plain.size(); ++v)
    if (plain[v] > 0.6 * *std::max_element(plain.begin(), plain.end()))
      some += std::to_string(v) + "\n";
  const auto masked =
      distances({elbow, "--mask", "vertices:" + folder.write("far.txt", some).string()});
  REQUIRE(masked.size() == plain.size());
  std::size_t closed = 0, shorter = 0;
  for (std::size_t v = 0; v < plain.size(); ++v) {
    closed += std::isinf(masked[v]);
    shorter += masked[v] < plain[v] * (1 - 1e-2);
  }
  CHECK(closed >= static_cast<std::size_t>(std::count(some.begin(), some.end(), '\n')));
  CHECK(closed < plain.size());
  CHECK(shorter == 0);
}

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
    const Outcome done = run_tool(words);
    INFO(done.err);
    REQUIRE(done.code == 0);
    return content(file);
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
  CHECK(content(csv) == run(corner, squares, half, csv));
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
    const Outcome refused =
        run_tool({"distance", square, "--source", "vertex:8", "--mask", mask, "--out", out});
    CHECK(refused.code == code);
    CHECK(refused.complaints() == 1);
    CHECK(refused.err.find(what) != std::string::npos);
  }
}

TEST_CASE("masks that leave a source or a target nowhere to go are refused in one line") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(6));
  const std::string mask = folder.write("mask.txt", "14\n"),
                    faces = folder.write("faces.txt", "20\n");
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& text) {
    words.insert(words.begin() + 1, input);
    const Outcome run = run_tool(words);
    CAPTURE(run.err, text);
    CHECK(run.code == code);
    CHECK(run.complaints() == 1);
    CHECK(run.err.find(text) != std::string::npos);
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

}  // namespace mask_test
