// Prepared files are an input like any other: same answers, and one line for what is wrong.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "folder.hpp"
#include "tool/tool.hpp"

namespace prepare_test {

using namespace cli_testing;
using Catch::Matchers::Contains;

namespace {

const std::string data = std::string(PLEXWAY_SOURCE_DIR) + "/data/";

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("commands answer from a prepared file as from its input") {
  const testing::Folder folder;
  for (const std::string name : {"knot.ply", "elbow.mesh", "vessels.obj"}) {
    CAPTURE(name);
    const std::string input = data + name, prepared = folder.at("one.plexway").string();
    const auto made = run_tool({"prepare", input, "--out", prepared});
    REQUIRE(made.code == 0);
    CHECK_THAT(made.out, Contains("written") && Contains("bytes"));
    const auto field = [&](const std::string& of) {
      const auto run = run_tool({"distance", of, "--source", "vertex:7", "--out", "-", "--quiet"});
      CHECK(run.code == 0);
      return run.out;
    };
    CHECK(!field(input).empty());
    CHECK(field(prepared) == field(input));
    const auto rows = [&](const std::string& of) {
      const auto out = folder.at(of == input ? "rows.npy" : "other.npy").string();
      CHECK(run_tool({"pairs", of, "--sources", "all", "--out", out, "--quiet"}).code == 0);
      return bytes_of(out);
    };
    if (name != "knot.ply") CHECK(rows(prepared) == rows(input));
    const auto path = [&](const std::string& of) {
      const auto out = folder.at(of == input ? "path.json" : "other.json").string();
      CHECK(
          run_tool({"path", of, "--from", "vertex:0", "--to", "vertex:9", "--out", out, "--quiet"})
              .code == 0);
      return bytes_of(out);
    };
    CHECK(path(prepared) == path(input));
    CHECK(run_tool({"info", prepared}).code == 0);
    const auto precise = [&](const std::string& of) {
      return run_tool({"distance", of, "-s", "vertex:7", "--precision", "double", "-o", "-"}).out;
    };
    CHECK(precise(prepared) == precise(input));
  }
}

TEST_CASE("what is no prepared file, or asks for another one, is one line and its exit code") {
  const testing::Folder folder;
  const std::string prepared = folder.at("one.plexway").string(), input = data + "elbow.mesh";
  REQUIRE(run_tool({"prepare", input, "--out", prepared, "--quiet"}).code == 0);
  const auto refused = [&](const std::vector<std::string>& words, int code, const char* why) {
    const auto run = run_tool(words);
    CHECK(run.code == code);
    CHECK_THAT(run.err, Contains(why));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  };
  refused({"prepare", input, "--out", folder.at("one.ply").string()}, 2, ".plexway");
  refused(
      {"prepare", input, "--out", folder.at("b.plexway").string(), "--triangulation", "delaunay"},
      2, "only a surface has triangles to flip");
  refused({"distance", prepared, "--as", "wireframe", "--source", "vertex:0"}, 2,
          "prepared already");
  std::string bytes = bytes_of(prepared);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  refused({"distance", folder.write("bad.plexway", bytes).string(), "--source", "vertex:0"}, 3,
          "bad.plexway: is damaged");
  refused({"info", folder.write("cut.plexway", bytes.substr(0, 700)).string()}, 3, "cut short");
  refused({"info", folder.write("off.plexway", "OFF\n").string()}, 3, "no prepared domain");
  refused({"info", folder.at("none.plexway").string()}, 3, "no such file");
  refused({"info", "/dev/null.plexway"}, 3, "no such file");
  // Over itself: the old one is mapped while the new one is written.
  CHECK(run_tool({"prepare", prepared, "--out", folder.at("again.plexway").string(), "--quiet"})
            .code == 0);
  CHECK(bytes_of(folder.at("again.plexway")) == bytes_of(prepared));
}

}  // namespace prepare_test
