#include "windows/merged_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <plexway/error.hpp>

#include "windows/entered_triangle.hpp"

namespace plexway::detail::windows {
namespace {

template <class Real>
constexpr Real unreached = std::numeric_limits<Real>::infinity();

/// In mean edges. Wider ones take more turns, since halfedges have theirs before all is there.
constexpr double merged_bucket_width = 0.125;
/// Vertices have their turn so much later than their distance, in mean edges: after the light that
/// may reach them straight.
constexpr double late = 0.25;
/// So many turns a halfedge in the mean are too many: below one is usual.
constexpr std::size_t merge_patience = 4;
constexpr std::size_t merged_share =
    65536;  ///< turns between two looks at what is told and allowed

}  // namespace

template <class Real>
MergedWindows<Real>::MergedWindows(const Sheet<Real>& sheet)
    : sheet_(sheet), triangles_(sheet.triangles), own_(sheet.own), pseudo_source_(triangles_) {}

template <class Real>
bool MergedWindows<Real>::solve(const WindowSources& sources, const PropagateOptions& options,
                                const MergeLimit& limit, std::vector<Real>& distance,
                                KeptWindows<Real>* kept) {
  begin(sources, options, limit, distance);
  kept_ = kept;
  const auto solve_in = [&](auto& order) {
    order.start(merged_bucket_width);
    seed(order, sources);
    Outcome outcome;
    do outcome = run(order, options);
    while (outcome == Outcome::done && fill_holes(order));
    complete_ = outcome == Outcome::done;
    return outcome != Outcome::too_much;
  };
  return in_order(options.schedule, nearest_, ring_, solve_in);
}

template <class Real>
Real MergedWindows<Real>::scale_at(double distance) const {
  if (!(limit_.reach < unreached<double>)) return static_cast<Real>(limit_.limit);
  const double way = std::max(distance - least_offset_, 0.);
  const double scale = limit_.limit * std::sqrt(way / limit_.reach);
  return static_cast<Real>(way > limit_.far ? scale * limit_.share_far : scale);
}

template <class Real>
Real MergedWindows<Real>::near(Index node) const {
  return node & bent ? distance_[shining_[node & ~bent].place] + static_cast<Real>(late)
                     : blocks_[node].near;
}

template <class Real>
[[gnu::always_inline]] inline Index& MergedWindows<Real>::next(Index node) {
  return node & bent ? shining_[node & ~bent].next : blocks_[node].next;
}

/// What the next turn will look up.
template <class Real>
[[gnu::always_inline]] inline void MergedWindows<Real>::fetch(Index node) const {
  if (node & bent) return;
  __builtin_prefetch(&triangles_[blocks_[node].place >> 2]);
}

template <class Real>
template <class Order>
[[gnu::always_inline]] inline void MergedWindows<Real>::commit_any(Order& order, const Turn& turn) {
  scale_ = turn.scale;
  if (turn.windows.size() == 1)
    commit_one(order, turn);
  else
    commit(order, turn);
}

template <class Real>
template <class Order>
typename MergedWindows<Real>::Outcome MergedWindows<Real>::run(Order& order,
                                                               const PropagateOptions& options) {
  std::size_t report = statistics_.expansions / merged_share * merged_share + merged_share;
  for (;;) {
    const std::size_t until = std::min(report, options.max_expansions);
    if (spread(order, until - statistics_.expansions)) return Outcome::done;
    if (statistics_.expansions == options.max_expansions) return left_over(order);
    report += merged_share;
    if (options.progress &&
        !options.progress({statistics_.expansions, statistics_.reached_simplices, own_,
                           order.distance() * sheet_.mesh->unit()}))
      throw Cancelled("cancelled by the progress callback");
    if (too_many(statistics_.expansions, own_)) return Outcome::too_much;
  }
}

/// Until nothing waits (true), or so many turns were taken: what was prepared last then waits to be
/// committed.
template <class Real>
template <class Order>
bool MergedWindows<Real>::spread(Order& order, std::size_t most) {
  const auto next_of = [this](Index n) -> Index& { return next(n); };
  const auto near_of = [this](Index n) { return static_cast<double>(near(n)); };
  double before = -1;
  Real scale = 0;
  // One turn is prepared before the one ahead of it is committed: what a wrong guess there undoes
  // is then not the arithmetic.
  std::size_t current = current_;
  bool waits = waits_;
  for (const std::size_t end = statistics_.expansions + most; statistics_.expansions != end;) {
    const Index n = order.pop(next_of, near_of);
    if (n == none) {
      current_ = current;
      waits_ = false;
      if (!waits) return true;
      waits = false;
      commit_any(order, turns_[current ^ 1]);
      continue;
    }
    ++statistics_.expansions;
    if (const Index after = order.peek(); after != none) fetch(after);
    if (order.distance() != before) scale = scale_at(before = order.distance());
    scale_ = scale;
    if (n & bent) {
      const Shining waited = shining_[n & ~bent];
      shining_at_.remove(n & ~bent, shining_);
      shining_[n & ~bent].next = std::exchange(free_shining_, n & ~bent);
      shine(order, waited.place, waited.arrival);
      continue;
    }
    Turn& turn = turns_[current];
    const Block& block = start(turn, n);
    if (block.count == 1) {
      turn.windows.append({block.window[0], labels_ ? block.source[0] : 0});
      turn.spread[0].go(turn.triangle, turn.windows[0].window);
    } else {
      gather(turn.windows, block);
      if (turn.windows.size() == 1)
        turn.spread[0].go(turn.triangle, turn.windows[0].window);
      else
        prepare(turn);
    }
    if (kept_) [[unlikely]] {
      for (std::size_t i = 0; i < turn.windows.size(); ++i) {
        const auto& [window, source] = turn.windows[i];
        kept_->take(block.place, window.beam, window.sigma, source);
      }
    }
    current ^= 1;
    if (waits) commit_any(order, turns_[current]);
    waits = true;
  }
  current_ = current;
  waits_ = waits;
  return false;
}

template <class Real>
template <class Order>
void MergedWindows<Real>::offer(Order& order, Index vertex, Real distance, Index corner,
                                Towards<Real> from, Index source, Real error) {
  if (know(order, vertex, distance, corner, from, source, error) && vertex < sheet_.shared)
      [[unlikely]]
    leaving_.tell(vertex);
}

/// Did the vertex get nearer?
template <class Real>
template <class Order>
[[gnu::always_inline]] inline bool MergedWindows<Real>::know(Order& order, Index vertex,
                                                             Real distance, Index corner,
                                                             Towards<Real> from, Index source,
                                                             Real error) {
  if (!(distance < distance_[vertex])) return false;
  distance_[vertex] = distance;
  error_[vertex] = static_cast<float>(error);
  if (labels_) source_[vertex] = source;
  ++statistics_.updates;
  const Arrival<float> arrival = {corner, static_cast<float>(from.along),
                                  static_cast<float>(from.off)};
  if (vertex < sheet_.shared) [[unlikely]]
    arrivals_[vertex] = arrival;
  const Index waits = WaitingTable::find(shining_at_.list(vertex), vertex, shining_);
  if (waits != none) {
    shining_[waits].arrival = arrival;
  } else if (corner == none || (corner & bent) || excess(vertex) > 4 * scale_) {
    order.push(will_shine({vertex, arrival, none, none}) | bent,
               static_cast<double>(distance + static_cast<Real>(late)),
               [this](Index i) -> Index& { return next(i); });
  }
  return true;
}

/// The number that it gets.
template <class Real>
[[gnu::noinline]] Index MergedWindows<Real>::will_shine(const Shining& vertex) {
  Index number = free_shining_;
  if (number == none) {
    number = static_cast<Index>(shining_.size());
    shining_at_.make_room(shining_.size() + 1, shining_);
    shining_.push_back(vertex);
  } else {
    free_shining_ = shining_[number].next;
    shining_[number] = vertex;
  }
  shining_[number].link = std::exchange(shining_at_.list(vertex.place), number);
  return number;
}

/// All that waits in a block.
template <class Real>
void MergedWindows<Real>::gather(Gathered<Real>& windows, const Block& block) const {
  const std::size_t count = block.count;
  const auto take = [&](std::size_t i) {
    windows.take({block.window[i], labels_ ? block.source[i] : 0});
  };
  if (count == 2) {
    const std::size_t first = block.window[1].beam.begin < block.window[0].beam.begin;
    windows.append({block.window[first], labels_ ? block.source[first] : 0});
    take(first ^ 1);
    return;
  }
  std::array<std::size_t, room> place{}, at;
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool before = block.window[i].beam.begin < block.window[j].beam.begin;
      place[i] += !before;
      place[j] += before;
    }
  for (std::size_t i = 0; i < count; ++i) at[place[i]] = i;
  for (std::size_t i = 0; i < count; ++i) take(at[i]);
}

