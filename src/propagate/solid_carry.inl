// Ways from vertex to vertex (SolidBorders): a label's string to a vertex that is in none of the
// tetrahedra that keep it. Part of the body of SolidRule, see solid_rule.hpp; C++ only.

/// A further edge, the last.
[[gnu::noinline]] void pull_around(Taut& s, Index edge, const Label& label) const {
  put_in(s, s.bends, edge);
  pull(s, label.sigma, fixed_bends(label), false);
}
/// The shortest string of a label to q, a point of t, that bends last at an edge of a tetrahedron at
/// `vertex`, which the label's string reaches. False if none is below `known`.
bool bend_at(const Label& label, Index vertex, Index t, const Point& q, Real known,
             Taut& best) const {
  const Taut straight = edges_of(label, q);
  if (straight.bends == most_bends) return false;
  bool found = false;
  for (const Index c : mesh_->corners_at(vertex)) {
    Index entry = first_reflex(c / 4);
    for (bool more = entry != none; more; ++entry) {
      const Index edge = entry_edge(reflex_entry(entry));
      more = !entry_is_last(reflex_entry(entry));
      if (bends_at(straight, edge) || (found && bends_at(best, edge))) continue;
      Taut s = straight;
      pull_around(s, edge, label);
      Hit hit;
      if (!bends_at(s, edge) || !(s.extent < (found ? best.extent : known)) ||
          !is_free(s, label, t, within(t, q), hit))
        continue;
      best = s;
      found = true;
    }
  }
  return found;
}

/// Offers the shortest way to a vertex to the tetrahedra there that know a longer one, around an
/// edge: those between may keep others, as each has one label. True if some took it.
bool pass_bends(Index vertex, Real radius) const {
  const Point& at = points_[vertex];
  Real best = std::numeric_limits<Real>::infinity();
  Index by = none;
  for (const Index c : mesh_->corners_at(vertex)) {
    if (!front_->reached(c / 4)) continue;
    const Label& label = front_->label(c / 4);
    if (by != none && same_way(label, front_->label(by))) continue;
    Hit own;
    const Real d = corner_sight(label, c / 4, c % 4, best, own);
    if (own.tet == none && d < best) best = d, by = c / 4;
  }
  if (by == none || best > radius) return false;
  const Label way = front_->label(by);
  const Index source = front_->source(by);
  bool any = false;
  for (const Index c : mesh_->corners_at(vertex)) {
    const Index t = c / 4;
    if (front_->reached(t)) {
      const Label& label = front_->label(t);
      if (same_way(label, way) || !(taut_to(label, at).extent * way_gain > best)) continue;
    }
    Label label = way;
    Taut s;
    if (!bend_at(way, vertex, t, tets_[t].centre, to_beat(t), s)) continue;
    keep(s, label, t, tets_[t].centre);
    any |= enter(t, 0, label, source);
  }
  return any;
}
/// Within rounding ways to a vertex are the same.
static constexpr Real way_gain = 1 - 64 * std::numeric_limits<Real>::epsilon();
/// May ways bend at an edge of a tetrahedron at a vertex?
[[nodiscard]] bool bends_near(Index vertex) const {
  const auto corners = mesh_->corners_at(vertex);
  return std::any_of(corners.begin(), corners.end(),
                     [&](Index c) { return tets_[c / 4].reflex != none; });
}

/// Which tetrahedron at a vertex does the line to a point go through, or nearest to?
[[nodiscard]] Index facing(Index vertex, const Point& to) const {
  const Point& at = points_[vertex];
  const Point g = to - at;
  Index found = none;
  Real best = -std::numeric_limits<Real>::infinity();
  for (const Index c : mesh_->corners_at(vertex)) {
    const Index* corner = tets_[c / 4].corner;
    const Point a = points_[corner[(c + 1) & 3]] - at, b = points_[corner[(c + 2) & 3]] - at,
                d = points_[corner[(c + 3) & 3]] - at;
    const Point bd = normal_to(b, d);
    const Real side = dot(a, bd) < 0 ? Real(-1) : Real(1);
    const Real wa = side * dot(g, bd), wb = side * dot(g, normal_to(d, a)),
               wd = side * dot(g, normal_to(a, b));
    const Real least = min(min(wa, wb), wd) / (abs(wa) + abs(wb) + abs(wd));
    if (least > best) best = least, found = c / 4;
    if (best >= 0) break;
  }
  return found == none ? mesh_->corners_at(vertex)[0] / 4 : found;
}

/// Must strings be walked? Not where the solid is convex.
[[nodiscard]] bool walks() const {
  return any_reflex_ || !mesh_->pinched().empty() || !mesh_->pinched_edges().empty();
}
/// Where the string of a label to q comes from.
[[nodiscard]] Point last_bend(const Label& label, const Point& q) const {
  if (label.bend[0] == none) return label.source;
  const Taut s = taut_to(label, q);
  return s.at[s.bends];
}
/// Length of the path to corner i of t by a label, wherever that is kept, whose string reaches
/// vertex `from`, another corner; +inf if there is none. Looked for if its string there is one
/// that `wanted(length)`; around what hides it only below `known`, and the label becomes that
/// path's.
template <class Wanted>
Real carry_on(Label& label, Index from, Index t, Index i, Real known,
              const Wanted& wanted) const {
  const Point& q = corner_of(t, i);
  const Point end = within(t, q);
  Taut s = taut_to(label, q);
  if (!wanted(s.extent)) return std::numeric_limits<Real>::infinity();
  Hit own;
  if (is_free(s, label, t, end, own)) return s.extent;
  const Index u = facing(tets_[t].corner[i], s.at[s.bends]);
  Hit other;
  if (u != t && is_free(s, label, u, within(u, q), other)) return s.extent;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  if (!(s.extent < known) || !any_reflex_) return infinity;
  Taut best;
  best.extent = bend_at(label, from, t, q, known, best) ? best.extent : known;
  const Index before = facing(from, last_bend(label, points_[from]));
  if (find_taut(label, before, within(t, points_[from]), t, end, q, best.extent, own, s))
    best = s;
  if (!(best.extent < known)) return infinity;
  keep(best, label, t, end);
  return best.extent;
}
