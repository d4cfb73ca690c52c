#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <plexway/solid/tet_mesh.hpp>

#include "labels/solid/solid_label.hpp"
#include "labels/solid/solid_paths.hpp"
#include "labels/solid/solid_sight.hpp"

namespace plexway {

/// Corners of face i, anticlockwise as seen from outside.
inline constexpr Index tet_face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

#include "kernel/text_begin.inl"

/// The rule of solids in mixed domains where strings do not go: a label is a string from a point
/// around reflex edges, which are the only places where paths bend, and is walked through the
/// tetrahedra before it counts.
template <class Real, class Front>
class SolidRule : public SolidPaths<Real> {
  using Paths = SolidPaths<Real>;
  using View = kernel::SolidSight<Real>;
  using Paths::abs, Paths::clamp, Paths::max, Paths::min, Paths::sqrt;
  using Paths::at_an_end, Paths::clear_bends, Paths::edges_of, Paths::fixed_bends, Paths::is_beside,
      Paths::bent_along, Paths::label_bends, Paths::leave_first, Paths::leave_out, Paths::may_turn,
      Paths::measure, Paths::most_bends, Paths::own_edges, Paths::own_edges_, Paths::pull,
      Paths::reflex_, Paths::reflex_edge, Paths::set_bends, Paths::slide, Paths::taut_end,
      Paths::taut_to, Paths::unfolded_door;
  using Paths::beside_door;
  using typename Paths::Edge, typename Paths::Taut;
  using typename View::FromEdge;
  using View::bend_point, View::in_crack, View::is_along, View::is_cracks, View::normal_to,
      View::passes, View::presses;
  using View::crossing_along, View::from_edge, View::point_on, Paths::is_unfolded;

 public:
  using Paths::begins_beside;
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;

  SolidRule(const TetMesh<Real>& mesh, Front& front)
      : Paths(mesh.reflex_edges().data(), static_cast<Index>(mesh.reflex_edges().size())),
        mesh_(&mesh),
        tets_(mesh.tets().data()),
        points_(mesh.points().data()),
        list_(mesh.reflex_list().data()),
        sentinel_(static_cast<Index>(mesh.tet_count())),
        any_reflex_(!mesh.reflex_edges().empty()),
        any_cracks_(mesh.has_crack()),
        front_(&front) {
    Label nearest = point_label({0, 0, 0}, 0);
    nearest.centre = -1;  // nothing is nearer: never accepted
    front_->put(sentinel_, nearest);
  }
#include "labels/solid/solid_walk.inl"

  /// Vertices, a mark each, that share their place with others, as on the faces of a crack;
  /// referred to. A source there is seen from the side alone that it is on.
  void tell_sides(std::span<const char> torn) { torn_ = torn.empty() ? nullptr : torn.data(); }

#include "labels/solid/solid_step.inl"

  [[nodiscard]] Real distance(Index t) const { return front_->label(t).centre; }
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

  /// Can an offer be dropped that another does not make up for? Not in a convex solid, but for what
  /// passes tetrahedra without volume.
  [[nodiscard]] bool drops() const {
    return any_reflex_ || !mesh_->pinched().empty() || !mesh_->pinched_edges().empty() ||
           mesh_->summary().degenerate_tets > 0;
  }
  /// No more than the square of `way`; cheap.
  [[nodiscard]] Real least_way2(Index t, Index u) const {
    const Point between = tets_[u].centre - tets_[t].centre;
    return dot(between, between);
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
    const Real known = to_beat(u);
    const Point& q = tets_[u].centre;
    const Real straight2 = straight_squared(from, q);
    if (!may_beat(from, straight2, known)) return;
    if (any_reflex_ || last_resort) {
      cross_fully(t, face, across, known, last_resort);
      return;
    }
    Label label;
    if (!offer_straight(from, t, face, q, label)) return;
    front_->accept(u, across & TetAcross::face_mask, label, label.centre, front_->source(t));
    prefetch_around(u);
  }

  /// A path of length sigma ends at corner i of t; false if t knows a better one.
  bool seed_corner(Index t, Index i, Real sigma, Index source) const {
    return seed(t, points_[tets_[t].corner[i]], (i + 1) & 3, sigma, source);
  }
  /// A point of t.
  [[nodiscard]] Point place(Index t, const std::array<double, 4>& barycentric) const {
    Point at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      at = at + static_cast<Real>(barycentric[i]) * points_[tets_[t].corner[i]];
    return at;
  }
  /// S at that point.
  [[nodiscard]] static Label point_label(const Point& at, Real sigma) {
    Label label = {at, sigma, 0, {}, none};
    clear_bends(label);
    return label;
  }
  /// The same where S is a point of t: of several places in one it is on the side of t.
  [[nodiscard]] Label point_label(Index t, const Point& at, Real sigma) const {
    Label label = point_label(at, sigma);
    if (torn_ != nullptr && is_torn(t, at)) label.door = SolidDoor::beside + t;
    return label;
  }
  /// A path of length sigma ends inside t.
  void seed_inside(Index t, const std::array<double, 4>& barycentric, Real sigma,
                   Index source) const {
    const Point at = place(t, barycentric);
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = seed(t, at, 0, sigma, source);
    const Label kept = front_->label(t);
    const Index kept_source = front_->source(t);
    if (!better) {
      front_->put(t, point_label(t, at, sigma));
      front_->set_source(t, source);
    }
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    front_->put(t, kept);
    front_->set_source(t, kept_source);
  }

