#include <catch2/catch.hpp>

#include <sstream>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace executor_test {

using namespace cli_testing;

namespace {

bool has_openmp() {
  return run_tool({"info", "--devices"}).out.find("\nopenmp ") != std::string::npos;
}

Outcome distance(std::vector<std::string> options) {
  std::vector<std::string> command = {"distance", sample("knot.ply"), "-s", "vertex:0", "--json"};
  command.insert(command.end(), options.begin(), options.end());
  return run_tool(command);
}

}  // namespace

TEST_CASE("openmp reaches what serial reaches, with any number of threads") {
  if (!has_openmp()) return;
  const auto alone = distance({});
  REQUIRE(alone.code == 0);
  for (const char* threads : {"1", "2", "5"}) {
    const auto run = distance({"--executor", "openmp", "--threads", threads});
    INFO(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["executor"] == "openmp");
    CHECK(run.json()["threads"] == std::stoi(threads));
    CHECK(run.json()["reached"] == alone.json()["reached"]);
    const double a = alone.json()["max_distance"], b = run.json()["max_distance"];
    CHECK(b == Approx(a).epsilon(1e-2));
  }
}

TEST_CASE("auto takes one thread for what is small") {
  const auto run = distance({"--executor", "auto", "--threads", "2"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["executor"] == "serial");
  CHECK(distance({"--executor", "auto", "--schedule", "priority"}).code == 0);
}

TEST_CASE("auto takes several threads for what is large") {
  const io_testing::Folder folder;
  std::ostringstream points;
  for (int i = 0; i < 240; ++i)
    for (int j = 0; j < 240; ++j) points << i << ' ' << j + 0.5 * (i % 2) << " 0\n";
  const std::string cloud = folder.write("sheet.xyz", points.str());
  const auto executor = [&](const std::string& accuracy) {
    std::vector<std::string> command = {"distance", cloud,    "--executor", "auto",  "--threads",
                                        "2",        "--json", "--accuracy", accuracy};
    for (int n = 0; n < 64; ++n) {
      command.push_back("-s");
      command.push_back("vertex:" + std::to_string(900 * n));
    }
    const auto run = run_tool(command);
    INFO(run.err);
    REQUIRE(run.code == 0);
    return run.json()["executor"].get<std::string>();
  };
  for (const char* accuracy : {"fast", "accurate"})
    CHECK(executor(accuracy) == (has_openmp() ? "openmp" : "serial"));
}

TEST_CASE("executors and options that do not go together are usage errors") {
  const auto refused = [](std::vector<std::string> options, int code, const std::string& says) {
    const auto run = distance(std::move(options));
    CHECK(run.code == code);
    CHECK(run.out.empty());
    CHECK(run.err.find(says) != std::string::npos);
    CHECK(run.err.find('\n') == run.err.size() - 1);
  };
  if (has_openmp())
    refused({"--executor", "openmp", "--schedule", "priority"}, 2, "the schedule priority");
  else
    refused({"--executor", "openmp"}, 4, "--executor openmp");
  refused({"--device", "0"}, 2, "--device");
  refused({"--executor", "abacus"}, 2, "abacus");
  refused({"--threads", "0"}, 2, "--threads");
  CHECK(distance({"--threads", "2"}).code == 0);  // it builds by two
  refused({"--executor", "auto", "--threads", "0"}, 2, "--threads");
  refused({"--executor", "auto", "--threads", "-2"}, 2, "--threads");
}

TEST_CASE("bench takes an executor") {
  if (!has_openmp()) return;
  const auto run = run_tool({"bench", sample("knot.ply"), "-s", "vertex:0", "--repeats", "2",
                             "--executor", "openmp", "--threads", "2", "--json", "-q"});
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.json()["executor"] == "openmp");
}

}  // namespace executor_test
