#include "propagate/windows/merged_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <plexway/error.hpp>

namespace plexway::windows {
namespace {

template <class Real>
constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// In mean edges.
constexpr double bucket_width = 0.5;
/// Vertices have their turn so much later than their distance, in mean edges: after the light that
/// may reach them straight.
constexpr double late = 0.5;
/// Each time a halfedge had so many turns in the mean, what goes on must gain more: nothing goes
/// around for ever.
constexpr std::size_t patience = 6;
/// Neighbours are joined over gaps up to this share of the edge.
constexpr double joint = 3e-2;

}  // namespace

template <class Real>
MergedWindows<Real>::MergedWindows(const TriangleMesh<Real>& mesh, const VertexAngles& angles)
    : triangles_(mesh.triangles()), mesh_(mesh), angles_(angles), pseudo_source_(triangles_) {
  excess_.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) excess_[v] = static_cast<Real>(angles.excess(v));
}

template <class Real>
void MergedWindows<Real>::solve(std::span<const PointSource> sources,
                                const PropagateOptions& options, const MergeLimit& limit) {
  limit_ = limit;
  labels_ = sources.size() > 1;
  vertices_.assign(mesh_.vertex_count(), {infinity<Real>, none, {0, 0}});
  error_.resize(mesh_.vertex_count());
  if (labels_) source_.resize(mesh_.vertex_count());
  if (pending_.empty() || !complete_) pending_.assign(4 * mesh_.face_count(), none);
  blocks_.clear();
  entries_.clear();
  free_block_ = free_entry_ = none;
  complete_ = false;
  statistics_ = {};
  slack_ = 1;
  radius_ = static_cast<Real>(options.radius / mesh_.unit());
  set_scale(0);
  const auto solve_in = [&](auto& order) {
    order.start(bucket_width);
    seed(order, sources);
    do complete_ = run(order, options);
    while (complete_ && fill_holes(order));
  };
  switch (options.schedule) {
    case Schedule::dual_queue: {
      BucketRing ring;
      solve_in(ring);
      break;
    }
    case Schedule::fifo: {
      FirstIn line;
      solve_in(line);
      break;
    }
    case Schedule::priority:
      solve_in(nearest_);
      break;
  }
}

template <class Real>
void MergedWindows<Real>::set_scale(double distance) {
  scale_ = static_cast<Real>(
      limit_.limit * (limit_.reach < infinity<double> ? std::sqrt(distance / limit_.reach) : 1));
}

template <class Real>
Real MergedWindows<Real>::near(Index what) const {
  if (what & bent) return vertices_[what & ~bent].distance + static_cast<Real>(late);
  return pending_[what] == none ? Real(0) : blocks_[pending_[what]].nearest;
}

template <class Real>
template <class Order>
void MergedWindows<Real>::push(Order& order, Index what, Real near) {
  Index n = free_entry_;
  if (n == none) {
    n = static_cast<Index>(entries_.size());
    entries_.emplace_back();
  } else {
    free_entry_ = entries_[n].next;
  }
  entries_[n].what = what;
  order.push(n, static_cast<double>(near), [this](Index i) -> Index& { return entries_[i].next; });
}

/// What the next turn will look up.
template <class Real>
void MergedWindows<Real>::fetch(Index what) const {
  if (what & bent) return;
  const TriangleRecord<Real>& t = triangles_[what >> 2];
  const std::size_t in = what & 3, before = edge_before(in), after = edge_after(in);
  __builtin_prefetch(&pending_[what]);
  __builtin_prefetch(&vertices_[t.corner[before]]);
  __builtin_prefetch(&pending_[t.across[before] >> Across::face_shift << 2]);
  __builtin_prefetch(&pending_[t.across[after] >> Across::face_shift << 2]);
}

