#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include <plexway/solve.hpp>

#include "data/mixed_pieces.hpp"

/// Mixed domains whose distances are known.
namespace mixed_domains {

using namespace plexway;
using namespace samples;
constexpr double infinity = never;

/// A domain under construction, with the positions that the answers are computed from.
struct Welded {
  explicit Welded(unsigned seed) : move(motion(seed)) {}

  Motion move;
  MixedComplex<double> complex;
  std::vector<Position> positions;
  using Piece = MixedComplex<double>::Piece;

  /// A piece on which paths run at `speed`.
  template <class Shape>
  Piece add(const Shape& shape, double speed = 1) {
    std::vector<Position> moved, timed;
    for (const Position& p : shape.positions) {
      moved.push_back(move(p));
      timed.push_back(moved.back());
      for (double& x : timed.back()) x /= speed;
    }
    positions.insert(positions.end(), shape.positions.begin(), shape.positions.end());
    if constexpr (requires { shape.tets; })
      return complex.add(TetMesh<double>(timed, shape.tets), moved);
    else if constexpr (requires { shape.faces; })
      return complex.add(TriangleMesh<double>(timed, shape.faces), moved);
    else
      return complex.add(Wireframe<double>(timed, shape.edges), moved);
  }
  std::size_t weld(const Piece& a, const Piece& b) {
    return complex.weld(a, b, {.tolerance = 1e-6 * move.scale});
  }
  Index nearest(const Piece& piece, const Position& p) const {
    Index best = piece.first_vertex;
    for (Index v = piece.first_vertex; v < piece.first_vertex + piece.vertices; ++v)
      if (distance(positions[v], p) < distance(positions[best], p)) best = v;
    REQUIRE(distance(positions[best], p) < 1e-12);
    return best;
  }
  /// Greatest error over all vertices, relative to the exact distance or to 1.
  double worst(Index source, const std::function<double(Index)>& exact,
               const PropagateOptions& options = {}) const {
    const auto field = solve(Serial{}, complex, PointSource::at(source), options);
    REQUIRE(field.distance.size() == positions.size());
    double worst = 0;
    for (Index v = 0; v < positions.size(); ++v) {
      const double d = field.distance[v] / move.scale, e = exact(v);
      CAPTURE(v, positions[v][0], positions[v][1], positions[v][2], d, e);
      if (e == infinity || d == infinity) {
        CHECK(d == e);
        continue;
      }
      const double error = std::abs(d - e) / std::max(e, 1.);
      if (error > 1e-3) CHECK(d == Approx(e));
      worst = std::max(worst, error);
    }
    return worst;
  }
  static bool of(const Piece& piece, Index v) {
    return v >= piece.first_vertex && v - piece.first_vertex < piece.vertices;
  }
};

/// What a field is off the truth, as a share of it; `low`: the most that it falls short.
struct Errors {
  double mean = 0, worst = 0, low = 0;
};
template <class E = Serial>
Errors errors(const Welded& domain, Index source, const std::function<double(Index)>& exact,
              const E& executor = {}) {
  const auto field = solve(executor, domain.complex, PointSource::at(source));
  Errors e;
  for (Index v = 0; v < domain.positions.size(); ++v) {
    const double truth = exact(v);
    if (truth < 1e-12) continue;
    const double off = (field.distance[v] / domain.move.scale - truth) / truth;
    e.mean += std::abs(off) / double(domain.positions.size());
    e.worst = std::max(e.worst, std::abs(off));
    e.low = std::min(e.low, off);
  }
  return e;
}

}  // namespace mixed_domains
