#include "closing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include <plexway/error.hpp>

namespace plexway::openvdb {
namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>;

// Above this share of its area in fans, a part is a sheet: half a sphere has 0.5, an open box 0.2.
constexpr double sheet_share = 0.6;

double area(const Point& a, const Point& b, const Point& c) {
  Point u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]);
}

// Corners on a line, as far as coordinates can tell.
bool is_collinear(const Point& a, const Point& b, const Point& c) {
  double reach = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    reach = std::max({reach, std::abs(a[k]), std::abs(b[k]), std::abs(c[k])});
  for (const auto& [p, q] : {std::pair{&a, &b}, {&b, &c}, {&c, &a}})
    longest =
        std::max(longest, std::hypot((*p)[0] - (*q)[0], (*p)[1] - (*q)[1], (*p)[2] - (*q)[2]));
  return area(a, b, c) <= 8 * std::numeric_limits<double>::epsilon() * reach * longest;
}

class Parts {
 public:
  explicit Parts(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), Index{0}); }
  Index of(Index v) {
    while (up_[v] != v) v = up_[v] = up_[up_[v]];
    return v;
  }
  void join(Index a, Index b) { up_[of(a)] = of(b); }

 private:
  std::vector<Index> up_;
};

void require_sound(std::span<const Point> positions, std::span<const Triangle> triangles) {
  if (triangles.empty()) throw InputError("no triangles: there is no surface");
  if (positions.size() >= none / 2) throw InputError("too many vertices");
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const double x : positions[v])
      if (!std::isfinite(x))
        throw InputError("vertex " + std::to_string(v) + ": a coordinate is not finite");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Index v : triangles[t])
      if (v >= positions.size())
        throw InputError("triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                         ", but there are " + std::to_string(positions.size()));
}

// The first vertex at the place of each.
std::vector<Index> welded(std::span<const Point> positions) {
  std::vector<Index> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i - 1]] == positions[order[i]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<Triangle> distinct(std::span<const Point> positions,
                               std::span<const Triangle> triangles, Repair& report) {
  const std::vector<Index> first = welded(positions);
  struct Entry {
    Triangle sorted, given;
  };
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Triangle given = {first[t[0]], first[t[1]], first[t[2]]};
    Triangle sorted = given;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2])
      ++report.degenerate;
    else
      entries.push_back({sorted, given});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.given < b.given;
  });
  std::vector<Triangle> kept;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && entries[i - 1].sorted == entries[i].sorted)
      ++report.doubled;
    else
      kept.push_back(entries[i].given);
  }
  return kept;
}

using Edge = std::array<Index, 2>;

std::vector<Edge> odd_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> odd;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if ((end - i) % 2 == 1) odd.push_back(edges[i]);
    i = end;
  }
  return odd;
}

// Triangles without area may be stitches, where a vertex of one side lies on an edge of the other,
// or lie on a surface that is closed without them. Takes those away that leave fewer open edges.
void drop_surplus(std::vector<Triangle>& triangles, const std::vector<char>& collinear,
                  const std::vector<Edge>& odd) {
  std::set<Edge> open(odd.begin(), odd.end());
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (collinear[t] != 0) {
      std::array<Edge, 3> sides;
      for (std::size_t i = 0; i < 3; ++i)
        sides[i] = {std::min(triangles[t][i], triangles[t][(i + 1) % 3]),
                    std::max(triangles[t][i], triangles[t][(i + 1) % 3])};
      const auto is_open = [&](const Edge& e) { return open.count(e) > 0; };
      if (std::count_if(sides.begin(), sides.end(), is_open) >= 2) {
        for (const Edge& e : sides)
          if (!open.erase(e)) open.insert(e);
        continue;
      }
    }
    triangles[kept++] = triangles[t];
  }
  triangles.resize(kept);
}

// Edges that hang together, their middle and how far they reach.
struct Rim {
  Point middle = {0, 0, 0};
  double length = 0;
  double fan_area = 0;
  Point low, high;
  Index part = none;
  Index centre = none;
};

struct Rims {
  std::vector<Rim> rims;
  std::vector<Index> of_edge;
};