  /// Length of the path to corner i of a reached tetrahedron, as far as it is below `known`.
  [[nodiscard]] Real corner_distance(Index t, Index i,
                                     Real known = std::numeric_limits<Real>::infinity()) const {
    return corner_reach(front_->label(t), t, i, known, nowhere());
  }
  /// Do paths bend at edges?
  [[nodiscard]] bool bends() const { return any_reflex_; }
  /// The least distance that tetrahedra offer a vertex, which is corner c % 4 of c / 4 for each c
  /// of `around`: offer(tetrahedron, distance), unless none is reached. First by their own strings,
  /// one of those that came the same way; then around what hides some of them.
  template <class Offer>
  void ask_around(std::span<const Index> around, const Offer& offer) const {
    Real best = std::numeric_limits<Real>::infinity();
    Index by = none;
    const auto take = [&](Index t, Real d) {
      if (!(d < best)) return;
      best = d;
      by = t;
    };
    Hidden hidden[most_hidden];
    std::size_t count = 0;
    for (const Index c : around) {
      const Index t = c / 4;
      if (!front_->reached(t)) continue;
      const Label& label = front_->label(t);
      if (by != none && same_way(label, front_->label(by))) continue;
      Hit own;
      const Real d = corner_sight(label, t, c % 4, best, own);
      if (own.tet == none)
        take(t, d);
      else if (count < most_hidden)
        hidden[count++] = {d, c, own};
      else
        take(t, corner_reach(label, t, c % 4, best, own));
    }
    std::sort(hidden, hidden + count, [](const Hidden& a, const Hidden& b) {
      return a.distance < b.distance || (a.distance == b.distance && a.corner < b.corner);
    });

    constexpr Real worth = Real(1e-4);  // what hides it, one from the same S has gone around
    for (std::size_t n = 0; n < count && hidden[n].distance < best; ++n) {
      const Index t = hidden[n].corner / 4;
      if (by != none && hidden[n].distance > best * (1 - worth) &&
          same_source(front_->label(t), front_->label(by)))
        continue;
      take(t, corner_reach(front_->label(t), t, hidden[n].corner % 4, best, hidden[n].own));
    }
    if (by != none) offer(by, best);
  }
  /// Labels of u offer a path over the edge (v, w) of t, which touches u in that edge only.
  bool pass_edge(Index u, Index t, Index v, Index w, Real known_gain) const {
    const Point q = tets_[t].centre;
    const Point b = bend_point(points_[v], points_[w], seen_from(u, tets_[u].centre).eye, q);
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    const Real walked = reach_at(front_->label(u), u, tets_[u].centre, u, b, infinity, nowhere());
    if (!(walked < infinity)) return false;
    Label label = point_label(t, b, walked);
    label.centre = label.sigma + norm(q - b);
    if (!(label.centre < to_beat(t) * known_gain)) return false;
    Index face = 0;  // one that contains the edge
    while (tets_[t].corner[face] == v || tets_[t].corner[face] == w) ++face;
    front_->accept(t, face, label, label.centre, front_->source(u));
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    return true;
  }

#include "labels/solid/solid_shared.inl"

  /// Fetches what the expansion of t's neighbours will need.
  [[gnu::always_inline]] void prefetch_around(Index t) const {
    for (const Index across : tets_[t].across) {
      __builtin_prefetch(&tets_[across >> TetAcross::tet_shift]);
      __builtin_prefetch(&front_->label(across >> TetAcross::tet_shift));
    }
  }

 private:
  /// A corner whose string is hidden, its length, and where it leaves the solid.
  struct Hidden {
    Real distance;
    Index corner;
    Hit own;
  };
  static constexpr std::size_t most_hidden = 32;

