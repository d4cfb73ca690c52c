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
    labels_[sentinel_].ring = labels_[sentinel_].limit[0] = labels_[sentinel_].limit[1] = none;
  }
  [[nodiscard]] SolidRule on(Front& front) const {
    SolidRule rule = *this;
    rule.front_ = &front;
    return rule;
  }

  [[nodiscard]] Real distance(Index t) const { return labels_[t].centre; }
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

  /// Longest way worth comparing with from the centre of t over face i to the next centre: through
  /// the face's centroid.
  [[nodiscard]] Real way(Index t, Index i) const {
    const TetRecord<Real>& r = tets_[t];
    Point middle = {0, 0, 0};
    for (const Index k : tet_face_corners[i])
      middle = middle + Real(1) / 3 * points_[r.corner[k]];
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
  void cross(Index t, Index face, bool last_resort) const {
    const Index across = tets_[t].across[face];
    const Index u = across >> TetAcross::tet_shift;
    const Label& from = labels_[t];
    const Real known = to_beat(u);
    const Point q = tets_[u].centre;
    if (from.ring == none) {
      if (!(from.sigma + norm(q - from.source) < known)) return;
    } else if (!(reach(from, q).length < known)) {
      return;
    }
    Label label = from;
    Reach path;
    if (any_reflex_) {
      gather(t, u, label, q);
      path = measure(label, q);
      if (!(path.length < known)) return;
    } else {
      path = reach(label, q);
    }
    const Index* corner = tets_[t].corner;
    const Index* order = tet_face_corners[face];
    const Point &a = points_[corner[order[0]]], &b = points_[corner[order[1]]],
                &c = points_[corner[order[2]]];
    if (path.bend >= 0) {
      const Index edge = label.limit[path.bend];
      if (hides_all(edge, reach(label, q).eye, a, b, c)) {
        turn(label, path.bend, q);
        path = measure(label, q);
      }
    }
    if (!passes(path.eye, q, a, b, c, tolerance)) {
      if (!last_resort) return;
      bend_anywhere(label, path, q, a, b, c);
      if (!(path.length < known)) return;
    }
    if (!(path.length < known)) return;
    label.centre = path.length;
    labels_[u] = label;
    front_->accept(u, across & TetAcross::face_mask, path.length, front_->source(t));
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

  /// Length of the path to corner i of a reached tetrahedron.
  [[nodiscard]] Real corner_distance(Index t, Index i) const {
    const Point q = points_[tets_[t].corner[i]];
    Label label = labels_[t];
    if (tets_[t].reflex == none && label.limit[0] == none) return reach(label, q).length;
    gather(t, sentinel_, label, q);
    return measure(label, q).length;
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
    label.ring = label.limit[0] = label.limit[1] = none;
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

  static constexpr Real tolerance = Real(1e-4);
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

  /// The same with a bend at a limit.
  [[nodiscard]] Reach reach_by(const Label& label, int limit, const Point& q) const {
    const ReflexEdge<Real>& edge = reflex_[label.limit[limit]];
    Point before = reach(label, q).eye;
    Point b = bend_point(edge, before, q);
    if (label.ring != none) {
      before = reach(label, b).eye;
      b = bend_point(edge, before, q);
    }
    return {b, reach(label, b).length + norm(q - b), limit};
  }

  /// The path with what hides q.
  [[nodiscard]] Reach measure(const Label& label, const Point& q) const {
    const Reach straight = reach(label, q);
    Reach longest = straight;
    for (int k = 0; k < 2; ++k) {
      if (label.limit[k] == none) break;
      if (!shade(reflex_[label.limit[k]], straight.eye, q, slack).dark) continue;
      const Reach bent = reach_by(label, k, q);
      if (bent.length > longest.length) longest = bent;
    }
    return longest;
  }

  /// Bends at a limit for good.
  void turn(Label& label, int limit, const Point& q) const {
    const Index edge = label.limit[limit];
    if (label.ring != none) {
      const Point b = reach_by(label, limit, q).eye;
      const Reach r = reach(label, b);
      label.sigma += norm(r.eye - label.source);
      label.source = r.eye;
    }
    label.path = SolidPath::bent(label.path, edge);
    label.ring = edge;
    label.limit[limit] = label.limit[1];
    label.limit[1] = none;
  }

  [[nodiscard]] bool hides_all(Index edge, const Point& eye, const Point& a, const Point& b,
                               const Point& c) const {
    for (const Point* p : {&a, &b, &c}) {
      const Shade<Real> s = shade(reflex_[edge], eye, *p, slack);
      if (s.light > Real(1e-4) || s.beyond < Real(0.999)) return false;
    }
    return true;
  }

  /// Chooses which edges the label remembers for q in u: its own, those of t, and those of
  /// neighbours of u that look at the same scene.
  void gather(Index t, Index u, Label& label, const Point& q) const {
    Index chosen[2] = {none, none};
    Real key[2] = {std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()};
    const Point eye = reach(label, q).eye;
    const auto consider = [&](Index edge) {
      if (edge == none || edge == label.ring || edge == chosen[0] || edge == chosen[1]) return;
      const Shade<Real> s = shade(reflex_[edge], eye, q, slack);
      const Real k = s.dark ? Real(-1) / (1 + s.angle2) : s.angle2;
      if (k < key[0]) {
        key[1] = key[0], chosen[1] = chosen[0];
        key[0] = k, chosen[0] = edge;
      } else if (k < key[1]) {
        key[1] = k, chosen[1] = edge;
      }
    };
    consider(label.limit[0]);
    consider(label.limit[1]);
    if (Index e = tets_[t].reflex; e != none)
      for (;; ++e) {
        consider(list_[e] >> ReflexEntry::edge_shift);
        if (list_[e] & ReflexEntry::last) break;
      }
    if (u != sentinel_)
      for (const Index across : tets_[u].across) {
        const Index v = across >> TetAcross::tet_shift;
        if (v == t || v == sentinel_ || !front_->reached(v)) continue;
        const Label& other = labels_[v];
        if (other.path == label.path) {
          consider(other.limit[0]);
          consider(other.limit[1]);
        } else if (other.ring != none &&
                   SolidPath::before(other.path, other.ring) == label.path) {
          consider(other.ring);
        }
      }
    label.limit[0] = chosen[0];
    label.limit[1] = chosen[1];
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
    label.ring = label.limit[0] = label.limit[1] = none;
    label.path = SolidPath::bent(label.path, none - 1);
    path = {at, walked + norm(q - at), -1};
  }

  bool seed(Index t, const Point& at, Index hinge, Real sigma, Index source) const {
    const Real d = sigma + norm(tets_[t].centre - at);
    if (!(d < to_beat(t))) return false;
    labels_[t] = {at, sigma, d, none, {none, none}, SolidPath::from_source(source)};
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
