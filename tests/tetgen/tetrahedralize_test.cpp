#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <string>

#include <plexway/error.hpp>

#include "helper_programs.hpp"
#include "io/io_testing.hpp"
#include "tetgen/solids.hpp"

namespace tetrahedralize_test {

using namespace tetgen_testing;

namespace {

// Triangles of the tets that only one tet has, corners sorted.
std::set<std::array<Index, 3>> boundary(const Solid& solid) {
  std::map<std::array<Index, 3>, int> count;
  for (const auto& tet : solid.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<Index, 3> face;
      for (std::size_t i = 0, at = 0; i < 4; ++i)
        if (i != left_out) face[at++] = tet[i];
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  }
  std::set<std::array<Index, 3>> once;
  for (const auto& [face, tets] : count) {
    REQUIRE(tets <= 2);
    if (tets == 1) once.insert(face);
  }
  return once;
}

}  // namespace

TEST_CASE("a filled surface has the volume it encloses") {
  for (const Shape& surface : {cube(), samples::geodesic_sphere(5), samples::knot(),
                               samples::torus(), samples::box(), samples::bumpy(8)}) {
    const Solid solid = fill(surface);
    INFO(surface.points.size() << " vertices");
    CHECK(volume(solid) == Approx(enclosed(surface)).epsilon(1e-9));
    for (std::size_t t = 0; t < solid.tets.size(); ++t) REQUIRE(volume(solid, t) > 0);
    for (const auto& tet : solid.tets)
      for (const Index v : tet) REQUIRE(v < solid.positions.size());
  }
}

TEST_CASE("the vertices of the surface come first, bit by bit") {
  Shape surface = samples::geodesic_sphere(6);
  surface.add({0.1, 0.2, 0.3});  // in no triangle
  surface.add({7, 7, 7});        // nor this one, outside
  for (const double unit : {1.0, 0.1, 3e7}) {
    Shape scaled = surface;
    for (Point& p : scaled.points) p = samples::operator*(unit, p);
    for (const bool keep : {false, true}) {
      const Solid solid =
          fill(scaled, {.max_volume = 0.01 * unit * unit * unit, .keep_surface = keep});
      REQUIRE(solid.positions.size() > scaled.points.size());
      CHECK(std::equal(scaled.points.begin(), scaled.points.end(), solid.positions.begin()));
      std::vector<bool> used(solid.positions.size(), false);
      for (const auto& tet : solid.tets)
        for (const Index v : tet) used[v] = true;
      for (std::size_t v = 0; v + 2 < scaled.points.size(); ++v) REQUIRE(used[v]);
      // Whatever was added is used.
      CHECK(std::all_of(used.begin() + static_cast<std::ptrdiff_t>(scaled.points.size()),
                        used.end(), [](bool b) { return b; }));
    }
  }
}

TEST_CASE("no tetrahedron is larger than max_volume") {
  for (const double bound : {0.02, 0.002}) {
    const Solid solid = fill(samples::geodesic_sphere(4), {.max_volume = bound});
    double largest = 0;
    for (std::size_t t = 0; t < solid.tets.size(); ++t)
      largest = std::max(largest, volume(solid, t));
    CHECK(largest <= bound * (1 + 1e-9));
    CHECK(largest > bound / 10);
    CHECK(static_cast<double>(solid.tets.size()) >= volume(solid) / bound);
  }
}

TEST_CASE("quality adds points, and a tighter bound more of them") {
  const Shape surface = samples::torus();
  const std::size_t none = fill(surface, {.quality = false}).positions.size();
  const std::size_t some = fill(surface).positions.size();
  const std::size_t more = fill(surface, {.max_radius_edge = 1.3}).positions.size();
  CHECK(none >= surface.points.size());  // the boundary may need some
  CHECK(some > none);
  CHECK(more > some);
}

TEST_CASE("keep_surface leaves the triangles of the boundary as they are") {
  const Shape surface = samples::torus();
  std::set<std::array<Index, 3>> given;
  for (auto face : surface.faces) {
    std::sort(face.begin(), face.end());
    given.insert(face);
  }
  const Solid solid = fill(surface, {.max_volume = 1e-3, .keep_surface = true});
  CHECK(solid.positions.size() > surface.points.size());
  CHECK(boundary(solid) == given);
  CHECK(volume(solid) == Approx(enclosed(surface)));
}

TEST_CASE("a hole point leaves a cavity empty, none makes it an inner wall") {
  const Shape nested = together(cube(3), cube(1), {1, 1, 1});
  CHECK(volume(fill(nested, {}, {{1.5, 1.5, 1.5}})) == Approx(26));
  CHECK(volume(fill(nested)) == Approx(27));
  CHECK(volume(fill(nested, {}, {{0.1, 0.1, 0.1}})) == Approx(1));
}

TEST_CASE("separate parts are filled, and parts that touch in a vertex") {
  using namespace samples;
  const Shape ball = geodesic_sphere(3);
  CHECK(volume(fill(together(ball, ball, {5, 0, 0}))) == Approx(2 * enclosed(ball)));
  const Point tip = ball.points[0];
  const Shape touching = together(ball, ball, 2.0 * tip);
  CHECK(volume(fill(touching)) == Approx(2 * enclosed(ball)));
}

TEST_CASE("a soup whose corners lie on each other is closed") {
  const Shape ball = samples::geodesic_sphere(3);
  Shape soup;
  for (const auto& face : ball.faces) {
    const auto first = static_cast<Index>(soup.points.size());
    for (const Index v : face) soup.add(ball.points[v]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  const Solid solid = fill(soup);
  CHECK(volume(solid) == Approx(enclosed(ball)));
  CHECK(std::equal(soup.points.begin(), soup.points.end(), solid.positions.begin()));
}

TEST_CASE("orientation and unit of the surface do not matter") {
  Shape turned = samples::geodesic_sphere(3);
  for (std::size_t f = 0; f < turned.faces.size(); f += 2)
    std::swap(turned.faces[f][0], turned.faces[f][1]);
  const double expected = enclosed(samples::geodesic_sphere(3));
  CHECK(volume(fill(turned)) == Approx(expected));
  for (const int power : {-300, 300}) {
    Shape scaled = turned;
    for (Point& p : scaled.points)
      for (double& x : p) x = std::ldexp(x, power);
    Solid solid = fill(scaled);
    for (Point& p : solid.positions)
      for (double& x : p) x = std::ldexp(x, -power);
    CHECK(volume(solid) == Approx(expected));
  }
}

TEST_CASE("filling is silent and gives the same again") {
  const io_testing::Folder folder;
  const std::string file = (folder.path() / "output.txt").string();
  std::printf("held back;");  // not flushed: the child inherits it
  const int kept = ::dup(STDOUT_FILENO);
  const int to_file = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  const auto direct = [](int to) {
    std::fflush(stdout);
    ::dup2(to, STDOUT_FILENO);
  };
  direct(to_file);
  std::printf("before;");
  const Solid once = fill(samples::geodesic_sphere(4));
  const std::string crossing = message_of([] {
    fill(together(samples::geodesic_sphere(4), samples::geodesic_sphere(4), {0.5, 0.3, 0.2}));
  });
  std::printf("behind");
  direct(kept);
  ::close(to_file);
  ::close(kept);
  CHECK(io_testing::bytes_of(file) == "before;behind");
  CHECK(crossing.find("intersect") != crossing.npos);

  const Solid again = fill(samples::geodesic_sphere(4));
  CHECK(once.positions == again.positions);
  CHECK(once.tets == again.tets);
}

using Catch::Contains;

namespace {

std::string complaint_of(const Shape& surface) {
  return message_of([&] { fill(surface); });
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
    CHECK(starts(message_of([&] {
                   fill(cube(), {}, {{0.5, x, 0.5}});
                 }),
                 "hole 0: a coordinate is not finite"));
  }
}

TEST_CASE("a surface without inside is refused") {
  Shape flat = cube();
  for (Point& p : flat.points) p[2] = 0.001 * p[0];
  CHECK_FALSE(complaint_of(flat).empty());
  CHECK(message_of([] {
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

}  // namespace tetrahedralize_test