template <class Real>
template <class Order>
[[gnu::always_inline]] inline void MergedWindows<Real>::enter(Order& order, Index halfedge,
                                                              const Window<Real>& window,
                                                              Index source) {
  if (radius_ < unreached<Real> && window.nearest() > radius_) [[unlikely]]
    return;
  const Real near = turn_of(window);
  Index* list = &waiting_at_.list(halfedge);
  const Index waiting = WaitingTable::find(*list, halfedge, blocks_);
  if (waiting != none) {
    Block& block = blocks_[waiting];
    block.window[block.count] = window;
    if (labels_) block.source[block.count] = source;
    // Full ones need not be found: edges of many triangles have thousands.
    if (++block.count == room) waiting_at_.remove(waiting, blocks_);
    block.near = std::min(block.near, near);
    return;
  }
  // The first, or one more than there is room for: that begins another turn.
  Index b = free_block_;
  if (b == none) [[unlikely]] {
    b = waiting_at_.one_more(blocks_);
    list = &waiting_at_.list(halfedge);
  } else {
    free_block_ = blocks_[b].next;
  }
  __builtin_prefetch(&triangles_[halfedge >> 2]);
  Block& block = blocks_[b];
  block.near = near;
  block.place = halfedge;
  block.link = std::exchange(*list, b);
  block.count = 1;
  block.window[0] = window;
  if (labels_) block.source[0] = source;
  order.push(b, static_cast<double>(near),
             [&](Index i) -> Index& { return i == b ? block.next : next(i); });
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
  if ((across & Across::special) || across >> Across::face_shift >= own_) [[unlikely]]
    leave_special(order, f, edge, window, source);
  else
    enter(order, halfedge_of(across), window, source);
}

