#include "windows/exact_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/number_range.hpp"
#include "windows/entered_triangle.hpp"

namespace plexway::detail::windows {
namespace {

/// What single precision may be off, relative.
constexpr double single = static_cast<double>(std::numeric_limits<float>::epsilon());

/// What the triangles' own numbers are worth.
template <class Real>
struct Rounding {
  static constexpr double tie = 1e-12;     ///< paths that differ by less are equal, relative
  static constexpr double cover = 1e-9;    ///< by this share of an edge light may miss a vertex
  static constexpr double excess = 1e-12;  ///< what the angles of a flat fan may be off, radians
  static constexpr double shadow = 1e-9;   ///< shadows are made so much wider, radians
};
template <>
struct Rounding<float> {
  static constexpr double tie = 1e-6, cover = 1e-5, excess = 2e-6, shadow = 1e-5;
};

/// No source lies nearer to the line of its edge than this, in lengths of the edge: one on the edge
/// itself then lights both of its sides.
constexpr double least_height(double width) { return 1e-14 * width + 1e-290; }
/// So many windows a triangle, and ties are no longer broken in favour of both: where lengths are
/// no metric, or nothing has any length, light could go around for ever.
constexpr std::size_t most_with_ties = 1000;
constexpr std::size_t share = 65536;  ///< windows between two looks at what is told and allowed
/// In mean edges.
constexpr double bucket_width = 0.5;

/// Two numbers at once: for a ray through a window's begin and one through its end.
typedef double Pair __attribute__((vector_size(16)));
/// A point of an edge is `shift` times its length plus `factor` times the way from the pivot.
struct FromPivot {
  double factor, shift;
};
constexpr FromPivot from_pivot[2] = {{1, 0}, {-1, 1}};

Window<double> measured_window(const Beam<double>& beam, double sigma) {
  Window<double> window = {beam, sigma, 0, 0, 0};
  window.begin_at(beam.begin);
  window.end_at(beam.end);
  return window;
}

}  // namespace

template <class Real>
ExactWindows<Real>::ExactWindows(const Sheet<Real>& sheet)
    : sheet_(sheet), triangles_(sheet.triangles), own_(sheet.own), pseudo_source_(triangles_) {}

template <class Real>
double ExactWindows<Real>::least_tie() {
  return Rounding<Real>::tie;
}

template <class Real>
bool ExactWindows<Real>::ties_end(std::size_t windows, std::size_t triangles) {
  return windows / most_with_ties > triangles;
}

template <class Real>
void ExactWindows<Real>::end_ties() {
  tie_ = -least_tie();
}

template <class Real>
bool ExactWindows<Real>::solve(const WindowSources& sources, const PropagateOptions& options,
                               const Patience& patience, KeptWindows<Real>* kept) {
  begin(sources, options, patience);
  kept_ = kept;
  const auto solve_in = [&](auto& order) {
    order.start(bucket_width);
    seed(order, sources);
    do
      if (!run(order, options)) return false;
    while (complete_ && fill_holes(order));
    return true;
  };
  return in_order(options.schedule, nearest_, ring_, solve_in);
}

template <class Real>
template <class Order>
bool ExactWindows<Real>::run(Order& order, const PropagateOptions& options) {
  const auto next = [this](Index n) -> Index& { return nodes_[n].next; };
  const auto near = [this](Index n) { return nearest(nodes_[n]); };
  for (;;) {
    if (statistics_.expansions >= options.max_expansions) {
      complete_ = order.pop(next, near) == none;
      return true;
    }
    if (statistics_.expansions >= share && options.progress &&
        !options.progress({statistics_.expansions, statistics_.reached_simplices, own_,
                           order.distance() * sheet_.mesh->unit()}))
      throw Cancelled("cancelled by the progress callback");
    if (too_many()) return false;
    if (ties_end(statistics_.expansions, own_)) end_ties();
    const std::size_t pause =
        std::min(options.max_expansions, (statistics_.expansions / share + 1) * share);
    if (spread(order, pause - statistics_.expansions)) return true;
  }
}

/// Until nothing waits (true), or so many windows.
template <class Real>
template <class Order>
bool ExactWindows<Real>::spread(Order& order, std::size_t most) {
  const auto next = [this](Index n) -> Index& { return nodes_[n].next; };
  const auto near = [this](Index n) { return nearest(nodes_[n]); };
  std::size_t turns = 0;
  for (; turns != most; ++turns) {
    const Index n = order.pop(next, near);
    if (n == none) break;
    if (const Index after = order.peek(); after != none) {
      const Node& node = nodes_[after];
      __builtin_prefetch(&nodes_[node.next != none ? node.next : after]);
      const Index face = node.edge & vertex_bit ? 0 : node.edge >> 2;
      const char* const t = reinterpret_cast<const char*>(&triangles_[face]);
      __builtin_prefetch(t);
      __builtin_prefetch(t + 64);
    }
    if (nodes_[n].edge & vertex_bit) [[unlikely]] {
      const Index vertex = nodes_[n].edge & ~vertex_bit;
      nodes_[n].next = std::exchange(free_, n);
      shine(order, vertex);
    } else {
      if (kept_) [[unlikely]]
        keep(nodes_[n], labels_ ? node_source_[n] : 0);
      expand(order, n);
    }
  }
  statistics_.expansions += turns;
  return turns != most;
}

template <class Real>
void ExactWindows<Real>::keep(const Node& node, Index source) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  const Beam<double>& b = node.beam;
  kept_->take(node.edge, {real(b.x), real(b.h), real(b.begin), real(b.end)}, real(node.sigma),
              source);
}

