#include "render/skins.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/field/colours.hpp"

namespace plexway::render {
using namespace detail;
namespace {

constexpr const std::array<Colour, 8>& palette = io::cell_colours;
constexpr float far_away = 1e30f;

double length(const Point& a, const Point& b) {
  const Point d = minus(a, b);
  return std::sqrt(dot(d, d));
}

// The source is d0 and d1 away from a and b: how far it is from v when everything is unfolded into
// the plane, the source and v on different sides of the line through a and b.
double across_line(const Point& a, const Point& b, const Point& v, double d0, double d1) {
  const double edge = length(a, b), to_a = length(a, v), to_b = length(b, v);
  if (!(edge > 0)) return std::min(d0 + to_a, d1 + to_b);
  const double x = (d0 * d0 - d1 * d1 + edge * edge) / (2 * edge);
  const double h = std::sqrt(std::max(0.0, d0 * d0 - x * x));
  const double xv = (to_a * to_a - to_b * to_b + edge * edge) / (2 * edge);
  const double hv = std::sqrt(std::max(0.0, to_a * to_a - xv * xv));
  // Values that are no distances may leave no room in between.
  const double least = std::max(d0 - to_a, d1 - to_b), most = std::min(d0 + to_a, d1 + to_b);
  return std::clamp(std::hypot(xv - x, hv + h), least, std::max(least, most));
}

// The same across the triangle a, b, c.
double across_triangle(const Point& a, const Point& b, const Point& c, const Point& v, double d0,
                       double d1, double d2) {
  const Point x = unit_or_zero(minus(b, a));
  const Point n = unit_or_zero(cross(x, minus(c, a)));
  const Point y = cross(n, x);
  const double bx = dot(minus(b, a), x), cx = dot(minus(c, a), x), cy = dot(minus(c, a), y);
  if (!(bx > 0) || !(cy > 0)) return across_line(a, b, v, d0, d1);
  const double sx = (d0 * d0 - d1 * d1 + bx * bx) / (2 * bx);
  const double sy = (d0 * d0 - d2 * d2 + cx * cx + cy * cy - 2 * sx * cx) / (2 * cy);
  const double h = std::sqrt(std::max(0.0, d0 * d0 - sx * sx - sy * sy));
  const Point to_v = minus(v, a);
  const double far = std::hypot(dot(to_v, x) - sx, dot(to_v, y) - sy, std::abs(dot(to_v, n)) + h);
  const double least = std::max({d0 - length(a, v), d1 - length(b, v), d2 - length(c, v)});
  const double most = std::min({d0 + length(a, v), d1 + length(b, v), d2 + length(c, v)});
  return std::clamp(far, least, std::max(least, most));
}

}  // namespace

std::span<const Colour> cell_palette() { return palette; }

Cells::Cells(const Part& part) : part_(part) {
  for (const auto& t : part.triangles) look_beyond(t);
  for (const auto& t : part.tets) look_beyond(t);
  // The best first, then one a vertex and label.
  std::sort(beyond_.begin(), beyond_.end(), [](const Beyond& a, const Beyond& b) {
    return std::tie(a.vertex, a.label, b.known, a.value) <
           std::tie(b.vertex, b.label, a.known, b.value);
  });
  beyond_.erase(std::unique(beyond_.begin(), beyond_.end(),
                            [](const Beyond& a, const Beyond& b) {
                              return a.vertex == b.vertex && a.label == b.label;
                            }),
                beyond_.end());
  choose_colours();
}

// A vertex that is not reached is in no cell, whatever its label.
std::int32_t Cells::label(std::uint32_t vertex) const {
  return part_.value.empty() || std::isfinite(part_.value[vertex]) ? part_.label[vertex] : -1;
}

void Cells::look_beyond(std::span<const std::uint32_t> corners) {
  for (const std::uint32_t v : corners)
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::int32_t label = this->label(corners[k]);
      if (label < 0 || label == this->label(v)) continue;
      std::array<std::uint32_t, 3> own{};
      std::size_t known = 0;
      bool first = true;
      for (std::size_t j = 0; j < corners.size(); ++j) {
        if (this->label(corners[j]) != label) continue;
        if (j < k) first = false;
        own[known++] = corners[j];
      }
      if (!first) continue;  // this label was looked at
      if (this->label(v) >= 0) neighbours_.push_back({this->label(v), label});
      const auto at = [&](std::size_t j) -> const Point& { return part_.positions[own[j]]; };
      const auto far = [&](std::size_t j) {
        return part_.value.empty() ? 0.0 : part_.value[own[j]];
      };
      const Point& p = part_.positions[v];
      double value = known == 1   ? far(0) + length(at(0), p)
                     : known == 2 ? across_line(at(0), at(1), p, far(0), far(1))
                                  : across_triangle(at(0), at(1), at(2), p, far(0), far(1), far(2));
      // Squares of huge values overflow.
      if (!std::isfinite(value)) value = far(0) + length(at(0), p);
      beyond_.push_back({v, label, known, value});
    }
}

