#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "folder.hpp"
#include "mpi/running.hpp"
#include "mpi/surfaces.hpp"

namespace ranks_test {

// Matrices by the tool among ranks.

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

// One field by the tool among ranks.

namespace {

// A net whose knots are not quite in rows.
std::string net() {
  constexpr int n = 200;
  std::ostringstream text;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      text << "v " << i + 0.3 * std::sin(7 * j + i) << ' ' << j + 0.3 * std::cos(5 * i) << " 0\n";
  for (int v = 0; v < n * n; ++v) {
    if (v % n > 0) text << "l " << v << ' ' << v + 1 << '\n';
    if (v >= n) text << "l " << v - n + 1 << ' ' << v + 1 << '\n';
  }
  return text.str();
}

// Are the parts beside `file` the whole that one process wrote?
void check_parts(const fs::path& file, int parts, const Vtu& whole) {
  const std::string names = content(file);
  const auto distance = whole.array<double>("distance"), error = whole.array<double>("error");
  const auto points = whole.array<double>("Points");
  const auto label = whole.array<std::int32_t>("label");
  std::vector<bool> seen(distance.size());
  std::vector<std::int64_t> corners;
  for (int p = 0; p < parts; ++p) {
    CAPTURE(p);
    const std::string name = file.stem().string() + "_" + std::to_string(p) + ".vtu";
    CHECK(names.find("<Piece Source=\"" + name + "\"/>") != std::string::npos);
    const Vtu part(file.parent_path() / name);
    const auto original = part.array<std::uint32_t>("original");
    const auto d = part.array<double>("distance"), e = part.array<double>("error");
    const auto at = part.array<double>("Points");
    const auto l = part.array<std::int32_t>("label");
    REQUIRE((d.size() == original.size() && at.size() == 3 * d.size()));
    REQUIRE((e.size() == (error.empty() ? 0 : d.size()) && l.size() == d.size()));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const std::size_t v = original[i];
      seen[v] = true;
      wrong += d[i] != distance[v] || l[i] != label[v] || (!e.empty() && e[i] != error[v]) ||
               std::memcmp(&at[3 * i], &points[3 * v], 3 * sizeof(double)) != 0;
    }
    CHECK(wrong == 0);
    for (const std::int64_t c : part.array<std::int64_t>("connectivity"))
      corners.push_back(original[static_cast<std::size_t>(c)]);
  }
  CHECK(std::find(seen.begin(), seen.end(), false) == seen.end());
  CHECK(corners == whole.array<std::int64_t>("connectivity"));
}

Words from(const std::string& input, const Words& more) {
  return Words{"distance", input, "--source", "vertex:0", "--source", "vertex:5000"} + more;
}

}  // namespace

TEST_CASE("ranks solve one field, bit for bit what threads solve") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string surface = folder.write("hills.off", hills());
  const auto same = [&](const std::string& input, const Words& options,
                        const std::vector<std::pair<int, int>>& schedulers) {
    const std::string alone = folder.at("alone.npy"), together = folder.at("ranks.npy");
    const Outcome threads =
        run_tool(from(input, options + Words{"--executor", "openmp", "--threads", "2", "--json",
                                             "--out", alone}));
    INFO(threads.err);
    REQUIRE(threads.code == 0);
    const auto expected = threads.json();
    CHECK(expected["supersteps"] > 3);
    CHECK(expected["messages"] > 100);
    for (const auto& [count, each] : schedulers) {
      CAPTURE(input, count, each);
      const Outcome run =
          run_ranks(count, from(input, options + Words{"--threads", std::to_string(each), "--json",
                                                       "--out", together}));
      INFO(run.err);
      REQUIRE(run.code == 0);
      CHECK(run.err == threads.err);  // notes, said once
      const auto json = run.json();
      CHECK(json["ranks"] == count);
      CHECK(json["threads"] == each);
      for (const char* const key : {"supersteps", "messages", "message_bytes", "expansions",
                                    "updates", "reached", "max_distance", "lowered_vertices"})
        if (expected.contains(key)) CHECK(json[key] == expected[key]);
      CHECK((json["sent_bytes"] > 0) == (count > 1));
      REQUIRE(json["peak_bytes"].size() == static_cast<std::size_t>(count));
      for (const auto& peak : json["peak_bytes"]) CHECK(peak > 1'000'000);
      CHECK(content(together) == content(alone));
      fs::remove(together);
    }
  };
  same(surface, {"--accuracy", "fast"}, {{1, 1}, {2, 2}, {4, 1}});
  same(surface, {"--precision", "double"}, {{2, 1}, {4, 2}});
  same(folder.write("net.obj", net()), {}, {{1, 2}, {2, 1}, {4, 2}});
}

