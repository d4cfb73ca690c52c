#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/propagate/solid_sight.hpp>

namespace plexway {

/// Corners of face i, anticlockwise as seen from outside.
inline constexpr Index tet_face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Visibility::saddles on solids in space: a virtual source is a point, or a ring about a reflex
/// edge; paths bend at reflex edges only, and each label remembers two that may hide its source.
template <class Real, class Front>
class SolidRule {
 public:
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;

  SolidRule(const TetMesh<Real>& mesh, Label* labels, Front& front)
      : mesh_(&mesh),
        tets_(mesh.tets().data()),
        points_(mesh.points().data()),
        reflex_(mesh.reflex_edges().data()),
        list_(mesh.reflex_list().data()),
        sentinel_(static_cast<Index>(mesh.tet_count())),
        any_reflex_(!mesh.reflex_edges().empty()),
        labels_(labels),
        front_(&front) {
    labels_[sentinel_].centre = -1;  // nothing is nearer: never accepted
    labels_[sentinel_].path = 0;
    labels_[sentinel_].ring = none;
    clear_limits(labels_[sentinel_]);
  }
  [[nodiscard]] SolidRule on(Front& front) const {
    SolidRule rule = *this;
    rule.front_ = &front;
    return rule;
  }

  [[nodiscard]] Real distance(Index t) const { return labels_[t].centre; }
  /// Says which way the path came; labels that agree in it agree about distances.
  [[nodiscard]] Index path(Index t) const { return labels_[t].path; }
  /// What a label for t must be below: by more than rounding.
  [[nodiscard, gnu::always_inline]] Real to_beat(Index t) const {
    constexpr Real gain = Real(1) - Real(16) * std::numeric_limits<Real>::epsilon();
    return front_->reached(t) ? labels_[t].centre * gain : std::numeric_limits<Real>::infinity();
  }
  /// Longest way from the centre to a corner.
  [[nodiscard]] Real size(Index t) const {
    Real longest = 0;
    for (const Index v : tets_[t].corner)
      longest = std::max(longest, norm(points_[v] - tets_[t].centre));
    return longest;
  }

  /// Can an offer be dropped that another does not make up for? Not in a convex solid.
  [[nodiscard]] bool drops() const {
    return any_reflex_ || !mesh_->pinched().empty() || !mesh_->pinched_edges().empty();
  }
  /// No more than `way`; cheap.
  [[nodiscard]] Real least_way(Index t, Index u) const {
    const Point between = tets_[u].centre - tets_[t].centre;
    return std::max(std::max(std::abs(between.x), std::abs(between.y)), std::abs(between.z));
  }
  /// Longest way worth comparing with from the centre of t over face i to the next centre: through
  /// the face's centroid.
  [[nodiscard]] Real way(Index t, Index i) const {
    const TetRecord<Real>& r = tets_[t];
    Point middle = {0, 0, 0};
    for (const Index k : tet_face_corners[i]) middle = middle + Real(1) / 3 * points_[r.corner[k]];
    const Index u = r.across[i] >> TetAcross::tet_shift;
    return norm(middle - r.centre) + norm(tets_[u].centre - middle);
  }

  /// Offers the label of t over all faces but the one it came by.
  [[gnu::always_inline]] void expand(Index t, bool last_resort) const {
    const Index in = static_cast<Index>(front_->hinge(t));
    for (Index i = 0; i < 4; ++i)
      if (i != in) cross(t, i, last_resort);
  }

  /// Over one face.
  [[gnu::always_inline]] void cross(Index t, Index face, bool last_resort) const {
    const Index across = tets_[t].across[face];
    const Index u = across >> TetAcross::tet_shift;
    const Label& from = labels_[t];
    const Real known = to_beat(u), left = known - from.sigma;
    const Point& q = tets_[u].centre;
    const Point g = q - from.source;
    // A ring's way is longer than the straight one.
    const Real straight2 = dot(g, g);
    if (!(left > 0) || !(straight2 < left * left)) return;
    if (any_reflex_ || last_resort) {
      cross_fully(t, face, across, known, last_resort);
      return;
    }
    const Index* corner = tets_[t].corner;
    const Index* order = tet_face_corners[face];
    if (!passes(from.source, q, points_[corner[order[0]]], points_[corner[order[1]]],
                points_[corner[order[2]]], tolerance))
      return;
    Label& label = labels_[u];
    label = from;
    label.centre = from.sigma + std::sqrt(straight2);
    front_->accept(u, across & TetAcross::face_mask, label.centre, front_->source(t));
    prefetch(u);
  }