template <class Real>
double ExactWindows<Real>::nearest(const Node& node) {
  const Beam<double>& beam = node.beam;
  const bool across = (beam.begin < beam.x) & (beam.x < beam.end) & (beam.h >= 0);
  return across ? node.sigma + beam.h : std::min(node.at_begin, node.at_end);
}

template <class Real>
template <class Order>
void ExactWindows<Real>::push(Order& order, const Node& node, double near, Index source) {
  Index n = free_;
  if (n == none) {
    n = static_cast<Index>(nodes_.size());
    if (nodes_.size() == nodes_.capacity())
        [[unlikely]]  // doubled they would be most of the memory
      nodes_.reserve(nodes_.size() + nodes_.size() / 4 + 1024);
    nodes_.push_back(node);
    if (labels_) node_source_.push_back(source);
  } else {
    free_ = nodes_[n].next;
    nodes_[n] = node;
    if (labels_) node_source_[n] = source;
  }
  order.push(n, near, [this](Index i) -> Index& { return nodes_[i].next; });
}

template <class Real>
bool ExactWindows<Real>::trim(Window<double>& w, double length, double to_first,
                              double to_second) const {
  Beam<double>& beam = w.beam;
  const double way = rounding(length + w.at_end);
  to_first += way;
  to_second += way;
  if (to_first + beam.end <= w.at_end || to_second + (length - beam.begin) <= w.at_begin)
    return false;
  if (to_first + beam.begin < w.at_begin) {
    const double low = served_from_end(beam.x, beam.h, to_first - w.sigma);
    if (low > beam.begin) beam.begin = low;
  }
  if (to_second + (length - beam.end) < w.at_end) {
    const Window<double> from_end = w.mirrored(length);
    const double high =
        length - served_from_end(from_end.beam.x, beam.h, to_second - from_end.sigma);
    if (high < beam.end) beam.end = high;
  }
  return beam.begin < beam.end;
}

template <class Real>
template <class Order>
void ExactWindows<Real>::offer(Order& order, Index vertex, double distance,
                               const Arrival<double>& arrival, Index source) {
  if (know(order, vertex, distance, arrival, source) && vertex < sheet_.shared)
    leaving_.tell(vertex);
}

/// Did the vertex get nearer?
template <class Real>
template <class Order>
bool ExactWindows<Real>::know(Order& order, Index vertex, double distance,
                              const Arrival<double>& arrival, Index source) {
  if (!(distance < distance_[vertex])) return false;
  distance_[vertex] = distance;
  if (labels_) source_[vertex] = source;
  arrival_[vertex] = arrival;
  ++statistics_.updates;
  if (arrival.corner == none ||
      static_cast<double>(sheet_.angles->excess[vertex]) > Rounding<Real>::excess)
    push(order, {{}, 0, distance, distance, vertex | vertex_bit, none}, distance, source);
  return true;
}

