#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace bad_input_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("bad files are refused by every command with file, line and cause") {
  const Folder folder;
  struct Bad {
    const char* name;
    std::string bytes;
    std::string start;  // of the message, behind the file's name
  };
  const std::string ply = bytes_of(sample("knot.ply"));
  const std::vector<Bad> files = {
      {"nan.obj", "v 0 nan 0\n" + triangle + "f 1 2 3\n", ":1: "},
      {"empty.obj", "", ": is empty"},
      {"truncated.ply", ply.substr(0, ply.size() / 2), ": "},
  };
  for (const Bad& bad : files) {
    const std::string file = folder.write(bad.name, bad.bytes);
    check_refused({"distance", file, "--source", "vertex:0"}, 3, file + bad.start);
    check_refused({"info", file}, 3, file + bad.start);
  }
  check_refused({"bench", folder.path() / "nan.obj", "--source", "vertex:0"}, 3,
                (folder.path() / "nan.obj").string());
}

TEST_CASE("files that are not there, or no domain, are bad input") {
  const Folder folder;
  const std::string missing = (folder.path() / "missing.obj").string();
  check_refused({"distance", missing, "-s", "vertex:0"}, 3, missing + ": no such file");
  const std::string text = folder.write("notes.md", "hello");
  check_refused({"distance", text, "-s", "vertex:0"}, 3, text + ": ");
}

TEST_CASE("what single precision cannot hold is bad input, and double takes it") {
  const Folder folder;
  for (const std::string size : {"1e39", "1e-50"}) {
    const std::string file =
        folder.write("far.obj", "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nf 1 2 3\n");
    check_refused({"distance", file, "-s", "vertex:0"}, 3, file + ": edges of ");
    check_refused({"path", file, "--from", "vertex:0", "--to", "vertex:1"}, 3,
                  file + ": edges of ");
    const Outcome run = run_tool({"distance", file, "-s", "vertex:0", "--precision", "double"});
    CHECK(run.code == 0);
    CHECK_THAT(run.out + run.err, Catch::Contains("3 of 3 vertices"));
  }
}

TEST_CASE("a table with a number that is none is bad input") {
  const Folder folder;
  const std::string table = folder.write(
      "table.json",
      R"({"kind":"plexway probe table","slender":0.3,"uneven":1e99999999999999,"low":0.2})");
  check_refused(
      {"distance", sample("knot.ply"), "-s", "vertex:0", "--visibility", "tuned", "--table", table},
      3, table + ": has a number that is too large");
}

TEST_CASE("a source out of range is bad input") {
  const std::string knot = sample("knot.ply");
  for (const char* source :
       {"vertex:5120", "vertex:4294967295", "vertex:99999999999999999999", "vertex:-1"}) {
    check_refused({"distance", knot, "--source", source}, 3,
                  knot + ": source " + source + " is out of range");
    check_refused({"distance", knot, "--source", source}, 3, "0 to 5119");
  }
}

TEST_CASE("a source that cannot be read is a usage error") {
  for (const char* source :
       {"", "0", "vertex", "vertex:", "vertex:x", "vertex:1x", "vertex:1.5", "vertex:-",
        "point:", "point:1,2", "point:1,2,3,4", "point:1,2,", "point:1,2,nan", "point:1,2,inf",
        "point:1,2,1e999", "point:1 2 3", "face:3"}) {
    check_refused({"distance", sample("knot.ply"), "--source", source}, 2, "--source '");
  }
}

TEST_CASE("usage errors are one line with a hint") {
  const std::string knot = sample("knot.ply");
  const std::vector<std::vector<std::string>> commands = {
      {},
      {"fly"},
      {"--fly"},
      {"distance"},
      {"distance", knot},
      {"distance", knot, "--source"},
      {"distance", knot, "--source", "vertex:0", "--fly"},
      {"distance", knot, "--source", "vertex:0", "vertex:1"},
      {"distance", knot, "--source", "vertex:0", "--step", "wide"},
      {"distance", knot, "--source", "vertex:0", "--max-expansions", "-1"},
      {"bench", knot},
      {"info"},
  };
  for (const auto& command : commands) check_refused(command, 2, "--help'");
}

TEST_CASE("option values that make no sense are usage errors") {
  const std::string knot = sample("knot.ply");
  const std::vector<std::vector<std::string>> options = {
      {"--visibility", "good"}, {"--schedule", "later"}, {"--precision", "half"},
      {"--executor", "abacus"}, {"--step", "0"},         {"--step", "nan"},
      {"--radius", "-1"},       {"--radius", "nan"},     {"--as", "soup"},
  };
  for (const auto& option : options) {
    std::vector<std::string> command = {"distance", knot, "--source", "vertex:0"};
    command.insert(command.end(), option.begin(), option.end());
    check_refused(command, 2, option.front());
  }
}

TEST_CASE("options that would be ignored are usage errors") {
  const std::string knot = sample("knot.ply"), elbow = sample("elbow.mesh");
  const auto refused = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    check_refused(command, 2, more.front());
  };
  const std::vector<std::string> distance = {"distance", knot, "-s", "vertex:0"};
  refused(distance, {"--step", "2", "--schedule", "fifo"});
  refused(distance, {"--table", "t.json"});
  refused(distance, {"--view", "iso"});
  const std::vector<std::string> path = {"path", knot, "--from", "vertex:0", "--to", "vertex:9"};
  refused(path, {"--astar", "--schedule", "fifo"});
  refused(path, {"--astar", "--step", "2"});
  refused({"path", elbow, "--from", "vertex:0", "--to", "vertex:9"}, {"--margin", "0.1"});
}

TEST_CASE("results go where they can") {
  const Folder folder;
  const std::string knot = sample("knot.ply");
  const std::string out = folder.at("there.ply");
  std::filesystem::create_directory(out);
  check_refused({"distance", knot, "-s", "vertex:0", "--out", out}, 1, "cannot write " + out);
  const std::string set = folder.write("set.csv", "0\n");
  check_refused({"distance", knot, "-s", "vertices:" + set, "--out", set}, 2,
                "--out " + set + ": would overwrite");
}

TEST_CASE("what this build lacks has its own exit code") {
  const std::string knot = sample("knot.ply");
#ifndef PLEXWAY_HAS_GL
  check_refused({"distance", knot, "-s", "vertex:0", "--executor", "gl"}, 4, "--executor gl");
#endif
#ifndef PLEXWAY_HAS_FLANN
  check_refused({"distance", knot, "-s", "vertex:0", "--as", "cloud"}, 4, "--as ");
  check_refused({"info", knot, "--as", "cloud"}, 4, "--as ");
#endif
  SUCCEED("a build with everything lacks nothing");
}

TEST_CASE("a file name with a line end stays on one line") {
  check_refused({"distance", "no\nsuch.obj", "-s", "vertex:0"}, 3, "no?such.obj");
}

}  // namespace bad_input_test
