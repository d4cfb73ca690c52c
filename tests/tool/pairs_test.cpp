#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace pairs_test {

namespace {

using namespace cli_testing;
namespace fs = std::filesystem;

std::vector<double> matrix(const fs::path& file) {
  const std::string bytes = io_testing::bytes_of(file);
  REQUIRE(bytes.size() > 128);
  std::uint16_t length = 0;
  std::memcpy(&length, bytes.data() + 8, 2);
  const std::string data = bytes.substr(10U + length);
  std::vector<double> values;
  const bool single = bytes.substr(0, 128).find("<f4") != std::string::npos;
  const std::size_t size = single ? 4 : 8;
  for (std::size_t i = 0; i < data.size(); i += size) {
    float f = 0;
    double d = 0;
    if (single)
      std::memcpy(&f, data.data() + i, 4), d = static_cast<double>(f);
    else
      std::memcpy(&d, data.data() + i, 8);
    values.push_back(d);
  }
  return values;
}

// The distance of vertices of square_off(n), flat: a straight line.
double straight(int n, int a, int b) { return std::hypot(a % n - b % n, a / n - b / n) / (n - 1); }

}  // namespace

TEST_CASE("pairs of all vertices are straight lines in a square, and rows those of distance") {
  const testing::Folder folder;
  const int n = 9;
  const std::string input = folder.write("square.off", square_off(n));
  const std::string out = folder.at("d.npy");
  const Outcome run = ran({"pairs", input, "--sources", "all", "--out", out, "--json"});
  CHECK(run.json()["rows"] == n * n);
  CHECK(run.json()["rows_solved"] == n * n);
  CHECK(run.json()["asymmetry"]["largest"] < 1e-5);
  const auto d = matrix(out);
  REQUIRE(d.size() == static_cast<std::size_t>(n * n * n * n));
  for (int a = 0; a < n * n; ++a)
    for (int b = 0; b < n * n; ++b)
      REQUIRE(d[static_cast<std::size_t>(a * n * n + b)] ==
              Approx(straight(n, a, b)).epsilon(1e-5).margin(1e-12));
  CHECK(folder.files() == 2);

  // The same bits as one field, with any number of threads.
  const std::string field = folder.at("field.csv");
  ran({"distance", input, "--source", "vertex:30", "--out", field});
  const auto column = csv_column(io_testing::bytes_of(field), "distance");
  for (int b = 0; b < n * n; ++b)
    REQUIRE(static_cast<float>(column[static_cast<std::size_t>(b)]) ==
            static_cast<float>(d[static_cast<std::size_t>(30 * n * n + b)]));
  const std::string bytes = io_testing::bytes_of(out);
  for (const std::string threads : {"1", "3"}) {
    ran({"pairs", input, "--sources", "all", "--out", out, "--threads", threads});
    CHECK(io_testing::bytes_of(out) == bytes);
  }
}

TEST_CASE("pairs takes what farthest writes, and lists of vertices") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(9));
  const std::string landmarks = folder.at("landmarks.csv"), out = folder.at("d.npy");
  ran({"farthest", input, "--count", "5", "--source", "point:0.3,0.41,0", "--out", landmarks});
  const std::string list = folder.write("some.txt", "# corners\n0\n8, \n80\n");
  ran({"pairs", input, "--sources", landmarks, "--targets", list, "--type", "float64",
       "--precision", "double", "--out", out});
  const auto d = matrix(out);
  REQUIRE(d.size() == 15);
  const auto x = csv_column(io_testing::bytes_of(landmarks), "x"),
             y = csv_column(io_testing::bytes_of(landmarks), "y");
  const double corner[3][2] = {{0, 0}, {1, 0}, {1, 1}};
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      CHECK(d[3 * i + j] ==
            Approx(std::hypot(x[i] - corner[j][0], y[i] - corner[j][1])).margin(1e-9));
}

