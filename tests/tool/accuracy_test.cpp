#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

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

}  // namespace accuracy_test
