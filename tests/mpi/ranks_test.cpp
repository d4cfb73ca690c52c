// Matrices by the tool among ranks.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "folder.hpp"
#include "mpi/running.hpp"

namespace ranks_test {

using namespace mpi_testing;

TEST_CASE("ranks make bit for bit what threads make") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(16));
  const auto command = [&](const Words& more) {
    return Words{"pairs", input, "--sources", "all", "--json"} + more;
  };
  const auto same = [&](const std::string& name, const Words& options, int ranks) {
    CAPTURE(name, ranks);
    const std::string alone = folder.at("alone" + name), together = folder.at("ranks" + name);
    REQUIRE(run_tool(command(options + Words{"--out", alone})).code == 0);
    const Outcome run = run_ranks(ranks, command(options + Words{"--out", together}));
    INFO(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.err.empty());
    CHECK(run.json()["ranks"] == ranks);
    CHECK(run.json()["rows_solved"] == 256);
    CHECK(content(together) == content(alone));
    fs::remove(alone);
    fs::remove(together);
  };
  same(".npy", {"--symmetric", "--precision", "double", "--type", "float64"}, 1);
  same(".npy", {"--accuracy", "fast"}, 2);
  same(".npy", {"--accuracy", "fast", "--threads", "2"}, 3);
  same(".npz", {"--radius", "0.3", "--nearest", "9"}, 2);
  same(".mtx", {"--radius", "0.2", "--precision", "double"}, 4);
  CHECK(folder.files() == 1);
}

TEST_CASE("ranks of a node map what one of them built, and do without where there is no room") {
  if (!mpirun()) return;
  const testing::Folder folder, temporary;
  const std::string input = folder.write("square.off", square_off(16)), alone = folder.at("a.npy"),
                    out = folder.at("d.npy"), kept = folder.at("square.plexway");
  const Words command = {"pairs", input, "--sources", "all", "--quiet", "--out"};
  REQUIRE(run_tool(command + Words{alone}).code == 0);
  REQUIRE(run_tool({"prepare", input, "--out", kept, "--quiet"}).code == 0);
  const auto same = [&](const std::string& domain, const std::string& place) {
    const Words run = Words{"env",
                            "TMPDIR=" + place,
                            PLEXWAY_TEST_MPI_TOOL,
                            "pairs",
                            domain,
                            "--sources",
                            "all",
                            "--quiet",
                            "--out",
                            out};
    const Outcome done = run_program(*mpirun() + Words{"-n", "3"} + run);
    INFO(done.err);
    REQUIRE(done.code == 0);
    CHECK(content(out) == content(alone));
    fs::remove(out);
  };
  same(input, temporary.path().string());
  CHECK(temporary.files() == 0);
  same(kept, temporary.path().string());
  same(input, folder.at("no such folder").string());
  same(input, "/proc");  // no file can be made there
  CHECK(folder.files() == 3);
}

TEST_CASE("what ranks cannot do is said once") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(5));
  const auto refused = [&](const Words& arguments, int code, const std::string& text) {
    check_complaint(run_ranks(2, arguments), code, text);
  };
  const std::string out = folder.at("d.npy");
  refused({"pairs", folder.at("none.off"), "--sources", "all", "--out", out}, 3, "none.off");
  refused({"pairs", input, "--sources", "all", "--out", folder.at("no/d.npy")}, 1, "no folder");
  refused({"info", input}, 2, "pairs --sources");
  refused({"pairs", input, "-s", "vertex:0", "-s", "vertex:1", "--out", out}, 2, "--sources");
  CHECK(folder.files() == 1);
}

TEST_CASE("a rank that dies ends the run, and the next goes on where it was") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(48));
  const std::string alone = folder.at("alone.npy"), out = folder.at("ranks.npy");
  const auto command = [&](const std::string& file) {
    return Words{"pairs", input, "--sources", "all", "--type", "float64", "--quiet", "--out", file};
  };
  REQUIRE(run_tool(command(alone)).code == 0);
  // The second of two is killed as soon as there is a journal, and again where it was through by
  // then.
  const Words tool = Words{PLEXWAY_TEST_MPI_TOOL} + command(out);
  const std::string a_while =
      "while kill -0 $rank 2>/dev/null && [ ! -s '" + out + ".journal' ]; do sleep 0.005; done";
  bool kept = false;
  for (int tries = 0; !kept; ++tries) {
    REQUIRE(tries < 20);
    if (run_with_one_killed(tool, a_while).code == 0) {
      fs::remove(out);
      continue;
    }
    CHECK_FALSE(fs::exists(out));
    kept = fs::exists(out + ".journal");
  }
  const Outcome rest = run_ranks(3, command(out));
  INFO(rest.err);
  REQUIRE(rest.code == 0);
  CHECK(content(out) == content(alone));
  CHECK(folder.files() == 3);
}

TEST_CASE("a disk that gets full ends all ranks, and nothing is lost") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(40));
  const std::string alone = folder.at("alone.npy"), out = folder.at("ranks.npy");
  const auto command = [&](const std::string& file) {
    return Words{"pairs", input, "--sources", "all", "--quiet", "--out", file};
  };
  REQUIRE(run_tool(command(alone)).code == 0);
  check_complaint(run_ranks(2, command(out), 5'000'000), 1, "cannot write " + out);
  CHECK_FALSE(fs::exists(out));
  REQUIRE(fs::exists(out + ".journal"));
  REQUIRE(run_ranks(2, command(out)).code == 0);
  CHECK(content(out) == content(alone));
}

}  // namespace ranks_test
