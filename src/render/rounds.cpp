#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "complexes/common/arrays.hpp"
#include "render/camera.hpp"
#include "render/skins.hpp"

namespace plexway::render {
using namespace detail;
namespace {

constexpr double turn = 6.28318530717958647692;

Vertex moved(const Vertex& v, const Point& normal, double radius) {
  Vertex out = v;
  out.normal = normal;
  out.position = plus(v.position, times(radius, normal));
  return out;
}

void add_quad(Batch& batch, const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  batch.add(a, b, c);
  batch.add(a, c, d);
}

// Unit vectors across a line, the same for each of its points.
struct Ring {
  Point x, y;

  [[nodiscard]] Point at(std::size_t k, std::size_t sides) const {
    const double angle = turn * static_cast<double>(k % sides) / static_cast<double>(sides);
    return plus(times(std::cos(angle), x), times(std::sin(angle), y));
  }
};

void add_pipe(Batch& batch, const Vertex& from, const Ring& first, const Vertex& to,
              const Ring& last, double radius, std::size_t sides) {
  for (std::size_t k = 0; k < sides; ++k)
    add_quad(batch, moved(from, first.at(k, sides), radius),
             moved(from, first.at(k + 1, sides), radius), moved(to, last.at(k + 1, sides), radius),
             moved(to, last.at(k, sides), radius));
}

// The paint of vertex v of a part without cells, and whether all is reached.
Vertex vertex_of(const Part& part, const Cells* cells, std::uint32_t v, const Making& making) {
  Vertex vertex;
  vertex.position = making.frame(part.positions[v]);
  if (!part.value.empty()) vertex.value = part.value[v];
  const bool reached = std::isfinite(vertex.value);
  if (!reached) vertex.value = 0;
  if (!reached || (cells != nullptr && part.label[v] < 0))
    vertex.paint = plain(unreached);
  else if (cells != nullptr)
    vertex.paint = plain(cells->colour(part.label[v]));
  else if (part.value.empty())
    vertex.paint = plain(part.colour.value_or(Colour{120, 130, 145}));
  return vertex;
}

}  // namespace

void add_ball(Batch& batch, const Vertex& centre, double radius, std::size_t rings) {
  const std::size_t sides = 2 * rings;
  const auto normal = [&](std::size_t ring, std::size_t side) -> Point {
    const double polar = turn / 2 * static_cast<double>(ring) / static_cast<double>(rings);
    const double around = turn * static_cast<double>(side % sides) / static_cast<double>(sides);
    return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
            std::cos(polar)};
  };
  for (std::size_t r = 0; r < rings; ++r)
    for (std::size_t s = 0; s < sides; ++s) {
      const Vertex a = moved(centre, normal(r, s), radius);
      const Vertex b = moved(centre, normal(r + 1, s), radius);
      const Vertex c = moved(centre, normal(r + 1, s + 1), radius);
      const Vertex d = moved(centre, normal(r, s + 1), radius);
      if (r + 1 < rings) batch.add(a, b, c);
      if (r > 0) batch.add(a, c, d);
    }
}

void add_ring(std::vector<Corner>& corners, const Vertex& centre, double inner, double outer,
              const Point& toward) {
  constexpr std::size_t sides = 40;
  Ring ring{some_perpendicular(toward), {}};
  ring.y = cross(toward, ring.x);
  Batch band(Look::overlay);
  for (std::size_t k = 0; k < sides; ++k) {
    const auto at = [&](std::size_t side, double radius) {
      Vertex v = centre;
      v.normal = toward;
      v.position = plus(centre.position, times(radius, ring.at(side, sides)));
      return v;
    };
    add_quad(band, at(k, inner), at(k, outer), at(k + 1, outer), at(k + 1, inner));
  }
  corners.insert(corners.end(), band.corners.begin(), band.corners.end());
}

