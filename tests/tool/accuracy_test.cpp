#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>

#include "exact_data.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace accuracy_test {

using namespace cli_testing;
using io_testing::Folder;

// --accuracy, of all commands that have it.

namespace {

struct Field {
  std::vector<double> distance, error;
  nlohmann::json summary;
};

Field field(const std::string& accuracy) {
  const Words arguments = {"distance", sample("knot.ply"), "--source",
                           "vertex:7", "--accuracy",       accuracy};
  const auto csv = ran(joined(arguments, {"--quiet", "--out", "-"}));
  const bool errors = csv.out.find(",error\n") != std::string::npos;
  return {csv_column(csv.out, "distance"),
          errors ? csv_column(csv.out, "error") : std::vector<double>(),
          ran(joined(arguments, {"--json"})).json()};
}

double mean_off(const std::vector<double>& found, const std::vector<double>& exact) {
  double sum = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] > 0) sum += std::abs(found[v] / exact[v] - 1);
  return sum / static_cast<double>(exact.size());
}

}  // namespace

TEST_CASE("distance is as accurate as it is asked to be, and says so") {
  const Field exact = field("exact");
  CHECK(exact.summary["accuracy"] == "exact");
  CHECK(exact.summary["precision"] == "double");
  CHECK(*std::max_element(exact.error.begin(), exact.error.end()) == 0);
  const Field accurate = field("accurate");
  CHECK(accurate.summary["accuracy"] == "accurate");
  CHECK(accurate.summary["precision"] == "float");
  REQUIRE(accurate.error.size() == accurate.distance.size());
  CHECK(*std::max_element(accurate.error.begin(), accurate.error.end()) > 0);
  const Field coarse = field("1e-3");
  CHECK(coarse.summary["accuracy"] == 1e-3);
  const Field fast = field("fast");
  CHECK(fast.summary["accuracy"] == "fast");
  CHECK(fast.error.empty());
  CHECK(mean_off(accurate.distance, exact.distance) < 2e-4);
  CHECK(mean_off(accurate.distance, exact.distance) < mean_off(coarse.distance, exact.distance));
  CHECK(mean_off(coarse.distance, exact.distance) < 2e-3);
  CHECK(5 * mean_off(accurate.distance, exact.distance) < mean_off(fast.distance, exact.distance));
}

TEST_CASE("pairs and bench know the accuracy") {
  const auto pairs = ran({"pairs", sample("knot.ply"), "-s", "vertex:0", "-s", "vertex:900", "-s",
                          "point:1,0,0.5", "--accuracy", "exact", "--json"});
  CHECK(pairs.json()["accuracy"] == "exact");
  CHECK(pairs.json()["asymmetry"].get<double>() < 1e-9);
  const auto bench = ran({"bench", sample("torus.obj"), "--source", "vertex:0", "--repeats", "1",
                          "--accuracy", "accurate", "--json"});
  CHECK(bench.json()["accuracy"] == "accurate");
}

TEST_CASE("solids have the accuracies fast and accurate") {
  for (const char* accuracy : {"fast", "accurate"}) {
    const auto run = ran({"distance", sample("elbow.mesh"), "--source", "vertex:0", "--accuracy",
                          accuracy, "--json"});
    CHECK(run.json()["accuracy"] == accuracy);
  }
  const auto usual =
      ran({"pairs", sample("elbow.mesh"), "-s", "vertex:0", "-s", "vertex:9", "--json"});
  CHECK(usual.json()["accuracy"] == "accurate");
}

