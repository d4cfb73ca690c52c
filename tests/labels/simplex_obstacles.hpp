#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "labels/simplex_testing.hpp"

/// Shortest ways around boxes by brute force, for any dimension: of all ways over points spread
/// densely on the boxes' faces of codimension 2 the best ones, then their bends moved to where the
/// way is shortest.
namespace plexway::testing {

/// Boxes, which may overlap, in the cells of a grid, and a linear map of all of it.
template <int N>
struct Obstacles {
  using Point = std::array<double, N>;
  struct Block {
    std::array<std::size_t, N> from, to;  // planes
  };

  KuhnGrid<N> grid;
  std::vector<Block> blocks;
  std::array<Point, N> map;  // row d: coordinate d from those of the grid

  Obstacles(KuhnGrid<N> cells, std::vector<Block> boxes)
      : grid(std::move(cells)), blocks(std::move(boxes)) {
    for (std::size_t d = 0; d < N; ++d)
      for (std::size_t e = 0; e < N; ++e) map[d][e] = d == e;
  }

  [[nodiscard]] Point mapped(const Point& p) const {
    Point q{};
    for (std::size_t d = 0; d < N; ++d)
      for (std::size_t e = 0; e < N; ++e) q[d] += map[d][e] * p[e];
    return q;
  }
  template <class Real>
  [[nodiscard]] SimplicialComplex<Real, N> complex() const {
    std::vector<double> positions;
    for (Index v = 0; v < grid.vertex_count(); ++v)
      for (const double x : mapped(grid.position(v))) positions.push_back(x);
    const auto simplices = grid.simplices([&](const auto& cell) { return is_absent(cell); });
    return {positions, N, simplices};
  }
  [[nodiscard]] bool is_absent(const std::array<std::size_t, N>& cell) const {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) {
      for (std::size_t d = 0; d < N; ++d)
        if (cell[d] < b.from[d] || cell[d] >= b.to[d]) return false;
      return true;
    });
  }
  [[nodiscard]] double low(const Block& b, std::size_t d) const {
    return grid.planes(d)[b.from[d]];
  }
  [[nodiscard]] double high(const Block& b, std::size_t d) const { return grid.planes(d)[b.to[d]]; }
  /// Are all cells at a point absent? (Not between two blocks that touch in a point or an edge.)
  [[nodiscard]] bool covers(const Point& p) const {
    constexpr double close = 1e-9;
    std::array<std::size_t, N> first, last;
    for (std::size_t d = 0; d < N; ++d) {
      const std::vector<double>& planes = grid.planes(d);
      const auto below = std::lower_bound(planes.begin(), planes.end(), p[d] - close);
      const auto above = std::upper_bound(planes.begin(), planes.end(), p[d] + close);
      first[d] = static_cast<std::size_t>(std::max(below - planes.begin(), std::ptrdiff_t{1}) - 1);
      last[d] = static_cast<std::size_t>(
          std::min(above - planes.begin(), static_cast<std::ptrdiff_t>(planes.size()) - 1));
    }
    for (auto cell = first;;) {
      if (!is_absent(cell)) return false;
      std::size_t d = 0;
      while (d < N && ++cell[d] >= last[d]) cell[d] = first[d], ++d;
      if (d == N) return true;
    }
  }
  [[nodiscard]] bool sees(const Point& p, const Point& q) const {
    std::vector<double> stops = {0, 1};
    for (std::size_t d = 0; d < N; ++d) {
      if (std::abs(q[d] - p[d]) < 1e-12) continue;
      for (const double x : grid.planes(d)) {
        const double t = (x - p[d]) / (q[d] - p[d]);
        if (t > 0 && t < 1) stops.push_back(t);
      }
    }
    std::sort(stops.begin(), stops.end());
    for (std::size_t i = 1; i < stops.size(); ++i) {
      if (stops[i] - stops[i - 1] < 1e-8) continue;
      Point m;
      for (std::size_t d = 0; d < N; ++d)
        m[d] = p[d] + (stops[i] + stops[i - 1]) / 2 * (q[d] - p[d]);
      if (covers(m)) return false;
    }
    return true;
  }
  [[nodiscard]] double length(const Point& p, const Point& q) const {
    return distance_between(mapped(p), mapped(q));
  }
};

template <int N>
Obstacles<N> sheared(Obstacles<N> o) {
  for (std::size_t d = 0; d < N; ++d)
    for (std::size_t e = 0; e < N; ++e)
      if (d != e) o.map[d][e] = .35 * std::sin(static_cast<double>(1 + 3 * d + 5 * e));
  return o;
}

/// So many boxes at most, thrown at random into a grid of so many cells a side, every other draw
/// sheared.
template <int N>
Obstacles<N> random_obstacles(unsigned seed, std::size_t cells, unsigned most) {
  std::mt19937 random(seed);
  std::vector<typename Obstacles<N>::Block> blocks(1 + below(random, most));
  for (auto& block : blocks)
    for (std::size_t d = 0; d < N; ++d) {
      const std::size_t width = 1 + below(random, static_cast<Index>(cells / 2));
      block.from[d] = below(random, static_cast<Index>(cells + 1 - width));
      block.to[d] = block.from[d] + width;
    }
  const Obstacles<N> obstacles(cube_grid<N>(cells, seed % 3), blocks);
  return seed % 2 ? sheared(obstacles) : obstacles;
}

template <int N>
class ShortestWays {
 public:
  using Point = typename Obstacles<N>::Point;

