#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include <plexway/complex/triangle_record.hpp>
#include <plexway/propagate/saddle_label.hpp>
#include <plexway/propagate/saddle_step.hpp>
#include <plexway/propagate/saddle_step_lanes.hpp>

namespace plexway {

/// Visibility::saddles on triangles: how labels get from one to the next.
template <class Real, class Front>
class SaddleRule {
 public:
  using Label = SaddleLabel<Real>;
  using Posed = PosedSaddles<Real>;
  using Point = typename Posed::Point;

  SaddleRule(std::span<const TriangleRecord<Real>> triangles, Front& front, bool vectorised)
      : triangles_(triangles.data()),
        sentinel_(static_cast<Index>(triangles.size() - 1)),
        front_(front),
        vectorised_(vectorised) {
    // Nothing is nearer: never accepted.
    front_.put(sentinel_, {kernel::Lanes<Real>(0, 0, 0, 0), kernel::Lanes<Real>(0, -1, 0, 0)});
  }

  /// The same rule on another front: of another executor, or one that a loop can keep in registers.
  template <class Other>
  [[nodiscard]] SaddleRule<Real, Other> on(Other& front) const {
    return SaddleRule<Real, Other>(triangles_, sentinel_, front, vectorised_);
  }

  [[nodiscard]] Real distance(Index f) const { return front_.label(f).distance(); }
  /// What a label for f must be below. Around a bend all paths are equally long from both sides, so
  /// rounding would decide which label stays; a gain must be more than that.
  [[nodiscard, gnu::always_inline]] Real to_beat(Index f) const {
    constexpr Real gain = Real(1) - Real(16) * std::numeric_limits<Real>::epsilon();
    return front_.reached(f) ? distance(f) * gain : std::numeric_limits<Real>::infinity();
  }

  /// The hot loop's body: pushes the label of triangle f over the two hinges it did not come by.
  /// `full(f, edge)` applies the full rule where the common case does not hold.
  template <class Full>
  [[gnu::always_inline]] void expand(Index f, Full full) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const std::size_t left = edge_before(in), right = edge_after(in);
    const Index over_left = t.across[left], over_right = t.across[right];
    if (((over_left | over_right) & Across::special) || !vectorised_) [[unlikely]] {
      full(f, left);
      full(f, right);
      return;
    }
    const Index l = over_left >> Across::face_shift, r = over_right >> Across::face_shift;
    const std::size_t kl = over_left & Across::edge_mask, kr = over_right & Across::edge_mask;
    const TriangleRecord<Real>&tl = triangles_[l], &tr = triangles_[r];
    const SaddleStepLanes<Real> step(t, in, left, right, front_.label(f), tl.apex_x(kl),
                                     tl.apex_h(kl), tr.apex_x(kr), tr.apex_h(kr));
    // Read before anything is accepted: one hinge must not change what the other compares with.
    // And after the arithmetic, so that it is under way when a branch is mispredicted here.
    const Real known_left = to_beat(l), known_right = to_beat(r);
    const Index source = front_.source(f);
    if (step.left_distance < known_left) {
      SaddleLabel<Real> label;
      if (step.left_rare()) [[unlikely]]
        label = resolve(step.left_posed(), tl, kl, 0, false);
      else if (step.left_bent()) [[unlikely]]
        label = step.bent_label(true, tl, kl);
      else
        label = step.left_label();
      if (label.distance() < known_left) [[likely]] {
        front_.accept(l, kl, label, label.distance(), source);
        if (front_.expands_soon()) prefetch(tl, kl);
      }
    }
    if (step.right_distance < known_right) {
      SaddleLabel<Real> label;
      if (step.right_rare()) [[unlikely]]
        label = resolve(step.right_posed(), tr, kr, 1, false);
      else if (step.right_bent()) [[unlikely]]
        label = step.bent_label(false, tr, kr);
      else
        label = step.right_label();
      if (label.distance() < known_right) [[likely]] {
        front_.accept(r, kr, label, label.distance(), source);
        if (front_.expands_soon()) prefetch(tr, kr);
      }
    }
  }

