#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"

namespace any_testing {

using namespace plexway;
using namespace plexway::testing;

inline constexpr double inf = std::numeric_limits<double>::infinity();

/// A convex domain of a kind, straight lines or bars, and where its vertices are.
struct Kind {
  AnyShape shape;
  std::vector<Position> places;

  [[nodiscard]] double distance(const Position& a, const Position& b) const {
    const double x = std::abs(a[0] - b[0]), y = std::abs(a[1] - b[1]);
    return shape.kind() == DomainKind::wireframe ? x + y : std::hypot(x, y, a[2] - b[2]);
  }
  [[nodiscard]] double from_first(std::size_t v) const { return distance(places[0], places[v]); }
  [[nodiscard]] Position place(const PointSource& p) const {
    if (p.vertex != none) return places[p.vertex];
    Position at{};
    const auto corners = shape.corners(p.simplex);
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += p.barycentric[i] * places[corners[i]][k];
    return at;
  }
};

inline std::vector<Kind> all_kinds() {
  std::vector<Kind> all;
  const Surface square = grid(10, 10);
  all.push_back({AnyShape::surface(square.positions, square.faces), square.positions});
  const Solid cube = solid_cube(4);
  all.push_back({AnyShape::solid(cube.positions, cube.tets), cube.positions});
  std::vector<Position> points;
  std::vector<std::array<Index, 2>> bars;
  for (Index v = 0; v < 100; ++v) {
    points.push_back({0.1 * (v % 10), 0.1 * (v / 10), 0});
    if (v % 10 > 0) bars.push_back({v - 1, v});
    if (v >= 10) bars.push_back({v - 10, v});
  }
  all.push_back({AnyShape::wireframe(points, bars), points});
  const KuhnGrid<2> kuhn({8, 8}, {0.1, 0.1});
  SimplexShape simplices{.dimension = 2, .axes = 2};
  simplices.positions = kuhn.positions();
  simplices.vertices = kuhn.vertex_count();
  for (const auto& s : kuhn.simplices())
    simplices.corners.insert(simplices.corners.end(), s.begin(), s.end());
  std::vector<Position> flat;
  for (Index v = 0; v < kuhn.vertex_count(); ++v)
    flat.push_back({kuhn.position(v)[0], kuhn.position(v)[1], 0});
  all.push_back({AnyShape::simplices(simplices), flat});
  MixedShape mixed;
  for (const double from : {0., 1.}) {
    mixed.parts.push_back(
        {.first_vertex = mixed.positions.size(), .vertices = square.positions.size()});
    for (Position p : square.positions) p[0] += from, mixed.positions.push_back(p);
    for (auto f : square.faces) {
      for (Index& v : f) v += static_cast<Index>(mixed.parts.back().first_vertex);
      mixed.parts.back().triangles.push_back(f);
    }
  }
  mixed.tolerance = 1e-9;
  all.push_back({AnyShape::mixed(mixed), mixed.positions});
  try {
    io::Points cloud;
    cloud.positions = points;
    all.push_back({AnyShape::cloud(cloud), points});
  } catch (const NotBuiltError&) {
    WARN("no clouds in this build");
  }
  return all;
}

inline AnyDomain exactly(const Kind& kind, BuildOptions options = {}) {
  options.precision = Precision::float64;
  return AnyDomain(kind.shape, options);
}

/// Every vertex against the closed form: `scale` times it, unreached where `open` is false.
inline void check_field(const Kind& kind, const AnyField& field, double scale = 1,
                        const std::function<bool(const Position&)>& open = {}) {
  for (std::size_t v = 0; v < kind.places.size(); ++v) {
    const bool reached = !open || open(kind.places[v]);
    INFO("vertex " << v);
    CHECK(field[v] ==
          (reached ? Approx(scale * kind.from_first(v)).epsilon(1e-6).margin(1e-9) : Approx(inf)));
  }
}

/// Inside of a simplex, away from the source.
inline PointSource inside(const Kind& kind) {
  PointSource at{.simplex = static_cast<Index>(kind.shape.simplices() * 2 / 3)};
  const std::size_t corners = kind.shape.corners(at.simplex).size();
  for (std::size_t i = 0; i < corners; ++i)
    at.barycentric[i] = (i == 0 ? 0.75 : 0.25 / static_cast<double>(corners - 1));
  return at;
}

/// Does it, or throws the sentence, after the name of a file where one is written. `use` asks
/// outside of a CHECK first.
inline void check(const Kind& kind, Purpose purpose, const std::function<void()>& use) {
  const Support found = support(purpose, kind.shape.kind());
  INFO(kind_name(kind.shape.kind()) << ", purpose " << static_cast<int>(purpose));
  if (found)
    use();
  else
    CHECK_THROWS_WITH(use(), Catch::Matchers::EndsWith(found.sentence()));
}

}  // namespace any_testing
