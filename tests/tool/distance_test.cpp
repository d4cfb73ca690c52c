#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>

#include "complexes/test_solids.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace distance_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

// The largest difference between the distances and those in the plane from (x, y).
double worst_in_square(const std::vector<double>& distance, int n, double x, double y) {
  REQUIRE(distance.size() == static_cast<std::size_t>(n * n));
  double worst = 0;
  for (int v = 0; v < n * n; ++v) {
    const double straight = std::hypot(v % n / (n - 1.0) - x, v / n / (n - 1.0) - y);
    worst = std::max(worst, std::abs(distance[static_cast<std::size_t>(v)] - straight));
  }
  return worst;
}

}  // namespace

TEST_CASE("distances on a flat square are exact") {
  const Folder folder;
  const int n = 11;
  const std::string square = folder.write("square.off", square_off(n));
  for (const std::string precision : {"float", "double"}) {
    const double tolerance = precision == "float" ? 1e-5 : 1e-12;
    const auto from = [&](const std::string& source) {
      return distances({square, "--source", source, "--precision", precision});
    };
    const auto corner = from("vertex:0");
    CHECK(worst_in_square(corner, n, 0, 0) < tolerance);
    CHECK(corner[0] == 0);
    CHECK(worst_in_square(from("point:0.23,0.41,5"), n, 0.23, 0.41) < tolerance);
  }
}

TEST_CASE("a point source is the closest point of the surface") {
  const Folder folder;
  const int n = 5;
  const std::string square = folder.write("square.off", square_off(n));
  const auto distances_from = [&](const std::string& point) {
    return distances({square, "--source", point, "--precision", "double"});
  };
  SECTION("the vertex itself") { CHECK(distances_from("point:0.25,0.5,0")[11] == 0); }
  SECTION("a vertex, from outside") {
    const auto distance = distances_from("point:-3,-4,2");
    CHECK(distance[0] == 0);
    CHECK(worst_in_square(distance, n, 0, 0) < 1e-12);
  }
  SECTION("on the border") {
    CHECK(worst_in_square(distances_from("point:0.3,-1e3,0"), n, 0.3, 0) < 1e-12);
  }
  SECTION("on an inner edge") {
    CHECK(worst_in_square(distances_from("point:0.3,0.25,0"), n, 0.3, 0.25) < 1e-12);
  }
}

TEST_CASE("the JSON of distance has its keys, in order") {
  const auto run = ran({"distance", sample("knot.ply"), "--source", "vertex:0", "--json"});
  CHECK(run.err.empty());
  const auto json = nlohmann::ordered_json::parse(run.out);
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  CHECK(keys == std::vector<std::string>{"input",
                                         "kind",
                                         "vertices",
                                         "simplices",
                                         "components",
                                         "sources",
                                         "seconds",
                                         "reached",
                                         "unreached",
                                         "max_distance",
                                         "farthest",
                                         "expansions",
                                         "updates",
                                         "lowered_vertices",
                                         "raised_vertices",
                                         "executor",
                                         "threads",
                                         "precision",
                                         "accuracy",
                                         "triangulation",
                                         "split_polygons",
                                         "split_cells",
                                         "dropped_simplices",
                                         "merged_vertices",
                                         "passed_over",
                                         "notes"});
  CHECK_THAT(ran({"distance", sample("knot.ply"), "--source", "vertex:0"}).out,
             Catch::Contains("5120 of 5120 vertices"));
  CHECK(json["input"] == sample("knot.ply"));
  CHECK(json["kind"] == "surface");
  CHECK(json["vertices"] == 5120);
  CHECK(json["simplices"] == 10240);
  CHECK(json["components"] == 1);
  CHECK(json["reached"] == 5120);
  CHECK(json["unreached"] == 0);
  CHECK(json["max_distance"].get<double>() > 1);
  CHECK(json["expansions"].get<std::size_t>() > 10000);
  CHECK(json["updates"].get<std::size_t>() >= 5120);  // one a vertex at least
  CHECK(json["accuracy"] == "accurate");
  CHECK(json["executor"] == "serial");
  CHECK(json["threads"] == 1);
  CHECK(json["precision"] == "float");
  for (const char* phase : {"load", "build", "solve"}) {
    CHECK(json["seconds"][phase].get<double>() >= 0);
  }
}