  /// Fetches what the expansion of f will need, in two steps: f itself, then its neighbours.
  [[gnu::always_inline]] void prefetch(Index f) const { __builtin_prefetch(&triangles_[f]); }
  [[gnu::always_inline]] void prefetch_around(Index f) const {
    prefetch(triangles_[f], front_.hinge(f));
  }

  /// The full rule over one edge, to every triangle there.
  [[gnu::noinline]] void cross(Index f, std::size_t edge, bool last_resort) {
    int pivot = -1;
    const Posed here = leave(f, front_.hinge(f), edge, pivot);
    cross_posed(f, edge, here, pivot, last_resort, front_.source(f));
  }

  void cross_posed(Index f, std::size_t edge, const Posed& here, int pivot, bool last_resort,
                   Index source) {
    around(f, edge, [&](Index g, std::size_t k, bool flip) {
      enter(g, k, here, flip, pivot, last_resort, source);
    });
  }

  /// A path of length sigma ends at corner i of triangle f; false if f knows a better one.
  bool seed_corner(Index f, std::size_t i, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real x = (t.length[i] + t.apex_x(i)) / 3, h = t.apex_h(i) / 3;
    const Real d = sigma + std::sqrt(x * x + h * h);
    if (!(d < to_beat(f))) return false;
    front_.accept(f, i, {kernel::Lanes<Real>(0, sigma, 0, 0), kernel::Lanes<Real>(0, d, 0, 0)}, d,
                  source);
    return true;
  }

  /// A path of length sigma ends inside triangle f, at (x, y) over its edge 0.
  void seed_inside(Index f, Real x, Real y, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real dx = (t.length[0] + t.apex_x(0)) / 3 - x, dy = t.apex_h(0) / 3 - y;
    const Real d = sigma + std::sqrt(dx * dx + dy * dy);
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = d < to_beat(f);
    const Label kept = front_.label(f);
    const Label label = {kernel::Lanes<Real>(x, sigma, 0, 0), kernel::Lanes<Real>(-y, d, 0, 0)};
    if (better)
      front_.accept(f, 0, label, d, source);
    else
      front_.put(f, label);
    // Expansion would not take edge 0, and would take a source on an edge for one behind it.
    for (std::size_t edge = 0; edge < 3; ++edge) {
      int pivot = -1;
      Posed here = leave(f, 0, edge, pivot);
      here.source.h = std::max(here.source.h, Real(0));
      here.limit[0] = here.limit[1] = here.source;
      cross_posed(f, edge, here, -1, true, source);
    }
    if (!better) front_.put(f, kept);
  }