  /// A path of length sigma ends at corner i of t; false if t knows a better one.
  bool seed_corner(Index t, Index i, Real sigma, Index source) const {
    return seed(t, points_[tets_[t].corner[i]], (i + 1) & 3, sigma, source);
  }
  /// A path of length sigma ends inside t.
  void seed_inside(Index t, const std::array<double, 4>& barycentric, Real sigma,
                   Index source) const {
    Point at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      at = at + static_cast<Real>(barycentric[i]) * points_[tets_[t].corner[i]];
    if (!seed(t, at, 0, sigma, source)) return;
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
  }

  /// Length of the path to corner i of a reached tetrahedron, as far as it is below `known`.
  [[nodiscard]] Real corner_distance(Index t, Index i,
                                     Real known = std::numeric_limits<Real>::infinity()) const {
    const Point& q = points_[tets_[t].corner[i]];
    const Label& from = labels_[t];
    const Real straight = from.sigma + norm(q - from.source);
    if (!any_reflex_ || !(straight < known)) return straight;
    Reach simple = reach(from, q);
    if (!(simple.length < known)) return simple.length;
    if (tets_[t].reflex == none) return measure(from, q, simple).length;
    Label label = from;
    gather(t, sentinel_, label, q, simple);
    return measure(label, q, simple).length;
  }

  /// Labels of u offer a path over the edge (v, w) of t, which touches u in that edge only.
  bool pass_edge(Index u, Index t, Index v, Index w, Real known_gain) const {
    const Label& from = labels_[u];
    const Point q = tets_[t].centre;
    const Reach before = reach(from, bend_point(points_[v], points_[w], from.source, q));
    const Point b = bend_point(points_[v], points_[w], before.eye, q);
    Label label;
    const Reach there = measure(from, b);
    label.source = b;
    label.sigma = there.length;
    label.ring = none;
    clear_limits(label);
    label.path = SolidPath::bent(from.path, v ^ w);
    label.centre = label.sigma + norm(q - b);
    if (!(label.centre < to_beat(t) * known_gain)) return false;
    labels_[t] = label;
    Index face = 0;  // one that contains the edge
    while (tets_[t].corner[face] == v || tets_[t].corner[face] == w) ++face;
    front_->accept(t, face, label.centre, front_->source(u));
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    return true;
  }

  static constexpr Real tolerance = Real(0.1);
  static constexpr Real slack = Real(0.5);

 private:
  struct Reach {
    Point eye;  // the last bend
    Real length;
    int bend = -1;  // at this limit
  };

  /// The path as the label has it, limits aside.
  [[nodiscard]] Reach reach(const Label& label, const Point& q) const {
    if (label.ring == none) return {label.source, label.sigma + norm(q - label.source), -1};
    const Point b = bend_point(reflex_[label.ring], label.source, q);
    return {b, label.sigma + norm(b - label.source) + norm(q - b), -1};
  }

  /// The same with bends at one limit, or at two in a row: relaxed once, which is exact for a
  /// single bend after a point and never too short.
  [[nodiscard]] Reach reach_by(const Label& label, const Point& eye, int limit,
                               const Point& q) const {
    const Point b = bend_point(reflex_[label.limit[limit]], eye, q);
    return {b, way_to(label, b) + norm(q - b), limit};
  }
  [[nodiscard]] Reach reach_by(const Label& label, const Point& eye, int first, int second,
                               const Point& q) const {
    const ReflexEdge<Real>& one = reflex_[label.limit[first]];
    const ReflexEdge<Real>& two = reflex_[label.limit[second]];
    Point c = bend_point(two, bend_point(one, eye, q), q);
    const Point b = bend_point(one, eye, c);
    c = bend_point(two, b, q);
    return {c, way_to(label, b) + norm(c - b) + norm(q - c), first};
  }
  [[nodiscard]] Real way_to(const Label& label, const Point& q) const {
    return reach(label, q).length;
  }

  [[nodiscard, gnu::always_inline]] bool hides(Index edge, const Point& eye, const Point& q) const {
    const ReflexEdge<Real>& e = reflex_[edge];
    if (on_bright_side(e, eye, q)) [[likely]]
      return false;
    return EdgeView<Real>(e, eye).hides(q, slack);
  }

  /// The path with what hides q.
  [[nodiscard]] Reach measure(const Label& label, const Point& q) const {
    return measure(label, q, reach(label, q));
  }
  [[nodiscard]] Reach measure(const Label& label, const Point& q, const Reach& straight) const {
    Reach bent = straight;
    for (int k = 0; k < Label::limits && label.limit[k] != none; ++k)
      if (hides(label.limit[k], straight.eye, q)) {
        const Reach other = reach_by(label, straight.eye, k, q);
        if (other.length > bent.length || bent.bend < 0) bent = other;
      }
    const int k = bent.bend;
    if (k < 0) return straight;
    // The way to the bend may be hidden itself, or the way on.
    const Reach one = bent;
    for (int j = 0; j < Label::limits && label.limit[j] != none; ++j) {
      if (j == k) continue;
      Reach both = one;
      if (hides(label.limit[j], straight.eye, one.eye))
        both = reach_by(label, straight.eye, j, k, q);
      else if (hides(label.limit[j], one.eye, q))
        both = reach_by(label, straight.eye, k, j, q);
      if (both.length > bent.length) bent = both;
    }
    return bent;
  }

