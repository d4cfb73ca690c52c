#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/propagate/solid_paths.hpp>
#include <plexway/propagate/solid_sight.hpp>

namespace plexway {

/// Corners of face i, anticlockwise as seen from outside.
inline constexpr Index tet_face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Visibility::saddles on solids in space: a virtual source is a point, or a ring about a reflex
/// edge; paths bend at reflex edges only, and each label remembers four that may hide its source.
template <class Real, class Front>
class SolidRule : public SolidPaths<Real> {
  using Paths = SolidPaths<Real>;
  using Paths::clear_limits, Paths::hides, Paths::hides_all, Paths::measure, Paths::name_of,
      Paths::reach, Paths::reach_by, Paths::reflex_, Paths::slack, Paths::turn;
  using typename Paths::Reach;

 public:
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;

  SolidRule(const TetMesh<Real>& mesh, Front& front)
      : Paths(mesh.reflex_edges().data()),
        mesh_(&mesh),
        tets_(mesh.tets().data()),
        points_(mesh.points().data()),
        list_(mesh.reflex_list().data()),
        sentinel_(static_cast<Index>(mesh.tet_count())),
        any_reflex_(!mesh.reflex_edges().empty()),
        own_rings_(static_cast<Index>(mesh.reflex_edges().size())),
        front_(&front) {
    Label nearest = {};
    nearest.centre = -1;  // nothing is nearer: never accepted
    nearest.ring = none;
    clear_limits(nearest);
    front_->put(sentinel_, nearest);
  }
  /// The same rule on the front of another executor.
  template <class Other>
  [[nodiscard]] SolidRule<Real, Other> on(Other& front) const {
    return SolidRule<Real, Other>(*this, front);
  }