TEST_CASE("an accuracy that cannot be is refused in one line") {
  const auto refused = [](const Words& arguments) { check_refused(arguments, 2); };
  const std::string knot = sample("knot.ply");
  for (const char* no : {"best", "-1", "1", "nan", "1e-3x", ""})
    refused({"distance", knot, "--source", "vertex:0", std::string("--accuracy=") + no});
  refused(
      {"distance", knot, "--source", "vertex:0", "--accuracy", "exact", "--precision", "float"});
  refused({"distance", knot, "--source", "vertex:0", "--accuracy", "accurate", "--visibility",
           "centroid"});
  refused({"distance", sample("vessels.obj"), "--source", "vertex:0", "--accuracy", "accurate"});
  refused({"distance", sample("elbow.mesh"), "--source", "vertex:0", "--accuracy", "exact"});
  refused(
      {"path", knot, "--from", "vertex:0", "--to", "vertex:9", "--astar", "--accuracy", "exact"});
  refused(
      {"pairs", sample("elbow.mesh"), "-s", "vertex:0", "-s", "vertex:9", "--accuracy", "exact"});
  refused({"distance", sample("elbow.mesh"), "--source", "vertex:0", "--accuracy", "accurate",
           "--visibility", "centroid"});
}

TEST_CASE(
    "distance is accurate by default on a tube that winds, where labels are far off and say so") {
  const Words from_840 = {"distance", sample("knot.ply"), "--source", "vertex:840"};
  const auto with = [&](const Words& more) {
    return ran(joined(from_840, joined(more, {"--out", "-"})));
  };
  const auto exact = csv_column(with({"--accuracy", "exact"}).out, "distance");
  const auto worst = [&](const Outcome& run) {
    const auto found = csv_column(run.out, "distance");
    REQUIRE(found.size() == exact.size());
    double most = 0;
    for (std::size_t v = 0; v < exact.size(); ++v)
      if (exact[v] > 0) most = std::max(most, std::abs(found[v] / exact[v] - 1));
    return most;
  };
  const auto fast = with({"--accuracy", "fast"}), accurate = with({"--accuracy", "accurate"});
  CHECK(worst(fast) > 0.2);  // else there is nothing to see here
  CHECK_THAT(fast.err, Catch::Contains("less accurate") && Catch::Contains("--accuracy accurate"));
  CHECK(worst(accurate) < 2e-3);
  CHECK_THAT(accurate.err, !Catch::Contains("less accurate"));
  CHECK(worst(with({})) < 2e-3);
  CHECK(worst(with({"--executor", "openmp", "--threads", "2"})) < 2e-3);
  // What only labels know brings labels, and is told.
  const Words tuned = joined(from_840, {"--visibility", "tuned"});
  CHECK(ran(joined(tuned, {"--json"})).json()["accuracy"] == "fast");
  check_refused(joined(tuned, {"--accuracy", "accurate"}), 2);
}

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

Words bench(const std::string& mesh, const std::string& truth, const Words& more = {}) {
  return joined({"bench", mesh, "--source", "vertex:0", "--truth", truth, "--repeats", "3"}, more);
}

}  // namespace

TEST_CASE("bench measures speed and error") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const std::string truth = folder.write("truth.txt", square_truth("nan"));
  const auto run = ran(bench(square, truth, {"--json", "--quiet", "--random-sources", "4"}));
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
  const auto run = ran(bench(square, truth, {"--json", "--precision", "double", "--anatomy"}));
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
  const auto text = ran(bench(square, truth, {"--anatomy"}));
  CHECK(text.out.find("within 5 edges of the source") != std::string::npos);
  CHECK(run_tool({"bench", square, "--source", "vertex:0", "--anatomy"}).code == 2);
}

TEST_CASE("bench reports signed errors, and what only one side reaches") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const std::string truth = folder.write("longer.txt", square_truth("inf", 1.25));
  const auto run = ran(bench(square, truth, {"--json", "--precision", "double"}));
  const auto json = run.json();
  CHECK(json["mean"].get<double>() == Approx(0.2));
  CHECK(json["max"].get<double>() == Approx(0.2));
  CHECK(json["most_below"].get<double>() == Approx(-0.2));
  CHECK(json["mismatched_unreached"] == 1);
}

