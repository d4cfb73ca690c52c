#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"

#include <algorithm>
#include <limits>

#include "complexes/common/arrays.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/shape_blocks.hpp"
#include "complexes/surface/triangle_shape.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t next(std::size_t i) { return edge_after(i); }
constexpr std::size_t previous(std::size_t i) { return edge_before(i); }

constexpr Halfedge halfedge(Index slot, std::size_t edge) {
  return slot << Across::face_shift | static_cast<Index>(edge);
}
constexpr Halfedge plain(Index packed) { return packed & ~Across::special; }
constexpr Index slot_of(Halfedge h) { return h >> Across::face_shift; }
constexpr std::size_t edge_in(Halfedge h) { return h & Across::edge_mask; }

// The third corner of a triangle that stands on the x axis from 0 to `length`, with the angle
// `start` at 0, and `end` at the other end. Taken from the nearer end: far away its place would be
// off by a rounding error of the longer way.
Planar apex(double length, double from_start, Turn start, double from_end, Turn end) {
  if (from_start <= from_end) return {from_start * start.c, from_start * start.s};
  return {length - from_end * end.c, from_end * end.s};
}

// From apex d (mirrored) to apex c, both relative to the end that they are near, if it is one.
Planar between(double length, const std::array<double, 2>& c, const std::array<Turn, 2>& at_c,
               const std::array<double, 2>& d, const std::array<Turn, 2>& at_d) {
  const std::size_t ic = c[0] <= c[1] ? 0 : 1, id = d[0] <= d[1] ? 0 : 1;
  const double sign_c = ic == 0 ? 1 : -1, sign_d = id == 0 ? 1 : -1;
  const double x = sign_d * d[id] * at_d[id].c - sign_c * c[ic] * at_c[ic].c +
                   (static_cast<double>(id) - static_cast<double>(ic)) * length;
  return {x, -(d[id] * at_d[id].s + c[ic] * at_c[ic].s)};
}

// Lengths and angles say the same twice. Each flip adds the contradictions of two triangles to its
// own rounding, and would double them flip by flip: what has grown beyond what lengths alone leave
// open is cut back to these.
void reconcile(IntrinsicTriangle& t) {
  constexpr double allowed = 16 * std::numeric_limits<double>::epsilon();
  std::size_t i = 0;  // the longest edge
  for (std::size_t k = 1; k < 3; ++k)
    if (t.length[k] > t.length[i]) i = k;
  const std::size_t j = next(i), k = previous(i);
  const double length = t.length[i], left = t.length[k], right = t.length[j];
  const double up = left * t.angle[i].s;
  const double apart =
      std::hypot(left * t.angle[i].c + right * t.angle[j].c - length, up - right * t.angle[j].s);
  if (apart * up <= allowed * length * std::fmax(std::fmin(left, right), up)) return;
  const TriangleShape shape = shape_from_lengths(t.length);
  for (std::size_t c = 0; c < 3; ++c) t.angle[c] = {shape.cosine[c], shape.sine[c]};
}

}  // namespace

template <class Real>
IntrinsicTriangulation::IntrinsicTriangulation(const TriangleMesh<Real>& mesh)
    : vertices_(mesh.vertex_count()),
      triangles_(mesh.face_count()),
      flips_(mesh.face_count(), 0),
      history_(mesh.face_count()) {
  const std::vector<Index> outer = vertices_outside(mesh);
  const Index sentinel = static_cast<Index>(mesh.face_count());
  turned_.assign(sentinel, 0);
  for (Index f = 0; f < sentinel; ++f) {
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    IntrinsicTriangle& mine = triangles_[f];
    turned_[f] = (t.face & reversed) != 0;
    for (std::size_t i = 0; i < 3; ++i) {
      mine.length[i] = static_cast<double>(t.length[i]);
      const Turn angle = {static_cast<double>(t.cosine[i]), static_cast<double>(t.sine(i))};
      mine.angle[i] = normalised(angle);
      mine.across[i] = slot_of(t.across[i]) == sentinel ? none : t.across[i];
      mine.corner[i] = outer[t.corner[i]];
    }
  }
  if (!mesh.summary().orientable) take_callers_turns();
}
template IntrinsicTriangulation::IntrinsicTriangulation(const TriangleMesh<float>&);
template IntrinsicTriangulation::IntrinsicTriangulation(const TriangleMesh<double>&);

