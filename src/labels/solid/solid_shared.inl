// For simplices of other complexes that share a face, an edge or a vertex with the solid. Part of the
// body of SolidRule, see solid_rule.hpp; C++ only.

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
  return sight(t, tets_[t].centre, t, within(t, q), q);
}
/// The same, a path's in any case: by way of the centre where no other is found.
[[nodiscard]] Sight reached_from(Index t, const Point& q) const {
  Taut s;
  if (find_sight(t, tets_[t].centre, t, within(t, q), q, s)) return last_bend(s);
  return {tets_[t].centre, front_->label(t).centre};
}
/// Is corner i of u in a straight line from a point of t? (On a crack another may lie there.)
[[nodiscard]] bool sees(Index t, const Point& from, Index u, Index i) const {
  const Index v = tets_[u].corner[i];
  return walk(t, from, within(u, points_[v])) &&
         std::find(tets_[t].corner, tets_[t].corner + 4, v) != tets_[t].corner + 4;
}

/// A source at `eye`, outside, comes in over a face of t.
bool enter_face(Index t, std::size_t face, const Point& eye, Real sigma, Index source) const {
  const Point q = tets_[t].centre;
  Label label = point_label(eye, sigma);
  label.door = SolidDoor::face(t, static_cast<Index>(face));
  label.centre = sigma + norm(q - eye);
  if (!(label.centre < to_beat(t))) return false;
  // The face as seen from within, where the path goes on.
  const Index* order = tet_face_corners[face];
  const Index* corner = tets_[t].corner;
  const Point &a = points_[corner[order[0]]], &b = points_[corner[order[2]]],
              &c = points_[corner[order[1]]];
  if (!passes(eye, q, a, b, c, face_tolerance)) {  // over the best point of the face's edges
    const Point over[3] = {bend_point(a, b, eye, q), bend_point(b, c, eye, q),
                           bend_point(c, a, eye, q)};
    const auto way = [&](const Point& p) { return norm(p - eye) + norm(q - p); };
    const Point& at = *std::min_element(
        over, over + 3, [&](const Point& p, const Point& r) { return way(p) < way(r); });
    label = point_label(t, at, sigma + norm(at - eye));
    label.centre = label.sigma + norm(q - at);
  }
  return enter(t, face, label, source);
}

/// Offers the source of t to its neighbours even where the line misses the face between. Of many
/// sources of nearly the same distance each tetrahedron keeps one, and the strip that would bring
/// another one may be taken. Without reflex edges nothing hides anything; else the path bends on
/// the face. A neighbour must gain the share `gain`. Offers at `horizon` or beyond are not made:
/// gives the nearest such, or +inf. Labels of t's source start all at one point.
Real offer_around(Index t, Real gain, Real horizon) const {
  Real left = std::numeric_limits<Real>::infinity();
  for (Index i = 0; i < 4; ++i) {
    const Index across = tets_[t].across[i], u = across >> TetAcross::tet_shift;
    if (!any_reflex_ && front_->reached(u) && front_->source(u) == front_->source(t)) continue;
    Label label = front_->label(t);
    label.centre = taut_to(label, tets_[u].centre).extent;
    if (!(label.centre < to_beat(u) * (1 - gain))) continue;
    if (!(label.centre < horizon))
      left = std::min(left, label.centre);
    else if (any_reflex_)
      cross(t, i, true);
    else
      front_->accept(u, across & TetAcross::face_mask, label, label.centre, front_->source(t));
  }
  return left;
}

/// A source that is seen over an edge of t only: a ring about it.
bool enter_edge(Index t, std::size_t face, Index ring, const Point& eye, Real sigma,
                Index source) const {
  Label label = point_label(eye, sigma);
  label.bend[0] = ring;
  label.centre = taut_to(label, tets_[t].centre).extent;
  return enter(t, face, label, source);
}