template <class Real>
template <class Order>
void ExactWindows<Real>::enter(Order& order, Index halfedge, const Window<double>& w,
                               Index source) {
  const double near = w.nearest();
  if (near <= radius_ && w.beam.begin < w.beam.end)
    push(order, {w.beam, w.sigma, w.at_begin, w.at_end, halfedge, none}, near, source);
}

template <class Real>
template <class Order>
void ExactWindows<Real>::leave(Order& order, Index f, std::size_t edge, const Window<double>& w,
                               Index source) {
  const Index across = triangles_[f].across[edge], sentinel = sheet_.sentinel();
  if (across >> Across::face_shift == sentinel) return;
  const auto go = [&](Index over, const Window<double>& seen) {
    if (over >> Across::face_shift >= own_) [[unlikely]]
      leaving_.windows.push_back({halfedge_of(over), source, none, seen});
    else
      enter(order, halfedge_of(over), seen, source);
  };
  if (!(across & Across::special)) [[likely]] {
    go(across, w);
    return;
  }
  const Window<double> mirrored = w.mirrored(static_cast<double>(triangles_[f].length[edge]));
  cross_edge(triangles_, f, edge,
             [&](Index over, bool turned) { go(over, turned ? mirrored : w); });
}

/// Most windows are narrow: all of their light leaves by one edge, and reaches no vertex. Which
/// edge is as good as random, so it is looked up, not branched on; both rays go in lanes.
template <class Real>
template <class Order>
[[gnu::always_inline]] inline void ExactWindows<Real>::expand(Order& order, Index n) {
  Node& node = nodes_[n];
  const TriangleRecord<Real>& t = triangles_[node.edge >> 2];
  const std::size_t in = node.edge & 3, before = edge_before(in), after = edge_after(in);
  const double width = static_cast<double>(t.length[in]);
  const double x = node.beam.x, h = std::max(node.beam.h, least_height(width));
  const double begin = node.beam.begin, end = node.beam.end, sigma = node.sigma;
  const double least = rounding(width + node.at_end);
  const double to_a = distance_[t.corner[in]], to_b = distance_[t.corner[after]];
  // Would trim do anything?
  const bool served =
      to_a + least + begin < node.at_begin || to_b + least + (width - end) < node.at_end;

  // All on the same side of the ray to the apex, and so far from it that the apex need not be
  // placed from its nearer end.
  const double side = static_cast<double>(t.length[before]);
  const double apex_x = side * static_cast<double>(t.cosine[in]);
  const double across = (apex_x - x) * h, down = side * static_cast<double>(t.sine(in)) + h;
  const double slack = Rounding<Real>::cover * width;
  const std::size_t to_right = across < (begin - x - slack) * down;
  const std::size_t to_left = across > (end - x + slack) * down;
  const bool parallel = node.beam.is_parallel();
  if (served || (to_left ^ to_right) == 0 || parallel) [[unlikely]] {
    const Window<double> window = {
        {x, parallel ? node.beam.h : h, begin, end}, sigma, node.at_begin, node.at_end, 0};
    const Index halfedge = node.edge, source = labels_ ? node_source_[n] : 0;
    node.next = std::exchange(free_, n);
    expand_wide(order, window, halfedge, source);
    return;
  }

  // The edge from its pivot: A, or B and all mirrored.
  const std::size_t pivot = to_right ? after : in, out = to_right ? after : before;
  const FromPivot& from = from_pivot[to_right];
  const double mirror = from.factor, origin = from.shift * width;
  const double cosine = static_cast<double>(t.cosine[pivot]);
  const double sine = static_cast<double>(t.sine(pivot));
  const double length = static_cast<double>(t.length[out]);
  const double seen = origin + mirror * x;
  const double child_x = cosine * seen - sine * h;
  const double child_h = std::max(sine * seen + cosine * h, 0.);
  const Pair points = origin + mirror * Pair{begin, end};
  const Pair below = sine * (seen - points) + cosine * h;
  const Pair reached = points * h / below, all = {length, length};
  const Pair at = (below > 0) & (reached < all) ? reached : all;
  const Pair along = at - child_x, squares = along * along + child_h * child_h;
  const Pair distances = sigma + Pair{std::sqrt(squares[0]), std::sqrt(squares[1])};

  const double child_origin = from.shift * length;
  const Pair child_ends = child_origin + mirror * at;
  const double child_begin = child_ends[0], child_end = child_ends[1];
  if (!(child_begin < child_end)) [[unlikely]] {
    node.next = std::exchange(free_, n);
    return;
  }
  const Index over = t.across[out];
  node.beam = {child_origin + mirror * child_x, child_h, child_begin, child_end};
  node.at_begin = distances[0], node.at_end = distances[1];
  if ((over & Across::special) || over >> Across::face_shift >= own_ || radius_ < infinity)
      [[unlikely]] {
    const Window<double> child = {node.beam, sigma, node.at_begin, node.at_end, 0};
    const Index f = node.edge >> 2, source = labels_ ? node_source_[n] : 0;
    node.next = std::exchange(free_, n);
    leave(order, f, out, child, source);
    return;
  }
  node.edge = halfedge_of(over);
  order.push(n, std::min(distances[0], distances[1]),
             [this](Index i) -> Index& { return nodes_[i].next; });
}