IntrinsicTriangulation::IntrinsicTriangulation(const FaceLayout& layout,
                                               const TriangleShapes& shapes, double& unit,
                                               int threads)
    : vertices_(layout.vertex_count()),
      flips_(layout.face_count(), 0),
      turned_(layout.face_count(), 0),
      history_(layout.face_count()) {
  const std::vector<Index> outer = layout.vertices_outside(threads);
  const std::size_t m = layout.face_count();
  const Index sentinel = static_cast<Index>(m);
  triangles_.resize(m);
  double longest = 0;
  const auto take = [&](std::size_t begin, std::size_t end, double& most) {
    ShapeBlock block{};
    for (std::size_t first = begin; first < end; first += ShapeBlock::size) {
      const std::size_t count = std::min(ShapeBlock::size, end - first);
      const auto faces = std::span(layout.face).subspan(first, count);
      shapes.look_up(faces, block);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t f = first + k;
        const bool turned = layout.is_turned(f);
        turned_[f] = turned;
        IntrinsicTriangle& mine = triangles_[f];
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t corner = turned && i != 0 ? 3 - i : i;
          mine.length[i] = block.length[turned ? 2 - i : i][k];
          most = std::max(most, mine.length[i]);
          mine.angle[i] = normalised({block.cosine[corner][k], block.sine[corner][k]});
          const Index o = layout.across[f][i];
          mine.across[i] = slot_of(o) == sentinel ? none : o;
          mine.corner[i] = outer[layout.corner[f][i]];
        }
        check_length(faces[k], mine.length);
      }
    }
  };
  gather_blocks<double>(m, threads, take, [&](double most) { longest = std::max(longest, most); });
  unit = mean_edge(m, longest, [&](std::size_t f) {
    std::array<double, 3> length = triangles_[f].length;
    if (turned_[f]) std::swap(length[0], length[2]);
    return length;
  });
  over_blocks(m, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f)
      for (double& l : triangles_[f].length) l /= unit;
  });
  if (!layout.orientable) take_callers_turns();
}

// Where no orientation fits, that of the caller: in it no loop turns over.
void IntrinsicTriangulation::take_callers_turns() {
  for (Index f = 0; f < turned_.size(); ++f)
    if (turned_[f]) {
      turn_over(f);
      turned_[f] = 0;
    }
}

std::size_t IntrinsicTriangulation::bytes() const {
  return triangles_.capacity() * sizeof(IntrinsicTriangle) +
         flips_.capacity() * sizeof(std::uint16_t) + turned_.capacity() + history_.bytes();
}

double IntrinsicTriangulation::excess(Halfedge h) const {
  constexpr double never = -std::numeric_limits<double>::infinity();
  const Index o = across(h);
  if (o == none || (o & Across::fan) != 0 || slot_of(o) == slot_of(h)) return never;
  const Turn a = triangles_[slot_of(h)].angle[previous(edge_in(h))];
  const Turn b = triangles_[slot_of(o)].angle[previous(edge_in(o))];
  // Beyond 3/2 pi the sine turns back, but then both are obtuse.
  if (a.c < 0 && b.c < 0) return std::fmax(-(a.s * b.c + a.c * b.s), std::fmin(-a.c, -b.c));
  return -(a.s * b.c + a.c * b.s);
}

std::uint32_t IntrinsicTriangulation::flips(Halfedge h) const {
  return std::max(flips_[slot_of(h)], flips_[slot_of(across(h))]);
}

/// The halfedge that leads to h: the other one, or in a cycle of more the one before.
Halfedge IntrinsicTriangulation::before(Halfedge h) const {
  Index o = across(h);
  if (o == none) return none;
  while (plain(across(plain(o))) != h) o = across(plain(o));
  return plain(o);
}

/// Gives halfedges other places, all at once; what leads to them follows. Mirrored: they are those
/// of a triangle that is turned over, so relative to all others they now run the other way.
void IntrinsicTriangulation::rename(std::span<const Halfedge> from, std::span<const Halfedge> to,
                                    bool mirrored) {
  std::array<Index, 4> after{}, leads{};
  const auto place = [&](Halfedge h) -> std::size_t {
    return static_cast<std::size_t>(std::find(from.begin(), from.end(), h) - from.begin());
  };
  for (std::size_t k = 0; k < from.size(); ++k) {
    after[k] = across(from[k]);
    leads[k] = before(from[k]);
  }
  const Index toggle = mirrored ? Across::flip : 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (after[k] == none) {
      across(to[k]) = none;
      continue;
    }
    const std::size_t other = place(plain(after[k]));
    across(to[k]) =
        other < from.size() ? (to[other] | (after[k] & Across::special)) : after[k] ^ toggle;
    if (place(leads[k]) == from.size())
      across(leads[k]) = (to[k] | (across(leads[k]) & Across::special)) ^ toggle;
  }
}

void IntrinsicTriangulation::turn_over(Index slot) {
  const std::array<Halfedge, 3> from = {halfedge(slot, 0), halfedge(slot, 1), halfedge(slot, 2)};
  const std::array<Halfedge, 3> to = {from[2], from[1], from[0]};
  rename(from, to, true);
  IntrinsicTriangle& t = triangles_[slot];
  std::swap(t.length[0], t.length[2]);
  std::swap(t.angle[1], t.angle[2]);
  std::swap(t.corner[1], t.corner[2]);
}