void add_tube(Batch& batch, std::span<const Vertex> points, double radius, std::size_t sides) {
  std::vector<Vertex> line;
  for (const Vertex& v : points) {
    const bool same =
        !line.empty() && std::sqrt(dot(minus(v.position, line.back().position),
                                       minus(v.position, line.back().position))) < 1e-3 * radius;
    if (!same) line.push_back(v);
  }
  if (line.empty()) return;
  const std::size_t rings = std::max<std::size_t>(sides / 2, 3);
  add_ball(batch, line.front(), radius, rings);
  if (line.size() == 1) return;
  add_ball(batch, line.back(), radius, rings);
  const auto direction = [&](std::size_t k) {
    return unit(minus(line[k + 1].position, line[k].position));
  };
  // The ring is carried along: turned as little as possible at each point.
  Point along = direction(0);
  Ring ring{some_perpendicular(along), {}};
  ring.y = cross(along, ring.x);
  const auto carry = [&](const Point& to) {
    ring.x = unit(minus(ring.x, times(dot(ring.x, to), to)));
    ring.y = cross(to, ring.x);
    along = to;
  };
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Ring first = ring;
    if (k + 2 == line.size()) {
      add_pipe(batch, line[k], first, line[k + 1], ring, radius, sides);
      break;
    }
    const Point next = direction(k + 1), before = direction(k);
    if (dot(before, next) > 0.9) {  // a mitre
      carry(unit(plus(before, next)));
      add_pipe(batch, line[k], first, line[k + 1], ring, radius, sides);
      continue;
    }
    carry(before);
    add_pipe(batch, line[k], first, line[k + 1], ring, radius, sides);
    add_ball(batch, line[k + 1], radius, rings);
    ring.x = std::abs(dot(ring.x, next)) < 0.99 ? ring.x : some_perpendicular(next);
    carry(next);
  }
}

void add_wires(Batch& batch, const Part& part, const Making& making) {
  std::optional<Cells> cells;
  if (!part.label.empty()) cells.emplace(part);
  const Cells* const cells_at = cells ? &*cells : nullptr;
  std::vector<double> lengths;
  for (const auto& e : part.edges) {
    const Point d = minus(part.positions[e[0]], part.positions[e[1]]);
    lengths.push_back(making.frame.scale * std::sqrt(dot(d, d)));
  }
  const double radius =
      std::clamp(0.22 * median(lengths), 0.9 * making.pixel, std::max(2.6 * making.pixel, 0.008));
  const std::size_t sides = part.edges.size() < 20000 ? 12 : part.edges.size() < 100000 ? 6 : 4;
  std::vector<bool> joined(part.positions.size(), false);
  for (const auto& e : part.edges) {
    const Vertex from = vertex_of(part, cells_at, e[0], making);
    Vertex to = vertex_of(part, cells_at, e[1], making);
    if (making.clip && (making.clip->over(from.position) > 0 || making.clip->over(to.position) > 0))
      continue;
    Vertex middle_of = between(from, to, 0.5), other = middle_of;
    other.paint = to.paint;
    const Point d = minus(to.position, from.position);
    if (dot(d, d) > 0) {
      const Point along = unit(d);
      Ring ring{some_perpendicular(along), {}};
      ring.y = cross(along, ring.x);
      if (from.paint == to.paint)
        add_pipe(batch, from, ring, to, ring, radius, sides);
      else  // half in the colour of each end; a value that is not known does not colour the other
        middle_of.value = from.value, other.value = to.value,
        add_pipe(batch, from, ring, middle_of, ring, radius, sides),
        add_pipe(batch, other, ring, to, ring, radius, sides);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (joined[e[k]]) continue;
      joined[e[k]] = true;
      add_ball(batch, k == 0 ? from : to, radius, sides / 2);
    }
  }
}

