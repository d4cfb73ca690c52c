#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "labels/surface/saddle_rule.hpp"

namespace plexway::detail {

/// What labels say about any point of a triangle, and about where two fronts meet: SaddleRule for
/// those who ask about labels rather than spread them.
template <class Real, class Front>
class SaddleOffers : public SaddleRule<Real, Front> {
 public:
  using Rule = SaddleRule<Real, Front>;
  using Rule::Rule;
  using typename Rule::Label;
  using typename Rule::Point;
  using typename Rule::Posed;

  /// Length of the path to a point of a reached triangle, by its own label.
  [[nodiscard]] Real distance_at(Index f, const std::array<double, 4>& weight) const {
    const std::size_t in = front_.hinge(f);
    const Posed label = posed(front_.label(f));
    const Point q = point_over(f, in, weight);
    if (label.source.h < 0)  // the source is in f
      return label.sigma + std::hypot(q.x[0] - label.source.x[0], q.h + label.source.h);
    return path_length<Real>(label, triangles_[f].length[in], q);
  }

  /// `found(length, source)` for each label of the triangles around f, those that share a vertex
  /// with it, that belongs to another source than f's: `length(weight)` is that of its path to a
  /// point of f. It says true to hear no more. A triangle keeps the label nearest to its centre, so
  /// near its corners those around it may know better.
  template <class Found>
  void offers_around(Index f, Found found) const {
    // Either way around a vertex: around a saddle they differ.
    for (const bool about_first : {true, false}) {
      SourcesHeard heard(front_.reached(f) ? front_.source(f) : none);
      for (std::size_t edge = 0; edge < 3; ++edge)
        if (offers_about(f, edge, about_first, heard, found)) return;
    }
  }

  /// `found(length, source)` for each label beyond an edge of f that belongs to another source than
  /// f's: the path from source to source through this edge.
  template <class Found>
  void meetings_over(Index f, std::size_t edge, Found found) const {
    around(f, edge, [&](Index g, std::size_t k, bool flip) {
      if (!front_.reached(g) || front_.source(g) == front_.source(f)) return;
      Posed here, there;
      if (!seen_over(f, edge, here) || !seen_over(g, k, there)) return;
      const Real length = triangles_[f].length[edge];
      const Posed p = flip ? mirrored(here, length) : here;
      const auto opposite = [&](const Point& q) { return Point{{length - q.x[0]}, q.h}; };
      // Either of the two may have a saddle in the way.
      found(std::max(path_length<Real>(p, length, opposite(there.source)) + there.sigma,
                     path_length<Real>(there, length, opposite(p.source)) + p.sigma),
            front_.source(g));
    });
  }

 private:
  using Rule::around;
  using Rule::front_;
  using Rule::leave;
  using Rule::posed;
  using Rule::sentinel_;
  using Rule::triangles_;
  using Rule::turned;

  Point point_over(Index f, std::size_t edge, const std::array<double, 4>& weight) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real v = static_cast<Real>(weight[edge_after(edge)]);
    const Real w = static_cast<Real>(weight[edge_before(edge)]);
    return {{v * t.length[edge] + w * t.apex_x(edge)}, w * t.apex_h(edge)};
  }

  static Posed mirrored(Posed p, Real length) {
    std::swap(p.limit[0], p.limit[1]);
    for (Point* q : {&p.source, &p.limit[0], &p.limit[1]}) q->x[0] = length - q->x[0];
    return p;
  }

  /// The label of f as seen from beyond one of its edges; false where it came in by that edge, or
  /// its source lies behind.
  bool seen_over(Index f, std::size_t edge, Posed& p) const {
    const std::size_t in = front_.hinge(f);
    const bool within = front_.label(f).h[0] < 0;
    if (in == edge && !within) return false;
    int pivot = -1;
    p = leave(f, in, edge, pivot);
    if (within) p.source.h = std::max(p.source.h, Real(0)), p.limit[0] = p.limit[1] = p.source;
    return p.source.h >= 0;
  }

  /// A few sources that need not be asked again.
  struct SourcesHeard {
    explicit SourcesHeard(Index own) : source{own}, count(1) {}
    bool first_time(Index s) {
      for (int i = 0; i < count; ++i)
        if (source[i] == s) return false;
      if (count < 8) source[count++] = s;
      return true;
    }
    Index source[8];
    int count;
  };

  /// As path_length, but a line that misses the edge bends only at a saddle: past any other vertex
  /// it goes through the triangles beside.
  Real sight_length(const Posed& p, Index f, std::size_t edge, const Point& q) const {
    const TriangleRecord<Real>& t = triangles_[f];
    if (p.source.h >= 0) {
      const auto c = Posed::Kernel::crossing(p.source, q);
      const bool left = c.x[0]<0, right = c.x[0]> t.length[edge] * c.w;
      const bool lit = !(left_of<Real>(p.source, p.limit[0], q) > 0) &&
                       !(left_of<Real>(p.source, p.limit[1], q) < 0);
      if (!lit || (left && t.saddle(edge)) || (right && t.saddle(edge_after(edge))))
        return path_length<Real>(p, t.length[edge], q);
    }
    return p.sigma + std::hypot(q.x[0] - p.source.x[0], q.h + p.source.h);
  }

  /// From edge to edge about one end of an edge of f, halfway around the vertex.
  template <class Found>
  bool offers_about(Index f, std::size_t edge, bool about_first, SourcesHeard& heard,
                    Found found) const {
    constexpr int half = 4;
    struct Step {
      Index g;
      std::size_t k, on;
      bool flip;
    } step[half];
    Index at = f;
    std::size_t out = edge;
    for (int n = 0; n < half; ++n) {
      const Index across = triangles_[at].across[out];
      const Index g = across >> Across::face_shift;
      if (g == sentinel_ || g == f) return false;
      const std::size_t k = across & Across::edge_mask;
      const bool flip = (across & Across::flip) != 0;
      out = about_first == flip ? edge_before(k) : edge_after(k);
      about_first = about_first != flip;
      step[n] = {g, k, out, flip};
      at = g;
      if (front_.reached(g) && heard.first_time(front_.source(g))) {
        // Back to f. In g the path came by some edge; posed on k it is seen from beyond.
        Posed p = posed(front_.label(g));
        int pivot = -1;
        if (front_.hinge(g) == k && front_.label(g).h[0] >= 0) {
          p = mirrored(p, triangles_[g].length[k]);
          for (Point* q : {&p.source, &p.limit[0], &p.limit[1]}) q->h = -q->h;
        } else {
          p = turned(triangles_[g], p, front_.hinge(g), k, pivot);
        }
        for (int m = n;; --m) {
          if (step[m].flip) p = mirrored(p, triangles_[step[m].g].length[step[m].k]);
          if (m == 0) break;
          p = turned(triangles_[step[m - 1].g], p, step[m - 1].on, step[m - 1].k, pivot);
        }
        const auto to = [&](const std::array<double, 4>& weight) {
          return sight_length(p, f, edge, point_over(f, edge, weight));
        };
        if (found(to, front_.source(g))) return true;
      }
      if (across & Across::fan) return false;
    }
    return false;
  }
};

}  // namespace plexway::detail