TEST_CASE("what cannot be reached is counted, noted and infinite") {
  const std::string parts = sample("two_parts.obj");
  const auto run = ran({"distance", parts, "--source", "vertex:0", "--json"});
  const auto json = run.json();
  CHECK(json["components"] == 2);
  const auto unreached = json["unreached"].get<std::size_t>();
  CHECK(unreached > 1);
  CHECK(json["reached"].get<std::size_t>() + unreached == json["vertices"].get<std::size_t>());
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("plexway: note: ") == 0);
  CHECK(run.err.find("2 components") != std::string::npos);

  std::size_t infinite = 0;
  for (const double d : distances({parts, "--source", "vertex:0"})) {
    CHECK_FALSE(std::isnan(d));
    infinite += std::isinf(d) ? 1 : 0;
  }
  CHECK(infinite == unreached);
}

TEST_CASE("a radius leaves the far vertices out and the near ones as they are") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(21));
  const auto exact = distances({square, "-s", "vertex:0"});
  const auto near = distances({square, "-s", "vertex:0", "--radius", "0.5"});
  std::size_t infinite = 0;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    if (exact[v] < 0.5) CHECK(near[v] == Approx(exact[v]).epsilon(1e-5));
    infinite += std::isinf(near[v]) ? 1 : 0;
  }
  CHECK(infinite > exact.size() / 2);
}

TEST_CASE("of several sources each vertex gets the nearest, and its label") {
  const Folder folder;
  const int n = 11;
  const std::string square = folder.write("square.off", square_off(n));
  const auto run = ran({"distance", square, "--source", "vertex:0", "--source", "point:1,1,0",
                        "--quiet", "--out", "-"});
  CHECK(run.out.rfind("vertex,distance,label,error\n", 0) == 0);
  const auto distance = csv_column(run.out, "distance");
  const auto label = csv_column(run.out, "label");
  for (int v = 0; v < n * n; ++v) {
    const double x = v % n / (n - 1.0), y = v / n / (n - 1.0);
    const double to_first = std::hypot(x, y), to_second = std::hypot(1 - x, 1 - y);
    const auto at = static_cast<std::size_t>(v);
    CHECK(distance[at] == Approx(std::min(to_first, to_second)).margin(1e-5));
    if (std::abs(to_first - to_second) > 0.2) CHECK(label[at] == (to_first < to_second ? 0 : 1));
  }
}

TEST_CASE("every policy, schedule and precision runs") {
  const auto reached = [](const Words& options) {
    return ran(joined({"distance", sample("torus.obj"), "--source", "vertex:3", "--json"}, options))
        .json()["reached"]
        .get<int>();
  };
  for (const char* name : {"saddles", "tuned", "centroid", "upper_bound"}) {
    CHECK(reached({"--visibility", name}) == 1152);
  }
  for (const char* name : {"dual_queue", "fifo", "priority"}) {
    CHECK(reached({"--schedule", name}) == 1152);
  }
  CHECK(reached({"--precision", "double"}) == 1152);
  CHECK(reached({"--step", "2"}) == 1152);
  CHECK(reached({"--executor", "serial"}) == 1152);
  CHECK(reached({"--as", "surface"}) == 1152);
  CHECK(reached({"--max-expansions", "100"}) < 1152);
}

TEST_CASE("every sample runs") {
  for (const char* name : {"box.stl", "ell.obj", "hills.off", "moebius.obj", "slit.off"}) {
    const auto run = ran({"distance", sample(name), "--source", "vertex:0", "--json"});
    CHECK(run.json()["unreached"] == 0);
  }
}

