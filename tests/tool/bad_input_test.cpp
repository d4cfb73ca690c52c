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

// One line on standard error, the exit code, and no data.
void check_refused(const Outcome& run, int code, const std::string& start) {
  INFO(run.err);
  CHECK(run.code == code);
  CHECK(run.out.empty());
  CHECK(run.complaints() == 1);
  CHECK(run.err.rfind("plexway: error: " + start, 0) == 0);
}

}  // namespace

TEST_CASE("bad files are refused by every command with file, line and cause") {
  const Folder folder;
  struct Bad {
    const char* name;
    std::string bytes;
    std::string start;  // of the message, behind the file's name
  };
  const std::string off = square_off(4);
  const std::string ply = bytes_of(sample("knot.ply"));
  const std::string stl = bytes_of(sample("box.stl"));
  const std::vector<Bad> files = {
      {"nan.obj", "v 0 nan 0\n" + triangle + "f 1 2 3\n", ":1: "},
      {"infinite.obj", triangle + "v 1 2 inf\nf 1 2 3\n", ":4: "},
      {"huge.obj", triangle + "v 1 2 1e999\nf 1 2 3\n", ":4: "},
      {"index.obj", triangle + "f 1 2 3\nf 1 2 9\n", ":5: "},
      {"negative.obj", triangle + "f 1 2 -7\n", ":4: "},
      {"short.obj", triangle + "f 1 2\n", ":4: "},
      {"empty.obj", "", ": "},
      {"words.obj", "v one two three\n", ":1: "},
      {"truncated.off", off.substr(0, off.size() / 2), ":"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":6: "},
      {"truncated.ply", ply.substr(0, ply.size() / 2), ": "},
      {"header.ply", ply.substr(0, 40), ":"},
      {"truncated.stl", stl.substr(0, stl.size() / 2), ": "},
  };
  for (const Bad& bad : files) {
    const std::string file = folder.write(bad.name, bad.bytes);
    check_refused(run_tool({"distance", file, "--source", "vertex:0"}), 3, file + bad.start);
    check_refused(run_tool({"info", file}), 3, file + bad.start);
  }
  check_refused(run_tool({"bench", folder.path() / "nan.obj", "--source", "vertex:0"}), 3,
                (folder.path() / "nan.obj").string());
}

TEST_CASE("files that are not there, or no domain, are bad input") {
  const Folder folder;
  const std::string missing = (folder.path() / "missing.obj").string();
  check_refused(run_tool({"distance", missing, "-s", "vertex:0"}), 3, missing + ": no such file");
  const std::string text = folder.write("notes.md", "hello");
  check_refused(run_tool({"distance", text, "-s", "vertex:0"}), 3, text + ": ");
  const std::string bare = folder.write("bare", "hello");
  check_refused(run_tool({"distance", bare, "-s", "vertex:0"}), 3, bare + ": ");
  const std::string dir = folder.path().string();
  check_refused(run_tool({"distance", dir, "-s", "vertex:0"}), 3, dir + ": ");
}

TEST_CASE("what single precision cannot hold is bad input, and double takes it") {
  const Folder folder;
  for (const std::string size : {"1e39", "1e-50"}) {
    const std::string file =
        folder.write("far.obj", "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nf 1 2 3\n");
    check_refused(run_tool({"distance", file, "-s", "vertex:0"}), 3, file + ": edges of ");
    check_refused(run_tool({"path", file, "--from", "vertex:0", "--to", "vertex:1"}), 3,
                  file + ": edges of ");
    const Outcome run = run_tool({"distance", file, "-s", "vertex:0", "--precision", "double"});
    CHECK(run.code == 0);
    CHECK_THAT(run.out + run.err, Catch::Contains("3 of 3 vertices"));
  }
}

