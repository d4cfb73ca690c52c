#include "surface_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <plexway/error.hpp>

namespace plexway::tetgen {
namespace {

// TetGen counts in int, and three times as many points as these must fit.
constexpr std::size_t most = static_cast<std::size_t>(std::numeric_limits<int>::max()) / 4;

std::string number(std::size_t n) { return std::to_string(n); }

void require_index(std::size_t v, std::size_t vertices, const char* what, std::size_t row) {
  if (v < vertices) return;
  throw InputError(std::string(what) + " " + number(row) + " names vertex " + number(v) +
                   ", but there are " + number(vertices));
}

struct Side {
  Index from, to;  // from < to
  Index triangle;
  bool operator<(const Side& other) const {
    return std::array{from, to, triangle} < std::array{other.from, other.to, other.triangle};
  }
};

void require_no_double(const std::vector<std::array<Index, 3>>& corners) {
  std::vector<Index> order(corners.size());
  std::iota(order.begin(), order.end(), Index{0});
  const auto sorted = [&](Index t) {
    auto row = corners[t];
    std::sort(row.begin(), row.end());
    return row;
  };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const auto of_a = sorted(a);
    const auto of_b = sorted(b);
    return of_a != of_b ? of_a < of_b : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (sorted(order[i - 1]) == sorted(order[i]))
      throw InputError("triangles " + number(order[i - 1]) + " and " + number(order[i]) +
                       " have the same corners; leave one out");
  }
}

}  // namespace

void require_finite(std::span<const std::array<double, 3>> points, const char* what) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (const double x : points[v]) {
      if (!std::isfinite(x))
        throw InputError(std::string(what) + " " + number(v) +
                         ": a coordinate is not finite: " + std::to_string(x));
    }
  }
}

std::vector<Index> weld(std::span<const std::array<double, 3>> positions) {
  if (positions.size() > most) throw InputError("more vertices than TetGen can count");
  std::vector<Index> order(positions.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
  });
  std::vector<Index> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i - 1]] == positions[order[i]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

void require_closed(std::span<const std::array<Index, 3>> triangles,
                    const std::vector<Index>& welded) {
  if (triangles.empty()) throw InputError("no triangles: there is no solid to fill");
  if (triangles.size() > most) throw InputError("more triangles than TetGen can count");
  std::vector<std::array<Index, 3>> corners(triangles.begin(), triangles.end());
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (Index& v : corners[t]) {
      require_index(v, welded.size(), "triangle", t);
      v = welded[v];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax(corners[t][i], corners[t][(i + 1) % 3]);
      if (from == to)
        throw InputError("triangle " + number(t) + " has two corners at vertex " + number(from) +
                         "; leave it out");
      sides.push_back({from, to, static_cast<Index>(t)});
    }
  }
  require_no_double(corners);

  std::sort(sides.begin(), sides.end());
  std::size_t open = 0;
  const Side* named = nullptr;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].from == sides[i].from && sides[end].to == sides[i].to)
      ++end;
    if (end == i + 1) {
      if (named == nullptr) named = &sides[i];
      ++open;
    }
    i = end;
  }
  if (open == 0) return;
  throw InputError(
      "the surface is open: " + number(open) + (open == 1 ? " edge has" : " edges have") +
      " only one triangle, such as the edge " + number(named->from) + " - " + number(named->to) +
      " of triangle " + number(named->triangle) + "; close it first");
}

void require_sound(const PiecewiseLinearComplex& complex) {
  if (complex.facets.empty()) throw InputError("no facets: there is no solid to fill");
  if (complex.positions.size() > most || complex.facets.size() > most)
    throw InputError("more vertices or facets than TetGen can count");
  require_finite(complex.positions, "vertex");
  require_finite(complex.holes, "hole");
  for (std::size_t r = 0; r < complex.regions.size(); ++r) {
    const auto& region = complex.regions[r];
    require_finite({&region.point, 1}, ("the point of region " + number(r) + ", row").c_str());
    if (!std::isfinite(region.attribute) || !std::isfinite(region.max_volume))
      throw InputError("region " + number(r) + ": its attribute or volume is not finite");
  }
  for (std::size_t f = 0; f < complex.facets.size(); ++f) {
    const auto& facet = complex.facets[f];
    require_finite(facet.holes, ("facet " + number(f) + ", hole").c_str());
    if (facet.polygons.empty()) throw InputError("facet " + number(f) + " has no polygon");
    for (const auto& polygon : facet.polygons) {
      if (polygon.empty())
        throw InputError("facet " + number(f) + " has a polygon without corners");
      for (const Index v : polygon) require_index(v, complex.positions.size(), "facet", f);
    }
  }
}

}  // namespace plexway::tetgen
