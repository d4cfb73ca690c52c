#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "exact_data.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace bench_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

constexpr int n = 15;

// Exact distances on square_off(n) from vertex 0, `first` in place of vertex 1's.
std::string square_truth(const std::string& first, double factor = 1) {
  std::ostringstream text;
  text.precision(17);
  for (int v = 0; v < n * n; ++v) {
    if (v == 1)
      text << first << '\n';
    else
      text << factor * std::hypot(v % n / (n - 1.0), v / n / (n - 1.0)) << '\n';
  }
  return text.str();
}

Outcome bench(const std::string& mesh, const std::string& truth,
              const std::vector<std::string>& more = {}) {
  std::vector<std::string> command = {"bench",   mesh,  "--source",  "vertex:0",
                                      "--truth", truth, "--repeats", "3"};
  command.insert(command.end(), more.begin(), more.end());
  return run_tool(command);
}

}  // namespace

TEST_CASE("bench measures speed and error") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const std::string truth = folder.write("truth.txt", square_truth("nan"));
  const auto run = bench(square, truth, {"--json", "--quiet", "--random-sources", "4"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["ns_per_vertex"].get<double>() > 0);
  CHECK(json["bytes_per_vertex"].get<double>() > 0);
  CHECK(json["compared"] == n * n - 2);
  CHECK(json["mismatched_unreached"] == 0);
  CHECK(json["mean"].get<double>() < 1e-6);
  CHECK(json["p99"].get<double>() <= json["max"].get<double>());
  CHECK(json["max"].get<double>() < 1e-5);
  CHECK(json["most_below"].get<double>() <= 0);
  CHECK(json["sources"] == 5);
  CHECK(json["repeats"] == 3);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  CHECK(json["dijkstra_ns_per_vertex"].get<double>() > 0);
  CHECK(json["ratio"].get<double>() ==
        Approx(json["ns_per_vertex"].get<double>() / json["dijkstra_ns_per_vertex"].get<double>()));
#else
  CHECK(json["dijkstra_ns_per_vertex"].is_null());
  CHECK(json["ratio"].is_null());
#endif
}

TEST_CASE("bench splits errors by where they come from") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  // All too short by a fifth, so that every split must add up to that.
  const std::string truth = folder.write("longer.txt", square_truth("nan", 1.25));
  const auto run = bench(square, truth, {"--json", "--precision", "double", "--anatomy"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  std::map<std::string, double> share;
  std::map<std::string, int> vertices;
  const auto json = run.json();
  for (const auto& row : json["anatomy"]) {
    const std::string split = row["split"];
    share[split] += row["share"].get<double>();
    vertices[split] += row["vertices"].get<int>();
    CHECK(row["mean"].get<double>() == Approx(.2));
    CHECK(row["below"].get<double>() == Approx(.2));
    CHECK(row["above"].get<double>() == 0);
    if (row["class"] == "on the boundary") CHECK(row["vertices"] == 4 * (n - 1) - 2);
    if (row["class"] == "flat") CHECK(row["vertices"] == (n - 2) * (n - 2));
    if (split == "sign") CHECK(row["class"] == "below exact");
    if (split == "shape") CHECK(row["class"] == "aspect below 4");
    if (split == "cut locus") CHECK(row["class"] == "elsewhere");
  }
  REQUIRE(share.size() == 5);  // solids have one more
  for (const auto& [split, sum] : share) CHECK(sum == Approx(1));
  for (const auto& [split, sum] : vertices) CHECK(sum == n * n - 2);
  const auto text = bench(square, truth, {"--anatomy"});
  CHECK(text.out.find("within 5 edges of the source") != std::string::npos);
  CHECK(run_tool({"bench", square, "--source", "vertex:0", "--anatomy"}).code == 2);
}

TEST_CASE("bench reports signed errors, and what only one side reaches") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const std::string truth = folder.write("longer.txt", square_truth("inf", 1.25));
  const auto run = bench(square, truth, {"--json", "--precision", "double"});
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["mean"].get<double>() == Approx(0.2));
  CHECK(json["max"].get<double>() == Approx(0.2));
  CHECK(json["most_below"].get<double>() == Approx(-0.2));
  CHECK(json["mismatched_unreached"] == 1);
}

TEST_CASE("bench prints its values for people too") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const auto run = bench(square, folder.write("truth.txt", square_truth("nan")));
  REQUIRE(run.code == 0);
  for (const char* word :
       {"ns_per_vertex", "dijkstra_ns_per_vertex", "ratio", "mean", "p99", "max", "most_below"}) {
    CHECK(run.out.find(word) != std::string::npos);
  }
}

TEST_CASE("bad truth files are bad input, with file and line") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const auto refused = [&](const std::string& bytes, const std::string& where) {
    const std::string truth = folder.write("truth.txt", bytes);
    const auto run = bench(square, truth);
    INFO(run.err);
    CHECK(run.code == 3);
    CHECK(run.out.empty());
    CHECK(run.complaints() == 1);
    CHECK(run.err.rfind("plexway: error: " + truth + where, 0) == 0);
  };
  const std::string good = square_truth("0.5");
  refused(square_truth("far"), ":2: not a number");
  refused(square_truth("1 2"), ":2: not a number");
  refused(square_truth("-1"), ":2: ");
  refused(square_truth(""), ":2: an empty line");
  refused(good + "1\n", ":226: ");
  refused(good.substr(0, good.rfind('\n', good.size() - 2)), ":224: ends after 224 values");
  refused("", ": is empty");
  const auto missing = bench(square, (folder.path() / "missing.txt").string());
  CHECK(missing.code == 3);
  CHECK(missing.err.find("missing.txt: no such file") != std::string::npos);
  CHECK(bench(square, folder.path().string()).code == 3);
  CHECK(bench(square, folder.write("t.txt", good), {"--truth", "other.txt"}).code == 2);
  CHECK(run_tool({"bench", square, "-s", "vertex:0", "--repeats", "0"}).code == 2);
}

TEST_CASE("bench meets the exact answers of a scan") {
  using plexway::testing::exact_file;
  const auto run = run_tool(
      {"bench", exact_file("surfaces", "spot.obj").string(), "--source", "vertex:1357", "--truth",
       exact_file("surfaces", "spot.v1357.txt").string(), "--source", "vertex:2367", "--truth",
       exact_file("surfaces", "spot.v2367.txt").string(), "--json", "--repeats", "4"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.json()["mean"].get<double>() < 3.3e-3);
  CHECK(run.json()["mismatched_unreached"] == 0);
}

}  // namespace bench_test
