#include "shape/info/error_classes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>

#include <plexway/support.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::detail {
namespace {

using Vector = Point3;

// Longest edge to least height: 1.15 for an equilateral triangle, 1.22 for a regular tetrahedron.
double aspect(std::span<const Vector> p) {
  double longest = 0, base = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, norm(minus(p[i], p[j])));
  if (p.size() == 3) return longest * longest / norm(cross(minus(p[1], p[0]), minus(p[2], p[0])));
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
    base = std::max(base, norm(cross(minus(b, a), minus(c, a))));
  }
  const Vector side = cross(minus(p[1], p[0]), minus(p[2], p[0]));
  return longest * base / std::abs(dot(side, minus(p[3], p[0])));
}

constexpr std::array<const char*, 6> split_names = {"sign",  "place",     "cut locus",
                                                    "shape", "curvature", "sight"};
constexpr std::array<double, 3> aspects = {4, 10, 50};
constexpr double slight = 0.01, strong = 0.3;                     // radians
constexpr std::array<double, 4> detours = {1e-9, .003, .02, .1};  // beyond the straight line
constexpr double rounding = 1e-6;
constexpr double near_edges = 5;     // "near the source": so many mean edges
constexpr double least_slope = 0.9;  // fronts meet where the exact distance rises less

}  // namespace

ErrorClasses::ErrorClasses(const AnyShape& domain)
    : domain_(domain), solid_(domain.kind() == DomainKind::solid) {
  support(Purpose::error_classes, domain.kind()).require();
  const auto points = domain.positions();
  const std::size_t vertices = domain.vertices(), corners = solid_ ? 4 : 3;
  shape_.assign(vertices, 0);
  curvature_.assign(vertices, 0);
  ridge_.assign(vertices, 0);
  std::vector<double> angle(vertices, 0);
  std::map<std::array<std::uint32_t, 3>, int> facets;
  double edges = 0;
  for (std::size_t s = 0; s < domain.simplices(); ++s) {
    const auto c = domain.corners(s);
    std::array<Vector, 4> p;
    for (std::size_t i = 0; i < corners; ++i) p[i] = points[c[i]];
    const double form = aspect({p.data(), corners});
    unsigned char part = 3;  // also where it is not finite
    for (std::size_t i = aspects.size(); i-- > 0;)
      if (form < aspects[i]) part = static_cast<unsigned char>(i);
    for (std::size_t i = 0; i < corners; ++i) {
      shape_[c[i]] = std::max(shape_[c[i]], part);
      const std::size_t j = (i + 1) % corners, k = (i + 2) % corners;
      edges += norm(minus(p[i], p[j]));
      const Vector a = minus(p[j], p[i]), b = minus(p[k], p[i]);
      if (!solid_) angle[c[i]] += std::atan2(norm(cross(a, b)), dot(a, b));
      std::array<std::uint32_t, 3> facet = {c[i], c[j], solid_ ? c[k] : none};
      std::sort(facet.begin(), facet.end());
      ++facets[facet];
    }
  }
  mean_edge_ = edges / static_cast<double>(std::max<std::size_t>(1, domain.simplices() * corners));
  for (std::size_t v = 0; v < vertices; ++v) {
    const double excess = solid_ ? 0 : angle[v] - 2 * std::numbers::pi;
    curvature_[v] = excess > strong     ? 0
                    : excess > slight   ? 1
                    : excess >= -slight ? 2
                    : excess >= -strong ? 3
                                        : 4;
  }
  for (const auto& [facet, count] : facets)
    if (count == 1)
      for (const std::uint32_t v : facet)
        if (v != none) curvature_[v] = 5;
}

// How fast the truth rises within a simplex, from its values at the corners: 1 in a plain front.
double ErrorClasses::slope(std::size_t simplex, std::span<const double> truth) const {
  const auto c = domain_.corners(simplex);
  const auto points = domain_.positions();
  // Gram-Schmidt: along each new direction the rest of the rise is the gradient's component.
  std::array<Vector, 3> axis;
  std::array<double, 3> rise{};
  const std::size_t dimension = c.size() - 1;
  double sum = 0;
  for (std::size_t i = 0; i < dimension; ++i) {
    Vector e = minus(points[c[i + 1]], points[c[0]]);
    double d = truth[c[i + 1]] - truth[c[0]];
    for (std::size_t j = 0; j < i; ++j) {
      const double along = dot(e, axis[j]);
      for (std::size_t k = 0; k < 3; ++k) e[k] -= along * axis[j][k];
      d -= along * rise[j];
    }
    const double length = norm(e);
    for (std::size_t k = 0; k < 3; ++k) axis[i][k] = e[k] / length;
    rise[i] = d / length;
    sum += rise[i] * rise[i];
  }
  return std::sqrt(sum);
}

