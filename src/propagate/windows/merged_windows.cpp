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
/// A boundary that turns by less is straight: rounding, in radians.
constexpr double turned = 1e-5;
/// So many turns a halfedge in the mean are too many: one to four are usual.
constexpr std::size_t patience = 12;

}  // namespace

template <class Real>
MergedWindows<Real>::MergedWindows(const TriangleMesh<Real>& mesh, const VertexAngles& angles)
    : triangles_(mesh.triangles()), mesh_(mesh), angles_(angles), pseudo_source_(triangles_) {
  excess_.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double excess = angles.excess(v);
    // At a boundary no light comes from the other side to close the gap behind a weak saddle.
    const bool strong = angles.kind[v] == VertexAngles::boundary && excess > turned;
    excess_[v] = strong ? infinity<Real> : static_cast<Real>(excess);
  }
}

template <class Real>
bool MergedWindows<Real>::solve(std::span<const PointSource> sources,
                                const PropagateOptions& options, const MergeLimit& limit,
                                KeptWindows<Real>* kept) {
  limit_ = limit;
  kept_ = kept;
  labels_ = sources.size() > 1;
  vertices_.assign(mesh_.vertex_count(), {infinity<Real>, none, {0, 0}});
  error_.resize(mesh_.vertex_count());
  if (labels_) source_.resize(mesh_.vertex_count());
  if (pending_.empty() || !complete_) pending_.assign(4 * mesh_.face_count(), none);
  blocks_.clear();
  entries_.clear();
  free_block_ = free_entry_ = none;
  complete_ = false;  // until all is done: a callback may throw
  statistics_ = {};
  radius_ = static_cast<Real>(options.radius / mesh_.unit());
  set_scale(0);
  const auto solve_in = [&](auto& order) {
    order.start(bucket_width);
    seed(order, sources);
    Outcome outcome;
    do outcome = run(order, options);
    while (outcome == Outcome::done && fill_holes(order));
    complete_ = outcome == Outcome::done;
    return outcome != Outcome::too_much;
  };
  switch (options.schedule) {
    case Schedule::fifo: {
      FirstIn line;
      return solve_in(line);
    }
    case Schedule::priority:
      return solve_in(nearest_);
    default: {
      BucketRing ring;
      return solve_in(ring);
    }
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
[[gnu::always_inline]] inline void MergedWindows<Real>::push(Order& order, Index what, Real near) {
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
  const Index* const pending = pending_.data();  // a boundary leads to its end
  __builtin_prefetch(pending + (t.across[before] >> Across::face_shift << 2));
  __builtin_prefetch(pending + (t.across[after] >> Across::face_shift << 2));
}

template <class Real>
template <class Order>
typename MergedWindows<Real>::Outcome MergedWindows<Real>::run(Order& order,
                                                               const PropagateOptions& options) {
  const auto next = [this](Index n) -> Index& { return entries_[n].next; };
  const auto near_of = [this](Index n) { return static_cast<double>(near(entries_[n].what)); };
  constexpr std::size_t share = 65536;
  std::size_t report = statistics_.expansions / share * share + share;
  double before = -1;
  for (Index n; (n = order.pop(next, near_of)) != none;) {
    const Index what = entries_[n].what;
    const bool vertex = (what & bent) != 0;
    if (!vertex && pending_[what] == none) {  // it had its turn when something nearer came
      entries_[n].next = std::exchange(free_entry_, n);
      continue;
    }
    if (statistics_.expansions == options.max_expansions) return Outcome::stopped;
    ++statistics_.expansions;
    entries_[n].next = std::exchange(free_entry_, n);
    if (const Index after = order.peek(); after != none) fetch(entries_[after].what);
    if (order.distance() != before) set_scale(before = order.distance());
    if (vertex) {
      shine(order, what & ~bent);
    } else {
      prepare(turn_, what);
      commit(order, turn_);
    }
    if (statistics_.expansions < report) continue;
    report += share;
    if (options.progress &&
        !options.progress({statistics_.expansions, statistics_.reached_simplices,
                           mesh_.face_count(), order.distance() * mesh_.unit()}))
      throw Cancelled("cancelled by the progress callback");
    if (statistics_.expansions > patience * 3 * mesh_.face_count() + share)
      return Outcome::too_much;
  }
  return Outcome::done;
}

template <class Real>
template <class Order>
void MergedWindows<Real>::offer(Order& order, Index vertex, Real distance, Index corner,
                                Towards<Real> from, Index source, Real error) {
  Vertex& v = vertices_[vertex];
  if (!(distance < v.distance)) return;
  v = {distance, corner, from};
  error_[vertex] = error;
  if (labels_) source_[vertex] = source;
  ++statistics_.updates;
  if (corner == none || (corner & bent) || excess_[vertex] > 4 * scale_)
    push(order, vertex | bent, distance + static_cast<Real>(late));
}

/// All that waits in a block.
template <class Real>
void MergedWindows<Real>::gather(Gathered<Real>& windows, const Block& block) {
  const std::size_t count = block.count;
  std::array<unsigned, room> rank;
  for (unsigned i = 0; i < count; ++i) {
    unsigned at = i;
    for (; at > 0 && block.window[i].beam.begin < block.window[rank[at - 1]].beam.begin; --at)
      rank[at] = rank[at - 1];
    rank[at] = i;
  }
  for (std::size_t i = 0; i < count; ++i)
    windows.take({block.window[rank[i]], block.source[rank[i]]});
}

template <class Real>
void MergedWindows<Real>::make_room(Block& block, Real length) {
  crowd_.start(length, scale_);
  gather(crowd_, block);
  while (crowd_.size() >= room) crowd_.shorten();
  block.count = static_cast<Index>(crowd_.size());
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    block.window[i] = crowd_[i].window;
    block.source[i] = crowd_[i].source;
  }
}

template <class Real>
template <class Order>
[[gnu::always_inline]] inline void MergedWindows<Real>::enter(Order& order, Index across,
                                                              const Window<Real>& window,
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
  if (block.count == room) make_room(block, triangles_[halfedge >> 2].length[halfedge & 3]);
  block.window[block.count] = window;
  block.source[block.count++] = source;
  if (near < block.nearest) {
    block.nearest = near;
    push(order, halfedge, near);
  }
}

/// A window over edge `edge` of f, measured from the edge's second corner, enters all triangles on
/// the other side.
template <class Real>
template <class Order>
[[gnu::always_inline]] inline void MergedWindows<Real>::leave(Order& order, Index f,
                                                              std::size_t edge,
                                                              const Window<Real>& window,
                                                              Index source) {
  const Index across = triangles_[f].across[edge];
  if (across >> Across::face_shift == mesh_.face_count()) return;
  if (across & Across::special) [[unlikely]]
    leave_special(order, f, edge, window, source);
  else
    enter(order, across, window, source);
}

template <class Real>
template <class Order>
[[gnu::noinline]] void MergedWindows<Real>::leave_special(Order& order, Index f, std::size_t edge,
                                                          const Window<Real>& window,
                                                          Index source) {
  const Window<Real> turned = window.mirrored(triangles_[f].length[edge]);
  Index across = triangles_[f].across[edge];
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
[[gnu::always_inline]] inline void MergedWindows<Real>::prepare(Turn& turn, Index halfedge) {
  const Index b = std::exchange(pending_[halfedge], none);
  Block& block = blocks_[b];
  turn.face = halfedge >> 2;
  const EnteredTriangle<Real>& t = turn.triangle;
  turn.triangle.enter(triangles_[turn.face], halfedge & 3);
  Gathered<Real>& windows = turn.windows;
  windows.start(t.width, scale_);
  if (block.count == 1)
    windows.append({block.window[0], block.source[0]});
  else
    gather(windows, block);
  if (block.nearest > radius_) [[unlikely]]
    windows.clear();
  block.count = std::exchange(free_block_, b);
  if (kept_) [[unlikely]]
    for (std::size_t i = 0; i < windows.size(); ++i)
      kept_->take(halfedge, windows[i].window.beam, windows[i].window.sigma, windows[i].source);

  turn.to_apex = infinity<Real>;
  turn.seen = 0;
  const auto sees = [&](std::size_t i, Real distance) {
    if (distance < turn.to_apex) turn.to_apex = distance, turn.seen = i;
  };
  for (std::size_t i = 0; i < windows.size(); ++i) {
    Spread<Real>& s = turn.spread[i];
    s.go(t, windows[i].window);
    if (s.left_reaches() && s.right_reaches()) sees(i, s.distance[1]);
    if (i == 0 || !windows.joined(windows[i - 1], windows[i])) continue;
    // No gap opens between joined neighbours: both reach the apex if it lies there and they agree
    // on it, else they meet at the middle.
    Spread<Real>& before = turn.spread[i - 1];
    const Real sigma_before = windows[i - 1].window.sigma, sigma = windows[i].window.sigma;
    if (!before.left_reaches() && !s.right_reaches()) {
      const Spread<Real> dark_before = before, dark = s;
      before.at.v[1] = t.left;
      s.at.v[3] = t.right;
      before.measure(sigma_before);
      s.measure(sigma);
      const Real from_left = before.distance[1], from_right = s.distance[3];
      if (std::abs(from_left - from_right) <= 4 * scale_ * t.width)
        sees(from_left < from_right ? i : i - 1, std::max(from_left, from_right));
      else
        before = dark_before, s = dark;
    } else if (before.at[1] < s.at[0]) {
      before.at.v[1] = s.at.v[0] = (before.at[1] + s.at[0]) / 2;
      before.measure(sigma_before);
      s.measure(sigma);
    } else if (s.at[3] < before.at[2]) {
      before.at.v[2] = s.at.v[3] = (before.at[2] + s.at[3]) / 2;
      before.measure(sigma_before);
      s.measure(sigma);
    }
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::commit(Order& order, const Turn& turn) {
  const EnteredTriangle<Real>& t = turn.triangle;
  const Gathered<Real>& windows = turn.windows;
  const Index corner = static_cast<Index>(3 * turn.face + t.before);
  if (turn.to_apex < infinity<Real>) {
    const Labelled<Real>& seen = windows[turn.seen];
    if (turn.to_apex < vertices_[t.p].distance)
      offer(order, t.p, turn.to_apex, corner, t.towards(seen.window.beam.x, seen.window.beam.h),
            seen.source, seen.window.error);
  } else {
    // Around the nearest end of what is lit.
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const Window<Real>& w = windows[i].window;
      const bool to_left = turn.spread[i].right_reaches();
      const Real end = to_left ? w.beam.end : w.beam.begin, dx = t.apex_x - end;
      offer(order, t.p,
            (to_left ? w.at_end : w.at_begin) + std::sqrt(dx * dx + t.apex_h * t.apex_h),
            corner | bent, t.towards(end, 0), windows[i].source, w.error);
    }
  }
  const Real to_a = vertices_[t.a].distance, to_b = vertices_[t.b].distance;
  const Real to_p = vertices_[t.p].distance;
  using L = typename Spread<Real>::L;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Labelled<Real>& w = windows[i];
    const int wanted = turn.spread[i].wanted(to_a, to_b, to_p, L(scale_) * turn.spread[i].length);
    if (wanted & 1) leave(order, turn.face, t.before, turn.spread[i].left(w.window), w.source);
    if (wanted & 2) leave(order, turn.face, t.after, turn.spread[i].right(w.window), w.source);
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
  if (radius_ < infinity<Real> ||
      std::all_of(vertices_.begin(), vertices_.end(),
                  [](const Vertex& v) { return v.distance < infinity<Real>; }))
    return false;
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
