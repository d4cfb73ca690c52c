// Files as other programs write them: what is cut, left out, passed over and guessed is told.

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <plexway/io/triangles.hpp>

#include "folder.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace files_test {

using namespace cli_testing;
using Catch::Contains;
using io_testing::bytes_of;
using io_testing::Folder;
using testing::Folder;
namespace fs = std::filesystem;

namespace {

// Distances from vertex 0, and what the summary says as JSON.
struct Solved {
  nlohmann::json json;
  std::vector<double> distance;
};

Solved solved(const std::string& file, const std::string& vertex = "vertex:0") {
  const Words source = {file, "--source", vertex, "--precision", "double"};
  return {ran(joined(joined({"distance"}, source), {"--json"})).json(), distances(source)};
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a face with a corner twice is left out and counted, and numbers stay") {
  const Folder folder;
  const std::string file = folder.write("a.obj", square + "f 1 2 3\nf 2 2 3\nf 1 3 4\n");
  const Solved found = solved(file);
  CHECK(found.json["dropped_simplices"] == 1);
  CHECK(found.json["simplices"] == 3);
  CHECK(found.distance[2] == Approx(std::sqrt(2)));
  CHECK_THAT(found.json["notes"].dump(),
             Contains("1 triangle (1) has a corner twice and is left out"));
  // A point on the edge that it has too, and one inside of the last.
  CHECK(solved(file, "point:1,0.5,0").distance[3] == Approx(std::hypot(1, .5)));
  const auto info = run_tool({"info", file, "--json"});
  CHECK(info.json()["dropped_simplices"] == 1);
  CHECK(info.json()["slender_share"] == 0);
  CHECK(info.json()["edge_length"]["min"] == 1);
  check_refused({"distance", file, "-s", "vertex:0", "--strict"}, 3,
                "has a corner twice and is left out, which --strict refuses");
  // As one of several files too.
  const Words several = {"distance", file, sample("torus.obj"), "--weld", "0", "-s", "vertex:0"};
  CHECK(run_tool(several).code == 0);
  check_refused(joined(several, {"--strict"}), 3,
                "has a corner twice and is left out, which --strict refuses");
  const std::string none = folder.write("none.obj", square + "f 2 2 3\nf 1 1 1\n");
  check_refused({"distance", none, "-s", "vertex:0"}, 3, "all 2 triangles have a corner twice");
  // What is written is what is open, and what is prepared as well.
  const std::string out = (folder.path() / "d.vtu").string(),
                    kept = (folder.path() / "a.plexway").string();
  CHECK(run_tool({"distance", file, "-s", "vertex:0", "-q", "-o", out}).code == 0);
  CHECK(run_tool({"info", out, "--json"}).json()["simplices"] == 2);
  CHECK(run_tool({"prepare", file, "-q", "-o", kept}).code == 0);
  CHECK(run_tool({"distance", kept, "-s", "vertex:0", "--json"}).json()["simplices"] == 2);
}

TEST_CASE("samples of a surface with such faces lie where they do without") {
  const Folder folder;
  std::string vertices, faces;
  constexpr int n = 8;
  for (int v = 0; v < n * n; ++v)
    vertices += "v " + std::to_string(v % n) + " " + std::to_string(v / n) + " 0\n";
  for (int v = 1; v < n * n - n; ++v)
    if (v % n != 0)
      faces += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " +
               std::to_string(v + n + 1) + "\nf " + std::to_string(v) + " " +
               std::to_string(v + n + 1) + " " + std::to_string(v + n) + "\n";
  const std::string whole = folder.write("whole.obj", vertices + faces).string(),
                    dropped = folder.write("dropped.obj", vertices + "f 1 1 2\nf 3 3 3\n" + faces)
                                  .string();
  const std::vector<std::vector<std::string>> commands = {
      {"poisson", "--radius", "1.5", "--seed", "3"},
      {"farthest", "--count", "5", "-s", "point:3.4,2.2,0"},
      {"cvt", "--count", "6", "--iterations", "3"}};
  for (const auto& command : commands) {
    const auto points = [&](const std::string& file) {
      return ran(joined(joined({command[0], file}, {command.begin() + 1, command.end()}),
                        {"-q", "-o", "-"}))
          .out;
    };
    const std::string one = points(whole), other = points(dropped);
    CAPTURE(command[0]);
    CHECK(csv_column(one, "x") == csv_column(other, "x"));
    CHECK(csv_column(one, "y") == csv_column(other, "y"));
    CHECK(csv_column(one, "b0") == csv_column(other, "b0"));
    const auto number = csv_column(one, "simplex"), behind = csv_column(other, "simplex");
    REQUIRE(number.size() == behind.size());
    for (std::size_t k = 0; k < number.size(); ++k)
      CHECK(behind[k] == (number[k] < 0 ? number[k] : number[k] + 2));
  }
}

TEST_CASE("solids, simplices and mixed domains leave such cells out as well") {
  const Folder folder;
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n"
      "0 1 0 0\n0 0 1 0\n2 2 2 0\nTetrahedra 3\n1 2 3 4 0\n1 1 2 3 0\n"
      "2 3 4 5 0\nTriangles 2\n1 2 2 0\n1 2 3 0\nEnd\n";
  const std::string file = folder.write("a.mesh", medit);
  const Solved solid = solved(file);
  CHECK(solid.json["dropped_simplices"] == 1);
  CHECK(run_tool({"info", file, "--json"}).json()["slender_share"] == 0);
  CHECK(solid.json["passed_over"]["triangles"] == 2);
  CHECK(solid.distance[4] == Approx(std::sqrt(12)));
  const auto mixed = run_tool({"distance", file, "--as", "mixed", "-s", "vertex:0", "--json"});
  CHECK(mixed.code == 0);
  CHECK(mixed.json()["dropped_simplices"] == 2);
  CHECK(mixed.json()["max_distance"] == Approx(std::sqrt(12)).epsilon(1e-6));
  const std::string simplices = folder.write(
      "a.simplices",
      "dimension 2\nvertices 4 2\n0 0\n1 0\n1 1\n0 1\nsimplices 3\n0 1 2\n1 1 2\n0 2 3\n");
  CHECK(solved(simplices).json["dropped_simplices"] == 1);
}

TEST_CASE("polygons are cut with their notches, and counted") {
  const Folder folder;
  const std::string ell = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
  for (const char* face : {"f 1 2 3 4 5 6\n", "f 3 4 5 6 1 2\n", "f 6 5 4 3 2 1\n"}) {
    const std::string file = folder.write("ell.obj", ell + face);
    const Solved found = solved(file, "vertex:2");
    CHECK(found.json["split_polygons"] == 1);
    CHECK(found.distance[5] == Approx(1 + std::sqrt(2)));
    CHECK_THAT(run_tool({"info", file}).out,
               Contains("split") && Contains("1 polygon into triangles"));
  }
  const std::string closed = folder.write("closed.obj", square + "f 1 2 3 4 1\n");
  CHECK(solved(closed).json["simplices"] == 2);
  CHECK(solved(closed).json["dropped_simplices"] == 0);
}

TEST_CASE("a source in no triangle is named, with the nearest vertex that is in one") {
  const Folder folder;
  const std::string file = folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  const auto run = run_tool({"distance", file, "-s", "vertex:0", "--json"});
  CHECK(run.code == 5);
  CHECK_THAT(run.err, Contains("nothing reached: vertex 0 is in none of the triangles") &&
                          Contains("the nearest that is in one is vertex"));
}

TEST_CASE("what a file holds decides: wires, points, surfaces in files of solids") {
  const Folder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\n";
  const std::string wires = folder.write("w.ply", head +
                                                      "element edge 2\nproperty int vertex1\n"
                                                      "property int vertex2\nend_header\n"
                                                      "0 0 0\n3 0 0\n3 4 0\n0 1\n1 2\n");
  CHECK(solved(wires).json["kind"] == "wireframe");
  CHECK(solved(wires).distance[2] == Approx(7));
  const std::string strips = folder.write("s.ply", head +
                                                       "element tristrips 1\nproperty list int "
                                                       "int vertex_indices\nend_header\n"
                                                       "0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n");
  CHECK(solved(strips).json["kind"] == "surface");
  const std::string plane =
      folder.write("p.mesh",
                   "MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\n"
                   "Triangles\n1\n1 2 3 0\nEnd\n");
  CHECK(solved(plane).json["kind"] == "surface");
  CHECK(run_tool({"distance", plane, "--as", "surface", "-s", "vertex:0", "-q"}).code == 0);
  const std::string cloud =
      folder.write("c.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\n");
  const auto points = run_tool({"info", cloud, "--json"});
  if (points.code != 4) CHECK(points.json()["kind"] == "cloud");
  const std::string coloured = folder.write(
      "c.xyz", "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 9 9 9\n.5 .5 0 1 2 3\n");
  const auto noted = run_tool({"distance", coloured, "-s", "vertex:0"});
  if (noted.code != 4) CHECK_THAT(noted.err, Contains("note: columns 4 to 6 are colours"));
  if (noted.code != 4)
    CHECK(run_tool({"distance", coloured, "-s", "vertex:0", "--strict"}).code == 3);
  const std::string edges = folder.write("none.edges", "vertices 3\n");
  const auto empty = run_tool({"distance", edges, "-s", "vertex:1", "--json"});
  CHECK(empty.code == 5);
  CHECK(empty.json()["unreached"] == 2);
}

TEST_CASE("help lists every extension that is read") {
  const std::string help = run_tool({"distance", "--help"}).out;
  for (const char* extension : {".obj",  ".off", ".ply", ".stl",  ".gii", ".white",     ".node",
                                ".mesh", ".msh", ".vtu", ".vtk",  ".glb", ".edges",     ".xyz",
                                ".csv",  ".las", ".pcd", ".poly", ".vdb", ".simplices", ".plexway"})
    CHECK_THAT(help, Contains(extension));
}

// Pipes and standard input as input, and outputs of several names.

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
    ran({"convert", sample("torus.obj"), files.emplace_back(folder.at(name))});
  for (const char* name : {"s.msh", "s.vtu", "s.vtk"})
    ran({"convert", solid, files.emplace_back(folder.at(name))});
  files.push_back(folder.write("w.edges", "0 1 1\n1 2 0.5\n2 3 7\n").string());
  files.push_back(folder.write("l.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n").string());
  std::string cloud;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) cloud += std::to_string(i) + ' ' + std::to_string(j) + " 0\n";
  files.push_back(folder.write("c.xyz", cloud).string());
  files.push_back(folder.at("c.ply"));
  ran({"convert", folder.at("c.xyz"), files.back()});
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

TEST_CASE("with CSV on standard output the summary goes to standard error") {
  const auto run =
      ran({"distance", sample("torus.obj"), "--source", "vertex:0", "--out", "-", "--json"});
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
    const Outcome run =
        run_tool({"distance", sample("torus.obj"), "-s", "vertex:0", "--out", file});
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
  check_refused({"distance", sample("knot.ply"), "-s", "vertex:0", "-o", missing}, 1,
                "cannot write " + missing);
  const std::string taken = (folder.path() / "folder.csv").string();
  std::filesystem::create_directory(taken);
  check_refused({"distance", sample("knot.ply"), "-s", "vertex:0", "-o", taken}, 1,
                "cannot write " + taken);
}

TEST_CASE("out must have a known extension and not be the input") {
  const Folder folder;
  check_refused(
      {"distance", sample("knot.ply"), "-s", "vertex:0", "-o", (folder.path() / "d.xyz").string()},
      2, ".csv .npy .gii .ply .vtk .vtu");
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

}  // namespace files_test
