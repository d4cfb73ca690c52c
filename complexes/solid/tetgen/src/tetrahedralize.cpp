#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/tetgen/tetrahedralize.hpp>

#include "isolated_run.hpp"
#include "surface_check.hpp"

namespace plexway::tetgen {
namespace {

using Point = std::array<double, 3>;

void require_bound(double value, double least, const char* what) {
  if (value == 0 || (value > least && std::isfinite(value))) return;
  throw UsageError(std::string(what) + " must be 0, for none, or a number above " +
                   (least > 0 ? "1" : "0"));
}

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

// The volume bound for a solid that is `scale` times as large; 0 for none.
double check(const TetrahedralizeOptions& options, double scale) {
  require_bound(options.max_volume, 0, "max_volume");
  require_bound(options.max_radius_edge, 1, "max_radius_edge");
  require_bound(options.max_seconds, 0, "max_seconds");
  const double bound = options.max_volume * scale * scale * scale;
  if (options.max_volume > 0 && !(bound > 1e-30))
    throw UsageError("max_volume is too small for a solid of this size");
  return bound;
}

// p: a piecewise linear complex; z: count from 0; J: keep the numbers of the input's points.
std::string switches_for(const PiecewiseLinearComplex& complex,
                         const TetrahedralizeOptions& options, double max_volume) {
  std::string switches = "pzJ";
  if (options.keep_surface) switches += "Y";
  if (options.quality) {
    switches += "q";
    if (options.max_radius_edge > 0) switches += text(options.max_radius_edge);
  }
  if (!complex.regions.empty()) switches += "A";
  const bool own_bounds = std::any_of(complex.regions.begin(), complex.regions.end(),
                                      [](const auto& region) { return region.max_volume > 0; });
  if (own_bounds) switches += "a";
  if (max_volume > 0 && std::isfinite(max_volume)) switches.append("a").append(text(max_volume));
  return switches;
}

// A power of two that brings the coordinates near 1: exact, and their cubes stay in range.
double scale_of(const std::vector<Point>& positions) {
  double largest = 0;
  for (const Point& p : positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  return largest > 0 ? std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1000, 1000)) : 1;
}

void multiply(std::span<Point> points, double scale) {
  for (Point& p : points)
    for (double& x : p) x *= scale;
}

PiecewiseLinearComplex scaled(const PiecewiseLinearComplex& complex, double scale) {
  PiecewiseLinearComplex copy = complex;
  multiply(copy.positions, scale);
  multiply(copy.holes, scale);
  for (auto& facet : copy.facets) multiply(facet.holes, scale);
  for (auto& region : copy.regions) {
    for (double& x : region.point) x *= scale;
    region.max_volume *= scale * scale * scale;
  }
  return copy;
}

double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  Point u, v, w;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
         (u[0] * v[1] - u[1] * v[0]) * w[2];
}

// Points that were added and then given up by TetGen are dropped; the input's own all stay.
Solid solid_of(Run&& run, const std::vector<Point>& positions) {
  if (run.points.size() < positions.size())
    throw Error("TetGen lost points of the input, which it should not");
  Solid solid;
  std::vector<Index> renumbered(run.points.size(), none);
  solid.positions = positions;
  for (std::size_t v = 0; v < positions.size(); ++v) renumbered[v] = static_cast<Index>(v);
  solid.tets.reserve(run.tets.size());
  for (const auto& tet : run.tets) {
    std::array<Index, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = static_cast<std::size_t>(tet[i]);
      if (v >= run.points.size()) throw Error("TetGen answered with a vertex that is not there");
      if (renumbered[v] == none) {
        renumbered[v] = static_cast<Index>(solid.positions.size());
        solid.positions.push_back(run.points[v]);
      }
      corners[i] = renumbered[v];
    }
    const auto& p = run.points;
    if (volume(p[static_cast<std::size_t>(tet[0])], p[static_cast<std::size_t>(tet[1])],
               p[static_cast<std::size_t>(tet[2])], p[static_cast<std::size_t>(tet[3])]) < 0)
      std::swap(corners[2], corners[3]);
    solid.tets.push_back(corners);
  }
  solid.regions = std::move(run.attributes);
  return solid;
}