double Cells::value(std::uint32_t vertex, std::int32_t label) const {
  if (this->label(vertex) == label) return part_.value.empty() ? 0 : part_.value[vertex];
  const auto found = std::lower_bound(
      beyond_.begin(), beyond_.end(), std::tie(vertex, label),
      [](const Beyond& b, const auto& key) { return std::tie(b.vertex, b.label) < key; });
  return found->value;
}

bool Cells::paint(std::span<const std::uint32_t> corners, std::span<Vertex> vertices) const {
  std::vector<std::pair<double, std::int32_t>> here;  // the least value of each cell, the cell
  for (const std::uint32_t v : corners) {
    const std::int32_t label = this->label(v);
    const auto known = std::find_if(here.begin(), here.end(),
                                    [&](const auto& cell) { return cell.second == label; });
    if (label < 0 || known != here.end()) continue;
    double least = value(v, label);
    for (const std::uint32_t w : corners) least = std::min(least, value(w, label));
    here.emplace_back(least, label);
  }
  if (here.empty()) return false;
  std::sort(here.begin(), here.end());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Vertex& vertex = vertices[k];
    vertex.value = value(corners[k], here[0].second);
    vertex.paint = lined(colour(here[0].second));
    if (here.size() == 1) continue;
    vertex.others = Others{{far_away, far_away}, {by_value, by_value}};
    for (std::size_t n = 1; n < std::min<std::size_t>(here.size(), 3); ++n) {
      vertex.others->value[n - 1] = static_cast<float>(value(corners[k], here[n].second));
      vertex.others->paint[n - 1] = lined(colour(here[n].second));
    }
  }
  return true;
}

Colour Cells::colour(std::int32_t label) const {
  return palette[colour_[static_cast<std::size_t>(label)]];
}

// Few cells have a colour each, in their order. Of many, each takes the colour used least among
// those that no neighbour before it has.
void Cells::choose_colours() {
  const std::int32_t largest = *std::max_element(part_.label.begin(), part_.label.end());
  colour_.assign(static_cast<std::size_t>(std::max(largest, 0)) + 1, 0);
  for (std::size_t l = 0; l < colour_.size(); ++l)
    colour_[l] = static_cast<std::uint8_t>(l % palette.size());
  if (colour_.size() <= palette.size()) return;
  for (auto& pair : neighbours_)
    if (pair[0] < pair[1]) std::swap(pair[0], pair[1]);
  std::sort(neighbours_.begin(), neighbours_.end());
  neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
  std::array<std::size_t, palette.size()> used{};
  auto pair = neighbours_.begin();
  for (std::size_t l = 0; l < colour_.size(); ++l) {
    std::array<std::size_t, palette.size()> cost = used;
    for (; pair != neighbours_.end() && (*pair)[0] == static_cast<std::int32_t>(l); ++pair)
      cost[colour_[static_cast<std::size_t>((*pair)[1])]] += colour_.size();
    colour_[l] =
        static_cast<std::uint8_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    ++used[colour_[l]];
  }
}

}  // namespace plexway::render
