#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <new>
#include <string>

#include <plexway/error.hpp>

#include "helper_programs.hpp"
#include "tetgen/solids.hpp"

namespace bad_input_test {

using namespace tetgen_testing;
using Catch::Contains;

namespace {

std::string complaint_of(const Shape& surface) {
  return complaint([&] { fill(surface); });
}

bool starts(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

}  // namespace

TEST_CASE("an open surface is refused, with its open edges") {
  Shape open = cube();
  open.faces.pop_back();  // 1 7 5
  const std::string message = complaint_of(open);
  CHECK(message ==
        "the surface is open: 3 edges have only one triangle, such as the edge 1 - 5 of triangle "
        "4; close it first");
  CHECK(starts(complaint_of(samples::hills()), "the surface is open: 144 edges"));
}

TEST_CASE("surfaces that cross are refused, with two triangles that do") {
  const Shape ball = samples::geodesic_sphere(6);
  const Shape crossing = together(ball, ball, {0.5, 0.3, 0.2});
  const std::string message = complaint_of(crossing);
  INFO(message);
  unsigned a = 0, b = 0;
  REQUIRE(std::sscanf(message.c_str(), "triangles %u and %u intersect", &a, &b) == 2);
  // One of each ball, with corners on both sides of the other's plane.
  REQUIRE(a < ball.faces.size());
  REQUIRE(b >= ball.faces.size());
  REQUIRE(b < crossing.faces.size());
  using namespace samples;
  const auto straddles = [&](Index first, Index second) {
    const auto& [i, j, k] = crossing.faces[first];
    const Point p = crossing.points[i];
    const Point normal = cross(crossing.points[j] - p, crossing.points[k] - p);
    int above = 0;
    for (const Index v : crossing.faces[second])
      above += dot(crossing.points[v] - p, normal) > 0 ? 1 : 0;
    return above == 1 || above == 2;
  };
  CHECK(straddles(a, b));
  CHECK(straddles(b, a));
}

TEST_CASE("surfaces that lie on each other are refused") {
  CHECK(starts(complaint_of(together(cube(), cube(), {0.5, 0, 0})), "triangles "));
  CHECK(starts(complaint_of(together(cube(), cube(), {1, 0.25, 0.25}, 0.5)), "triangles "));
  const Shape ball = samples::geodesic_sphere(6);
  // TetGen's own search for what crosses does not end on this one.
  const std::string nearly = complaint_of(together(ball, ball, {1e-10, 0, 0}));
  INFO(nearly);
  CHECK(starts(nearly, "triangles "));
  CHECK(nearly.find("lie on each other") != nearly.npos);
}

TEST_CASE("a triangle that is there twice is named") {
  Shape doubled = cube();
  doubled.faces.push_back({doubled.faces[3][2], doubled.faces[3][0], doubled.faces[3][1]});
  CHECK(complaint_of(doubled) == "triangles 3 and 12 have the same corners; leave one out");
}

TEST_CASE("arrays that make no sense are named") {
  CHECK(complaint_of({}) == "no triangles: there is no solid to fill");
  Shape wrong = cube();
  wrong.faces[4] = {1, 2, 8};
  CHECK(complaint_of(wrong) == "triangle 4 names vertex 8, but there are 8");
  wrong.faces[4] = {1, 2, 1};
  CHECK(complaint_of(wrong) == "triangle 4 has two corners at vertex 1; leave it out");
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Shape bad = cube();
    bad.points[5][2] = x;
    CHECK(starts(complaint_of(bad), "vertex 5: a coordinate is not finite"));
    CHECK(starts(complaint([&] {
                   fill(cube(), {}, {{0.5, x, 0.5}});
                 }),
                 "hole 0: a coordinate is not finite"));
  }
}

TEST_CASE("a surface without inside is refused") {
  Shape flat = cube();
  for (Point& p : flat.points) p[2] = 0.001 * p[0];
  CHECK(complaint_of(flat) != "no complaint");
  CHECK(complaint([] {
          fill(cube(), {}, {{0.5, 0.5, 0.5}});
        }) == "the boundary encloses no volume that is not a hole");
}

TEST_CASE("options out of range are usage errors") {
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(fill(cube(), {.max_volume = bad}), plexway::UsageError);
    CHECK_THROWS_AS(fill(cube(), {.max_radius_edge = bad}), plexway::UsageError);
    CHECK_THROWS_AS(fill(cube(), {.max_seconds = bad}), plexway::UsageError);
  }
  CHECK_THROWS_AS(fill(cube(), {.max_radius_edge = 1}), plexway::UsageError);
  CHECK_THROWS_AS(fill(cube(), {.max_volume = 1e-300}), plexway::UsageError);
}

TEST_CASE("a time limit stops TetGen") {
  try {
    fill(cube(), {.max_volume = 1e-8, .max_seconds = 0.2});
    FAIL("no error");
  } catch (const plexway::Error& error) {
    CHECK(std::string(error.what()).find("time limit") != std::string::npos);
  }
}

TEST_CASE("TetGen can be watched and stopped") {
  int asked = 0;
  double last = 0;
  const auto go_on = [&](double seconds) {
    CHECK(seconds > last);
    last = seconds;
    return ++asked < 3;
  };
  CHECK_THROWS_AS(fill(cube(), {.max_volume = 1e-8, .go_on = go_on}), plexway::Cancelled);
  CHECK(asked == 3);
  const auto fails = [](double) -> bool { throw plexway::UsageError("enough"); };
  CHECK_THROWS_AS(fill(cube(), {.max_volume = 1e-8, .go_on = fails}), plexway::UsageError);
}

// TetGen's program: what ends it is told, and not blamed on the surface.

namespace {

// Whether the surface is blamed, in words with `with`.
bool blames_surface(const std::string& script, const std::string& with, const Shape& shape) {
  const testing::FakeHelper helper("plexway-tetgen", script);
  INFO(script);
  try {
    fill(shape);
    FAIL("no error");
  } catch (const plexway::InputError& error) {
    CHECK_THAT(error.what(), Contains(with));
    return true;
  } catch (const plexway::Error& error) {
    CHECK_THAT(error.what(), Contains(with));
  }
  return false;
}

}  // namespace

TEST_CASE("the surface is not blamed for a helper that was killed or is not there") {
  // More than a pipe holds, and none of these reads it.
  const Shape large = samples::geodesic_sphere(40);
  const auto before = std::signal(SIGPIPE, SIG_DFL);
  CHECK_FALSE(
      blames_surface("kill -9 $$", "was killed (signal 9): memory may have run out", large));
  CHECK_FALSE(blames_surface("kill -HUP $$", "was ended by signal 1", large));
  CHECK_FALSE(blames_surface("exit 3", "ended early, with code 3", large));
  CHECK_FALSE(blames_surface("exit 65", "of another version", large));
  CHECK_FALSE(blames_surface("cat >/dev/null; kill -9 $$", "was killed (signal 9)", large));
  CHECK(blames_surface("cat >/dev/null; kill -ABRT $$", "TetGen gives up", cube()));
  std::signal(SIGPIPE, before);
  {
    const testing::FakeHelper helper("another", "exit 0");
    CHECK_THROWS_AS(fill(cube()), plexway::NotBuiltError);
  }
  {
    const testing::FakeHelper helper(
        "plexway-tetgen",
        "cat >/dev/null; for i in 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
        "0 0 0 0; do printf \"\\\\00$i\" >&3; done");
    CHECK_THROWS_AS(fill(cube()), std::bad_alloc);
  }
  CHECK_FALSE(fill(cube()).tets.empty());
}

}  // namespace bad_input_test