Rims rims_of(const std::vector<Edge>& odd, std::span<const Point> positions, Parts& parts) {
  Parts loops(positions.size());
  for (const Edge& e : odd) loops.join(e[0], e[1]);
  Rims found;
  std::vector<Index> number(positions.size(), none);
  constexpr double far = std::numeric_limits<double>::infinity();
  for (const Edge& e : odd) {
    Index& rim = number[loops.of(e[0])];
    if (rim == none) {
      rim = static_cast<Index>(found.rims.size());
      found.rims.push_back({});
      found.rims.back().low.fill(far);
      found.rims.back().high.fill(-far);
      found.rims.back().part = parts.of(e[0]);
    }
    found.of_edge.push_back(rim);
    Rim& it = found.rims[rim];
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k)
      squared += std::pow(positions[e[1]][k] - positions[e[0]][k], 2);
    it.length += std::sqrt(squared);
    for (std::size_t k = 0; k < 3; ++k) {
      it.middle[k] += std::sqrt(squared) * 0.5 * (positions[e[0]][k] + positions[e[1]][k]);
      for (const Index v : e) {
        it.low[k] = std::min(it.low[k], positions[v][k]);
        it.high[k] = std::max(it.high[k], positions[v][k]);
      }
    }
  }
  for (Rim& rim : found.rims)
    for (double& x : rim.middle) x /= rim.length;
  for (std::size_t i = 0; i < odd.size(); ++i) {
    Rim& rim = found.rims[found.of_edge[i]];
    rim.fan_area += area(positions[odd[i][0]], positions[odd[i][1]], rim.middle);
  }
  return found;
}

}  // namespace

ClosedSurface close_surface(std::span<const Point> positions, std::span<const Triangle> triangles,
                            Repair& report) {
  require_sound(positions, triangles);
  std::vector<Triangle> kept = distinct(positions, triangles, report);
  const auto is_flat = [&](const Triangle& t) {
    return is_collinear(positions[t[0]], positions[t[1]], positions[t[2]]);
  };
  std::vector<char> collinear(kept.size());
  std::transform(kept.begin(), kept.end(), collinear.begin(), is_flat);
  const auto stitches = std::count(collinear.begin(), collinear.end(), 1);
  report.degenerate += static_cast<std::size_t>(stitches);
  if (stitches > 0) drop_surplus(kept, collinear, odd_edges(kept));
  Parts parts(positions.size());
  for (const Triangle& t : kept) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
  }
  const std::vector<Edge> odd = odd_edges(kept);
  report.open_edges = odd.size();
  Rims rims = rims_of(odd, positions, parts);

  std::vector<double> own(positions.size(), 0), fans(positions.size(), 0);
  for (const Triangle& t : kept)
    own[parts.of(t[0])] += area(positions[t[0]], positions[t[1]], positions[t[2]]);
  for (const Rim& rim : rims.rims) fans[rim.part] += rim.fan_area;
  const auto is_sheet = [&](Index part) { return fans[part] > sheet_share * own[part]; };

  ClosedSurface closed;
  closed.positions.assign(positions.begin(), positions.end());
  std::vector<char> counted(positions.size(), 0);
  for (const Triangle& t : kept) {
    const Index part = parts.of(t[0]);
    if (stitches > 0 && is_flat(t)) continue;  // its neighbours have its edges
    if (!is_sheet(part)) {
      closed.triangles.push_back(t);
      continue;
    }
    ++report.sheet_triangles;
    if (counted[part] == 0) ++report.sheets;
    counted[part] = 1;
  }
  if (closed.triangles.empty()) {
    if (report.sheets == 0) throw InputError("all triangles are without area: nothing is enclosed");
    throw InputError("it encloses nothing: " + std::to_string(odd.size()) +
                     " open edges are the rim of a sheet rather than of holes (closing them would "
                     "take more than "
                     "0.6 of the surface's own area)");
  }
  for (Rim& rim : rims.rims) {
    if (is_sheet(rim.part)) continue;
    ++report.holes;
    report.largest_hole = std::max(
        report.largest_hole,
        std::hypot(rim.high[0] - rim.low[0], rim.high[1] - rim.low[1], rim.high[2] - rim.low[2]));
    rim.centre = static_cast<Index>(closed.positions.size());
    closed.positions.push_back(rim.middle);
  }
  for (std::size_t i = 0; i < odd.size(); ++i) {
    const Rim& rim = rims.rims[rims.of_edge[i]];
    if (rim.centre != none) closed.triangles.push_back({odd[i][0], odd[i][1], rim.centre});
  }
  return closed;
}

std::string Repair::text() const {
  const auto number = [](double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.4g", value);
    return std::string(digits);
  };
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
  };
  std::string said = "voxel " + number(voxel);
  if (holes > 0)
    said += "; " + counted(holes, "hole", "holes") + " closed, " +
            (holes == 1 ? "" : "the largest ") + number(largest_hole) + " across";
  if (doubled > 0)
    said += "; " + counted(doubled, "triangle", "triangles") + " there before left out";
  if (degenerate > 0)
    said += "; " + counted(degenerate, "triangle", "triangles") + " without area left out";
  if (sheets > 0)
    said += "; " + counted(sheets, "open sheet", "open sheets") + " of " +
            counted(sheet_triangles, "triangle", "triangles") + " left out";
  return said;
}

}  // namespace plexway::openvdb