template <class Real>
template <class Order>
void ExactWindows<Real>::expand_wide(Order& order, Window<double> w, Index halfedge, Index source) {
  const Index f = halfedge >> 2;
  const EnteredTriangle<double> t(triangles_[f], halfedge & 3);
  const double to_a = distance_[t.a], to_b = distance_[t.b];
  if (!trim(w, t.width, to_a, to_b)) return;

  // Where the ray to the apex crosses the edge: `across` / `down` from below the source, of
  // parallel light from A.
  const Beam<double>& beam = w.beam;
  const bool parallel = beam.is_parallel();
  const double x = parallel ? 0 : beam.x;
  const double across =
      parallel ? -(t.apex_x * beam.h + t.apex_h * beam.x) : (t.apex_x - x) * beam.h;
  const double down = parallel ? -beam.h : t.apex_h + beam.h;
  const double from = (beam.begin - x) * down, until = (beam.end - x) * down;
  const double slack = Rounding<Real>::cover * t.width * down;
  bool go_left = across > from, go_right = across < until;
  // Up to where light goes left, and from where on right.
  double left_end = w.beam.end, right_begin = w.beam.begin;
  double way = infinity;
  if (across <= until + slack && across >= from - slack) {
    const double dx = t.apex_x - x;
    way = w.sigma + (parallel ? dx * beam.x + t.apex_h * down : std::sqrt(dx * dx + down * down));
    if (way < distance_[t.p]) {
      const Towards<double> back = t.towards(beam);
      offer(order, t.p, way, {static_cast<Index>(3 * f + t.before), back.along, back.off}, source);
    }
  }
  // One angle, one split: of two windows that see the apex the one that is farther from it has
  // nothing to say beyond the other's ray. Not so one that only just misses it.
  if (across <= until && across >= from) {
    Split& best = split_[3 * f + t.in];
    const double foot = x + across / down;
    if (way < static_cast<double>(best.distance))
      best = {static_cast<float>(way * (1 + single)), static_cast<float>(foot)};
    if (way > static_cast<double>(best.distance) + rounding(t.width + way)) {
      // What starts between the two rays and crosses the nearer one's is needless. What starts
      // beyond that ray would have crossed it before, or met its source.
      const double best_foot = static_cast<double>(best.foot), off = single * t.width;
      if (foot < best_foot - off) {
        if (splits_whole_) go_right = false;
        right_begin = std::max(right_begin, best_foot - off);
      } else if (foot > best_foot + off) {
        if (splits_whole_) go_left = false;
        left_end = std::min(left_end, best_foot + off);
      }
    }
  }

  const double to_p = distance_[t.p], least = rounding(t.width + w.at_end);
  // One side, measured from its pivot: from the ray through a point of AB to that through another,
  // or to the apex. `to_other`: the vertex that lies behind.
  const auto go = [&](const Beam<double>& seen, double sigma, double near, double far, bool to_apex,
                      double to_pivot, double to_other, double cosine, double sine,
                      Window<double>& child) {
    child = {{seen.x, seen.h, near, to_apex ? seen.end : far}, sigma, 0, 0, 0};
    if (!(child.beam.begin < child.beam.end)) return false;
    child.at_end = to_apex && way < infinity ? way : child.at(child.beam.end);
    if (to_pivot + child.beam.end + least < child.at_end) return false;
    child.at_begin = child.at(child.beam.begin);
    if (to_p + (seen.end - child.beam.begin) + least < child.at_begin) return false;
    // Light that enters over AB and meets this edge at some point has crossed the line from the
    // other vertex to the first such point: if that vertex reaches it sooner, all is needless.
    const double along = cosine * t.width - near, off = sine * t.width;
    const double in = child.at_begin - to_other - least;
    return !(in > 0 && along * along + off * off < in * in);
  };
  Window<double> child;
  if (go_left && w.beam.begin < left_end) {
    const bool to_apex = across <= (left_end - x) * down;
    if (go(t.seen_left(beam), w.sigma, t.onto_left(beam, beam.begin),
           to_apex ? 0 : t.onto_left(beam, left_end), to_apex, to_a, to_b, t.cos_a, t.sin_a, child))
      leave(order, f, t.before, child, source);
  }
  if (go_right && right_begin < w.beam.end) {
    const bool to_apex = across >= (right_begin - x) * down;
    if (go(t.seen_right(beam), t.sigma_at_b(beam, w.sigma), t.onto_right(beam, beam.end),
           to_apex ? 0 : t.onto_right(beam, right_begin), to_apex, to_b, to_a, t.cos_b, t.sin_b,
           child))
      leave(order, f, t.after, child.mirrored(t.right), source);
  }
}