template <class Real>
template <class Order>
[[gnu::noinline]] void MergedWindows<Real>::leave_special(Order& order, Index f, std::size_t edge,
                                                          const Window<Real>& window,
                                                          Index source) {
  const Index sentinel = sheet_.sentinel();
  if (triangles_[f].across[edge] >> Across::face_shift == sentinel) return;
  const Window<Real> mirrored = window.mirrored(triangles_[f].length[edge]);
  cross_edge(triangles_, f, edge, [&](Index across, bool turned) {
    const Window<Real>& seen = turned ? mirrored : window;
    if (across >> Across::face_shift >= own_)
      leaving_.windows.push_back({halfedge_of(across), source, none, seen});
    else
      enter(order, halfedge_of(across), seen, source);
  });
}

/// A block has its turn.
template <class Real>
[[gnu::always_inline]] inline auto MergedWindows<Real>::start(Turn& turn, Index b) -> Block& {
  Block& block = blocks_[b];
  block.next = std::exchange(free_block_, b);
  const Index halfedge = block.place;
  if (block.count < room) waiting_at_.remove(b, blocks_);
  turn.face = halfedge >> 2;
  turn.scale = scale_;
  const TriangleRecord<Real>& record = triangles_[turn.face];
  turn.triangle.enter(record, halfedge & 3);
  const EnteredTriangle<Real>& t = turn.triangle;
  __builtin_prefetch(&distance_[t.p]);
  turn.windows.start(t.width, scale_);
  return block;
}

