#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace tune_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

// The sample ell.obj, four times as wide, and what is exact from its vertex 24 at (0, 2): the other
// arm is hidden by the corner, now at (4, 1).
std::string write_ell(const Folder& folder) {
  std::ifstream in(sample("ell.obj"));
  std::ostringstream mesh, truth;
  truth.precision(15);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    double x = 0, y = 0;
    words >> word >> x >> y;
    if (word != "v") {
      mesh << line << '\n';
      continue;
    }
    x *= 4;
    mesh << "v " << x << ' ' << y << " 0\n";
    const bool hidden = x > 4 && -x < (y - 2) * 4;
    truth << (hidden ? std::hypot(4, 1) + std::hypot(x - 4, y - 1) : std::hypot(x, y - 2)) << '\n';
  }
  folder.write("ell.v24.txt", truth.str());
  return folder.write("ell.obj", mesh.str()).string();
}

Outcome tune(const std::string& mesh, const Words& more) {
  return run_tool(joined({"tune", mesh, "--json", "--quiet"}, more));
}

// Everything but how long it took.
nlohmann::json without_times(const Outcome& run) {
  INFO(run.err);
  REQUIRE(run.code == 0);
  auto json = run.json();
  json.erase("seconds");
  return json;
}

void check_tune_refused(const std::string& mesh, const Words& more, int code, const char* cause) {
  check_refused(tune(mesh, more), code, cause);
}

}  // namespace

TEST_CASE("tune makes a table better, and the tool takes it") {
  const Folder folder;
  const std::string mesh = write_ell(folder), table = (folder.path() / "table.json").string();
  const auto json = without_times(tune(mesh, {"--evaluations", "150", "--out", table, "--cpp",
                                              (folder.path() / "table.inc").string()}));
  CHECK(json["complete"] == true);
  CHECK(json["evaluated"] == 150);
  CHECK(json["improvement"].get<double>() >= 0.15);
  const auto found = nlohmann::json::parse(io_testing::bytes_of(table));
  CHECK(found["share"] == json["found"]["share"]);
  CHECK(found["provenance"]["seed"] == 1);
  CHECK(found["provenance"]["mean_error"] == json["mean_error"]);
  CHECK(io_testing::bytes_of((folder.path() / "table.inc").string()).find("ProbeTable table = {") !=
        std::string::npos);

  // What `bench` measures with it is what was promised.
  const auto bench =
      ran({"bench", mesh, "--source", "vertex:24", "--truth",
           (folder.path() / "ell.v24.txt").string(), "--visibility", "tuned", "--triangulation",
           "input", "--table", table, "--json", "--repeats", "1", "--quiet"});
  CHECK(bench.json()["mean"].get<double>() == Approx(json["mean_error"].get<double>()));

  // Where it began it goes on.
  const auto again = without_times(tune(mesh, {"--evaluations", "1", "--from", table}));
  CHECK(again["mean_error"] == json["mean_error"]);
  CHECK(again["found"]["share"] == json["found"]["share"]);
}

TEST_CASE("tune gives the same result with the same seed, any threads, and when resumed") {
  const Folder folder;
  const std::string mesh = write_ell(folder), state = (folder.path() / "state").string();
  const std::vector<std::string> options = {"--evaluations", "20", "--restarts", "2",
                                            "--seed",        "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return tune(mesh, more);
  };
  const auto whole = without_times(with({"--threads", "1"}));
  CHECK(without_times(with({"--threads", "3"})) == whole);
  auto part = without_times(with({"--checkpoint", state, "--stop-after", "13"}));
  CHECK(part["complete"] == false);
  CHECK(part["evaluated"] == 13);
  part = without_times(with({"--checkpoint", state, "--stop-after", "9", "--resume"}));
  CHECK(part["evaluated"] == 22);
  CHECK(without_times(with({"--checkpoint", state, "--resume"})) == whole);
  CHECK(without_times(with({"--checkpoint", state, "--resume"})) ==
        whole);  // nothing is left to do
  CHECK(without_times(tune(mesh, {"--evaluations", "20", "--restarts", "2", "--seed", "6"})) !=
        whole);

  const auto other = tune(mesh, {"--evaluations", "21", "--restarts", "2", "--seed", "5",
                                 "--checkpoint", state, "--resume"});
  CHECK(other.code == 3);
  CHECK(other.err.find("another evaluations: 20, not 21") != std::string::npos);
  CHECK(other.complaints() == 1);
}

