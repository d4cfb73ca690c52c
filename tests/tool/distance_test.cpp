#include <catch2/catch.hpp>
#include <cmath>
#include <set>

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
    const auto corner = run_tool({"distance", square, "--source", "vertex:0", "--precision",
                                  precision, "--quiet", "--out", "-"});
    INFO(precision << ": " << corner.err);
    REQUIRE(corner.code == 0);
    CHECK(corner.err.empty());
    const auto distance = csv_column(corner.out, "distance");
    CHECK(worst_in_square(distance, n, 0, 0) < tolerance);
    CHECK(distance[0] == 0);

    const auto inside = run_tool({"distance", square, "--source", "point:0.23,0.41,5",
                                  "--precision", precision, "--quiet", "--out", "-"});
    REQUIRE(inside.code == 0);
    CHECK(worst_in_square(csv_column(inside.out, "distance"), n, 0.23, 0.41) < tolerance);
  }
}

TEST_CASE("a point source is the closest point of the surface") {
  const Folder folder;
  const int n = 5;
  const std::string square = folder.write("square.off", square_off(n));
  const auto distances_from = [&](const std::string& point) {
    const auto run = run_tool(
        {"distance", square, "--source", point, "--precision", "double", "--quiet", "--out", "-"});
    INFO(run.err);
    REQUIRE(run.code == 0);
    return csv_column(run.out, "distance");
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
  const auto run = run_tool({"distance", sample("knot.ply"), "--source", "vertex:0", "--json"});
  INFO(run.err);
  REQUIRE(run.code == 0);
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
                                         "passed_over",
                                         "notes"});
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

TEST_CASE("without options a short summary is printed") {
  const auto run = run_tool({"distance", sample("knot.ply"), "--source", "vertex:0"});
  REQUIRE(run.code == 0);
  CHECK(run.err.empty());
  CHECK(run.out.find("5120 of 5120 vertices") != std::string::npos);
  CHECK(run_tool({"distance", sample("knot.ply"), "--source", "vertex:0", "--quiet"}).out.empty());
}

TEST_CASE("what cannot be reached is counted, noted and infinite") {
  const std::vector<std::string> command = {"distance", sample("two_parts.obj"), "--source",
                                            "vertex:0"};
  auto json_command = command;
  json_command.emplace_back("--json");
  const auto run = run_tool(json_command);
  REQUIRE(run.code == 0);
  const auto json = run.json();
  CHECK(json["components"] == 2);
  const auto unreached = json["unreached"].get<std::size_t>();
  CHECK(unreached > 1);
  CHECK(json["reached"].get<std::size_t>() + unreached == json["vertices"].get<std::size_t>());
  CHECK(run.complaints() == 1);
  CHECK(run.err.find("plexway: note: ") == 0);
  CHECK(run.err.find("2 components") != std::string::npos);

  auto csv_command = command;
  csv_command.insert(csv_command.end(), {"--quiet", "--out", "-"});
  const auto csv = run_tool(csv_command);
  CHECK(csv.err.empty());
  std::size_t infinite = 0;
  for (const double d : csv_column(csv.out, "distance")) {
    CHECK_FALSE(std::isnan(d));
    infinite += std::isinf(d) ? 1 : 0;
  }
  CHECK(infinite == unreached);
}

TEST_CASE("a radius leaves the far vertices out and the near ones as they are") {
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(21));
  const auto all = run_tool({"distance", square, "-s", "vertex:0", "-q", "-o", "-"});
  const auto some =
      run_tool({"distance", square, "-s", "vertex:0", "-q", "-o", "-", "--radius", "0.5"});
  REQUIRE(some.code == 0);
  const auto exact = csv_column(all.out, "distance");
  const auto near = csv_column(some.out, "distance");
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
  const auto run = run_tool({"distance", square, "--source", "vertex:0", "--source", "point:1,1,0",
                             "--quiet", "--out", "-"});
  REQUIRE(run.code == 0);
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
  const auto reached = [](std::vector<std::string> options) {
    std::vector<std::string> command = {"distance", sample("torus.obj"), "--source", "vertex:3",
                                        "--json"};
    command.insert(command.end(), options.begin(), options.end());
    const auto run = run_tool(command);
    INFO(options.back() << ": " << run.err);
    REQUIRE(run.code == 0);
    return run.json()["reached"].get<int>();
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
    const auto run = run_tool({"distance", sample(name), "--source", "vertex:0", "--json"});
    INFO(name << ": " << run.err);
    REQUIRE(run.code == 0);
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
  CHECK(run.err.find("plexway: error: " + file + ": nothing reached") == 0);
  CHECK(run.json()["reached"] == 1);
  CHECK(run.json()["max_distance"] == 0);
}

}  // namespace distance_test