TEST_CASE("statistics and histograms and parcels are those of the matrix") {
  const testing::Folder folder;
  const int n = 8;
  const auto many = static_cast<std::size_t>(n * n);
  const std::string input = folder.write("square.off", square_off(n));
  const std::string out = folder.at("d.npy"), stats = folder.at("s.csv"),
                    histogram = folder.at("h.csv"), labels = folder.at("labels.txt"),
                    parcels = folder.at("p.csv");
  const Outcome run =
      ran({"pairs", input, "--sources", "all", "--out", out, "--stats", stats, "--histogram",
           histogram, "--bin-width", "0.2", "--bins", "5", "--json"});
  const auto d = matrix(out);
  const auto mean = csv_column(io_testing::bytes_of(stats), "mean"),
             most = csv_column(io_testing::bytes_of(stats), "largest"),
             far = csv_column(io_testing::bytes_of(stats), "farthest");
  std::vector<double> counts(5, 0);
  double diameter = 0;
  for (std::size_t i = 0; i < many; ++i) {
    double sum = 0, largest = 0;
    for (std::size_t j = 0; j < many; ++j) {
      const double value = d[i * many + j];
      sum += value;
      largest = std::max(largest, value);
      ++counts[std::min<std::size_t>(static_cast<std::size_t>(value / 0.2), 4)];
    }
    diameter = std::max(diameter, largest);
    CHECK(mean[i] == Approx(sum / static_cast<double>(many)));
    CHECK(most[i] == Approx(largest));
    CHECK(d[i * many + static_cast<std::size_t>(far[i])] == Approx(largest));
  }
  CHECK(csv_column(io_testing::bytes_of(histogram), "count") == counts);
  CHECK(run.json()["diameter"] == Approx(diameter));
  CHECK(diameter == Approx(std::sqrt(2.)).epsilon(1e-5));

  // Two halves, and a column that is in none.
  std::string text;
  for (int v = 0; v < n * n; ++v) text += v % n == 0 ? "-1\n" : v / n < n / 2 ? "7\n" : "3\n";
  std::ofstream(labels) << text;
  ran({"pairs", input, "--sources", "all", "--labels", labels, "--out", parcels});
  CHECK(io_testing::bytes_of(parcels).substr(0, 10) == "label,3,7\n");
  const auto to3 = csv_column(io_testing::bytes_of(parcels), "3"),
             to7 = csv_column(io_testing::bytes_of(parcels), "7");
  for (const bool lower : {false, true})
    for (const bool to_lower : {false, true}) {
      double sum = 0;
      int pairs = 0;
      for (int a = 0; a < n * n; ++a)
        for (int b = 0; b < n * n; ++b)
          if (a % n != 0 && b % n != 0 && (a / n < n / 2) == lower && (b / n < n / 2) == to_lower)
            sum += straight(n, a, b), ++pairs;
      CHECK((to_lower ? to7 : to3)[lower ? 1 : 0] == Approx(sum / pairs).epsilon(1e-5));
    }
  CHECK(folder.files() == 6);
}

TEST_CASE("rows by a device are its fields, and go on where they were") {
  const testing::Folder folder;
  const int n = 9;
  const std::string input = folder.write("square.off", square_off(n));
  const std::string out = folder.at("d.npy"), field = folder.at("field.csv");
  const std::vector<std::string> command = {"pairs",
                                            input,
                                            "--sources",
                                            "all",
                                            "--out",
                                            out,
                                            "--executor",
                                            "gl",
                                            "--quiet",
                                            "--targets",
                                            folder.write("t.txt", "80\n7\n0\n")};
  const Outcome run = run_tool(command);
  if (run.code == 4) {  // no device, or a build without
    CHECK(run.complaints() == 1);
    return;
  }
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto d = matrix(out);
  REQUIRE(d.size() == static_cast<std::size_t>(3 * n * n));
  for (const int a : {0, 17, 40, 80}) {
    ran({"distance", input, "--source", "vertex:" + std::to_string(a), "--executor", "gl",
         "--quiet", "--out", field});
    const auto column = csv_column(io_testing::bytes_of(field), "distance");
    for (const std::size_t c : {0UL, 1UL, 2UL})
      CHECK(static_cast<float>(d[3 * static_cast<std::size_t>(a) + c]) ==
            static_cast<float>(column[std::array{80UL, 7UL, 0UL}[c]]));
  }
  for (const auto& [more, text] :
       {std::pair<std::vector<std::string>, std::string>{{"--precision", "double"}, "precision"},
        {{"--accuracy", "accurate"}, "the accuracy fast"},
        {{"--radius", "1", "--out", folder.at("d.npz")}, "threads"}}) {
    std::vector<std::string> words = {"pairs", input, "--sources", "all", "--executor", "gl"};
    if (more[0] != "--radius") words.insert(words.end(), {"--out", out});
    words.insert(words.end(), more.begin(), more.end());
    check_refused(words, 2, text);
  }
}