// What glues a loop, whose ends are one vertex, can only be told where it does not turn over.
bool IntrinsicTriangulation::may_turn_over(Index slot) const {
  const IntrinsicTriangle& t = triangles_[slot];
  for (std::size_t i = 0; i < 3; ++i)
    if (t.corner[i] == t.corner[next(i)] && t.across[i] != none && slot_of(t.across[i]) != slot)
      return false;
  return true;
}

bool IntrinsicTriangulation::flip(Halfedge h) {
  CornerOrder order_f, order_g;
  if ((across(h) & Across::flip) != 0) {
    const Halfedge o = plain(across(h));
    const bool turn_g = may_turn_over(slot_of(o));
    if (!turn_g && !may_turn_over(slot_of(h))) return false;
    (turn_g ? order_g : order_f).mirrored = true;
    turn_over(slot_of(turn_g ? o : h));
    if (!turn_g) h = halfedge(slot_of(h), 2 - edge_in(h));
  }
  const Halfedge o = plain(across(h));
  const Index f = slot_of(h), g = slot_of(o);
  const std::size_t fa = edge_in(h), fb = next(fa), fc = next(fb);
  const std::size_t gb = edge_in(o), ga = next(gb), gd = next(ga);
  IntrinsicTriangle &tf = triangles_[f], &tg = triangles_[g];

  // a is the origin, b on the x axis, c above, d below.
  const double length = tf.length[fa], bc = tf.length[fb], ca = tf.length[fc], ad = tg.length[ga],
               db = tg.length[gd];
  const std::array<Turn, 2> up = {tf.angle[fa], tf.angle[fb]};
  const std::array<Turn, 2> down = {tg.angle[ga], tg.angle[gb]};
  const Turn at_c = tf.angle[fc], at_d = tg.angle[gd];
  const Planar c = apex(length, ca, up[0], bc, up[1]);
  Planar d = apex(length, ad, down[0], db, down[1]);
  d.y = -d.y;
  const Planar across_quad = between(length, {ca, bc}, up, {ad, db}, down);  // c to d
  const double cd = norm(across_quad);

  // The angles at a and b are sums. That of c is divided by the new edge, and what is left of two
  // right angles in adc goes to d. Edges without length: the limit of thin triangles.
  const Turn a_new = clamped(sum(up[0], down[0])), b_new = clamped(sum(up[1], down[1]));
  Turn c_left, d_left;
  if (ca == 0 && ad > 0) {
    c_left = supplement(a_new);
  } else if (ad == 0) {
    c_left = {};
  } else if (bc == 0) {
    c_left = clamped(difference(at_c, supplement(b_new)));
  } else if (db == 0) {
    c_left = at_c;
  } else if (cd == 0) {
    c_left = half(supplement(a_new));
  } else {
    const Planar to_a =
        ca <= bc ? Planar{-c.x, -c.y} : Planar{bc * up[1].c - length, -(bc * up[1].s)};
    c_left = clamped(turn_between(to_a, across_quad));
  }
  Turn c_right = difference(at_c, c_left);
  if (c_right.s < 0) c_right = {}, c_left = at_c;
  d_left = clamped(supplement(sum(a_new, c_left)));
  Turn d_right = difference(at_d, d_left);
  if (d_right.s < 0) d_right = {}, d_left = at_d;

  const Index a = tf.corner[fa], b = tf.corner[fb], vc = tf.corner[fc], vd = tg.corner[gd];
  const auto in_old = [](CornerOrder order, std::size_t first) {
    order.first = static_cast<std::uint8_t>(order.mirrored ? (3 - first) % 3 : first);
    return order;
  };
  history_.add(
      {PatchHistory::Kind::flip, {f, g}, length, c, d, {in_old(order_f, fa), in_old(order_g, gb)}});

  const std::array<Halfedge, 4> from = {halfedge(f, fb), halfedge(f, fc), halfedge(g, ga),
                                        halfedge(g, gd)};
  const std::array<Halfedge, 4> to = {halfedge(g, 0), halfedge(f, 2), halfedge(f, 0),
                                      halfedge(g, 2)};
  rename(from, to);
  tf.length = {ad, cd, ca};
  tf.angle = {a_new, d_left, c_left};
  tf.corner = {a, vd, vc};
  tf.across[1] = halfedge(g, 1);
  tg.length = {bc, cd, db};
  tg.angle = {b_new, c_right, d_right};
  tg.corner = {b, vc, vd};
  tg.across[1] = halfedge(f, 1);
  reconcile(tf);
  reconcile(tg);
  constexpr std::uint16_t most = std::numeric_limits<std::uint16_t>::max();
  if (flips_[f] < most) ++flips_[f];
  if (flips_[g] < most) ++flips_[g];
  return true;
}

