// A surface in parts by the tool: no rank has the whole.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "folder.hpp"
#include "mpi/running.hpp"
#include "mpi/surfaces.hpp"

namespace parts_test {

using namespace mpi_testing;

namespace {

Words from(const std::string& input, const Words& more) {
  return Words{"distance", input, "--source", "vertex:0", "--source", "point:0.4,0.3,0.2"} + more;
}

// The field in parts, by the surface's numbers, and how many triangles the parts have. What no part
// has is no number.
struct Parts {
  Parts(const fs::path& file, int parts, std::size_t vertices)
      : distance(vertices, std::numeric_limits<double>::quiet_NaN()), label(vertices, -7) {
    const std::string names = content(file);
    for (int p = 0; p < parts; ++p) {
      CAPTURE(p);
      const std::string name = file.stem().string() + "_" + std::to_string(p) + ".vtu";
      if (names.find("<Piece Source=\"" + name + "\"/>") == std::string::npos) continue;
      const Vtu part(file.parent_path() / name);
      const auto original = part.array<std::uint32_t>("original");
      const auto d = part.array<double>("distance");
      const auto l = part.array<std::int32_t>("label");
      const auto at = part.array<double>("Points");
      REQUIRE((d.size() == original.size() && l.size() == d.size() && at.size() == 3 * d.size()));
      triangles += part.array<std::int64_t>("connectivity").size() / 3;
      for (std::size_t i = 0; i < d.size(); ++i) {
        REQUIRE(original[i] < vertices);
        if (label[original[i]] != -7)
          agree &= distance[original[i]] == d[i] && label[original[i]] == l[i];
        distance[original[i]] = d[i];
        label[original[i]] = l[i];
      }
    }
  }
  std::vector<double> distance;
  std::vector<std::int32_t> label;
  std::size_t triangles = 0;
  bool agree = true;
};

// An .off with its last two vertices in the other order, and the same triangles.
std::string swapped(const std::string& off) {
  std::istringstream in(off);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  in >> word >> vertices >> faces >> edges;
  std::vector<std::array<double, 3>> at(vertices);
  for (auto& p : at) in >> p[0] >> p[1] >> p[2];
  std::swap(at[vertices - 1], at[vertices - 2]);
  std::ostringstream out;
  out << "OFF\n" << vertices << ' ' << faces << " 0\n";
  for (const auto& p : at) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t count = 0;
    in >> count;
    out << count;
    for (std::size_t v = 0, i = 0; i < count; ++i) {
      in >> v;
      out << ' ' << (v == vertices - 1 ? v - 1 : v == vertices - 2 ? v + 1 : v);
    }
    out << '\n';
  }
  return out.str();
}

}  // namespace

TEST_CASE("ranks solve a surface in parts as one process solves the whole") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string text = folder.write("hills.off", hills()), input = folder.at("hills.ply"),
                    alone = folder.at("alone.vtu"), out = folder.at("d.pvtu");
  REQUIRE(run_tool({"convert", text, input, "--quiet"}).code == 0);
  const Words exact = {"--accuracy", "exact"};
  REQUIRE(run_tool(from(input, exact + Words{"--quiet", "--out", alone})).code == 0);
  const Vtu whole(alone);
  const auto known = whole.array<double>("distance");
  const auto label = whole.array<std::int32_t>("label");
  const Words fast = {"--accuracy", "fast"};
  for (const Words& accuracy : {exact, Words{}, fast}) {
    std::vector<double> first;
    for (const auto& [ranks, threads] : {std::pair(1, 2), std::pair(3, 1), std::pair(4, 1)}) {
      CAPTURE(ranks, threads);
      const Outcome run = run_ranks(
          ranks, from(input, accuracy + Words{"--in-parts", "--threads", std::to_string(threads),
                                              "--json", "--out", out}));
      INFO(run.err);
      REQUIRE(run.code == 0);
      CHECK(run.err.find("1 vertex not reached") != std::string::npos);
      const auto json = run.json();
      CHECK(json["in_parts"] == true);
      CHECK(json["ranks"] == ranks);
      CHECK(json["vertices"] == known.size());
      CHECK(json["reached"] == known.size() - 1);
      CHECK(json["pieces"] > 1);
      CHECK(json["messages"] > 100);
      CHECK((json["sent_bytes"] > 0) == (ranks > 1));
      REQUIRE(json["peak_bytes"].size() == static_cast<std::size_t>(ranks));
      const Parts parts(out, ranks, known.size());
      CHECK(parts.agree);
      CHECK(json["simplices"] == parts.triangles);
      double worst = 0, sum = 0;
      std::size_t other = 0;
      for (std::size_t v = 0; v < known.size(); ++v) {
        REQUIRE(std::isinf(known[v]) == std::isinf(parts.distance[v]));
        if (std::isinf(known[v])) continue;
        const double miss = std::abs(parts.distance[v] - known[v]) / std::max(known[v], 1e-3);
        worst = std::max(worst, miss);
        sum += miss;
        other += parts.label[v] != label[v];
      }
      CHECK(json["accuracy"] == (accuracy.empty() ? "accurate" : accuracy[1]));
      CHECK(worst < (accuracy.empty() ? 3e-3 : accuracy == fast ? 2e-2 : 1e-12));
      CHECK(sum < (accuracy == fast ? 1e-3 : 1e-4) * static_cast<double>(known.size()));
      CHECK(other <= known.size() / 500);
      if (first.empty()) first = parts.distance;
      CHECK(parts.distance == first);
    }
  }
}