void add_discs(Batch& batch, const Part& part, const Making& making) {
  std::optional<Cells> cells;
  if (!part.label.empty()) cells.emplace(part);
  const std::vector<double> spacing = spacings(part.positions);
  const bool flat = !part.normals.empty();
  const std::size_t most_sides = part.positions.size() < 50000 ? 14 : 8;
  // Of very many points a disc is a pixel or two, and a triangle does for it.
  const bool tiny = part.positions.size() > 200000;
  batch.corners.reserve(part.positions.size() * (tiny ? 3 : 3 * most_sides));
  for (std::size_t i = 0; i < part.positions.size(); ++i) {
    Vertex centre =
        vertex_of(part, cells ? &*cells : nullptr, static_cast<std::uint32_t>(i), making);
    if (making.clip && making.clip->over(centre.position) > 0) continue;
    double radius =
        std::max((flat ? 0.68 : 0.58) * making.frame.scale * spacing[i], 1.2 * making.pixel);
    const std::size_t sides = tiny && radius < 2.5 * making.pixel ? 3 : most_sides;
    if (sides == 3) radius *= 1.55;  // the area of the disc
    Point facing = flat ? unit_or_zero(part.normals[i]) : making.toward;
    const bool bulges = !flat || !(dot(facing, facing) > 0);
    if (bulges) facing = making.toward;
    Ring ring{some_perpendicular(facing), {}};
    ring.y = cross(facing, ring.x);
    centre.normal = facing;
    const bool sloped = !part.slope.empty() && centre.paint == by_value;
    const auto rim = [&](std::size_t k) {
      Vertex v = moved(centre, ring.at(k, sides), radius);
      if (sloped) {
        const double rise = dot(part.slope[i], v.normal) * radius / making.frame.scale;
        if (std::isfinite(rise)) v.value += rise;
      }
      // A little round, so that single discs can be distinguished.
      v.normal = unit(plus(v.normal, times(bulges ? 0.55 : 3.5, facing)));
      if (bulges) v.position = minus(v.position, times(0.5 * radius, facing));
      return v;
    };
    if (sides == 3)
      batch.add(rim(0), rim(1), rim(2));
    else
      for (std::size_t k = 0; k < sides; ++k) batch.add(centre, rim(k), rim(k + 1));
  }
}

namespace {

constexpr std::size_t leaf = 8;

// A k-d tree in the order of its points: each range is cut in its middle.
class Tree {
 public:
  explicit Tree(std::span<const Point> points)
      : points_(points.begin(), points.end()), cuts_(points.size()) {
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    split(0, points_.size());
  }

  [[nodiscard]] std::size_t places() const { return points_.size(); }

  /// The squares of the distances to the four nearest other places, in order; infinite if none.
  [[nodiscard]] std::array<double, 4> nearest(const Point& p) const {
    std::array<double, 4> found{};
    found.fill(std::numeric_limits<double>::infinity());
    look(p, 0, points_.size(), found);
    return found;
  }

 private:
  struct Cut {
    double at = 0;
    std::size_t axis = 0;
  };

  void split(std::size_t begin, std::size_t end) {
    if (end - begin <= leaf) return;
    Point low = points_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], points_[i][k]);
        high[k] = std::max(high[k], points_[i][k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    cuts_[middle] = {points_[middle][axis], axis};
    split(begin, middle);
    split(middle, end);
  }

  void look(const Point& p, std::size_t begin, std::size_t end,
            std::array<double, 4>& found) const {
    if (end - begin > leaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const double over = p[cuts_[middle].axis] - cuts_[middle].at;
      if (over < 0)
        look(p, begin, middle, found);
      else
        look(p, middle, end, found);
      if (over * over > found[3]) return;
      if (over < 0)
        look(p, middle, end, found);
      else
        look(p, begin, middle, found);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      const Point d = minus(points_[i], p);
      double square = dot(d, d);
      if (!(square > 0) || !(square < found[3])) continue;
      for (double& other : found)
        if (square < other) std::swap(square, other);
    }
  }

  std::vector<Point> points_;
  std::vector<Cut> cuts_;  // of the range with this middle
};

}  // namespace

std::vector<double> spacings(std::span<const Point> points) {
  const Tree tree(points);
  if (tree.places() < 2) return std::vector<double>(points.size(), 0.1);
  const std::size_t wanted = std::min<std::size_t>(tree.places() - 1, 4);
  std::vector<double> found;
  found.reserve(points.size());
  for (const Point& p : points) {
    double distance = std::sqrt(tree.nearest(p)[wanted - 1]);
    if (!std::isfinite(distance)) distance = 0;  // the squares of such sizes are no numbers
    found.push_back(distance);
  }
  std::vector<double> copy = found;
  const double middle = median(copy);
  for (double& f : found) f = std::clamp(f, middle / 2, middle * 2);
  return found;
}

}  // namespace plexway::render