TEST_CASE("reaching nothing has its own exit code") {
  const Folder folder;
  const std::string file =
      folder.write("lonely.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
  const auto run = run_tool({"distance", file, "--source", "vertex:3", "--json"});
  CHECK(run.code == 5);
  CHECK(run.complaints() == 1);
  CHECK(run.err.starts_with("plexway: error: " + file + ": nothing reached"));
  CHECK(run.json()["reached"] == 1);
  CHECK(run.json()["max_distance"] == 0);
}

namespace {

bool has_openmp() {
  return run_tool({"info", "--devices"}).out.find("\nopenmp ") != std::string::npos;
}

Outcome distance(std::vector<std::string> options) {
  std::vector<std::string> command = {"distance", sample("knot.ply"), "-s", "vertex:0", "--json"};
  command.insert(command.end(), options.begin(), options.end());
  return run_tool(command);
}

}  // namespace

TEST_CASE("openmp reaches what serial reaches, with any number of threads") {
  if (!has_openmp()) return;
  const auto alone = distance({});
  REQUIRE(alone.code == 0);
  for (const char* threads : {"1", "2", "5"}) {
    const auto run = distance({"--executor", "openmp", "--threads", threads});
    INFO(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.json()["executor"] == "openmp");
    CHECK(run.json()["threads"] == std::stoi(threads));
    CHECK(run.json()["reached"] == alone.json()["reached"]);
    const double a = alone.json()["max_distance"], b = run.json()["max_distance"];
    CHECK(b == Approx(a).epsilon(1e-2));
  }
}

TEST_CASE("auto takes one thread for what is small") {
  const auto run = distance({"--executor", "auto", "--threads", "2"});
  REQUIRE(run.code == 0);
  CHECK(run.json()["executor"] == "serial");
  CHECK(distance({"--executor", "auto", "--schedule", "priority"}).code == 0);
}

TEST_CASE("auto takes several threads for what is large") {
  const io_testing::Folder folder;
  std::ostringstream points;
  for (int i = 0; i < 240; ++i)
    for (int j = 0; j < 240; ++j) points << i << ' ' << j + 0.5 * (i % 2) << " 0\n";
  const std::string cloud = folder.write("sheet.xyz", points.str());
  const auto executor = [&](const std::string& accuracy) {
    std::vector<std::string> command = {"distance", cloud,    "--executor", "auto",  "--threads",
                                        "2",        "--json", "--accuracy", accuracy};
    for (int n = 0; n < 64; ++n) {
      command.push_back("-s");
      command.push_back("vertex:" + std::to_string(900 * n));
    }
    const auto run = ran(command);
    return run.json()["executor"].get<std::string>();
  };
  for (const char* accuracy : {"fast", "accurate"})
    CHECK(executor(accuracy) == (has_openmp() ? "openmp" : "serial"));
}

TEST_CASE("auto takes several threads for solids unless they are solved fast") {
  const io_testing::Folder folder;
  const plexway::testing::Solid cube = plexway::testing::solid_cube(16);  // 24,576 tetrahedra
  const std::string file = folder.at("cube.msh").string();
  plexway::io::write_tets(file, {cube.positions, cube.tets});
  const auto executor = [&](const char* option, const char* value) {
    return ran({"distance", file, "-s", "vertex:0", "--executor", "auto", "--threads", "2", option,
                value, "--json"})
        .json()["executor"];
  };
  CHECK(executor("--accuracy", "accurate") == (has_openmp() ? "openmp" : "serial"));
  CHECK(executor("--accuracy", "fast") == "serial");
  CHECK(executor("--visibility", "centroid") == "serial");  // which strings do not know
}

TEST_CASE("executors and options that do not go together are usage errors") {
  const auto refused = [](std::vector<std::string> options, int code, const std::string& says) {
    const auto run = distance(std::move(options));
    CHECK(run.code == code);
    CHECK(run.out.empty());
    CHECK(run.err.find(says) != std::string::npos);
    CHECK(run.err.find('\n') == run.err.size() - 1);
  };
  if (has_openmp())
    refused({"--executor", "openmp", "--schedule", "priority"}, 2, "the schedule priority");
  else
    refused({"--executor", "openmp"}, 4, "--executor openmp");
  refused({"--device", "0"}, 2, "--device");
  refused({"--executor", "abacus"}, 2, "abacus");
  refused({"--threads", "0"}, 2, "--threads");
  CHECK(distance({"--threads", "2"}).code == 0);  // it builds by two
  refused({"--executor", "auto", "--threads", "0"}, 2, "--threads");
  refused({"--executor", "auto", "--threads", "-2"}, 2, "--threads");
}

TEST_CASE("bench takes an executor") {
  if (!has_openmp()) return;
  const auto run = ran({"bench", sample("knot.ply"), "-s", "vertex:0", "--repeats", "2",
                        "--executor", "openmp", "--threads", "2", "--json", "-q"});
  CHECK(run.json()["executor"] == "openmp");
}

namespace {

// A flat strip of n by n cells, 40 times as long as wide and sheared, so that the diagonals are
// wrong: thin triangles that are far from Delaunay.
std::string sheared_off(int n) {
  std::string text =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string(2 * (n - 1) * (n - 1)) + " 0\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      text += std::to_string(i + 3.0 * j) + " " + std::to_string(0.025 * j) + " 0\n";
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i, b = a + n;
      text += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(b + 1) +
              "\n3 " + std::to_string(a) + " " + std::to_string(b + 1) + " " + std::to_string(b) +
              "\n";
    }
  return text;
}

}  // namespace

