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

Field field(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"distance", sample("knot.ply"), "--source", "vertex:7"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::vector<std::string> told = arguments, written = arguments;
  told.push_back("--json");
  written.insert(written.end(), {"--quiet", "--out", "-"});
  const auto json = run_tool(told), csv = run_tool(written);
  INFO(json.err);
  REQUIRE(json.code == 0);
  REQUIRE(csv.code == 0);
  const bool errors = csv.out.find(",error\n") != std::string::npos;
  return {csv_column(csv.out, "distance"),
          errors ? csv_column(csv.out, "error") : std::vector<double>(), json.json()};
}

double mean_off(const std::vector<double>& found, const std::vector<double>& exact) {
  double sum = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] > 0) sum += std::abs(found[v] / exact[v] - 1);
  return sum / static_cast<double>(exact.size());
}

}  // namespace

TEST_CASE("distance is as accurate as it is asked to be, and says so") {
  const Field exact = field({"--accuracy", "exact"});
  CHECK(exact.summary["accuracy"] == "exact");
  CHECK(exact.summary["precision"] == "double");
  CHECK(*std::max_element(exact.error.begin(), exact.error.end()) == 0);
  const Field accurate = field({"--accuracy", "accurate"});
  CHECK(accurate.summary["accuracy"] == "accurate");
  CHECK(accurate.summary["precision"] == "float");
  REQUIRE(accurate.error.size() == accurate.distance.size());
  CHECK(*std::max_element(accurate.error.begin(), accurate.error.end()) > 0);
  const Field coarse = field({"--accuracy", "1e-3"});
  CHECK(coarse.summary["accuracy"] == 1e-3);
  const Field fast = field({"--accuracy", "fast"});
  CHECK(fast.summary["accuracy"] == "fast");
  CHECK(fast.error.empty());
  CHECK(mean_off(accurate.distance, exact.distance) < 2e-4);
  CHECK(mean_off(accurate.distance, exact.distance) < mean_off(coarse.distance, exact.distance));
  CHECK(mean_off(coarse.distance, exact.distance) < 2e-3);
  CHECK(5 * mean_off(accurate.distance, exact.distance) < mean_off(fast.distance, exact.distance));
}

TEST_CASE("paths are as long as distances, whatever the accuracy and the triangles") {
  const std::string to = "point:0.9,0.1,0.2";
  for (const char* triangles : {"input", "delaunay", "refined"})
    for (const char* accuracy : {"exact", "accurate"}) {
      const auto run =
          run_tool({"path", sample("knot.ply"), "--from", "vertex:7", "--to", "vertex:3000", "--to",
                    to, "--accuracy", accuracy, "--triangulation", triangles, "--json", "--quiet"});
      INFO(run.err);
      REQUIRE(run.code == 0);
      const auto told = run.json();
      CHECK(told["accuracy"] == accuracy);
      for (const auto& path : told["paths"]) {
        CAPTURE(triangles, accuracy, path.dump());
        CHECK(path["length"].get<double>() ==
              Approx(path["distance"].get<double>())
                  .epsilon(std::string(accuracy) == "exact" ? 1e-6 : 2e-3));
      }
    }
}

TEST_CASE("pairs and bench know the accuracy") {
  const auto pairs = run_tool({"pairs", sample("knot.ply"), "-s", "vertex:0", "-s", "vertex:900",
                               "-s", "point:1,0,0.5", "--accuracy", "exact", "--json"});
  INFO(pairs.err);
  REQUIRE(pairs.code == 0);
  CHECK(pairs.json()["accuracy"] == "exact");
  CHECK(pairs.json()["asymmetry"].get<double>() < 1e-9);
  const auto bench = run_tool({"bench", sample("torus.obj"), "--source", "vertex:0", "--repeats",
                               "1", "--accuracy", "accurate", "--json"});
  INFO(bench.err);
  REQUIRE(bench.code == 0);
  CHECK(bench.json()["accuracy"] == "accurate");
}