  /// Length of the path to corner i of a reached triangle.
  [[nodiscard]] Real corner_distance(Index f, std::size_t i) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const Posed label = posed(front_.label(f));
    Point q = {{Real(0)}, Real(0)};
    if (i == (in + 1) % 3) q.x[0] = t.length[in];
    if (i == (in + 2) % 3) q = {{t.apex_x(in)}, t.apex_h(in)};
    return path_length<Real>(label, t.length[in], q);
  }

  [[nodiscard]] const Label& label(Index f) const { return front_.label(f); }

  // Any point of a triangle, by the weights of its corners.

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

  // What follows is for simplices of other complexes that share an edge or all of a triangle.

  /// The source of f as seen from one of its edges, x from the edge's first corner: behind the bend
  /// where the middle of the edge is in shadow. Limits are dropped.
  [[nodiscard]] Posed seen_from(Index f, std::size_t edge) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    int pivot = -1;
    Posed p = posed(front_.label(f));
    const bool from_inside = edge != in || p.source.h < 0;
    if (from_inside) p = leave(f, in, edge, pivot);
    SaddleHinge<Real> middle;  // a triangle without area: its apex is the edge's middle
    middle.extent = t.length[edge];
    middle.apex = {{t.length[edge] / 2}, Real(0)};
    middle.saddle[0] = middle.saddle[1] = false;
    middle.pivot = pivot;
    cross_hinge<Real>(p, middle, true);
    const bool left = detail::left_of<Real>(p.source, p.limit[0], middle.apex) > 0;
    const bool right = detail::left_of<Real>(p.source, p.limit[1], middle.apex) < 0;
    if (left || right) detail::give_up_source<Real>(p, Point(p.limit[left ? 0 : 1]));
    p.source.h = std::max(p.source.h, Real(0));
    if (from_inside) p.source.x[0] = t.length[edge] - p.source.x[0];
    p.limit[0] = p.limit[1] = p.source;
    return p;
  }

  /// The source of f as its centre sees it, posed on the edge that f's label came in by.
  [[nodiscard]] Posed seen_from_centre(Index f) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const Real length = t.length[in];
    Posed p = posed(front_.label(f));
    const Point q = {{(length + t.apex_x(in)) / 3}, t.apex_h(in) / 3};
    const bool left = detail::left_of<Real>(p.source, p.limit[0], q) > 0;
    const bool right = detail::left_of<Real>(p.source, p.limit[1], q) < 0;
    if (left || right) detail::give_up_source<Real>(p, Point(p.limit[left ? 0 : 1]));
    const auto c = Posed::Kernel::crossing(p.source, q);
    if (p.source.h >= 0 && (c.x[0] < 0 || c.x[0] > length * c.w))
      detail::give_up_source<Real>(p, {{c.x[0] < 0 ? Real(0) : length}, Real(0)});
    return p;
  }

  /// A source comes over edge k of f from elsewhere, (x, h) on the far side, x from its first
  /// corner.
  bool enter_over(Index f, std::size_t k, Real x, Real h, Real sigma, Index source) {
    Posed p;
    p.source = p.limit[0] = p.limit[1] = {{x}, h};
    p.sigma = sigma;
    const std::size_t before = front_.updates();
    enter(f, k, p, false, -1, true, source);
    return front_.updates() != before;
  }

  /// The same for a label with limits.
  void enter_posed(Index f, std::size_t k, const Posed& label, Index source) {
    enter(f, k, label, false, -1, true, source);
  }
  [[nodiscard]] const TriangleRecord<Real>& triangle(Index f) const { return triangles_[f]; }

  /// A source lies at height h over (x, y) of f, y over its edge 0: the neighbours see it over
  /// the edges; f itself gets the way by its best corner.
  bool enter_from_above(Index f, Real x, Real y, Real h, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t before = front_.updates();
    const Real cx[3] = {0, t.length[0], t.apex_x(0)}, cy[3] = {0, 0, t.apex_h(0)};
    for (std::size_t i = 0; i < 3; ++i) {
      const Real d2 = (cx[i] - x) * (cx[i] - x) + (cy[i] - y) * (cy[i] - y) + h * h;
      seed_corner(f, i, sigma + std::sqrt(d2), source);
    }
    if (!front_.reached(f)) return false;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::size_t i = edge, j = edge == 2 ? 0 : edge + 1;
      const Real length = t.length[edge];
      if (!(length > 0)) continue;
      const Real ux = (cx[j] - cx[i]) / length, uy = (cy[j] - cy[i]) / length;
      const Real along = (x - cx[i]) * ux + (y - cy[i]) * uy;
      const Real off = (y - cy[i]) * ux - (x - cx[i]) * uy;
      if (h == 0 && off < 0) continue;  // in the plane of f and already beyond this edge
      Posed p;
      p.source = {{length - along}, std::sqrt(off * off + h * h)};
      p.limit[0] = p.limit[1] = p.source;
      p.sigma = sigma;
      cross_posed(f, edge, p, -1, true, source);
    }
    return front_.updates() != before;
  }

 private:
  template <class, class>
  friend class SaddleRule;
  SaddleRule(const TriangleRecord<Real>* triangles, Index sentinel, Front& front, bool vectorised)
      : triangles_(triangles), sentinel_(sentinel), front_(front), vectorised_(vectorised) {}

  static Posed posed(const Label& label) {
    Posed p;
    p.source = {{label.x[0]}, label.h[0]};
    p.limit[0] = {{label.x[0] + label.x[2]}, label.h[0] + label.h[2]};
    p.limit[1] = {{label.x[0] + label.x[3]}, label.h[0] + label.h[3]};
    p.sigma = label.sigma();
    return p;
  }

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
      const bool lit = !(detail::left_of<Real>(p.source, p.limit[0], q) > 0) &&
                       !(detail::left_of<Real>(p.source, p.limit[1], q) < 0);
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

  /// `visit(g, k, flip)` for each triangle beyond an edge, and whether it runs the same way there.
  template <class Visit>
  void around(Index f, std::size_t edge, Visit visit) const {
    const Index start = triangles_[f].across[edge];
    bool flip = (start & Across::flip) != 0;
    for (Index across = start;;) {
      const Index g = across >> Across::face_shift;
      const std::size_t k = across & Across::edge_mask;
      if (g == sentinel_ || (g == f && k == edge)) break;
      visit(g, k, flip);
      if (!(across & Across::fan)) break;
      across = triangles_[g].across[k];
      flip = flip == ((across & Across::flip) != 0);
    }
  }

  /// The label of f posed on one of its edges, as a neighbour that runs the other way sees it.
  Posed leave(Index f, std::size_t in, std::size_t edge, int& pivot) const {
    return turned(triangles_[f], posed(front_.label(f)), in, edge, pivot);
  }
  static Posed turned(const TriangleRecord<Real>& t, Posed p, std::size_t in, std::size_t edge,
                      int& pivot) {
    if (edge == in) {  // only from a source inside
      p.source = {{t.length[in] - p.source.x[0]}, -p.source.h};
      p.limit[0] = p.limit[1] = p.source;
      pivot = -1;
      return p;
    }
    const bool left = edge == (in == 0 ? 2 : in - 1);
    pivot = left ? 0 : 1;
    const std::size_t corner = left ? in : edge;
    return kernel::SaddleKernel<Real>::turn_label(p, left, t.length[in], t.length[edge],
                                                  t.cosine[corner], t.sine(corner));
  }

  void enter(Index g, std::size_t k, Posed label, bool flip, int pivot, bool last_resort,
             Index source) {
    const TriangleRecord<Real>& t = triangles_[g];
    if (flip) {
      label = kernel::SaddleKernel<Real>::mirror_label(label, t.length[k]);
      if (pivot >= 0) pivot = 1 - pivot;
    }
    const Label entered = resolve(label, t, k, pivot, last_resort);
    if (!(entered.distance() < to_beat(g))) return;
    front_.accept(g, k, entered, entered.distance(), source);
  }

  /// The full rule for one triangle beyond.
  [[gnu::noinline]] static Label resolve(Posed label, const TriangleRecord<Real>& t, std::size_t k,
                                         int pivot, bool last_resort) {
    SaddleHinge<Real> hinge;
    hinge.extent = t.length[k];
    hinge.apex = {{t.apex_x(k)}, t.apex_h(k)};
    hinge.saddle[0] = t.saddle(k);
    hinge.saddle[1] = t.saddle(k == 2 ? 0 : k + 1);
    hinge.pivot = pivot;
    const Real d = cross_hinge<Real>(label, hinge, last_resort);
    const Point &S = label.source, &l = label.limit[0], &r = label.limit[1];
    return {kernel::Lanes<Real>(S.x[0], label.sigma, l.x[0] - S.x[0], r.x[0] - S.x[0]),
            kernel::Lanes<Real>(S.h, d, l.h - S.h, r.h - S.h)};
  }

  // What the neighbours of a triangle come in by edge k will need when its turn comes.
  [[gnu::always_inline]] void prefetch(const TriangleRecord<Real>& t, std::size_t k) const {
    const Index a = t.across[k == 0 ? 2 : k - 1] >> Across::face_shift;
    const Index b = t.across[k == 2 ? 0 : k + 1] >> Across::face_shift;
    __builtin_prefetch(&triangles_[a]);
    __builtin_prefetch(&front_.label(a));
    __builtin_prefetch(&triangles_[b]);
    __builtin_prefetch(&front_.label(b));
  }

  const TriangleRecord<Real>* triangles_;
  Index sentinel_;
  Front& front_;
  bool vectorised_;
};

}  // namespace plexway