TEST_CASE("what ranks cannot do in parts is said once, and no file is left") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string text = folder.write("square.off", square_off(5)),
                    input = folder.at("square.ply"), out = folder.at("d.pvtu");
  REQUIRE(run_tool({"convert", text, input, "--quiet"}).code == 0);
  const std::size_t files = folder.files();
  const auto refused_by = [&](const Words& arguments, int code, const std::string& why) {
    check_complaint(arguments, code, why);
    CHECK(folder.files() == files);
  };
  const auto distance = [&](const std::string& file) {
    return Words{PLEXWAY_TEST_MPI_TOOL, "distance", file, "-s", "vertex:0",
                 "--in-parts",          "-o",       out};
  };
  const auto refused = [&](const Words& more, int code, const std::string& why) {
    refused_by(Words{"-n", "2"} + distance(input) + more, code, why);
  };
  refused({"--source", "boundary"}, 2, "--source boundary");
  refused({"--metric", "speed:none.txt"}, 2, "--metric");
  refused({"--triangulation", "delaunay"}, 2, "--triangulation");
  refused({"--schedule", "fifo"}, 2, "dual_queue");
  refused_by(Words{"-n", "2", PLEXWAY_TEST_MPI_TOOL, "distance", input, "-s", "vertex:0",
                   "--in-parts", "-o", folder.at("d.vtu")},
             2, ".pvtu");
  refused({"--as", "solid"}, 2, "--as solid");
  refused({"--mask", "vertices:none.txt"}, 2, "--mask");
  refused({"--executor", "serial"}, 2, "OpenMP");
  refused({"--source", "vertex:25"}, 3, "vertex:25");
  refused_by(Words{"-n", "2"} + distance(text), 3,
             "square.off: in parts a binary .ply of triangles or a .pvtu is read, no .off");
  refused_by(Words{"-n", "2"} + distance(folder.at("none.ply")), 3, "none.ply");
  // A rank without its file.
  refused_by(
      Words{"-n", "1"} + distance(input) + Words{":", "-n", "1"} + distance(folder.at("none.ply")),
      3, "rank 1: ");
  refused({"--voxel", "1"}, 2, "--voxel");
  refused({"--grid", "a"}, 2, "--grid");
  refused({"--view", "1,2"}, 2, "--view");
  refused({"--isoline-step", "1"}, 2, "--isolines-out");
  refused_by(Words{"-n", "2", PLEXWAY_TEST_MPI_TOOL, "distance", input, text} +
                 Words{"-s", "vertex:0", "--in-parts", "-o", out},
             2, "the further file " + text);
  const Outcome alone = run_tool({"distance", input, "-s", "vertex:0", "--in-parts", "-o", out});
  CHECK(alone.code == 2);
  CHECK(folder.files() == files);
  // A file that is cut short.
  const std::string bytes = content(input);
  const std::string cut = folder.write("cut.ply", bytes.substr(0, bytes.size() - 1));
  check_complaint(Words{"-n", "2"} + distance(cut), 3, "cut.ply");
  fs::remove(cut);
  // Two files of as many vertices and triangles, of which one is numbered in another way; and what
  // is wrong with the content of one file, which several ranks read.
  const auto refused_for = [&](const Words& ranks, const std::string& why) {
    check_complaint(ranks, 3, why);
    CHECK(!fs::exists(out));
  };
  const std::string other = folder.at("other.ply"), huge = folder.at("huge.ply"),
                    wrong = folder.at("wrong.ply");
  const std::string other_text = folder.write("other.off", swapped(content(text)));
  REQUIRE(run_tool({"convert", other_text, other, "--quiet"}).code == 0);
  REQUIRE(content(other).size() == bytes.size());
  refused_for(Words{"-n", "1"} + distance(input) + Words{":", "-n", "1"} + distance(other),
              "the ranks of one solve need the same domain");
  std::string broken = bytes;
  broken.back() = '\x7f';  // of the last corner
  folder.write("wrong.ply", broken);
  refused_for(Words{"-n", "3"} + distance(wrong), "wrong.ply");
  // A corner occurs twice: what only the surface looks at names the file, too.
  broken = bytes;
  broken.replace(broken.size() - 4, 4, broken.substr(broken.size() - 8, 4));
  folder.write("huge.ply", broken);
  refused_for(Words{"-n", "3"} + distance(huge), "huge.ply: face ");
  for (const std::string& file : {other, other_text, wrong, huge}) fs::remove(file);
  // A disk that gets full.
  const std::string large_text = folder.write("hills.off", hills()), large = folder.at("hills.ply");
  REQUIRE(run_tool({"convert", large_text, large, "--quiet"}).code == 0);
  folder.write("d.pvtu", "an older one");
  fs::create_symlink("/dev/full", folder.at("d_1.vtu"));
  check_complaint(Words{"-n", "2"} + distance(large), 1,
                  "rank 1: cannot write " + folder.at("d_1.vtu").string());
  CHECK(content(out) == "an older one");
}