  /// Bends at a limit for good.
  void turn(Label& label, int limit, const Point& q) const {
    const Index edge = label.limit[limit];
    if (label.ring != none) {
      // If the edges are parallel, S turns about the old ring until it lies in line with the way to
      // the new one: exact. Else the bend becomes the source.
      const ReflexEdge<Real>& ring = reflex_[label.ring];
      const Point c = reach_by(label, reach(label, q).eye, limit, q).eye;
      const Point b = bend_point(ring, label.source, c);
      const Real walked = norm(b - label.source), on = norm(c - b);
      const Real at = dot(b - ring.end[0], ring.direction);
      const bool parallel = std::abs(dot(ring.direction, reflex_[edge].direction)) > Real(1 - 1e-6);
      if (parallel && at > 0 && at < ring.length && on > 0) {
        label.source = b + walked / on * (b - c);
      } else {
        label.sigma += walked;
        label.source = b;
      }
    }
    label.path = SolidPath::bent(label.path, edge);
    label.ring = edge;
    for (int k = limit; k + 1 < Label::limits; ++k) label.limit[k] = label.limit[k + 1];
    label.limit[Label::limits - 1] = none;
  }

  static void clear_limits(Label& label) {
    for (Index& limit : label.limit) limit = none;
  }

  [[nodiscard]] bool hides_all(Index edge, const Point& eye, const Point& a, const Point& b,
                               const Point& c) const {
    const EdgeView<Real> view(reflex_[edge], eye);
    constexpr Real small = Real(1e-8);
    return !view.lights(a, small) && !view.lights(b, small) && !view.lights(c, small);
  }

  /// The full rule over one face.
  [[gnu::noinline]] void cross_fully(Index t, Index face, Index across, Real known,
                                     bool last_resort) const {
    const Index u = across >> TetAcross::tet_shift;
    const Label& from = labels_[t];
    const Point q = tets_[u].centre;
    Reach path = reach(from, q);
    if (!(path.length < known)) return;
    const Index* corner = tets_[t].corner;
    const Index* order = tet_face_corners[face];
    const Point &a = points_[corner[order[0]]], &b = points_[corner[order[1]]],
                &c = points_[corner[order[2]]];
    const bool through = passes(path.eye, q, a, b, c, tolerance);
    // A line that misses the face passes it if it bends at an edge known here.
    if (!through && !last_resort && !may_bend(t, path.eye, q)) return;
    Label label = from;
    gather(t, u, label, q, path);
    if (label.limit[0] != none || label.ring != from.ring) {
      const Point eye = path.eye;
      path = measure(label, q, path);
      if (!(path.length < known)) return;
      if (path.bend >= 0 && hides_all(label.limit[path.bend], eye, a, b, c)) {
        turn(label, path.bend, q);
        path = measure(label, q);
      }
    }
    if (!(path.bend < 0 && label.ring == from.ring ? through
                                                   : passes(path.eye, q, a, b, c, tolerance))) {
      if (!last_resort) return;
      bend_anywhere(label, path, q, a, b, c);
    }
    if (!(path.length < known)) return;
    label.centre = path.length;
    labels_[u] = label;
    front_->accept(u, across & TetAcross::face_mask, path.length, front_->source(t));
    prefetch(u);
  }

  /// Is there an edge in t's memory, or at t, that hides q?
  [[nodiscard]] bool may_bend(Index t, const Point& eye, const Point& q) const {
    for (const Index limit : labels_[t].limit) {
      if (limit == none) break;
      if (hides(limit, eye, q)) return true;
    }
    if (Index e = tets_[t].reflex; e != none)
      for (;; ++e) {
        const Index edge = list_[e] >> ReflexEntry::edge_shift;
        if (edge != labels_[t].ring && hides(edge, eye, q)) return true;
        if (list_[e] & ReflexEntry::last) break;
      }
    return false;
  }

  struct Candidates {
    Index edge[24];
    int count = 0;
    void add(Index e, Index except = none) {
      if (e == none || e == except || count == 24) return;
      for (int i = 0; i < count; ++i)
        if (edge[i] == e) return;
      edge[count++] = e;
    }
  };