TEST_CASE("pairs go around what is masked") {
  // Vertices (4, 0) to (4, 5) of 9 x 9 are closed, and with them the triangles about each, which
  // reach up to (3, 6) and (4, 6), and to (5, 5) on the other side.
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(9));
  std::string closed;
  for (int y = 0; y < 6; ++y) closed += std::to_string(9 * y + 4) + "\n";
  const std::string mask = folder.write("mask.txt", closed), out = folder.at("d.npy");
  const std::string ends = folder.write("ends.txt", "0\n8\n"),
                    inside = folder.write("in.txt", "4\n");
  ran({"pairs", input, "--sources", ends, "--targets", ends, "--mask", "vertices:" + mask,
       "--precision", "double", "--type", "float64", "--out", out});
  const double around = (std::sqrt(45.) + 1 + std::sqrt(2.) + std::sqrt(34.)) / 8;
  const auto d = matrix(out);
  REQUIRE(d.size() == 4);
  CHECK(d[0] == 0);
  CHECK(d[1] == Approx(around).epsilon(1e-9));
  CHECK(d[2] == Approx(around).epsilon(1e-9));
  // Within a radius that leads through the mask, but not around it, nothing but the ends.
  const std::string near = folder.at("near.mtx");
  ran({"pairs", input, "--sources", ends, "--targets", ends, "--mask", "vertices:" + mask,
       "--radius", "1.5", "--out", near});
  CHECK(io_testing::bytes_of(near).find("\n2 2 2\n1 1 0\n2 2 0\n") != std::string::npos);

  for (const auto& [kind, text] :
       {std::pair<std::string, std::string>{"vertices:" + mask, "is masked"},
        {"vertices:" + folder.write("b.txt", "81\n").string(), "b.txt:1: vertex 81"},
        {"simplices:" + folder.write("c.txt", "128\n").string(), "c.txt:1: no such simplex"},
        {"edges:" + mask, "vertices:FILE"}}) {
    const Outcome run =
        run_tool({"pairs", input, "--sources", inside, "--mask", kind, "--out", out});
    CHECK((run.code == 2 || run.code == 3));
    CHECK(run.complaints() == 1);
    CHECK(run.err.find(text) != std::string::npos);
  }
}

TEST_CASE("a matrix killed twenty times is bit for bit one that was not") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(50));
  const std::string whole = folder.at("whole.npy"), parts = folder.at("parts.npy");
  const auto command = [&](const std::string& out) {
    return std::vector<std::string>{"pairs",  input,     "--sources",   "all",
                                    "--type", "float16", "--symmetric", "--threads",
                                    "2",      "--out",   out,           "--json"};
  };
  const Outcome undisturbed = ran(command(whole));
  const std::string expected = io_testing::bytes_of(whole);
  const int about = static_cast<int>(1000 * undisturbed.json()["seconds"]["solve"].get<double>());
  std::mt19937 random(1);
  int kills = 0, kept = 0;
  while (kills < 20) {
    const int wait = 1 + static_cast<int>(random() % static_cast<unsigned>(about / 2 + 20));
    const Outcome run = run_tool_and_kill(command(parts), wait);
    if (run.code != 0) REQUIRE(run.code == 128 + 9);
    if (fs::exists(parts)) {  // it was through before: with the file, if not with all that it says
      REQUIRE(io_testing::bytes_of(parts) == expected);
      fs::remove(parts);
      continue;
    }
    REQUIRE(run.code != 0);
    ++kills;
    kept += fs::exists(parts + ".journal");
  }
  const Outcome last = ran(command(parts));
  CHECK(kept > 0);
  CHECK(io_testing::bytes_of(parts) == expected);
  CHECK(last.json()["asymmetry"] == undisturbed.json()["asymmetry"]);
  CHECK(folder.files() == 3);
}