TEST_CASE("solids have the accuracies fast and accurate") {
  for (const char* accuracy : {"fast", "accurate"}) {
    const auto run = run_tool({"distance", sample("elbow.mesh"), "--source", "vertex:0",
                               "--accuracy", accuracy, "--json"});
    INFO(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["accuracy"] == accuracy);
  }
  const auto usual =
      run_tool({"pairs", sample("elbow.mesh"), "-s", "vertex:0", "-s", "vertex:9", "--json"});
  INFO(usual.err);
  REQUIRE(usual.code == 0);
  CHECK(usual.json()["accuracy"] == "accurate");
}

TEST_CASE("an accuracy that cannot be is refused in one line") {
  const auto refused = [](std::vector<std::string> arguments) {
    const auto run = run_tool(arguments);
    CAPTURE(arguments, run.err);
    CHECK(run.code == 2);
    CHECK(run.complaints() == 1);
    CHECK(run.out.empty());
  };
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

TEST_CASE("labels that got much wrong on a tube that winds say so, and name the cure") {
  // Known to be off: from there labels fall short of exact distances by more than a tenth.
  const std::vector<std::string> command = {
      "distance", sample("knot.ply"), "--source", "vertex:840", "--out", "-"};
  const auto with = [&](const std::string& accuracy) {
    auto words = command;
    words.insert(words.end(), {"--accuracy", accuracy});
    return run_tool(words);
  };
  const auto exact = with("exact"), accurate = with("accurate"), fast = with("fast");
  REQUIRE(exact.code == 0);
  const auto truth = csv_column(exact.out, "distance");
  const auto worst = [&](const std::string& csv) {
    const auto d = csv_column(csv, "distance");
    REQUIRE(d.size() == truth.size());
    double most = 0;
    for (std::size_t v = 0; v < d.size(); ++v)
      if (truth[v] > 0) most = std::max(most, std::abs(d[v] / truth[v] - 1));
    return most;
  };
  CHECK(worst(accurate.out) < 2e-3);
  CHECK(accurate.err.find("less accurate") == std::string::npos);
  if (worst(fast.out) > 0.1) {  // until labels are right there
    CHECK(fast.err.find("less accurate") != std::string::npos);
    CHECK(fast.err.find("--accuracy accurate") != std::string::npos);
  }
}

TEST_CASE("distance is accurate by default where labels are far off") {
  const auto from_840 = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"distance", sample("knot.ply"), "--source", "vertex:840", "--quiet",
                               "--out", "-"});
    const auto run = run_tool(more);
    INFO(run.err);
    REQUIRE(run.code == 0);
    return csv_column(run.out, "distance");
  };
  const auto exact = from_840({"--accuracy", "exact"});
  const auto worst = [&](const std::vector<double>& found) {
    double most = 0;
    REQUIRE(found.size() == exact.size());
    for (std::size_t v = 0; v < exact.size(); ++v)
      if (exact[v] > 0) most = std::max(most, std::abs(found[v] / exact[v] - 1));
    return most;
  };
  CHECK(worst(from_840({"--accuracy", "fast"})) > 0.2);  // else there is nothing to see here
  CHECK(worst(from_840({})) <= 5e-3);
  CHECK(worst(from_840({"--executor", "openmp", "--threads", "2"})) <= 5e-3);
  // What only labels know brings labels, and is told.
  const auto tuned = run_tool({"distance", sample("knot.ply"), "--source", "vertex:840", "--json",
                               "--visibility", "tuned"});
  CHECK(tuned.json()["accuracy"] == "fast");
  const auto both = run_tool({"distance", sample("knot.ply"), "--source", "vertex:840",
                              "--visibility", "tuned", "--accuracy", "accurate"});
  CHECK(both.code == 2);
  CHECK(both.complaints() == 1);
}

}  // namespace accuracy_test