template <class Real>
template <class Order>
bool MergedWindows<Real>::run(Order& order, const PropagateOptions& options) {
  const auto next = [this](Index n) -> Index& { return entries_[n].next; };
  const auto near_of = [this](Index n) { return static_cast<double>(near(entries_[n].what)); };
  constexpr std::size_t share = 65536;
  double before = -1;
  for (;;) {
    if (statistics_.expansions >= options.max_expansions) return order.pop(next, near_of) == none;
    const Index n = order.pop(next, near_of);
    if (n == none) return true;
    const Index what = entries_[n].what;
    entries_[n].next = std::exchange(free_entry_, n);
    if (!(what & bent) && pending_[what] == none) continue;
    if (const Index after = order.peek(); after != none) fetch(entries_[after].what);
    if (order.distance() != before) set_scale(before = order.distance());
    ++statistics_.expansions;
    if (statistics_.expansions % share == 0) {
      if (options.progress &&
          !options.progress({statistics_.expansions, statistics_.reached_simplices,
                             mesh_.face_count(), order.distance() * mesh_.unit()}))
        throw Cancelled("cancelled by the progress callback");
      const std::size_t rounds =
          statistics_.expansions / (patience * 3 * mesh_.face_count() + share);
      if (rounds > 0) slack_ = 1 - 8 * static_cast<Real>(rounds);
    }
    if (what & bent)
      shine(order, what & ~bent);
    else
      expand(order, what);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::offer(Order& order, Index vertex, Real distance, Index corner,
                                Towards<Real> from, Index source, Real error) {
  Vertex& v = vertices_[vertex];
  if (!(distance < v.distance)) return;
  if (slack_ < 0 && !(distance < v.distance + slack_ * scale_)) return;
  v = {distance, corner, from};
  error_[vertex] = error;
  if (labels_) source_[vertex] = source;
  ++statistics_.updates;
  if (corner == none || (corner & bent) || excess_[vertex] > 4 * scale_)
    push(order, vertex | bent, distance + static_cast<Real>(late));
}

template <class Real>
bool MergedWindows<Real>::joined(const Labelled<Real>& u, const Labelled<Real>& w,
                                 Real length) const {
  return w.window.beam.begin - u.window.beam.end <= static_cast<Real>(joint) * length &&
         std::abs(w.window.at_begin - u.window.at_end) <= 4 * scale_ * length;
}

/// What waits on a halfedge of that length, into list_.
template <class Real>
void MergedWindows<Real>::gather(const Block& block, Real length) {
  const std::size_t count = block.count;
  std::array<unsigned, room> rank;
  for (unsigned i = 0; i < count; ++i) {
    unsigned at = i;
    for (; at > 0 && block.window[i].beam.begin < block.window[rank[at - 1]].beam.begin; --at)
      rank[at] = rank[at - 1];
    rank[at] = i;
  }
  list_.clear();
  list_.append({block.window[rank[0]], block.source[rank[0]]});
  for (std::size_t i = 1; i < count; ++i)
    take({block.window[rank[i]], block.source[rank[i]]}, length);
}

/// One more that begins no sooner than the others: merged with the last, or beside it.
template <class Real>
void MergedWindows<Real>::take(Labelled<Real> added, Real length) {
  Labelled<Real>& last = list_.back();
  Window<Real>&u = last.window, &w = added.window;
  const auto fit = [&] {
    Window<Real> merged;
    if (last.source != added.source || !joined(last, added, length) ||
        !merge(u, w, scale_ * (w.beam.end - u.beam.begin), merged))
      return false;
    u = merged;
    return true;
  };
  const Real overlap = u.beam.end - w.beam.begin;
  const bool nested = w.beam.end <= u.beam.end;
  if (overlap < static_cast<Real>(joint) * length && !nested && fit()) return;
  if (overlap > 0) {
    const Real end = nested ? w.beam.end : u.beam.end;
    const bool u_first = u.at(w.beam.begin) <= w.at_begin;
    const bool u_last = (nested ? u.at(end) : u.at_end) <= (nested ? w.at_end : w.at(end));
    if (u_first && u_last) {
      if (nested) return;
      w.begin_at(end);
    } else if (nested || u_last) {
      list_.insert(added);
      return;
    } else if (u_first) {
      const Real x = crossing(u, w, w.beam.begin, end);
      u.end_at(x);
      w.begin_at(x);
    } else {
      u.end_at(w.beam.begin);
    }
    if (!(u.beam.begin < u.beam.end)) {
      last = added;
      return;
    }
    if (!(w.beam.begin < w.beam.end) || fit()) return;
  }
  list_.append(added);
}

template <class Real>
void MergedWindows<Real>::make_room(Block& block, Real length) {
  gather(block, length);
  while (list_.size() >= room) {
    // The shortest goes, into its neighbour if they fit at all.
    std::size_t shortest = 0;
    const auto extent = [&](std::size_t i) {
      return list_[i].window.beam.end - list_[i].window.beam.begin;
    };
    for (std::size_t i = 1; i < list_.size(); ++i)
      if (extent(i) < extent(shortest)) shortest = i;
    const std::size_t u = shortest == 0 ? 0 : shortest - 1;
    Window<Real> merged;
    if (list_[u].source == list_[u + 1].source &&
        merge(list_[u].window, list_[u + 1].window, infinity<Real>, merged)) {
      list_[u].window = merged;
      shortest = u + 1;
    }
    for (std::size_t i = shortest; i + 1 < list_.size(); ++i) list_[i] = list_[i + 1];
    list_.resize(list_.size() - 1);
  }
  block.count = static_cast<Index>(list_.size());
  for (std::size_t i = 0; i < list_.size(); ++i) {
    block.window[i] = list_[i].window;
    block.source[i] = list_[i].source;
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::enter(Order& order, Index across, const Window<Real>& window,
                                Index source) {
  const Index halfedge = across >> Across::face_shift << 2 | (across & Across::edge_mask);
  const Real near = window.nearest();
  Index b = pending_[halfedge];
  if (b == none) {
    b = free_block_;
    if (b == none) {
      b = static_cast<Index>(blocks_.size());
      blocks_.emplace_back();
    } else {
      free_block_ = blocks_[b].count;
    }
    pending_[halfedge] = b;
    __builtin_prefetch(&triangles_[halfedge >> 2]);
    blocks_[b].count = 1;
    blocks_[b].window[0] = window;
    blocks_[b].source[0] = source;
    blocks_[b].nearest = near;
    push(order, halfedge, near);
    return;
  }
  Block& block = blocks_[b];
  if (block.count == room) {
    const Overlay<Real> saved = list_;
    make_room(block, triangles_[halfedge >> 2].length[halfedge & 3]);
    list_ = saved;
  }
  block.window[block.count] = window;
  block.source[block.count++] = source;
  if (near < block.nearest) {
    block.nearest = near;
    push(order, halfedge, near);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::leave(Order& order, Index f, std::size_t edge, const Window<Real>& window,
                                Index source) {
  Index across = triangles_[f].across[edge];
  if (across >> Across::face_shift == mesh_.face_count()) return;
  if (!(across & Across::special)) [[likely]] {
    enter(order, across, window, source);
    return;
  }
  const Window<Real> turned = window.mirrored(triangles_[f].length[edge]);
  bool flip = (across & Across::flip) != 0;
  if (!(across & Across::fan)) {
    enter(order, across, turned, source);
    return;
  }
  for (;;) {
    const Index g = across >> Across::face_shift, k = across & Across::edge_mask;
    if (g == f && k == edge) return;
    enter(order, across, flip ? turned : window, source);
    across = triangles_[g].across[k];
    flip ^= !(across & Across::flip);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::expand(Order& order, Index halfedge) {
  const Index f = halfedge >> 2, b = std::exchange(pending_[halfedge], none);
  Block& block = blocks_[b];
  const EnteredTriangle<Real> t(triangles_[f], halfedge & 3);
  if (block.nearest > radius_) {
    block.count = std::exchange(free_block_, b);
    return;
  }
  if (block.count == 1) {
    const Window<Real> window = block.window[0];
    const Index source = block.source[0];
    block.count = std::exchange(free_block_, b);
    expand(order, f, t, window, source);
    return;
  }
  gather(block, t.width);
  block.count = std::exchange(free_block_, b);
  if (list_.size() == 1)
    expand(order, f, t, list_[0].window, list_[0].source);
  else
    expand_list(order, f, t);
}

/// One window alone.
template <class Real>
template <class Order>
void MergedWindows<Real>::expand(Order& order, Index f, const EnteredTriangle<Real>& t,
                                 const Window<Real>& w, Index source) {
  const Spread<Real> s(t, w);
  const Index corner = static_cast<Index>(3 * f + t.before);
  Real to_p = vertices_[t.p].distance;
  if (s.left_reaches() && s.right_reaches()) {
    if (s.distance[1] < to_p) {
      to_p = s.distance[1];
      offer(order, t.p, to_p, corner, t.towards(w.beam.x, w.beam.h), source, w.error);
    }
  } else {
    const bool to_left = s.right_reaches();
    to_p = std::min(to_p, offer_around(order, t, corner, to_left ? w.beam.end : w.beam.begin,
                                       to_left ? w.at_end : w.at_begin, source, w.error));
  }
  const int wanted =
      s.wanted(vertices_[t.a].distance, vertices_[t.b].distance, to_p, slack_ * scale_);
  if (wanted & 1) leave(order, f, t.before, s.left(w), source);
  if (wanted & 2) leave(order, f, t.after, s.right(w), source);
}

/// The apex lies in shadow as far as this edge knows: by the nearest end of what is lit.
template <class Real>
template <class Order>
Real MergedWindows<Real>::offer_around(Order& order, const EnteredTriangle<Real>& t, Index corner,
                                       Real end, Real at_end, Index source, Real error) {
  const Real dx = t.apex_x - end, d = at_end + std::sqrt(dx * dx + t.apex_h * t.apex_h);
  offer(order, t.p, d, corner | bent, t.towards(end, 0), source, error);
  return d;
}

/// All that list_ holds.
template <class Real>
template <class Order>
void MergedWindows<Real>::expand_list(Order& order, Index f, const EnteredTriangle<Real>& t) {
  const std::size_t count = list_.size();
  std::array<Spread<Real>, Overlay<Real>::most> spread;
  Real best = infinity<Real>;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Spread<Real>& s = spread[i] = Spread<Real>(t, list_[i].window);
    if (s.left_reaches() && s.right_reaches() && s.distance[1] < best)
      best = s.distance[1], nearest = i;
    if (i == 0 || !joined(list_[i - 1], list_[i], t.width)) continue;
    // No gap opens between joined neighbours: both reach the apex if it lies there and they agree
    // on it, else they meet at the middle.
    Spread<Real>& before = spread[i - 1];
    if (!before.left_reaches() && !s.right_reaches()) {
      const Spread<Real> dark_before = before, dark = s;
      before.at.v[1] = t.left;
      s.at.v[3] = t.right;
      before.measure(list_[i - 1].window.sigma);
      s.measure(list_[i].window.sigma);
      const Real from_left = before.distance[1], from_right = s.distance[3];
      if (!(std::abs(from_left - from_right) <= 4 * scale_ * t.width)) {
        before = dark_before;
        s = dark;
      } else if (std::max(from_left, from_right) < best) {
        best = std::max(from_left, from_right);
        nearest = from_left < from_right ? i : i - 1;
      }
    } else if (before.at[1] < s.at[0]) {
      before.at.v[1] = s.at.v[0] = (before.at[1] + s.at[0]) / 2;
      before.measure(list_[i - 1].window.sigma);
      s.measure(list_[i].window.sigma);
    } else if (s.at[3] < before.at[2]) {
      before.at.v[2] = s.at.v[3] = (before.at[2] + s.at[3]) / 2;
      before.measure(list_[i - 1].window.sigma);
      s.measure(list_[i].window.sigma);
    }
  }
  const Index corner = static_cast<Index>(3 * f + t.before);
  if (best < infinity<Real>) {
    const Window<Real>& w = list_[nearest].window;
    offer(order, t.p, best, corner, t.towards(w.beam.x, w.beam.h), list_[nearest].source, w.error);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      const Window<Real>& w = list_[i].window;
      const bool to_left = spread[i].right_reaches();
      offer_around(order, t, corner, to_left ? w.beam.end : w.beam.begin,
                   to_left ? w.at_end : w.at_begin, list_[i].source, w.error);
    }
  }
  const Real to_a = vertices_[t.a].distance, to_b = vertices_[t.b].distance;
  const Real to_p = vertices_[t.p].distance;
  for (std::size_t i = 0; i < count; ++i) {
    const int wanted = spread[i].wanted(to_a, to_b, to_p, slack_ * scale_);
    if (wanted & 1) leave(order, f, t.before, spread[i].left(list_[i].window), list_[i].source);
    if (wanted & 2) leave(order, f, t.after, spread[i].right(list_[i].window), list_[i].source);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::shine(Order& order, Index vertex) {
  const Vertex v = vertices_[vertex];
  const Real sigma = v.distance;
  if (sigma > radius_) return;
  const bool anywhere = v.corner == none, is_bent = !anywhere && (v.corner & bent);
  // What is bent looks around both corners of what is lit; else only strong saddles shine.
  const Real shadow = excess_[vertex] + (is_bent ? std::numbers::pi_v<Real> : -4 * scale_);
  if (!anywhere && !(shadow > 0)) return;
  const Index source = labels_ ? source_[vertex] : 0;
  const Real error = error_[vertex];
  const VertexAngles::Kind kind = angles_.kind[vertex];
  const auto lit = [&](const Lit& part) {
    const TriangleRecord<Real>& t = triangles_[part.face];
    const Beam<Real> beam = {t.apex_x(part.edge), t.apex_h(part.edge),
                             static_cast<Real>(part.begin), static_cast<Real>(part.end)};
    Window<Real> window = {beam.mirrored(t.length[part.edge]), sigma, 0, 0, error};
    window.begin_at(window.beam.begin);
    window.end_at(window.beam.end);
    leave(order, part.face, part.edge, window, source);
  };
  const auto along = [&](const FanWalk& walk) {
    const TriangleRecord<Real>& t = triangles_[walk.face];
    const Index e = walk.leaving_edge();
    const Index far = static_cast<Index>(walk.by_start ? edge_after(e) : e);
    offer(order, t.corner[far], sigma + t.length[e], 3 * walk.face + far,
          walk.by_start ? Towards<Real>{t.cosine[far], t.sine(far)} : Towards<Real>{1, 0}, source,
          error);
  };
  if (anywhere || kind == VertexAngles::irregular) {
    mesh_.corners_at(vertex, corners_);
    pseudo_source_.shine_all(corners_, lit, along);
  } else {
    const Arrival<double> arrival = {v.corner & ~bent, static_cast<double>(v.from.along),
                                     static_cast<double>(v.from.off)};
    const Towards<double> wider =
        is_bent ? Towards<double>{0, 1} : Towards<double>{1, static_cast<double>(scale_)};
    pseudo_source_.shine(arrival, kind == VertexAngles::boundary, wider, lit, along);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::seed(Order& order, std::span<const PointSource> sources) {
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const Index number = static_cast<Index>(n);
    const Real sigma = static_cast<Real>(s.offset / mesh_.unit());
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, none, {0, 0}, number, 0);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const auto corner = std::find(b.begin(), b.begin() + 3, 1.);
    if (corner != b.begin() + 3) {
      offer(order, t.corner[corner - b.begin()], sigma, none, {0, 0}, number, 0);
      continue;
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t i = edge_after(e), p = edge_before(e);
      const double length = static_cast<double>(t.length[e]);
      const double x = b[i] * length + b[p] * static_cast<double>(t.apex_x(e));
      const double h = b[p] * static_cast<double>(t.apex_h(e));
      const Beam<double> beam = Beam<double>{x, h, 0, length}.mirrored(length);
      Window<Real> window = {
          {static_cast<Real>(beam.x), static_cast<Real>(beam.h), 0, t.length[e]}, sigma, 0, 0, 0};
      window.begin_at(0);
      window.end_at(t.length[e]);
      leave(order, f, e, window, number);
      offer(order, t.corner[e], sigma + static_cast<Real>(std::sqrt(x * x + h * h)),
            static_cast<Index>(3 * f + e), {static_cast<Real>(x), static_cast<Real>(h)}, number, 0);
    }
  }
}

template <class Real>
template <class Order>
bool MergedWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity<Real>) return false;
  bool any = false;
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const TriangleRecord<Real>& t = triangles_[f];
    for (std::size_t e = 0; e < 3; ++e)
      for (const auto& [from, to] : {std::pair(e, edge_after(e)), std::pair(edge_after(e), e)}) {
        const Index v = t.corner[from], w = t.corner[to];
        if (vertices_[w].distance < infinity<Real> || !(vertices_[v].distance < infinity<Real>))
          continue;
        offer(order, w, vertices_[v].distance + t.length[e], none, {0, 0}, labels_ ? source_[v] : 0,
              error_[v]);
        any = true;
      }
  }
  return any;
}

template <class Real>
std::size_t MergedWindows<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(excess_) + of(vertices_) + of(source_) + of(error_) + of(pending_) +
         of(blocks_) + of(entries_) + of(corners_);
}

template class MergedWindows<float>;
template class MergedWindows<double>;

}  // namespace plexway::windows