TEST_CASE("pairs write HDF5 that h5py reads, whole after any number of kills") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(40));
  const std::string plain = folder.at("d.npy"), whole = folder.at("whole.h5"),
                    parts = folder.at("parts.h5");
  const auto command = [&](const std::string& out) {
    return std::vector<std::string>{"pairs",     input,   "--sources", "all",     "--symmetric",
                                    "--threads", "2",     "--type",    "float16", "--precision",
                                    "double",    "--out", out,         "--json"};
  };
  const Outcome undisturbed = run_tool(command(whole));
  if (undisturbed.code == 4) {  // a build without HDF5 says so, before anything is read
    CHECK(undisturbed.complaints() == 1);
    CHECK(undisturbed.err.find("libhdf5-dev") != std::string::npos);
    CHECK(folder.files() == 1);
    return;
  }
  REQUIRE(undisturbed.code == 0);
  ran(command(plain));
  CHECK(folder.files() == 3);
  CHECK(fs::file_size(whole) < fs::file_size(plain));
  if (const std::string python = "/usr/bin/python3 -c 'import h5py, numpy";
      std::system((python + "' >/dev/null 2>&1").c_str()) == 0) {
    CHECK(std::system((python + "; f = h5py.File(\"" + whole + "\"); d = f[\"distance\"]; " +
                       "assert d.dtype == numpy.float16 and d.compression == \"gzip\"; " +
                       "assert (d[()] == numpy.load(\"" + plain + "\")).all(); " +
                       "assert (f[\"rows\"][()] == numpy.arange(1600)).all(); " +
                       "assert (f[\"columns\"][()] == numpy.arange(1600)).all()'")
                          .c_str()) == 0);
  }

  const int about = static_cast<int>(1000 * undisturbed.json()["seconds"]["solve"].get<double>());
  std::mt19937 random(3);
  for (int kills = 0; kills < 6;) {
    const int wait = 1 + static_cast<int>(random() % static_cast<unsigned>(about + 100));
    if (run_tool_and_kill(command(parts), wait).code != 0) {
      ++kills;
    } else {
      REQUIRE(io_testing::bytes_of(parts) == io_testing::bytes_of(whole));
      fs::remove(parts);
    }
  }
  ran(command(parts));
  CHECK(io_testing::bytes_of(parts) == io_testing::bytes_of(whole));
  CHECK(folder.files() == 4);

  // A disk that gets full while rows are solved, twice.
  fs::remove(parts);
  for (const std::size_t room : {2'000'000UL, 4'500'000UL}) {
    const Outcome full = run_tool_with_small_files(command(parts), room);
    CHECK(full.code == 1);
    CHECK(full.err.find("cannot write " + parts) != std::string::npos);
    CHECK_FALSE(fs::exists(parts));
    CHECK(fs::exists(parts + ".journal"));
  }
  const Outcome rest = ran(command(parts));
  CHECK(rest.json()["rows_solved"] < 1600);
  CHECK(io_testing::bytes_of(parts) == io_testing::bytes_of(whole));
}