/// One window goes on: straight to the apex, or around the end that is nearer to it.
template <class Real>
template <class Order>
[[gnu::always_inline]] inline void MergedWindows<Real>::commit_one(Order& order, const Turn& turn) {
  const EnteredTriangle<Real>& t = turn.triangle;
  const Spread<Real>& s = turn.spread[0];
  const auto& [w, source] = turn.windows[0];
  const bool right = s.right_reaches(), seen = s.left_reaches() & right;
  const Real ends[2] = {w.beam.begin, w.beam.end}, to_ends[2] = {w.at_begin, w.at_end};
  const Real dx = t.apex_x - ends[right];
  const Real ways[2] = {to_ends[right] + std::sqrt(dx * dx + t.apex_h * t.apex_h), s.distance[1]};
  if (ways[seen] < distance_[t.p]) {
    const Index corner = static_cast<Index>(3 * turn.face + t.before);
    offer(order, t.p, ways[seen], seen ? corner : corner | bent,
          seen ? t.towards(w.beam) : t.towards(ends[right], 0), source, w.error);
  }
  const int wanted = s.wanted(distance_[t.a], distance_[t.b], distance_[t.p], scale_ * s.length);
  if (wanted & 1) leave(order, turn.face, t.before, s.left(w), source);
  if (wanted & 2) leave(order, turn.face, t.after, s.right(w), source);
}