  [[nodiscard]] Real distance(Index t) const { return front_->label(t).centre; }
  /// Says which way the path came; labels that agree in it agree about distances.
  [[nodiscard]] Index path(Index t) const { return front_->label(t).path; }
  /// What a label for t must be below: by more than rounding.
  [[nodiscard, gnu::always_inline]] Real to_beat(Index t) const {
    constexpr Real gain = Real(1) - Real(16) * std::numeric_limits<Real>::epsilon();
    return front_->reached(t) ? front_->label(t).centre * gain
                              : std::numeric_limits<Real>::infinity();
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
  /// No more than the square of `way`; cheap.
  [[nodiscard]] Real least_way2(Index t, Index u) const {
    const Point between = tets_[u].centre - tets_[t].centre;
    return dot(between, between);
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
    const Label& from = front_->label(t);
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
    Label label = from;
    label.centre = from.sigma + std::sqrt(straight2);
    front_->accept(u, across & TetAcross::face_mask, label, label.centre, front_->source(t));
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
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = seed(t, at, 0, sigma, source);
    const Label kept = front_->label(t);
    const Index kept_source = front_->source(t);
    if (!better) {
      front_->put(t, point_label(at, sigma));
      front_->set_source(t, source);
    }
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    front_->put(t, kept);
    front_->set_source(t, kept_source);
  }

  /// Length of the path to corner i of a reached tetrahedron, as far as it is below `known`.
  [[nodiscard]] Real corner_distance(Index t, Index i,
                                     Real known = std::numeric_limits<Real>::infinity()) const {
    return distance_at(t, points_[tets_[t].corner[i]], known);
  }
  /// The same to any point of it, or of a neighbour that sees t's source as t does.
  [[nodiscard]] Real distance_at(Index t, const Point& q,
                                 Real known = std::numeric_limits<Real>::infinity()) const {
    const Label& from = front_->label(t);
    const Real straight = from.sigma + norm(q - from.source);
    if (!any_reflex_ || !(straight < known)) return straight;
    Reach simple = reach(from, q);
    if (!(simple.length < known)) return simple.length;
    if (tets_[t].reflex == none) return measure(from, q, simple, known).length;
    Label label = from;
    gather(t, sentinel_, label, q, simple);
    return measure(label, q, simple, known).length;
  }

  /// Length of the path from the source of t through a face to that of the neighbour; +inf if none
  /// passes there.
  [[nodiscard]] Real meeting_over(Index t, Index face) const {
    const Index u = tets_[t].across[face] >> TetAcross::tet_shift;
    const Index* order = tet_face_corners[face];
    const Point &a = points_[tets_[t].corner[order[0]]], &b = points_[tets_[t].corner[order[1]]],
                &c = points_[tets_[t].corner[order[2]]];
    const Point here = seen_from(t, tets_[u].centre).eye, there = seen_from(u, tets_[t].centre).eye;
    if (!passes(here, there, a, b, c, tolerance)) return std::numeric_limits<Real>::infinity();
    const Point q = plane_crossing(here, there, a, b, c);
    return distance_at(t, q) + distance_at(u, q);
  }

  /// Labels of u offer a path over the edge (v, w) of t, which touches u in that edge only.
  bool pass_edge(Index u, Index t, Index v, Index w, Real known_gain) const {
    const Label& from = front_->label(u);
    const Point q = tets_[t].centre;
    const Reach before = reach(from, bend_point(points_[v], points_[w], from.source, q));
    const Point b = bend_point(points_[v], points_[w], before.eye, q);
    Label label;
    const Reach there = measure(from, b);
    label.source = b;
    label.sigma = there.length;
    label.ring = none;
    clear_limits(label);
    label.path = name_of(b, label.sigma);
    label.centre = label.sigma + norm(q - b);
    if (!(label.centre < to_beat(t) * known_gain)) return false;
    Index face = 0;  // one that contains the edge
    while (tets_[t].corner[face] == v || tets_[t].corner[face] == w) ++face;
    front_->accept(t, face, label, label.centre, front_->source(u));
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    return true;
  }

  // What follows is for simplices of other complexes that share a face, an edge or a vertex.

  /// Edges beyond the solid's own at which paths may bend, for `enter_edge`: the ring numbered
  /// mesh.reflex_edges().size() + i is edge i here, behind a copy of the solid's own.
  void set_rings(std::span<const ReflexEdge<Real>> own_and_further) {
    reflex_ = own_and_further.data();
    any_reflex_ = !own_and_further.empty();
  }

  struct Sight {
    Point eye;
    Real sigma;
  };
  /// The last bend on the way from the source of t to q, a point of its boundary.
  [[nodiscard]] Sight seen_from(Index t, const Point& q) const {
    Label label = front_->label(t);
    Reach simple = reach(label, q);
    gather(t, sentinel_, label, q, simple);
    const Reach path = measure(label, q, simple);
    return {path.eye, path.length - norm(q - path.eye)};
  }

  /// A source at `eye`, outside, comes in over a face of t.
  bool enter_face(Index t, std::size_t face, const Point& eye, Real sigma, Index source) const {
    const Point q = tets_[t].centre;
    Label label = point_label(eye, sigma);
    Reach path = {eye, sigma + norm(q - eye), -1};
    if (!(path.length < to_beat(t))) return false;
    // The face as seen from within, where the path goes on.
    const Index* order = tet_face_corners[face];
    const Index* corner = tets_[t].corner;
    const Point &a = points_[corner[order[0]]], &b = points_[corner[order[2]]],
                &c = points_[corner[order[1]]];
    if (!passes(path.eye, q, a, b, c, tolerance)) bend_anywhere(label, path, q, a, b, c);
    return enter(t, face, label, path.length, source);
  }

  /// A source that is seen over an edge of t only: a ring about it.
  bool enter_edge(Index t, std::size_t face, Index ring, const Point& eye, Real sigma,
                  Index source) const {
    const Index path = SolidPath::bent(name_of(eye, sigma), ring);
    Label label = {eye, sigma, 0, ring, {}, path};
    clear_limits(label);
    return enter(t, face, label, reach(label, tets_[t].centre).length, source);
  }

  static constexpr Real tolerance = Real(0.1);

 private:
  template <class, class>
  friend class SolidRule;
  template <class Other>
  SolidRule(const SolidRule<Real, Other>& rule, Front& front)
      : Paths(rule.reflex_),
        mesh_(rule.mesh_),
        tets_(rule.tets_),
        points_(rule.points_),
        list_(rule.list_),
        sentinel_(rule.sentinel_),
        any_reflex_(rule.any_reflex_),
        own_rings_(rule.own_rings_),
        front_(&front) {}

  bool enter(Index t, std::size_t face, Label label, Real centre, Index source) const {
    if (!(centre < to_beat(t))) return false;
    label.centre = centre;
    front_->accept(t, face, label, centre, source);
    cross(t, static_cast<Index>(face), false);  // which `expand` leaves out
    return true;
  }

  /// The full rule over one face.
  [[gnu::noinline]] void cross_fully(Index t, Index face, Index across, Real known,
                                     bool last_resort) const {
    const Index u = across >> TetAcross::tet_shift;
    const Label& from = front_->label(t);
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
      path = measure(label, q, path, known);
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
    front_->accept(u, across & TetAcross::face_mask, label, path.length, front_->source(t));
    prefetch(u);
  }

  /// Is there an edge in t's memory, or at t, that hides q?
  [[nodiscard]] bool may_bend(Index t, const Point& eye, const Point& q) const {
    for (const Index limit : front_->label(t).limit) {
      if (limit == none) break;
      if (hides(limit, eye, q)) return true;
    }
    return own_hides(t, eye, q);
  }
  /// One at t?
  [[nodiscard]] bool own_hides(Index t, const Point& eye, const Point& q) const {
    if (Index e = tets_[t].reflex; e != none)
      for (;; ++e) {
        const Index edge = list_[e] >> ReflexEntry::edge_shift;
        if (edge != front_->label(t).ring && hides(edge, eye, q)) return true;
        if (list_[e] & ReflexEntry::last) break;
      }
    return false;
  }

  struct Candidates {
    Index edge[24];
    int count = 0;
    [[gnu::always_inline]] void add(Index e, Index except) {
      if (e == except || count == 24) return;
      for (int i = 0; i < count; ++i)
        if (edge[i] == e) return;
      edge[count++] = e;
    }
    [[gnu::always_inline]] void add(const Label& label, Index except) {
      for (const Index limit : label.limit) {
        if (limit == none) break;
        add(limit, except);
      }
    }
  };

  /// Chooses which edges the label remembers for q in u: its own, those of t, and those of
  /// neighbours of u that look at the same scene.
  void gather(Index t, Index u, Label& label, const Point& q, Reach& straight) const {
    Candidates found;
    for (const Index limit : label.limit) {
      if (limit == none) break;
      found.edge[found.count++] = limit;
    }
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
        const Label& other = front_->label(v);
        if (other.path == label.path) {
          if (std::memcmp(other.limit, label.limit, sizeof label.limit) != 0)
            found.add(other, label.ring);
        } else if (other.ring < own_rings_ &&
                   SolidPath::before(other.path, other.ring) == label.path) {
          found.add(other.ring, label.ring);
        }
      }
    if (found.count == own) return;
    // An edge that hides the ring itself comes before it.
    if (label.ring < own_rings_)
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
    // The one that hides q most closely comes first; what else is in the way is so from that bend.
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Point eye = straight.eye;
    Index bend = none;
    Real closest = infinity;
    for (int i = 0; i < found.count; ++i) {
      const Index edge = found.edge[i];
      const EdgeView<Real> view(reflex_[edge], eye);
      if (edge == label.ring || !view.hides(q, slack)) continue;
      const Real close2 = view.rank(q, slack, infinity).closeness;
      if (close2 < closest) closest = close2, bend = edge;
    }
    clear_limits(label);
    if (bend != none) {
      label.limit[0] = bend;
      eye = bend_point(reflex_[bend], eye, q);
    }
    // Then the nearest, and before them those that hide q.
    const int first = bend != none;
    int count = first;
    Real key[Label::limits];
    for (int i = 0; i < found.count; ++i) {
      const Index edge = found.edge[i];
      if (edge == label.ring || edge == bend) continue;
      const auto [close2, dark] =
          EdgeView<Real>(reflex_[edge], eye)
              .rank(q, slack, count < Label::limits ? infinity : key[Label::limits - 1]);
      if (!(close2 < infinity)) continue;
      const Real k = dark ? Real(-1) / (1 + close2) : close2;
      int place = count < Label::limits ? count++ : Label::limits;
      for (; place > first && k < key[place - 1]; --place)
        if (place < Label::limits)
          key[place] = key[place - 1], label.limit[place] = label.limit[place - 1];
      if (place < Label::limits) key[place] = k, label.limit[place] = edge;
    }
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
    label.path = name_of(at, walked);
    path = {at, walked + norm(q - at), -1};
  }

  static Label point_label(const Point& at, Real sigma) {
    Label label = {at, sigma, 0, none, {}, name_of(at, sigma)};
    clear_limits(label);
    return label;
  }

  bool seed(Index t, const Point& at, Index hinge, Real sigma, Index source) const {
    const Real d = sigma + norm(tets_[t].centre - at);
    if (!(d < to_beat(t))) return false;
    Label label = point_label(at, sigma);
    label.centre = d;
    front_->accept(t, hinge, label, d, source);
    return true;
  }

  [[gnu::always_inline]] void prefetch(Index t) const {
    for (const Index across : tets_[t].across) {
      __builtin_prefetch(&tets_[across >> TetAcross::tet_shift]);
      __builtin_prefetch(&front_->label(across >> TetAcross::tet_shift));
    }
  }

  const TetMesh<Real>* mesh_;
  const TetRecord<Real>* tets_;
  const Point* points_;
  const Index* list_;
  Index sentinel_;
  bool any_reflex_;
  Index own_rings_;  // rings from here on are further edges, which hide nothing
  Front* front_;
};

}  // namespace plexway