Index IntrinsicTriangulation::add_slot() {
  triangles_.push_back({{}, {}, {none, none, none}, {none, none, none}});
  flips_.push_back(0);
  return static_cast<Index>(triangles_.size() - 1);
}

Index IntrinsicTriangulation::add_vertex(Index slot, const std::array<double, 3>& at) {
  inserted_.push_back(history_.back({slot, at}));
  return static_cast<Index>(vertices_++);
}

void IntrinsicTriangulation::split(Index f, const std::array<double, 3>& at) {
  const Index vertex = add_vertex(f, at);
  const Index g = add_slot(), h = add_slot();
  const IntrinsicTriangle t = triangles_[f];
  const Planar a, b = {t.length[0], 0};
  const Planar c = apex(t.length[0], t.length[2], t.angle[0], t.length[1], t.angle[1]);
  const Planar p = at[1] * b + at[2] * c;
  history_.add({PatchHistory::Kind::split, {f, g}, b.x, c, p, {}});

  const double pa = norm(p), pb = norm(p - b), pc = norm(p - c);
  const Turn a_first = clamped(turn_between(b - a, p - a)),
             b_first = clamped(turn_between(p - b, a - b)),
             c_first = clamped(turn_between(p - c, b - c));
  const Turn a_rest = clamped(difference(t.angle[0], a_first)),
             b_rest = clamped(difference(t.angle[1], b_first)),
             c_rest = clamped(difference(t.angle[2], c_first));
  const auto third = [](Turn x, Turn y) { return clamped(supplement(sum(x, y))); };

  const std::array<Halfedge, 2> from = {halfedge(f, 1), halfedge(f, 2)};
  const std::array<Halfedge, 2> to = {halfedge(g, 0), halfedge(h, 0)};
  rename(from, to);
  const Index a0 = t.corner[0], b0 = t.corner[1], c0 = t.corner[2];
  const auto set = [&](Index slot, const std::array<double, 3>& length, Turn x, Turn y,
                       const std::array<Index, 3>& corner) {
    IntrinsicTriangle& own = triangles_[slot];
    own.length = length;
    own.angle = {x, y, third(x, y)};
    own.corner = corner;
    reconcile(own);
  };
  set(f, {t.length[0], pb, pa}, a_first, b_first, {a0, b0, vertex});
  set(g, {t.length[1], pc, pb}, b_rest, c_first, {b0, c0, vertex});
  set(h, {t.length[2], pa, pc}, c_rest, a_rest, {c0, a0, vertex});
  const auto glue = [&](Halfedge x, Halfedge y) {
    across(x) = y;
    across(y) = x;
  };
  glue(halfedge(f, 1), halfedge(g, 2));
  glue(halfedge(g, 1), halfedge(h, 2));
  glue(halfedge(h, 1), halfedge(f, 2));
}

void IntrinsicTriangulation::split_border(Halfedge e) {
  const Index f = slot_of(e);
  const std::size_t fa = edge_in(e), fb = next(fa), fc = next(fb);
  std::array<double, 3> middle{};
  middle[fa] = middle[fb] = 0.5;
  const Index vertex = add_vertex(f, middle);
  const Index g = add_slot();
  const IntrinsicTriangle t = triangles_[f];
  const Planar a, b = {t.length[fa], 0}, p = {t.length[fa] / 2, 0};
  const Planar c = apex(t.length[fa], t.length[fc], t.angle[fa], t.length[fb], t.angle[fb]);
  const CornerOrder order{static_cast<std::uint8_t>(fa), 0};
  history_.add({PatchHistory::Kind::split_border, {f, g}, b.x, c, p, {order, {}}});

  const Turn c_first = clamped(turn_between(a - c, p - c)),
             c_rest = clamped(difference(t.angle[fc], c_first));
  const double pc = norm(p - c);
  const std::array<Halfedge, 2> from = {halfedge(f, fb), halfedge(f, fc)};
  const std::array<Halfedge, 2> to = {halfedge(g, 1), halfedge(f, 2)};
  rename(from, to);
  IntrinsicTriangle &left = triangles_[f], &right = triangles_[g];
  left.length = {p.x, pc, t.length[fc]};
  left.angle = {t.angle[fa], clamped(supplement(sum(t.angle[fa], c_first))), c_first};
  left.corner = {t.corner[fa], vertex, t.corner[fc]};
  right.length = {p.x, t.length[fb], pc};
  right.angle = {clamped(supplement(sum(t.angle[fb], c_rest))), t.angle[fb], c_rest};
  right.corner = {vertex, t.corner[fb], t.corner[fc]};
  reconcile(left);
  reconcile(right);
  left.across[0] = right.across[0] = none;
  left.across[1] = halfedge(g, 2);
  right.across[2] = halfedge(f, 1);
}

}  // namespace plexway::detail