TEST_CASE("tune fits the thresholds of saddles") {
  const Folder folder;
  const std::string mesh = write_ell(folder), out = (folder.path() / "saddles.json").string();
  const auto json =
      without_times(tune(mesh, {"--what", "saddles", "--from", "standard", "--evaluations", "10",
                                "--fitness", "relative", "--triangulation", "auto", "--out", out}));
  CHECK(json["mean_error"].get<double>() <= json["baselines"]["standard"].get<double>());
  CHECK(nlohmann::json::parse(io_testing::bytes_of(out))["kind"] == "plexway saddle thresholds");
}

TEST_CASE("tune says before it begins what it will not write") {
  const Folder folder;
  const std::string mesh = write_ell(folder), truth = folder.at("ell.v24.txt");
  const std::string before = io_testing::bytes_of(mesh), exact = io_testing::bytes_of(truth);
  const auto refused = [&](const std::vector<std::string>& more, int code, const char* cause) {
    check_tune_refused(mesh, more, code, cause);
  };
  refused({"--out", mesh}, 2, "would overwrite");
  refused({"--cpp", truth}, 2, "would overwrite");
  refused({"--checkpoint", truth}, 2, "would overwrite");
  refused({"--out", folder.at("a.json"), "--checkpoint", folder.at("a.json")}, 2, "two results");
  refused({"--out", folder.at("none/a.json")}, 1, "there is no folder");
  refused({"--cpp", folder.path()}, 1, "is a directory");
  CHECK(io_testing::bytes_of(mesh) == before);
  CHECK(io_testing::bytes_of(truth) == exact);
}

TEST_CASE("tune refuses bad input with one line") {
  const Folder folder;
  const std::string mesh = write_ell(folder), file = (folder.path() / "bad.json").string();
  const auto refused = [&](const std::vector<std::string>& more, int code, const char* cause) {
    check_tune_refused(mesh, more, code, cause);
  };
  refused({"--what", "colours"}, 2, "choose one of table, saddles");
  refused({"--fitness", "best"}, 2, "choose one of mean, relative");
  refused({"--from", "nowhere"}, 2, "choose one of random, centroid");
  refused({"--resume"}, 2, "--checkpoint");
  refused({"--mutation", "0"}, 2, "step");
  refused({"--truth-dir", (folder.path() / "missing").string()}, 3, "missing");
  refused({"--checkpoint", file, "--resume"}, 3, "bad.json: no such file");
  folder.write("bad.json", "{\n\"kind\": 7,\n?");
  refused({"--from", file}, 3, "bad.json:3: is not JSON");
  folder.write("bad.json", "{\"kind\": 7}");
  refused({"--from", file}, 3, "is no probe table");
  refused({"--checkpoint", file, "--resume"}, 3, "is no checkpoint");
  folder.write("bad.json", R"({"kind": "plexway tune checkpoint", "settings": 3})");
  refused({"--checkpoint", file, "--resume"}, 3, "damaged checkpoint");
  const std::string head = R"({"kind": "plexway probe table", "slender": 5, "uneven": 4, )";
  folder.write("bad.json", head + R"("low": 0.5, "share": [0, 0, 0, 0, 0]})");
  refused({"--from", file}, 3, "share is not an array of 6 numbers");
  folder.write("bad.json", head + R"("low": 0.5, "share": [0, 0, 0, 0, 0, 2]})");
  refused({"--from", file}, 3, "share[5] is 2, not from 0 to 1.5");
  folder.write("bad.json", head + R"("share": [0, 0, 0, 0, 0, 1]})");
  refused({"--from", file}, 3, "low is missing or not a number");

  std::filesystem::remove((folder.path() / "ell.v24.txt"));
  refused({}, 3, "no exact distances ell.vID.txt");
  folder.write("ell.v24.txt", "1\n2\n");
  refused({}, 3, "ends after 2 values");
  std::filesystem::remove(folder.path() / "ell.v24.txt");
  folder.write("ell.v9999.txt", "1\n");
  refused({}, 3, "has no vertex 9999");
}

TEST_CASE("a table goes with the policy it is for") {
  const Folder folder;
  const std::string mesh = write_ell(folder);
  const std::string table =
      folder.write("table.json",
                   R"({"kind": "plexway probe table", "slender": 5, "uneven": 4, "low": 0.5,
          "share": [1, 1, 1, 1, 1, 1]})");
  const auto solve = [&](const Words& more) {
    return run_tool(
        joined({"distance", mesh, "--source", "vertex:24", "--quiet", "--out", "-"}, more));
  };
  CHECK(solve({"--table", table}).code == 2);
  const auto tuned = solve({"--visibility", "tuned", "--table", table});
  REQUIRE(tuned.code == 0);
  CHECK(tuned.out == solve({"--visibility", "centroid"}).out);
  CHECK(tuned.out != solve({"--visibility", "upper_bound"}).out);
}

}  // namespace tune_test