TEST_CASE("a disk that gets full loses nothing, and room or not is said in one line") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(40));
  const std::string whole = folder.at("whole.npy"), out = folder.at("d.npy");
  const auto command = [&](const std::string& file) {
    return std::vector<std::string>{"pairs", input,     "--sources", "all", "--threads",
                                    "2",     "--quiet", "--out",     file};
  };
  ran(command(whole));
  const Outcome full = run_tool_with_small_files(command(out), 5'000'000);
  CHECK(full.code == 1);
  CHECK(full.complaints() == 1);
  CHECK(full.err.find("cannot write " + out) != std::string::npos);
  CHECK_FALSE(fs::exists(out));
  REQUIRE(fs::exists(out + ".journal"));
  auto again = command(out);
  again.erase(std::find(again.begin(), again.end(), "--quiet"));
  again.push_back("--json");
  const Outcome rest = ran(again);
  CHECK(rest.json()["blocks_kept"] > 0);
  CHECK(rest.json()["rows_solved"] < 1600);
  CHECK(io_testing::bytes_of(out) == io_testing::bytes_of(whole));
}

TEST_CASE("pairs refuses what makes no sense, in one line") {
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(6));
  const std::string out = folder.at("d.npy");
  const std::string beyond = folder.write("beyond.txt", "0\n36\n");
  const std::string few = folder.write("few.txt", "1\n2\n");
  const auto refused = [&](const Words& more, int code, const std::string& text) {
    check_refused(joined({"pairs", input}, more), code, text);
  };
  refused({"--sources", "all", "--targets", beyond, "--out", out}, 3, "beyond.txt:2: vertex 36");
  refused({"--sources", beyond, "--out", out}, 3, "beyond.txt:2: vertex 36");
  refused({"--sources", folder.at("none.txt"), "--out", out}, 3, "none.txt");
  refused({"--sources", "all"}, 2, "--out");
  refused({"--out", out}, 2, "--sources");
  refused({"--sources", "all", "-s", "vertex:0", "--out", out}, 2, "--sources");
  refused({"-s", "vertex:0", "-s", "vertex:1", "--radius", "1", "--out", out}, 2, "--radius");
  refused({"--sources", "all", "--out", folder.at("d.txt")}, 2, ".npy");
  refused({"--sources", "all", "--radius", "0.1", "--out", out}, 2, ".npz");
  refused({"--sources", "all", "--radius", "-1", "--out", folder.at("d.npz")}, 2, "--radius");
  refused({"--sources", "all", "--nearest", "0", "--out", folder.at("d.npz")}, 2, "--nearest");
  refused({"--sources", "all", "--targets", few, "--symmetric", "--out", out}, 2, "--symmetric");
  refused({"--sources", "all", "--type", "int8", "--out", out}, 2, "int8");
  refused({"--sources", "all", "--labels", few, "--out", out}, 3, "2 labels");
  refused({"--sources", "all", "--histogram", folder.at("h.csv")}, 2, "--bin-width");
  refused({"--sources", "all", "--out", folder.at("no/d.npy")}, 1, "no folder");
  refused({"--sources", few, "--out", few}, 2, "");
  CHECK(folder.files() == 3);

  // Options that changed, and a run beside another, once there is something to go on from.
  const std::string large = folder.write("large.off", square_off(60));
  std::vector<std::string> first = {"pairs", large, "--sources", "all", "--quiet", "--out", out};
  Outcome killed = run_tool_and_kill(first, 400);
  for (int wait = 300; killed.code == 0 || !fs::exists(out + ".journal"); wait = wait * 2 / 3 + 5) {
    fs::remove(out);
    REQUIRE(wait > 20);
    killed = run_tool_and_kill(first, wait);
  }
  first.insert(first.end(), {"--precision", "double"});
  const Outcome changed = run_tool(first);
  CHECK(changed.code == 1);
  CHECK(changed.complaints() == 1);
  CHECK(changed.err.find("precision: float', now it is 'precision: double'") != std::string::npos);
  const Outcome other = run_tool({"pairs", input, "--sources", "all", "--quiet", "--out", out});
  CHECK(other.code == 1);
  CHECK(other.err.find("'input: ") != std::string::npos);
}

}  // namespace pairs_test