TEST_CASE("triangulation is chosen by shape, and planes stay exact") {
  const Folder folder;
  constexpr int n = 12;
  const std::string strip = folder.write("strip.off", sheared_off(n));
  const auto info = ran({"info", strip, "--json"});
  CHECK(info.json()["triangulation"]["needle_share"].get<double>() > 0.9);
  CHECK(info.json()["triangulation"]["auto"] == "refined");
  for (const std::string name : {"input", "delaunay", "refined", "auto"}) {
    for (const auto& [accuracy, off] :
         {std::pair("fast", 1e-9), {"exact", 1e-9}, {"accurate", 1e-6}}) {
      const auto distance = distances({strip, "--source", "vertex:0", "--triangulation", name,
                                       "--accuracy", accuracy, "--precision", "double"});
      REQUIRE(distance.size() == n * n);
      // The strip is convex: straight lines.
      for (int v = 0; v < n * n; ++v) {
        const int i = v % n, j = v / n;
        CHECK(distance[static_cast<std::size_t>(v)] ==
              Approx(std::hypot(i + 3.0 * j, 0.025 * j)).epsilon(off).margin(1e-12));
      }
    }
    const auto report =
        ran({"distance", strip, "--source", "point:17,0.125,0", "--json", "--triangulation", name});
    CHECK(report.json()["triangulation"] == (name == "auto" ? "refined" : name));
    CHECK(report.json()["simplices"] == 2 * (n - 1) * (n - 1));
    // The farther end of the strip from the point: both ends are corners.
    const double ends[2] = {std::hypot(17, 0.125), std::hypot(11 + 33 - 17.0, 0.275 - 0.125)};
    CHECK(report.json()["max_distance"].get<double>() ==
          Approx(std::max(ends[0], ends[1])).epsilon(1e-5));
  }
}

TEST_CASE("triangulation leaves good meshes alone, and says what it knows") {
  const auto knot = ran({"distance", sample("knot.ply"), "--source", "vertex:0", "--json"});
  CHECK(knot.json()["triangulation"] == "input");
  const auto flips = ran({"bench", sample("hills.off"), "--source", "vertex:0", "--repeats", "1",
                          "--json", "--quiet", "--triangulation", "delaunay"});
  CHECK(flips.json()["triangulation"] == "delaunay");
  CHECK(flips.json()["flips"].get<int>() > 0);
  check_refused({"distance", sample("knot.ply"), "--source", "vertex:0", "--triangulation", "good"},
                2);
  const auto wires = run_tool(
      {"distance", sample("vessels.obj"), "--source", "vertex:0", "--triangulation", "delaunay"});
  CHECK(wires.code == 2);
  CHECK(wires.err.find("only a surface") != std::string::npos);
}

TEST_CASE("labels and unreached vertices survive a refinement") {
  const auto with = [](const std::string& triangulation) {
    return ran({"distance", sample("two_parts.obj"), "--source", "vertex:0", "--source", "vertex:1",
                "--triangulation", triangulation, "--out", "-", "--quiet"});
  };
  const auto run = with("refined");
  const auto a = csv_column(run.out, "distance"), b = csv_column(with("input").out, "distance");
  REQUIRE(a.size() == b.size());
  for (std::size_t v = 0; v < a.size(); ++v) CHECK(std::isinf(a[v]) == std::isinf(b[v]));
  CHECK(csv_column(run.out, "label").size() == b.size());
}

}  // namespace distance_test