  /// The last bend on the way from the source of t over `middle` to q, which is walked from `end`
  /// in u.
  [[nodiscard]] Sight sight(Index t, const Point& middle, Index u, const Point& end,
                            const Point& q) const {
    Taut s;
    const bool found = find_sight(t, middle, u, end, q, s);
    return last_bend(found ? s : taut_to(front_->label(t), tets_[t].centre));
  }
  bool find_sight(Index t, const Point& middle, Index u, const Point& end, const Point& q,
                  Taut& s) const {
    const Label& label = front_->label(t);
    if (any_reflex_)
      return find_taut(label, t, middle, u, end, q, std::numeric_limits<Real>::infinity(),
                       nowhere(), s);
    s = taut_to(label, q);
    return true;
  }
  [[nodiscard]] Sight last_bend(const Taut& s) const {
    return {s.at[s.bends], s.extent - norm(taut_end(s) - s.at[s.bends])};
  }
  bool enter(Index t, std::size_t face, const Label& label, Index source) const {
    if (!(label.centre < to_beat(t))) return false;
    front_->accept(t, face, label, label.centre, source);
    cross(t, static_cast<Index>(face), false);  // which `expand` leaves out
    return true;
  }

  /// The full rule over one face.
  [[gnu::noinline]] void cross_fully(Index t, Index face, Index across, Real known,
                                     bool last_resort) const {
    const Index u = across >> TetAcross::tet_shift;
    Label label;
    if (!offer_bent(front_->label(t), t, face, u, known, last_resort, label)) return;
    front_->accept(u, across & TetAcross::face_mask, label, label.centre, front_->source(t));
    prefetch_around(u);
  }

  bool seed(Index t, const Point& at, Index hinge, Real sigma, Index source) const {
    const Real d = sigma + norm(tets_[t].centre - at);
    if (!(d < to_beat(t))) return false;
    Label label = point_label(t, at, sigma);
    label.centre = d;
    front_->accept(t, hinge, label, d, source);
    return true;
  }
  /// Does a point of t lie where all corners nearby share their places with others?
  [[nodiscard]] bool is_torn(Index t, const Point& at) const {
    const Index* const corner = tets_[t].corner;
    Real weight = 0, others = 0;
    for (Index i = 0; i < 4; ++i) {
      const Point &a = points_[corner[(i + 1) & 3]], &b = points_[corner[(i + 2) & 3]],
                  &c = points_[corner[(i + 3) & 3]];
      const Real share = abs(dot(at - a, normal_to(b - a, c - a)));
      weight += share;
      if (torn_[corner[i]] == 0) others += share;
    }
    return others <= nudge * weight;
  }

  // What solid_step.inl reads.
  [[gnu::always_inline]] const Point& centre_of(Index t) const { return tets_[t].centre; }
  [[gnu::always_inline]] const Point& corner_of(Index t, Index i) const {
    return points_[tets_[t].corner[i]];
  }
  [[gnu::always_inline]] const Point& face_corner(Index t, Index face, Index k) const {
    return corner_of(t, tet_face_corners[face][k]);
  }
  [[gnu::always_inline]] Index vertex_of(Index t, Index i) const { return tets_[t].corner[i]; }
  [[gnu::always_inline]] static Real component(const Point& p, Index i) {
    constexpr Real Point::*axis[3] = {&Point::x, &Point::y, &Point::z};
    return p.*axis[i];
  }
  static Index face_corner_number(Index face, Index k) { return tet_face_corners[face][k]; }
  [[gnu::always_inline]] Index neighbour(Index t, Index i) const {
    return tets_[t].across[i] >> TetAcross::tet_shift;
  }
  [[gnu::always_inline]] Index face_beyond(Index t, Index i) const {
    return tets_[t].across[i] & TetAcross::face_mask;
  }
  Index no_tet() const { return sentinel_; }
  [[gnu::always_inline]] Index first_reflex(Index t) const { return tets_[t].reflex; }
  [[gnu::always_inline]] Index reflex_entry(Index e) const { return list_[e]; }
  static Index entry_edge(Index entry) { return entry >> ReflexEntry::edge_shift; }
  static bool entry_is_last(Index entry) { return (entry & ReflexEntry::last) != 0; }
  bool any_reflex() const { return any_reflex_; }
  bool any_cracks() const { return any_cracks_; }
  [[gnu::always_inline]] bool reached(Index t) const { return front_->reached(t); }
  [[gnu::always_inline]] const Label& label_of(Index t) const { return front_->label(t); }
  /// A line that left the solid in t on its way to the label's source: did it leave by the door?
  [[nodiscard]] bool comes_in(const Label& label, Index t) const {
    if (label.door >= unfolded_door) return false;
    const Index door = label.door / 4, face = label.door % 4;
    const Point &a = face_corner(door, face, 0), &b = face_corner(door, face, 1),
                &c = face_corner(door, face, 2);
    const Point n = normal_to(b - a, c - a);
    return std::abs(dot(n, tets_[t].centre - a)) < norm(n);
  }

  const TetMesh<Real>* mesh_;
  const TetRecord<Real>* tets_;
  const Point* points_;
  const Index* list_;
  Index sentinel_;
  bool any_reflex_, any_cracks_;
  const char* torn_ = nullptr;
  Front* front_;
};

#include "kernel/text_end.inl"

}  // namespace plexway