  /// So many points along each axis of a face.
  ShortestWays(const Obstacles<N>& obstacles, std::size_t density) : obstacles_(obstacles) {
    for (const auto& block : obstacles.blocks)
      for (std::size_t a = 0; a < N; ++a)
        for (std::size_t b = a + 1; b < N; ++b)
          for (int ends = 0; ends < 4; ++ends) spread(block, a, b, ends, density);
    const std::size_t count = stop_.size();
    next_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (stop_[i].face != stop_[j].face && obstacles.sees(stop_[i].at, stop_[j].at)) {
          const double d = obstacles.length(stop_[i].at, stop_[j].at);
          next_[i].push_back({j, d});
          next_[j].push_back({i, d});
        }
  }

  /// From now on all ways start here.
  void start(const Point& source) {
    source_ = source;
    distance_.assign(stop_.size(), infinity);
    before_.assign(stop_.size(), none);
    std::vector<char> done(stop_.size(), 0);
    for (std::size_t i = 0; i < stop_.size(); ++i)
      if (obstacles_.sees(source, stop_[i].at))
        distance_[i] = obstacles_.length(source, stop_[i].at);
    for (;;) {
      std::size_t best = stop_.size();
      for (std::size_t i = 0; i < stop_.size(); ++i)
        if (!done[i] && (best == stop_.size() || distance_[i] < distance_[best])) best = i;
      if (best == stop_.size() || std::isinf(distance_[best])) return;
      done[best] = 1;
      for (const auto& [to, d] : next_[best])
        if (distance_[best] + d < distance_[to]) {
          distance_[to] = distance_[best] + d;
          before_[to] = static_cast<Index>(best);
        }
    }
  }

  [[nodiscard]] double to(const Point& target) const {
    if (obstacles_.sees(source_, target)) return obstacles_.length(source_, target);
    std::vector<std::pair<double, std::size_t>> last;
    for (std::size_t i = 0; i < stop_.size(); ++i)
      if (distance_[i] < infinity && obstacles_.sees(stop_[i].at, target))
        last.emplace_back(distance_[i] + obstacles_.length(stop_[i].at, target), i);
    std::sort(last.begin(), last.end());
    double best = infinity;
    std::vector<std::vector<std::size_t>> tried;
    for (const auto& [length, i] : last) {
      if (tried.size() >= 12 || length > best * 1.05) break;
      std::vector<std::size_t> faces;
      std::vector<Point> way;
      for (std::size_t at = i;; at = before_[at]) {
        faces.push_back(stop_[at].face);
        way.push_back(stop_[at].at);
        if (before_[at] == none) break;
      }
      if (std::find(tried.begin(), tried.end(), faces) != tried.end()) continue;
      tried.push_back(faces);
      best = std::min({best, length, tightened(faces, way, target)});
    }
    return best;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Stop {
    Point at;
    std::size_t face;
  };
  struct Face {
    Point low, high;
  };
  struct Way {
    std::size_t to;
    double length;
  };

  void spread(const typename Obstacles<N>::Block& block, std::size_t a, std::size_t b, int ends,
              std::size_t density) {
    Face face;
    for (std::size_t d = 0; d < N; ++d) {
      face.low[d] = obstacles_.low(block, d);
      face.high[d] = obstacles_.high(block, d);
    }
    face.low[a] = face.high[a] = ends & 1 ? face.low[a] : face.high[a];
    face.low[b] = face.high[b] = ends & 2 ? face.low[b] : face.high[b];
    // No way bends on the border of the whole domain.
    for (const std::size_t d : {a, b})
      if (face.low[d] == obstacles_.grid.planes(d).front() ||
          face.low[d] == obstacles_.grid.planes(d).back())
        return;
    faces_.push_back(face);
    std::size_t total = 1;
    for (std::size_t k = 2; k < N; ++k) total *= density;
    for (std::size_t n = 0; n < total; ++n) {
      Point p = face.low;
      std::size_t rest = n;
      for (std::size_t d = 0; d < N; ++d) {
        if (face.low[d] == face.high[d]) continue;
        p[d] += (face.high[d] - face.low[d]) * static_cast<double>(rest % density) /
                static_cast<double>(density - 1);
        rest /= density;
      }
      if (!obstacles_.covers(p)) stop_.push_back({p, faces_.size() - 1});
    }
  }

  /// The shortest way over these faces, from the last to the first, all of it free.
  [[nodiscard]] double tightened(const std::vector<std::size_t>& faces, std::vector<Point> way,
                                 const Point& target) const {
    const auto total = [&] {
      double sum = obstacles_.length(way.front(), target) + obstacles_.length(way.back(), source_);
      for (std::size_t i = 1; i < way.size(); ++i) sum += obstacles_.length(way[i], way[i - 1]);
      return sum;
    };
    const auto free = [&](std::size_t i) {
      return obstacles_.sees(way[i], i == 0 ? target : way[i - 1]) &&
             obstacles_.sees(way[i], i + 1 == way.size() ? source_ : way[i + 1]);
    };
    double best = total();
    for (double share = .25; share > 1e-9; share /= 2)
      for (bool better = true; better;) {
        better = false;
        for (std::size_t i = 0; i < way.size(); ++i)
          for (std::size_t d = 0; d < N; ++d) {
            const Face& face = faces_[faces[i]];
            const double width = face.high[d] - face.low[d], old = way[i][d];
            if (width == 0) continue;
            for (const double sign : {-1., 1.}) {
              way[i][d] = std::clamp(old + sign * share * width, face.low[d], face.high[d]);
              const double now = total();
              if (now < best * (1 - 1e-15) && free(i)) {
                best = now;
                better = true;
                break;
              }
              way[i][d] = old;
            }
          }
      }
    return best;
  }

  Obstacles<N> obstacles_;
  std::vector<Face> faces_;
  std::vector<Stop> stop_;
  std::vector<std::vector<Way>> next_;
  Point source_{};
  std::vector<double> distance_;
  std::vector<Index> before_;
};

}  // namespace plexway::testing