TEST_CASE("a metric that no precision holds is refused with the place") {
  const Folder folder;
  const std::string square =
      folder.write("square.off", "OFF\n4 2 0\n0 0 0\n0 1 0\n1 1 .3\n1 0 0\n3 0 1 2\n3 0 2 3\n");
  const auto run = [&](const char* large, const std::string& precision) {
    const std::string tensors =
        folder.write("tensors.txt", "2 .1 " + std::string(large) + " 1 0 1\n2 .1 0 1 0 1\n");
    return run_tool({"distance", square, "-s", "vertex:0", "--metric", "tensor:" + tensors,
                     "--precision", precision});
  };
  check_refused(run("1e12", "float"), 3, square + ": faces 0 and 1 measure the edge between them");
  CHECK(run("1e12", "double").code == 0);
  check_refused(run("9e18", "double"), 3, square + ": faces 0 and 1 measure");
  const std::string speeds = folder.write("speeds.txt", "1\n1e-30\n");
  for (const char* precision : {"float", "double"})
    check_refused(run_tool({"distance", square, "-s", "vertex:0", "--metric", "speed:" + speeds,
                            "--precision", precision}),
                  3, square + ": face");
}

TEST_CASE("a table with a number that is none is bad input") {
  const Folder folder;
  const std::string table = folder.write(
      "table.json",
      R"({"kind":"plexway probe table","slender":0.3,"uneven":1e99999999999999,"low":0.2})");
  check_refused(run_tool({"distance", sample("knot.ply"), "-s", "vertex:0", "--visibility", "tuned",
                          "--table", table}),
                3, table + ": has a number that is too large");
}

TEST_CASE("a source out of range is bad input") {
  const std::string knot = sample("knot.ply");
  for (const char* source :
       {"vertex:5120", "vertex:4294967295", "vertex:99999999999999999999", "vertex:-1"}) {
    const auto run = run_tool({"distance", knot, "--source", source});
    check_refused(run, 3, knot + ": source " + source + " is out of range");
    CHECK(run.err.find("0 to 5119") != std::string::npos);
  }
}

TEST_CASE("a source that cannot be read is a usage error") {
  for (const char* source :
       {"", "0", "vertex", "vertex:", "vertex:x", "vertex:1x", "vertex:1.5", "vertex:-",
        "point:", "point:1,2", "point:1,2,3,4", "point:1,2,", "point:1,2,nan", "point:1,2,inf",
        "point:1,2,1e999", "point:1 2 3", "face:3"}) {
    INFO(source);
    const auto run = run_tool({"distance", sample("knot.ply"), "--source", source});
    check_refused(run, 2, "--source '");
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
  for (const auto& command : commands) {
    const auto run = run_tool(command);
    check_refused(run, 2, "");
    CHECK(run.err.find("--help'") != std::string::npos);
  }
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
    check_refused(run_tool(command), 2, option.front());
  }
}

TEST_CASE("options that would be ignored are usage errors") {
  const std::string knot = sample("knot.ply"), elbow = sample("elbow.mesh");
  const auto refused = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    check_refused(run_tool(command), 2, more.front());
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
  check_refused(run_tool({"distance", knot, "-s", "vertex:0", "--out", out}), 1,
                "cannot write " + out);
  const std::string set = folder.write("set.csv", "0\n");
  check_refused(run_tool({"distance", knot, "-s", "vertices:" + set, "--out", set}), 2,
                "--out " + set + ": would overwrite");
}

TEST_CASE("what this build lacks has its own exit code") {
  const std::string knot = sample("knot.ply");
#ifndef PLEXWAY_HAS_GL
  check_refused(run_tool({"distance", knot, "-s", "vertex:0", "--executor", "gl"}), 4,
                "--executor gl");
#endif
#ifndef PLEXWAY_HAS_FLANN
  check_refused(run_tool({"distance", knot, "-s", "vertex:0", "--as", "cloud"}), 4, "--as ");
  check_refused(run_tool({"info", knot, "--as", "cloud"}), 4, "--as ");
#endif
  SUCCEED("a build with everything lacks nothing");
}

TEST_CASE("a file name with a line end stays on one line") {
  check_refused(run_tool({"distance", "no\nsuch.obj", "-s", "vertex:0"}), 3, "no?such.obj");
}

}  // namespace bad_input_test
