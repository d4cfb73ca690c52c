#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

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
  const std::string crossing = complaint([] {
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

}  // namespace tetrahedralize_test