void ErrorClasses::count(std::size_t split, std::size_t part, double error) {
  Sum& sum = sum_[split][part];
  ++sum.vertices;
  (error > 0 ? sum.above : sum.below) += error;
}

void ErrorClasses::add(std::span<const double> distance, std::span<const double> truth,
                       const Vector& source) {
  const auto points = domain_.positions();
  std::fill(ridge_.begin(), ridge_.end(), static_cast<unsigned char>(0));
  for (std::size_t s = 0; s < domain_.simplices(); ++s) {
    const auto c = domain_.corners(s);
    const bool near = std::any_of(
        c.begin(), c.end(), [&](std::uint32_t v) { return !(truth[v] > near_edges * mean_edge_); });
    if (!near && slope(s, truth) < least_slope)
      for (const std::uint32_t v : c) ridge_[v] = 1;
  }
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0) || !std::isfinite(truth[v]) || !std::isfinite(distance[v])) continue;
    const double error = distance[v] / truth[v] - 1;
    count(0, error > rounding ? 0 : error < -rounding ? 1 : 2, error);
    count(1, truth[v] < near_edges * mean_edge_ ? 0 : 1, error);
    count(2, ridge_[v] != 0 ? 0 : 1, error);
    count(3, shape_[v], error);
    count(4, curvature_[v], error);
    if (!solid_) continue;
    const double detour = truth[v] / norm(minus(points[v], source)) - 1;
    std::size_t part = 0;
    while (part < detours.size() && !(detour < detours[part])) ++part;
    count(5, part, error);
  }
}

std::string ErrorClasses::class_name(std::size_t split, std::size_t part) const {
  static constexpr std::array<std::array<const char*, most_classes>, splits> names = {
      {{"above exact", "below exact", "within 1e-6", "", "", ""},
       {"within 5 edges of the source", "farther", "", "", "", ""},
       {"where fronts meet", "elsewhere", "", "", "", ""},
       {"aspect below 4", "4 to 10", "10 to 50", "50 and more", "", ""},
       {"saddle, over 0.3", "saddle, 0.01 to 0.3", "flat", "bowl, 0.01 to 0.3", "bowl, over 0.3",
        "on the boundary"},
       {"in sight", "detour below 0.3 %", "0.3 to 2 %", "2 to 10 %", "10 % and more", ""}}};
  if (solid_ && split == 4 && part == 2) return "inside";
  return names[split][part];
}

Json ErrorClasses::json() const {
  Json list = Json::array();
  for (std::size_t split = 0; split < splits; ++split) {
    double all = 0;
    for (const Sum& sum : sum_[split]) all += sum.above - sum.below;
    for (std::size_t part = 0; part < most_classes; ++part) {
      const Sum& sum = sum_[split][part];
      if (sum.vertices == 0) continue;
      const double count = static_cast<double>(sum.vertices);
      list.push_back({{"split", split_names[split]},
                      {"class", class_name(split, part)},
                      {"vertices", sum.vertices},
                      {"mean", json_number((sum.above - sum.below) / count)},
                      {"above", json_number(sum.above / count)},
                      {"below", json_number(-sum.below / count)},
                      {"share", json_number(all > 0 ? (sum.above - sum.below) / all : 0)}});
    }
  }
  return list;
}

std::string ErrorClasses::text() const {
  // JSON has no infinity and no NaN.
  const auto number = [](const Json& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  std::string text;
  char line[160];
  std::snprintf(line, sizeof line, "%-10s %-29s %10s %9s %9s %9s %7s\n", "split", "class",
                "vertices", "mean", "above", "below", "share");
  text += line;
  for (const Json& row : json()) {
    std::snprintf(line, sizeof line, "%-10s %-29s %10zu %9.2e %9.2e %9.2e %5.1f %%\n",
                  row["split"].get<std::string>().c_str(), row["class"].get<std::string>().c_str(),
                  row["vertices"].get<std::size_t>(), number(row["mean"]), number(row["above"]),
                  number(row["below"]), 100 * number(row["share"]));
    text += line;
  }
  return text;
}

}  // namespace plexway::detail