  /// Chooses which edges the label remembers for q in u: its own, those of t, and those of
  /// neighbours of u that look at the same scene.
  void gather(Index t, Index u, Label& label, const Point& q, Reach& straight) const {
    Candidates found;
    for (const Index limit : label.limit) found.add(limit);
    const int own = found.count;
    if (Index e = tets_[t].reflex; e != none)
      for (;; ++e) {
        found.add(list_[e] >> ReflexEntry::edge_shift, label.ring);
        if (list_[e] & ReflexEntry::last) break;
      }
    if (u != sentinel_)
      for (const Index across : tets_[u].across) {
        const Index v = across >> TetAcross::tet_shift;
        if (v == t || v == sentinel_ || !front_->reached(v)) continue;
        const Label& other = labels_[v];
        if (other.path == label.path) {
          for (const Index limit : other.limit) found.add(limit, label.ring);
        } else if (other.ring != none && SolidPath::before(other.path, other.ring) == label.path) {
          found.add(other.ring, label.ring);
        }
      }
    if (found.count == own) return;
    // An edge that hides the ring itself comes before it.
    if (label.ring != none)
      for (int i = own; i < found.count; ++i) {
        const Index edge = found.edge[i];
        if (!hides(edge, label.source, straight.eye)) continue;
        label.path = SolidPath::bent(SolidPath::before(label.path, label.ring), edge);
        found.edge[i] = label.ring;
        label.ring = edge;
        straight = reach(label, q);
      }
    if (found.count <= Label::limits) {
      for (int i = own; i < found.count; ++i) label.limit[i] = found.edge[i];
      return;
    }
    Point eye = straight.eye;
    clear_limits(label);
    // The nearest, and first of all those that hide q.
    Real key[Label::limits];
    int count = 0;
    const auto choose = [&](int first) {
      count = first;
      for (int i = 0; i < found.count; ++i) {
        const Index edge = found.edge[i];
        if (edge == label.ring || (first > 0 && edge == label.limit[0])) continue;
        const EdgeView<Real> view(reflex_[edge], eye);
        const Real close2 = view.closeness(q);
        if (!(close2 < std::numeric_limits<Real>::infinity())) continue;
        const bool dark = view.hides(q, slack);
        const Real k = dark ? Real(-1) / (1 + close2) : close2;
        int place = count < Label::limits ? count++ : Label::limits;
        for (; place > first && k < key[place - 1]; --place)
          if (place < Label::limits)
            key[place] = key[place - 1], label.limit[place] = label.limit[place - 1];
        if (place < Label::limits) key[place] = k, label.limit[place] = edge;
      }
    };
    choose(0);
    if (count == 0 || !(key[0] < 0)) return;
    // What else is in the way is so from the bend.
    for (int k = 1; k < Label::limits; ++k) label.limit[k] = none;
    eye = reach_by(label, eye, 0, q).eye;
    choose(1);
  }

  /// No straight line: over the best point of the face's edges.
  void bend_anywhere(Label& label, Reach& path, const Point& q, const Point& a, const Point& b,
                     const Point& c) const {
    const Point* corner[3] = {&a, &b, &c};
    Real best = std::numeric_limits<Real>::infinity();
    Point at = a;
    Real walked = 0;
    for (int i = 0; i < 3; ++i) {
      const Point p = bend_point(*corner[i], *corner[i == 2 ? 0 : i + 1], path.eye, q);
      const Real w = norm(p - path.eye), d = w + norm(q - p);
      if (d < best) best = d, at = p, walked = w;
    }
    walked += path.length - norm(q - path.eye);
    label.source = at;
    label.sigma = walked;
    label.ring = none;
    clear_limits(label);
    label.path = SolidPath::bent(label.path, none - 1);
    path = {at, walked + norm(q - at), -1};
  }

  bool seed(Index t, const Point& at, Index hinge, Real sigma, Index source) const {
    const Real d = sigma + norm(tets_[t].centre - at);
    if (!(d < to_beat(t))) return false;
    Label& label = labels_[t];
    label.source = at;
    label.sigma = sigma;
    label.centre = d;
    label.ring = none;
    clear_limits(label);
    label.path = SolidPath::from_source(source);
    front_->accept(t, hinge, d, source);
    return true;
  }

  [[gnu::always_inline]] void prefetch(Index t) const {
    for (const Index across : tets_[t].across) {
      __builtin_prefetch(&tets_[across >> TetAcross::tet_shift]);
      __builtin_prefetch(&labels_[across >> TetAcross::tet_shift]);
    }
  }

  const TetMesh<Real>* mesh_;
  const TetRecord<Real>* tets_;
  const Point* points_;
  const ReflexEdge<Real>* reflex_;
  const Index* list_;
  Index sentinel_;
  bool any_reflex_;
  Label* labels_;
  Front* front_;
};

}  // namespace plexway