TEST_CASE("ranks write a field in parts, which one file names") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("hills.off", hills());
  const std::string alone = folder.at("alone.vtu"), out = folder.at("a & b.pvtu");
  REQUIRE(run_tool(from(input, {"--executor", "openmp", "--quiet", "--out", alone})).code == 0);
  const Vtu whole(alone);
  folder.write("a & b.pvtu", "an older one");
  const Outcome run = run_ranks(3, from(input, {"--threads", "1", "--out", out}));
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.out.find("ranks") != std::string::npos);
  const std::string text = content(out);
  CHECK(text.find("<PUnstructuredGrid") != std::string::npos);
  std::string names = text;
  for (std::size_t at; (at = names.find("&amp;")) != names.npos;) names.erase(at + 1, 4);
  folder.write("a & b.pvtu", names);
  check_parts(out, 3, whole);
  CHECK(folder.files() == 6);

  // More ranks than cells, and one rank.
  const std::string two = folder.write("two.off", square_off(2)), small = folder.at("small.pvtu"),
                    small_alone = folder.at("small.vtu");
  const auto command = [&](const std::string& file) {
    return Words{"distance", two, "-s", "vertex:0", "-s", "vertex:3", "--quiet", "-o", file};
  };
  REQUIRE(run_tool(command(small_alone)).code == 0);
  REQUIRE(run_ranks(4, command(small)).code == 0);
  check_parts(small, 2, Vtu(small_alone));
  CHECK(folder.files() == 11);
  REQUIRE(run_ranks(1, command(small)).code == 0);
  check_parts(small, 1, Vtu(small_alone));
}

TEST_CASE("what ranks cannot solve together is said once, and no file is left") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("square.off", square_off(5)),
                    wires = folder.write("wires.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"),
                    out = folder.at("d.pvtu");
  const auto refused_by = [&](const Words& arguments, int code, const std::string& text) {
    check_complaint(arguments, code, text);
    CHECK(folder.files() == 2);
  };
  const auto refused = [&](const Words& arguments, int code, const std::string& text) {
    refused_by(Words{"-n", "2", PLEXWAY_TEST_MPI_TOOL} + arguments, code, text);
  };
  const auto distance = [&](const std::string& file) {
    return Words{"distance", file, "-s", "vertex:0", "-o", out};
  };
  refused(distance(folder.at("none.off")), 3, "none.off");
  refused(distance(input) + Words{"--executor", "serial"}, 2, "OpenMP");
  refused(distance(wires), 2, ".pvtu");
  refused({"distance", input, "-s", "vertex:77", "-o", out}, 3, "77");
  refused({"distance", input, "-s", "vertex:0", "-o", folder.at("no/d.pvtu")}, 1, "no");
  // A rank without its file.
  refused_by(Words{"-n", "1", PLEXWAY_TEST_MPI_TOOL} + distance(input) +
                 Words{":", "-n", "1", PLEXWAY_TEST_MPI_TOOL} + distance(folder.at("none.off")),
             3, "rank 1: ");
  // Two of one name that are not the same.
  const fs::path other = folder.write("other.off", square_off(6));
  check_complaint(Words{"-n", "1", PLEXWAY_TEST_MPI_TOOL} + distance(input) +
                      Words{":", "-n", "1", PLEXWAY_TEST_MPI_TOOL} + distance(other),
                  3, "the same domain: rank 1 differs");
  fs::remove(other);
  CHECK(folder.files() == 2);
  // Two outputs, or one: what is in parts would miss some.
  const auto to = [&](const Words& output) {
    return Words{"-n", "1", PLEXWAY_TEST_MPI_TOOL, "distance", input, "-s", "vertex:0"} + output;
  };
  for (const auto& [one, another] :
       {std::pair(Words{"-o", out}, Words{}), std::pair(Words{}, Words{"-o", out}),
        std::pair(Words{"-o", out}, Words{"-o", folder.at("e.pvtu")}),
        std::pair(Words{}, Words{"-o", folder.at("e.csv")})})
    refused_by(to(one) + Words{":"} + to(another), 2, "the same outputs: rank 1 differs");
  // Alone there are no parts.
  const Outcome alone = run_tool(distance(input));
  CHECK(alone.code == 2);
  CHECK(folder.files() == 2);
}

TEST_CASE("a disk that gets full, or a rank that dies, leaves no field that looks whole") {
  if (!mpirun()) return;
  const testing::Folder folder;
  const std::string input = folder.write("hills.off", hills()), out = folder.at("d.pvtu"),
                    alone = folder.at("alone.vtu");
  REQUIRE(run_tool(from(input, {"--executor", "openmp", "--quiet", "--out", alone})).code == 0);
  const Vtu whole(alone);
  folder.write("d.pvtu", "an older one");
  fs::create_symlink("/dev/full", folder.at("d_1.vtu"));
  const Words tool =
      Words{PLEXWAY_TEST_MPI_TOOL} + from(input, {"--threads", "1", "--quiet", "--out", out});
  check_complaint(Words{"-n", "2"} + tool, 1,
                  "rank 1: cannot write " + folder.at("d_1.vtu").string());
  CHECK(content(out) == "an older one");  // nothing was lost
  CHECK(folder.files() == 4);
  fs::remove(folder.at("d_1.vtu"));

  for (const std::string seconds : {"0.3", "0.6"}) {
    CAPTURE(seconds);
    fs::remove(out);
    const Outcome killed = run_with_one_killed(tool, "sleep " + seconds);
    // The list of parts comes last: where it is, all are whole.
    if (killed.code == 0 || fs::exists(out)) check_parts(out, 2, whole);
  }
  REQUIRE(run_program(*mpirun() + Words{"-n", "2"} + tool).code == 0);
  check_parts(out, 2, whole);
}

}  // namespace ranks_test