TEST_CASE("ranks solve in parts what others have written in parts") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string text = folder.write("hills.off", hills()), ply = folder.at("hills.ply"),
                    alone = folder.at("alone.vtu"), input = folder.at("in.pvtu"),
                    out = folder.at("d.pvtu");
  REQUIRE(run_tool({"convert", text, ply, "--quiet"}).code == 0);
  const Words exact = {"--accuracy", "exact", "--quiet", "--out"};
  REQUIRE(run_tool(from(ply, exact + Words{alone})).code == 0);
  const auto known = Vtu(alone).array<double>("distance");
  REQUIRE(run_ranks(3, from(ply, exact + Words{input, "--in-parts"})).code == 0);
  std::vector<double> first;
  for (const int ranks : {1, 2, 4}) {
    CAPTURE(ranks);
    const Outcome run = run_ranks(
        ranks, from(input, {"--accuracy", "exact", "--in-parts", "--json", "--out", out}));
    INFO(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["vertices"] == known.size());
    CHECK(run.json()["files"]["joined_by"] == "ids");
    CHECK(run.json()["files"]["alone"] == 0);
    CHECK(run.err.find("one place") == std::string::npos);
    const Parts parts(out, ranks, known.size());
    CHECK(parts.agree);
    CHECK(run.json()["simplices"] == parts.triangles);
    double worst = 0;
    for (std::size_t v = 0; v < known.size(); ++v) {
      REQUIRE(std::isinf(known[v]) == std::isinf(parts.distance[v]));
      if (!std::isinf(known[v])) worst = std::max(worst, std::abs(parts.distance[v] - known[v]));
    }
    CHECK(worst < 1e-12);
    if (first.empty()) first = parts.distance;
    CHECK(parts.distance == first);
  }
  // Without numbers points are one by their places, which is told.
  for (const char* const file : {"in.pvtu", "in_0.vtu", "in_1.vtu", "in_2.vtu"}) {
    std::string bytes = content(folder.at(file));
    for (std::size_t at = 0; (at = bytes.find("Name=\"original\"", at)) != std::string::npos;)
      bytes.replace(at, 15, "Name=\"Original\"");
    for (std::size_t at = 0; (at = bytes.find("\"in_", at)) != std::string::npos;)
      bytes.replace(at, 4, "\"no_");
    folder.write("no" + std::string(file).substr(2), bytes);
  }
  const Outcome no = run_ranks(2, from(folder.at("no.pvtu"), {"--in-parts", "--json"}));
  INFO(no.err);
  REQUIRE(no.code == 0);
  CHECK(no.json()["vertices"] == known.size());
  CHECK(no.json()["files"]["joined_by"] == "places");
  CHECK(no.json()["files"]["shared_points"] > 0);
  CHECK(no.err.find("taken as one, for they lie in one place: ") != std::string::npos);
  // The tool that reads wholes names the one that does not; so does this one, of one rank's whole.
  for (const Outcome& whole :
       {run_tool(from(input, {"--quiet"})), run_ranks(2, from(input, {"--quiet"}))})
    check_complaint(whole, 3, "in.pvtu --in-parts");
  // Ranks whose files have the same names, but not all the same sizes; or other names.
  fs::create_directory(folder.at("far"));
  for (const char* const file : {"in.pvtu", "in_0.vtu", "in_1.vtu", "in_2.vtu"})
    fs::copy_file(folder.at(file), folder.at("far") / file);
  const auto differs = [&](const std::string& why) {
    const Words rank = {"-n", "1", PLEXWAY_TEST_MPI_TOOL};
    const Words more = {"--in-parts", "--quiet"};
    const Outcome run = run_program(*mpirun() + rank + from(input, more) + Words{":"} + rank +
                                    from((folder.at("far") / "in.pvtu").string(), more));
    if (!why.empty()) return check_complaint(run, 3, why);
    CHECK(run.code == 0);
    CHECK(complaints(run).empty());
  };
  fs::remove(folder.at("far") / "in_0.vtu");  // which the first rank reads
  differs("");
  folder.write("far/in_2.vtu", content(folder.at("in_2.vtu")) + "\n");
  differs("in_2.vtu has other sizes");
  folder.write("far/in.pvtu", content(folder.at("no.pvtu")));
  for (const char* const file : {"no_0.vtu", "no_1.vtu", "no_2.vtu"})
    fs::copy_file(folder.at(file), folder.at("far") / file);
  differs("the ranks of one solve need the same domain");
  // In the place of what is read.
  fs::copy_file(input, folder.at("other.pvtu"));
  check_complaint(
      run_ranks(2, from(folder.at("other.pvtu"), {"--in-parts", "--quiet", "--out", input})), 2,
      "in_0.vtu");
  // What is wrong with one of the files.
  const auto refused = [&](const std::string& why) {
    fs::remove(out);
    check_complaint(run_ranks(2, from(input, {"--in-parts", "--quiet", "--out", out})), 3, why);
    CHECK(!fs::exists(out));
  };
  const std::string part = content(folder.at("in_1.vtu"));
  folder.write("in_1.vtu", part.substr(0, part.size() / 2));
  refused("in_1.vtu");
  std::string other = part;  // not the same numbers
  other.replace(other.find("Name=\"original\""), 15, "Name=\"Original\"");
  folder.write("in_1.vtu", other);
  refused("number their points");
  fs::remove(folder.at("in_1.vtu"));
  refused("in_1.vtu");
  folder.write("in.pvtu", "<VTKFile type=\"PPolyData\"/>");
  refused("in.pvtu");
}