/// Several windows, before vertices are looked at.
template <class Real>
[[gnu::always_inline]] inline void MergedWindows<Real>::prepare(Turn& turn) {
  const EnteredTriangle<Real>& t = turn.triangle;
  const Gathered<Real>& windows = turn.windows;
  turn.to_apex = unreached<Real>;
  turn.seen = 0;
  const auto sees = [&](std::size_t i, Real distance) {
    const std::size_t nearer = distance < turn.to_apex;
    turn.to_apex = std::min(distance, turn.to_apex);
    turn.seen += nearer * (i - turn.seen);
  };
  using L = typename Spread<Real>::L;
  constexpr Real if_not[2] = {unreached<Real>, 0};  // as good as random: no branch
  for (std::size_t i = 0; i < windows.size(); ++i) {
    Spread<Real>& s = turn.spread[i];
    s.go(t, windows[i].window);
    sees(i, s.distance[1] + if_not[s.reaches_apex()]);
    if (i == 0 || !windows.joined(windows[i - 1], windows[i])) continue;
    // No gap opens between joined neighbours: both reach the apex if it lies there and they agree
    // on it, else they meet at the middle.
    Spread<Real>& before = turn.spread[i - 1];
    const Window<Real>&window_before = windows[i - 1].window, &window = windows[i].window;
    if (!before.left_reaches() && !s.right_reaches()) {
      const Spread<Real> dark_before = before, dark = s;
      before.at = L(before.at[0], t.left, before.at[2], before.at[3]);
      s.at = L(s.at[0], s.at[1], s.at[2], t.right);
      before.measure(t, window_before);
      s.measure(t, window);
      const Real from_left = before.distance[1], from_right = s.distance[3];
      if (std::abs(from_left - from_right) <= 4 * scale_ * t.width)
        sees(from_left < from_right ? i : i - 1, std::max(from_left, from_right));
      else
        before = dark_before, s = dark;
    } else if (before.at[1] < s.at[0]) {
      const Real middle = (before.at[1] + s.at[0]) / 2;
      before.at = L(before.at[0], middle, before.at[2], before.at[3]);
      s.at = L(middle, s.at[1], s.at[2], s.at[3]);
      before.measure(t, window_before);
      s.measure(t, window);
    } else if (s.at[3] < before.at[2]) {
      const Real middle = (before.at[2] + s.at[3]) / 2;
      before.at = L(before.at[0], before.at[1], middle, before.at[3]);
      s.at = L(s.at[0], s.at[1], s.at[2], middle);
      before.measure(t, window_before);
      s.measure(t, window);
    }
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::commit(Order& order, const Turn& turn) {
  const EnteredTriangle<Real>& t = turn.triangle;
  const Gathered<Real>& windows = turn.windows;
  const Index corner = static_cast<Index>(3 * turn.face + t.before);
  Real bound = distance_[t.p];
  const bool is_lit = turn.to_apex < unreached<Real>;
  if (turn.to_apex < bound) {
    const Labelled<Real>& seen = windows[turn.seen];
    offer(order, t.p, turn.to_apex, corner, t.towards(seen.window.beam), seen.source,
          seen.window.error);
    bound = turn.to_apex;
  }
  // Around the end of what is lit beside it; where another window sees it, if that is shorter by
  // more than merging may be off.
  if (is_lit) bound -= 4 * scale_ * t.width;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Window<Real>& w = windows[i].window;
    const bool to_left = turn.spread[i].right_reaches();
    const Real end = to_left ? w.beam.end : w.beam.begin, dx = t.apex_x - end;
    const Real way = (to_left ? w.at_end : w.at_begin) + std::sqrt(dx * dx + t.apex_h * t.apex_h);
    if ((way < bound) & !(to_left & turn.spread[i].left_reaches())) [[unlikely]]
      offer(order, t.p, way, corner | bent, t.towards(end, 0), windows[i].source, w.error);
  }
  const Real to_a = distance_[t.a], to_b = distance_[t.b];
  const Real to_p = distance_[t.p];
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
void MergedWindows<Real>::shine(Order& order, Index vertex, const Arrival<float>& from) {
  const Real sigma = distance_[vertex];
  if (sigma > radius_) return;
  const bool anywhere = from.corner == none, is_bent = !anywhere && (from.corner & bent);
  // What is bent looks around both corners of what is lit; else only strong saddles shine.
  const Real shadow = excess(vertex) + (is_bent ? std::numbers::pi_v<Real> : -4 * scale_);
  if (!anywhere && !(shadow > 0)) return;
  const Index source = labels_ ? source_[vertex] : 0;
  const Real error = static_cast<Real>(error_[vertex]);
  const VertexAngles::Kind kind = sheet_.angles->kind[vertex];
  const auto lit = [&](const Lit& part) {
    if (part.face >= own_) return;
    const TriangleRecord<Real>& t = triangles_[part.face];
    const Beam<Real> beam = {t.apex_x(part.edge), t.apex_h(part.edge),
                             static_cast<Real>(part.begin), static_cast<Real>(part.end)};
    Window<Real> window = {beam.mirrored(t.length[part.edge]), sigma, 0, 0, error};
    window.begin_at(window.beam.begin);
    window.end_at(window.beam.end);
    leave(order, part.face, part.edge, window, source);
  };
  const auto along = [&](const FanWalk& walk) {
    if (walk.face >= own_) return;
    const TriangleRecord<Real>& t = triangles_[walk.face];
    const Index e = walk.leaving_edge();
    const Index far = static_cast<Index>(walk.by_start ? edge_after(e) : e);
    offer(order, t.corner[far], sigma + t.length[e], 3 * walk.face + far,
          walk.by_start ? Towards<Real>{t.cosine[far], t.sine(far)} : Towards<Real>{1, 0}, source,
          error);
  };
  if (anywhere || kind == VertexAngles::irregular) {
    sheet_.corners_at(vertex, corners_);
    pseudo_source_.shine_all(corners_, lit, along);
  } else {
    const Arrival<double> arrival = {from.corner & ~bent, static_cast<double>(from.along),
                                     static_cast<double>(from.off)};
    const Towards<double> wider =
        is_bent ? Towards<double>{0, 1} : Towards<double>{1, static_cast<double>(scale_)};
    pseudo_source_.shine(arrival, kind == VertexAngles::boundary, wider, lit, along);
  }
}

}  // namespace plexway::detail::windows

#include "windows/merged_seeds.inl"

namespace plexway::detail::windows {
template class MergedWindows<float>;
template class MergedWindows<double>;

}  // namespace plexway::detail::windows
