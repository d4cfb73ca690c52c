#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "surface_check.hpp"

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

namespace {

// Calls `take` with each line of `text`, without a copy of the text.
template <class Take>
void for_each_line(const std::string& text, Take take) {
  for (std::size_t from = 0; from < text.size();) {
    std::size_t end = text.find('\n', from);
    if (end == text.npos) return;  // cut off
    take(text.substr(from, end - from));
    from = end + 1;
  }
}

// Pairs of facets, counted from 0, that the diagnosis says touch where they must not.
struct Clashes {
  std::pair<int, int> first = {-1, -1};
  bool duplicates = false;  // the first pair covers the same triangle
  std::set<std::pair<int, int>> all;
};

Clashes clashes_in(const std::string& said) {
  Clashes clashes;
  for_each_line(said, [&](const std::string& line) {
    int a = 0, b = 0;
    const bool crosses = std::sscanf(line.c_str(), " Facet #%d intersects facet #%d", &a, &b) == 2;
    if (!crosses && std::sscanf(line.c_str(), " Facet #%d duplicates facet #%d", &a, &b) != 2)
      return;
    const auto pair = std::minmax({a - 1, b - 1});
    if (clashes.all.empty()) {
      clashes.first = pair;
      clashes.duplicates = !crosses;
    }
    clashes.all.insert(pair);
  });
  return clashes;
}

// Two vertices that TetGen took for one, though they are not in the same place.
std::pair<int, int> merged_in(const std::string& said) {
  std::pair<int, int> merged = {-1, -1};
  for_each_line(said, [&](const std::string& line) {
    int a = 0, b = 0;
    if (merged.first < 0 &&
        std::sscanf(line.c_str(), "Warning: Point %d is replaced by point %d", &a, &b) == 2)
      merged = std::minmax({a, b});
  });
  return merged;
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

void give_reason(const Run& run, const Run& diagnosis, const std::string& facet) {
  if (run.ending == Ending::out_of_memory) throw std::bad_alloc();
  if (run.ending == Ending::killed)
    throw Error(std::string("the program ") + helper_name + ", which fills solids, " + run.how);
  if (run.ending == Ending::cancelled || diagnosis.ending == Ending::cancelled)
    throw Cancelled("TetGen was stopped");
  const Clashes clashes = clashes_in(diagnosis.said);
  if (!clashes.all.empty()) {
    const bool only_part = diagnosis.ending != Ending::done;
    std::string message = facet + "s " + std::to_string(clashes.first.first) + " and " +
                          std::to_string(clashes.first.second) +
                          (clashes.duplicates ? " lie on each other" : " intersect");
    message += ", " + plural(clashes.all.size(), "pair") + (only_part ? " or more" : "") +
               " in all: the boundary must not cross or cover itself";
    throw InputError(message);
  }
  if (run.ending == Ending::out_of_time)
    throw Error(
        "TetGen was stopped at the time limit; allow more, keep the surface as it is, or ask "
        "for less quality");
  for (const std::string* said : {&run.said, &diagnosis.said}) {
    const auto [a, b] = merged_in(*said);
    if (a >= 0) {
      throw InputError(
          "vertices " + std::to_string(a) + " and " + std::to_string(b) +
          " are too close to be distinguished (1e-8 of the solid's size), and the boundary "
          "is not sound if they are one: merge them first");
    }
  }
  switch (run.ending) {
    case Ending::done:
      throw InputError("the boundary encloses no volume that is not a hole");
    case Ending::self_intersection:
      throw InputError("the boundary intersects itself; TetGen does not say where");
    case Ending::tiny_feature:
      throw InputError(
          "the boundary has a feature too small for TetGen: merge vertices that are "
          "very close");
    case Ending::close_facets:
      throw InputError("two " + facet +
                       "s of the boundary nearly lie on each other; with keep_surface "
                       "TetGen may succeed");
    case Ending::input_error:
      throw InputError("TetGen does not accept this input, and does not say why");
    default:
      throw InputError(
          "TetGen gives up on this boundary; it may be flat, nearly cross itself, or "
          "have parts that nearly touch");
  }
}

}  // namespace plexway::tetgen
