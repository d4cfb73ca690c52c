#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "complexes/test_meshes.hpp"
#include "labels/straight_lines.hpp"
#include "windows/windows_solving.hpp"

using namespace plexway;
using namespace plexway::detail;
using namespace plexway::testing;

// Several sources, of which one may be the nearer in the middle of an edge alone.
namespace {

Position place(const Surface& s, const PointSource& p) {
  if (p.vertex != none) return s.positions[p.vertex];
  Position at = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      at[k] += p.barycentric[i] * s.positions[s.faces[p.simplex][i]][k];
  return at;
}

double apart(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace

TEMPLATE_TEST_CASE("sources inside triangles with offsets, in the plane", "", float, double) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const Surface s = random_polygon(5 + seed % 7, 20 + seed % 40, 30, seed);
    std::vector<PointSource> sources;
    for (unsigned k = 0; k < 2 + seed % 4; ++k) {
      const double a = .05 + uniform(random), b = .05 + uniform(random), c = .05 + uniform(random);
      PointSource source = PointSource::in(below(random, s.faces.size()),
                                           {a / (a + b + c), b / (a + b + c), c / (a + b + c)});
      if (k % 2) source = PointSource::at(below(random, s.positions.size()));
      source.offset = .5 * uniform(random);
      sources.push_back(source);
    }
    const TriangleMesh<TestType> mesh(s.positions, s.faces);
    for (const Accuracy accuracy : window_accuracies) {
      const auto found = solve_windows(mesh, sources, accuracy);
      for (Index v = 0; v < s.positions.size(); ++v) {
        double least = std::numeric_limits<double>::infinity();
        for (const PointSource& p : sources)
          least = std::min(least, p.offset + apart(s.positions[v], place(s, p)));
        CAPTURE(seed, v, name(accuracy));
        const double within = accuracy != Accuracy::exact()     ? 2e-3
                              : std::is_same_v<TestType, float> ? 1e-5
                                                                : 1e-11;
        CHECK(found[v] == Approx(least).epsilon(within).margin(1e-6));
      }
    }
  }
}

TEST_CASE("straight lines from many sources are those from the nearest") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const double flat = seed % 2;
    const auto anywhere = [&] {
      return Position{uniform(random), uniform(random), flat * uniform(random)};
    };
    std::vector<SourcePlace> places(1 + 13 * seed);
    for (SourcePlace& place : places) place = {anywhere(), seed % 3 ? .3 * uniform(random) : 0};
    std::vector<Position> vertices(200);
    for (Position& p : vertices) p = anywhere();
    // What is not known stops nobody.
    if (seed % 5 == 4) {
      places[seed].at[1] = std::numeric_limits<double>::quiet_NaN();
      vertices[7][0] = std::numeric_limits<double>::quiet_NaN();
    }
    const StraightLines<double> lines(vertices, places);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const auto line = [&](const SourcePlace& p) {
        const double straight = apart(vertices[v], p.at);
        return p.sigma + (straight > 0 ? straight : 0);
      };
      const Index own = below(random, places.size());
      const double d = line(places[own]) * (.5 + uniform(random));
      double least = std::numeric_limits<double>::infinity();
      for (const SourcePlace& p : places) least = std::min(least, line(p));
      CAPTURE(seed, v, own);
      const bool known = apart(vertices[v], places[own].at) >= 0;  // NaN is not
      const bool is_below = known && d < line(places[own]) * (1 - 1e-12);
      CHECK(lines.raised(v, d, own) == Approx(is_below ? std::max(d, least) : d).epsilon(1e-12));
    }
  }
}
