// Pipes and standard input as input, and outputs of several names.

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace streams_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;
namespace fs = std::filesystem;

namespace {

// What comes through a pipe of that name, once.
Outcome through_pipe(const fs::path& pipe, const std::string& bytes,
                     const std::vector<std::string>& arguments) {
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  const Outcome outcome = run_tool(arguments);
  writer.join();
  fs::remove(pipe);
  return outcome;
}

// The distances of the command, which reads from `command`'s output.
std::string distances_of(const std::string& file, const std::string& as) {
  const std::string line = "cat '" + file + "' | '" PLEXWAY_TEST_TOOL "' distance " + as +
                           " --source vertex:0 --quiet --out - 2>&1";
  std::FILE* const from = ::popen(line.c_str(), "r");
  REQUIRE(from != nullptr);
  std::string text;
  for (int c = 0; (c = std::fgetc(from)) != EOF;) text += static_cast<char>(c);
  ::pclose(from);
  return text;
}

}  // namespace

TEST_CASE("every format that is read from end to end comes through pipes and standard input") {
  const Folder folder;
  const std::string solid = sample("elbow.mesh");
  std::vector<std::string> files = {sample("torus.obj"), sample("knot.ply"), solid};
  for (const char* name : {"t.off", "t.stl", "t.ply"})
    REQUIRE(run_tool({"convert", sample("torus.obj"), files.emplace_back(folder.at(name))}).code ==
            0);
  for (const char* name : {"s.msh", "s.vtu", "s.vtk"})
    REQUIRE(run_tool({"convert", solid, files.emplace_back(folder.at(name))}).code == 0);
  files.push_back(folder.write("w.edges", "0 1 1\n1 2 0.5\n2 3 7\n").string());
  files.push_back(folder.write("l.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n").string());
  std::string cloud;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) cloud += std::to_string(i) + ' ' + std::to_string(j) + " 0\n";
  files.push_back(folder.write("c.xyz", cloud).string());
  files.push_back(folder.at("c.ply"));
  REQUIRE(run_tool({"convert", folder.at("c.xyz"), files.back()}).code == 0);
  for (const std::string& file : files) {
    INFO(file);
    const auto direct =
        run_tool({"distance", file, "--source", "vertex:0", "--quiet", "--out", "-"});
    if (direct.code == 4) continue;  // not in this build
    REQUIRE(direct.code == 0);
    const std::string extension = fs::path(file).extension().string();
    const fs::path pipe = folder.at("pipe" + extension);
    const auto piped =
        through_pipe(pipe, bytes_of(file),
                     {"distance", pipe.string(), "--source", "vertex:0", "--quiet", "--out", "-"});
    CHECK(piped.err.empty());
    CHECK(piped.out == direct.out);
    CHECK(distances_of(file, extension.substr(1) + ":-") == direct.out);
    const std::string stdin_name = extension.substr(1) + ":/dev/stdin";
    CHECK(distances_of(file, stdin_name) == direct.out);
  }
}

TEST_CASE("what does not tell its format, or cannot come through a pipe, is told") {
  const auto complaint = [](const std::string& name) {
    const auto run = run_tool({"distance", name, "--source", "vertex:0"});
    CHECK(run.code == 3);
    CHECK(run.complaints() == 1);
    return run.err;
  };
  CHECK(complaint("-").find("say what it is, as in ply:-") != std::string::npos);
  CHECK(complaint("ply:-").find("ply:-: is empty") != std::string::npos);
  CHECK(complaint("teapot:-").find("teapot:-: is empty") != std::string::npos);
  for (const char* name : {"vdb:-", "pcd:-", "poly:-"})
    CHECK(complaint(name).find("must be a file with that extension") != std::string::npos);
  const Folder folder;
  const fs::path odd = folder.path() / "off:odd";
  fs::copy(sample("torus.obj"), odd);  // a file of that very name is meant itself
  CHECK(complaint(odd.string()).find("no extension") != std::string::npos);
}

TEST_CASE("two names of one output are noticed before anything is done") {
  const Folder folder;
  const auto at = [&](const char* name) { return folder.at(name).string(); };
  const auto run = [&](const std::string& a, const std::string& b) {
    return run_tool({"distance", sample("torus.obj"), "--source", "vertex:0", "--out", a,
                     "--isolines-out", b, "--isoline-step", "0.2"});
  };
  fs::create_symlink("real.ply", folder.at("link.ply"));
  fs::create_directory(folder.at("sub"));
  fs::create_directory_symlink(folder.path(), folder.at("again"));
  folder.write("hard.ply", "old");
  fs::create_hard_link(folder.at("hard.ply"), folder.at("other.ply"));
  for (const auto& [a, b] :
       std::vector<std::pair<std::string, std::string>>{{at("same.ply"), at("same.ply")},
                                                        {at("same.ply"), at("sub/../same.ply")},
                                                        {at("link.ply"), at("real.ply")},
                                                        {at("again/x.ply"), at("x.ply")},
                                                        {at("hard.ply"), at("other.ply")}}) {
    const auto both = run(a, b);
    INFO(a << ' ' << b << ": " << both.err);
    CHECK(both.code == 2);
    CHECK(both.err.find("two results would go into this one file") != std::string::npos);
  }
  CHECK(bytes_of(folder.at("hard.ply")) == "old");
  CHECK_FALSE(fs::exists(folder.at("same.ply")));
}

}  // namespace streams_test