TEST_CASE("a rank that has nothing in parts writes nothing, and why a vertex is not reached") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string text = folder.write("square.off", square_off(5)),
                    input = folder.at("square.ply"), out = folder.at("d.pvtu");
  REQUIRE(run_tool({"convert", text, input, "--quiet"}).code == 0);
  const Outcome run = run_ranks(3, {"distance", input, "--source", "vertex:0", "--source",
                                    "point:1,1,7", "--in-parts", "--radius", "0.3", "--out", out});
  INFO(run.err << run.out);
  REQUIRE(run.code == 0);
  const std::string names = content(out);
  CHECK(names.find("d_0.vtu") != std::string::npos);
  CHECK(names.find("d_1.vtu") == std::string::npos);
  CHECK(!fs::exists(folder.at("d_1.vtu")));
  CHECK(!fs::exists(folder.at("d_2.vtu")));
  const auto said = run.err + run.out;
  CHECK(said.find("not reached (inf): --radius or --max-expansions") != std::string::npos);
  CHECK(said.find(" 7 away)") != std::string::npos);
}

TEST_CASE("a rank that dies in parts leaves no field that looks whole") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string text = folder.write("hills.off", hills()), input = folder.at("hills.ply"),
                    out = folder.at("d.pvtu");
  REQUIRE(run_tool({"convert", text, input, "--quiet"}).code == 0);
  const Words tool = Words{PLEXWAY_TEST_MPI_TOOL} +
                     from(input, {"--in-parts", "--threads", "1", "--quiet", "--out", out});
  const Outcome killed = run_with_one_killed(tool, "sleep 0.3");
  if (killed.code == 0 || fs::exists(out)) CHECK(Parts(out, 2, 131 * 131 + 1).agree);
}

}  // namespace parts_test