// How many times larger the largest tetrahedron is than its bound, or 1.
double excess(const Solid& solid, const PiecewiseLinearComplex& complex, double max_volume) {
  std::map<double, double> bound_of_region;
  for (const auto& region : complex.regions)
    if (region.max_volume > 0) bound_of_region[region.attribute] = region.max_volume;
  double worst = 1;
  for (std::size_t t = 0; t < solid.tets.size(); ++t) {
    double bound = max_volume > 0 ? max_volume : std::numeric_limits<double>::infinity();
    if (t < solid.regions.size()) {
      const auto own = bound_of_region.find(solid.regions[t]);
      if (own != bound_of_region.end()) bound = std::min(bound, own->second);
    }
    const auto& [a, b, c, d] = solid.tets[t];
    const auto& p = solid.positions;
    worst = std::max(worst, volume(p[a], p[b], p[c], p[d]) / 6 / bound);
  }
  return worst;
}

// `facet` is what messages call one.
Solid fill(const PiecewiseLinearComplex& complex, const TetrahedralizeOptions& options,
           const char* facet) {
  const double scale = scale_of(complex.positions);
  PiecewiseLinearComplex work = scaled(complex, scale);
  double max_volume = check(options, scale);
  const double wanted = max_volume;
  const PiecewiseLinearComplex bounded = work;
  // TetGen smooths at the end, and tetrahedra may grow over their bound by that.
  for (int attempt = 0;; ++attempt) {
    Run run = run_isolated(work, switches_for(work, options, max_volume),
                           {.seconds = options.max_seconds, .go_on = options.go_on});
    if (run.ending != Ending::done || run.tets.empty()) {
      // TetGen's search for what crosses takes less time than filling, but may not end.
      Patience patience = {.seconds = 20, .until_it_talks = true, .go_on = options.go_on};
      if (run.ending == Ending::out_of_time)
        patience.seconds = std::min(patience.seconds, options.max_seconds);
      Run diagnosis;
      if (run.ending != Ending::cancelled && run.ending != Ending::killed)
        diagnosis = run_isolated(work, "pzd", patience);
      give_reason(run, diagnosis, facet);
    }
    Solid solid = solid_of(std::move(run), work.positions);
    const double over = excess(solid, bounded, wanted);
    if (over <= 1 + 1e-12 || attempt == 4) {
      std::copy(complex.positions.begin(), complex.positions.end(), solid.positions.begin());
      multiply({solid.positions.begin() + static_cast<std::ptrdiff_t>(complex.positions.size()),
                solid.positions.end()},
               1 / scale);
      return solid;
    }
    const double tighter = 0.95 / over;
    max_volume *= tighter;
    for (auto& region : work.regions) region.max_volume *= tighter;
  }
}

}  // namespace

Solid tetrahedralize(const GivenPoints& positions, const GivenSimplices<3>& triangles,
                     const GivenPoints& holes, const TetrahedralizeOptions& options) {
  require_finite(positions, "vertex");
  const std::vector<Index> welded = weld(positions);
  require_closed(triangles, welded);
  PiecewiseLinearComplex complex;
  complex.positions.assign(positions.begin(), positions.end());
  complex.holes.assign(holes.begin(), holes.end());
  complex.facets.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    complex.facets.push_back({.polygons = {{welded[a], welded[b], welded[c]}}, .holes = {}});
  require_finite(complex.holes, "hole");
  return fill(complex, options, "triangle");
}

Solid tetrahedralize(const PiecewiseLinearComplex& complex, const TetrahedralizeOptions& options) {
  require_sound(complex);
  return fill(complex, options, "facet");
}

}  // namespace plexway::tetgen
