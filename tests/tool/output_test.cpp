#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>

#include <plexway/io/triangles.hpp>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace output_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;

namespace {

Outcome write_two_sources(const std::string& file) {
  return run_tool({"distance", sample("torus.obj"), "--source", "vertex:0", "--source",
                   "vertex:600", "--out", file});
}

}  // namespace

TEST_CASE("the extension of out picks the format") {
  const Folder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  for (const char* name : {"d.csv", "d.npy", "d.ply", "d.vtu", "D.CSV"}) {
    const auto run = write_two_sources(path(name));
    INFO(name << ": " << run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find(path(name)) != std::string::npos);
    CHECK(std::filesystem::file_size(path(name)) > 1152);
  }
  CHECK(folder.files() == 5);
  CHECK(csv_column(bytes_of(path("d.csv")), "distance").size() == 1152);
  CHECK(csv_column(bytes_of(path("d.csv")), "label").size() == 1152);
  CHECK(bytes_of(path("d.npy")).find("(1152,)") != std::string::npos);
  const auto ply = plexway::io::read_triangles(path("d.ply"));
  CHECK(ply.positions.size() == 1152);
  CHECK(ply.triangles.size() == 2304);
  const std::string vtu = bytes_of(path("d.vtu"));
  CHECK(vtu.find("NumberOfPoints=\"1152\"") != std::string::npos);
  CHECK(vtu.find("\"label\"") != std::string::npos);
}

TEST_CASE("with CSV on standard output the summary goes to standard error") {
  const auto run =
      run_tool({"distance", sample("torus.obj"), "--source", "vertex:0", "--out", "-", "--json"});
  REQUIRE(run.code == 0);
  CHECK(run.out.rfind("vertex,distance,error\n0,0,0\n1,", 0) == 0);
  CHECK(csv_column(run.out, "distance").size() == 1152);
  CHECK(nlohmann::json::parse(run.err)["reached"] == 1152);
}

TEST_CASE("a file larger than the limit leaves the one that was there, and says so") {
  const Folder folder;
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  for (const char* name : {"d.csv", "d.ply", "d.vtu", "d.glb"}) {
    const std::string file = folder.write(name, "old");
    rlimit low = before;
    low.rlim_cur = 8192;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &low) == 0);
    const Outcome run = write_two_sources(file);
    setrlimit(RLIMIT_FSIZE, &before);
    INFO(run.err);
    CHECK(run.code == 1);
    CHECK(run.complaints() == 1);
    CHECK(run.err.find("cannot write " + file) != std::string::npos);
    CHECK(bytes_of(file) == "old");
  }
  CHECK(folder.files() == 4);
}

TEST_CASE("a reader that goes away is no failure") {
  const auto run = run_tool_into_closed_pipe(
      {"distance", sample("knot.ply"), "--source", "vertex:0", "--quiet", "--out", "-"});
  CHECK(run.code == 0);
  CHECK(run.err.empty());
}

TEST_CASE("a full disk is a failure with a line that says so") {
  if (!std::filesystem::exists("/dev/full")) return;
  const auto run =
      run_tool_into("/dev/full", {"distance", sample("knot.ply"), "--source", "vertex:0"});
  CHECK(run.code == 1);
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("plexway: error: cannot write standard output: No space left") == 0);
  const auto file =
      run_tool({"distance", sample("knot.ply"), "--source", "vertex:0", "--out", "/dev/full"});
  CHECK(file.code == 2);  // no extension says what to write
}

TEST_CASE("an out that cannot be written is a failure, before any work") {
  const Folder folder;
  const std::string missing = (folder.path() / "missing" / "d.csv").string();
  const auto run = run_tool({"distance", sample("knot.ply"), "-s", "vertex:0", "-o", missing});
  CHECK(run.code == 1);
  CHECK(run.out.empty());
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("plexway: error: cannot write " + missing) == 0);

  const std::string taken = (folder.path() / "folder.csv").string();
  std::filesystem::create_directory(taken);
  const auto onto_folder =
      run_tool({"distance", sample("knot.ply"), "-s", "vertex:0", "-o", taken});
  CHECK(onto_folder.code == 1);
  CHECK(onto_folder.complaints() == 1);
  CHECK(onto_folder.err.find("plexway: error: cannot write " + taken) == 0);
}

TEST_CASE("out must have a known extension and not be the input") {
  const Folder folder;
  const auto unknown = run_tool(
      {"distance", sample("knot.ply"), "-s", "vertex:0", "-o", (folder.path() / "d.xyz").string()});
  CHECK(unknown.code == 2);
  CHECK(unknown.complaints() == 1);
  CHECK(unknown.err.find(".csv .npy .ply .vtk .vtu") != std::string::npos);

  const std::string ply = (folder.path() / "mesh.ply").string();
  std::filesystem::copy_file(sample("knot.ply"), ply);
  CHECK(run_tool({"distance", ply, "-s", "vertex:0", "-o", ply}).code == 2);
  CHECK(bytes_of(ply) == bytes_of(sample("knot.ply")));
}

TEST_CASE("progress is shown on a terminal only, and not when quiet") {
  const std::vector<std::string> command = {"distance", sample("knot.ply"), "-s", "vertex:0",
                                            "--json"};
  const auto shown = run_tool_on_terminal(command);
  REQUIRE(shown.code == 0);
  CHECK(shown.err.find("reading") != std::string::npos);
  CHECK(shown.err.find("solving") != std::string::npos);
  CHECK(shown.json()["reached"] == 5120);
  auto quiet = command;
  quiet.emplace_back("--quiet");
  CHECK(run_tool_on_terminal(quiet).err.empty());
  CHECK(run_tool(command).err.empty());
}

}  // namespace output_test