template <class Real>
template <class Order>
void ExactWindows<Real>::shine(Order& order, Index vertex) {
  const double sigma = distance_[vertex];
  if (sigma > radius_) return;
  const Index source = this->source(vertex);
  const Arrival<double> arrival = arrival_[vertex];
  const VertexAngles::Kind kind = sheet_.angles->kind[vertex];
  const auto lit = [&](const Lit& part) {
    if (part.face >= own_) return;
    const TriangleRecord<Real>& t = triangles_[part.face];
    const Beam<double> beam = {static_cast<double>(t.apex_x(part.edge)),
                               static_cast<double>(t.apex_h(part.edge)), part.begin, part.end};
    leave(order, part.face, part.edge,
          measured_window(beam.mirrored(static_cast<double>(t.length[part.edge])), sigma), source);
  };
  const auto along = [&](const FanWalk& walk) {
    if (walk.face >= own_) return;
    const TriangleRecord<Real>& t = triangles_[walk.face];
    const Index e = walk.leaving_edge();
    // The far end, and the way back there: along the edge, in the corner that it starts or ends.
    const Index far = static_cast<Index>(walk.by_start ? edge_after(e) : e);
    const double cosine = static_cast<double>(t.cosine[far]);
    const double sine = static_cast<double>(t.sine(far));
    offer(order, t.corner[far], sigma + static_cast<double>(t.length[e]),
          {3 * walk.face + far, walk.by_start ? cosine : 1, walk.by_start ? sine : 0}, source);
  };
  if (arrival.corner == none || kind == VertexAngles::irregular) {
    sheet_.corners_at(vertex, corners_);
    pseudo_source_.shine_all(corners_, lit, along);
  } else {
    pseudo_source_.shine(arrival, kind == VertexAngles::boundary, {1, Rounding<Real>::shadow}, lit,
                         along);
  }
}

template <class Real>
std::size_t ExactWindows<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(distance_) + of(arrival_) + of(source_) + of(split_) + of(nodes_) +
         of(node_source_) + of(corners_) + leaving_.bytes();
}

}  // namespace plexway::detail::windows

#include "windows/exact_seeds.inl"

namespace plexway::detail::windows {

template class ExactWindows<float>;
template class ExactWindows<double>;

}  // namespace plexway::detail::windows
