// `--mask` of every command: what masks may be, and what is refused. (What is solved behind one:
// tests/shape.)

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace mask_test {

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

}  // namespace mask_test