TEST_CASE("bench prints its values for people too") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const auto run = ran(bench(square, folder.write("truth.txt", square_truth("nan"))));
  for (const char* word :
       {"ns_per_vertex", "dijkstra_ns_per_vertex", "ratio", "mean", "p99", "max", "most_below"}) {
    CHECK(run.out.find(word) != std::string::npos);
  }
}

TEST_CASE("bench measures solids, wireframes and clouds") {
  const Folder folder;
  std::string points, edges, far, along = "0\n", in_sight;
  for (int v = 0; v < 100; ++v) {
    points += std::to_string(v % 10) + " " + std::to_string(v / 10) + " 0\n";
    far += std::to_string(std::hypot(v % 10, v / 10)) + "\n";
    edges += std::to_string(v) + " " + std::to_string(v + 1) + " 0.5\n";
    along += std::to_string(0.5 * (v + 1)) + "\n";
  }
  const auto solid = plexway::io::read_tets(sample("elbow.mesh"));
  const auto from = solid.positions[0];  // the corner that sees all of the L
  for (const auto& p : solid.positions)
    in_sight += std::to_string(std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2])) + "\n";
  struct {
    std::string kind, file, truth;
    std::size_t compared;
    double most;  // truths of six decimals
  } const cases[] = {{"solid", sample("elbow.mesh"), in_sight, 324, 1e-5},
                     {"wireframe", folder.write("path.edges", edges), along, 100, 1e-6},
                     {"cloud", folder.write("flat.xyz", points), far, 99, 1e-5}};
  for (const auto& [kind, file, truth, compared, most] : cases) {
    const auto run = run_tool(bench(file, folder.write("truth.txt", truth), {"--json"}));
    INFO(kind << ": " << run.err);
    if (run.code == 4) continue;  // a build without neighbours
    REQUIRE(run.code == 0);
    CHECK(run.json()["kind"] == kind);
    CHECK(run.json()["compared"] == compared);
    CHECK(run.json()["max"].get<double>() < most);
    CHECK(run.json()["ns_per_vertex"].get<double>() > 0);
#ifdef PLEXWAY_HAS_BOOST_GRAPH
    CHECK(run.json()["dijkstra_ns_per_vertex"].get<double>() > 0);
#endif
  }
  ran({"bench", sample("vessels.obj"), "-s", "point:0,0,0.4", "--json"});
}

TEST_CASE("bad truth files are bad input, with file and line") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(n));
  const auto refused = [&](const std::string& bytes, const std::string& where) {
    const std::string truth = folder.write("truth.txt", bytes);
    check_refused(bench(square, truth), 3, "plexway: error: " + truth + where);
  };
  const std::string good = square_truth("0.5");
  refused(square_truth("far"), ":2: not a number");
  refused(square_truth("1 2"), ":2: not a number");
  refused(square_truth("-1"), ":2: ");
  refused(square_truth(""), ":2: an empty line");
  refused(good + "1\n", ":226: ");
  refused(good.substr(0, good.rfind('\n', good.size() - 2)), ":224: ends after 224 values");
  refused("", ": is empty");
  check_refused(bench(square, folder.at("missing.txt")), 3, "missing.txt: no such file");
  check_refused(bench(square, folder.path()), 3);
  check_refused(bench(square, folder.write("t.txt", good), {"--truth", "other.txt"}), 2);
  CHECK(run_tool({"bench", square, "-s", "vertex:0", "--repeats", "0"}).code == 2);
}

TEST_CASE("bench meets the exact answers of a scan") {
  using plexway::testing::exact_file;
  const auto run = ran(
      {"bench", exact_file("surfaces", "spot.obj").string(), "--source", "vertex:1357", "--truth",
       exact_file("surfaces", "spot.v1357.txt").string(), "--source", "vertex:2367", "--truth",
       exact_file("surfaces", "spot.v2367.txt").string(), "--json", "--repeats", "4"});
  CHECK(run.json()["mean"].get<double>() < 3.3e-3);
  CHECK(run.json()["mismatched_unreached"] == 0);
}

}  // namespace accuracy_test
