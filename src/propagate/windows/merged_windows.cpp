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
/// So many turns a halfedge, and ties count as losses: nothing goes around for ever.
constexpr std::size_t patience = 24;
/// Neighbours are joined over gaps up to this share of the edge.
constexpr double joint = 1e-2;

}  // namespace

template <class Real>
MergedWindows<Real>::MergedWindows(const TriangleMesh<Real>& mesh, const VertexAngles& angles)
    : triangles_(mesh.triangles()), mesh_(mesh), angles_(angles), pseudo_source_(triangles_) {}

template <class Real>
void MergedWindows<Real>::solve(std::span<const PointSource> sources,
                                const PropagateOptions& options, const MergeLimit& limit) {
  limit_ = limit;
  labels_ = sources.size() > 1;
  vertices_.assign(mesh_.vertex_count(), {infinity<Real>, none, 0, 0});
  error_.resize(mesh_.vertex_count());
  if (labels_) source_.resize(mesh_.vertex_count());
  pending_.assign(4 * mesh_.face_count(), none);
  blocks_.clear();
  entries_.clear();
  free_block_ = free_entry_ = none;
  complete_ = true;
  statistics_ = {};
  slack_ = 1;
  radius_ = static_cast<Real>(options.radius / mesh_.unit());
  set_scale(0);
  const auto solve_in = [&](auto& order) {
    order.start(bucket_width);
    seed(order, sources);
    do run(order, options);
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

template <class Real>
template <class Order>
void MergedWindows<Real>::run(Order& order, const PropagateOptions& options) {
  const auto next = [this](Index n) -> Index& { return entries_[n].next; };
  const auto near_of = [this](Index n) { return static_cast<double>(near(entries_[n].what)); };
  constexpr std::size_t share = 65536;
  double before = -1;
  for (;;) {
    if (statistics_.expansions >= options.max_expansions) {
      complete_ = order.pop(next, near_of) == none;
      return;
    }
    const Index n = order.pop(next, near_of);
    if (n == none) return;
    const Index what = entries_[n].what;
    entries_[n].next = std::exchange(free_entry_, n);
    if (!(what & bent) && pending_[what] == none) continue;
    if (order.distance() != before) set_scale(before = order.distance());
    ++statistics_.expansions;
    if (statistics_.expansions % share == 0) {
      if (options.progress &&
          !options.progress({statistics_.expansions, statistics_.reached_simplices,
                             mesh_.face_count(), order.distance() * mesh_.unit()}))
        throw Cancelled("cancelled by the progress callback");
      if (statistics_.expansions / patience > 3 * mesh_.face_count()) slack_ = -1;
    }
    if (what & bent)
      shine(order, what & ~bent);
    else
      expand(order, what);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::offer(Order& order, Index vertex, Real distance, Index corner, Real along,
                                Real off, Index source, Real error) {
  Vertex& v = vertices_[vertex];
  if (!(distance < v.distance)) return;
  v = {distance, corner, along, off};
  error_[vertex] = error;
  if (labels_) source_[vertex] = source;
  ++statistics_.updates;
  if (corner == none || (corner & bent) ||
      angles_.excess(vertex) > 4 * static_cast<double>(scale_))
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
void MergedWindows<Real>::gather(Block& block, Real length) {
  const std::size_t count = block.count;
  list_.clear();
  if (count == 1) {
    list_.append({block.window[0], block.source[0]});
    return;
  }
  std::array<unsigned, room> rank;
  for (unsigned i = 0; i < count; ++i) {
    unsigned at = i;
    for (; at > 0 && block.window[i].beam.begin < block.window[rank[at - 1]].beam.begin; --at)
      rank[at] = rank[at - 1];
    rank[at] = i;
  }
  for (std::size_t i = 0; i < count; ++i)
    list_.insert({block.window[rank[i]], block.source[rank[i]]});
  std::size_t kept = 0;
  for (std::size_t i = 1; i < list_.size(); ++i) {
    Labelled<Real>& u = list_[kept];
    const Labelled<Real>& w = list_[i];
    Window<Real> merged;
    if (u.source == w.source && joined(u, w, length) &&
        merge(u.window, w.window, scale_ * (w.window.beam.end - u.window.beam.begin), merged))
      u.window = merged;
    else
      list_[++kept] = w;
  }
  list_.resize(kept + 1);
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
  const Index f = halfedge >> 2;
  const EnteredTriangle<Real> t(triangles_[f], halfedge & 3);
  {
    const Index b = std::exchange(pending_[halfedge], none);
    if (blocks_[b].nearest <= radius_) gather(blocks_[b], t.width);
    else list_.clear();
    blocks_[b].count = std::exchange(free_block_, b);
  }
  const std::size_t count = list_.size();
  if (count == 0) return;

  // Where the rays to the apex cross the edge; who sees the apex.
  std::array<Real, Overlay<Real>::most> foot;
  std::array<bool, Overlay<Real>::most> reaches_left{}, reaches_right{}, joins{};
  Real best = infinity<Real>, best_x = 0, best_h = 0;
  std::size_t best_window = 0;
  const auto straight = [&](std::size_t i) {
    const Beam<Real>& beam = list_[i].window.beam;
    const Real dx = t.apex_x - beam.x, dy = t.apex_h + beam.h;
    const Real d = list_[i].window.sigma + std::sqrt(dx * dx + dy * dy);
    if (d < best) best = d, best_x = beam.x, best_h = beam.h, best_window = i;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Beam<Real>& beam = list_[i].window.beam;
    foot[i] = t.foot(beam.x, beam.h);
    reaches_left[i] = foot[i] <= beam.end && beam.begin < foot[i];
    reaches_right[i] = beam.begin <= foot[i] && foot[i] < beam.end;
    if (beam.begin <= foot[i] && foot[i] <= beam.end) straight(i);
    joins[i] = i > 0 && joined(list_[i - 1], list_[i], t.width);
    if (joins[i] && foot[i - 1] > list_[i - 1].window.beam.end && foot[i] < beam.begin) {
      straight(i - 1);
      straight(i);
      reaches_left[i - 1] = reaches_right[i] = true;
    }
  }
  const Index corner = static_cast<Index>(3 * f + t.before);
  if (best < infinity<Real>) {
    const Real dx = t.apex_x - best_x, dy = t.apex_h + best_h;
    offer(order, t.p, best, corner, t.apex_h * dy + t.apex_x * dx, t.apex_x * dy - t.apex_h * dx,
          list_[best_window].source, list_[best_window].window.error);
  } else {
    // In shadow as far as this edge knows: by the nearest end of what is lit.
    Real end = 0;
    const auto around = [&](std::size_t i, Real b, Real at) {
      const Real dx = t.apex_x - b, d = at + std::sqrt(dx * dx + t.apex_h * t.apex_h);
      if (d < best) best = d, end = b, best_window = i;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Window<Real>& w = list_[i].window;
      if (foot[i] > w.beam.end) around(i, w.beam.end, w.at_end);
      else around(i, w.beam.begin, w.at_begin);
    }
    const Real dx = t.apex_x - end, dy = t.apex_h;
    offer(order, t.p, best, corner | bent, t.apex_h * dy + t.apex_x * dx,
          t.apex_x * dy - t.apex_h * dx, list_[best_window].source,
          list_[best_window].window.error);
  }

  struct Child {
    Real near, far;
    bool exists;
  };
  std::array<Child, Overlay<Real>::most> left, right;
  for (std::size_t i = 0; i < count; ++i) {
    const Beam<Real>& beam = list_[i].window.beam;
    left[i].exists = beam.begin < foot[i];
    if (left[i].exists)
      left[i].near = t.onto_left(beam.x, beam.h, beam.begin),
      left[i].far = reaches_left[i] ? t.left : t.onto_left(beam.x, beam.h, beam.end);
    right[i].exists = beam.end > foot[i];
    if (right[i].exists)
      right[i].near = t.onto_right(beam.x, beam.h, beam.end),
      right[i].far = reaches_right[i] ? t.right : t.onto_right(beam.x, beam.h, beam.begin);
    if (!joins[i]) continue;
    if (left[i - 1].exists && left[i].exists && left[i - 1].far < left[i].near)
      left[i - 1].far = left[i].near = (left[i - 1].far + left[i].near) / 2;
    if (right[i - 1].exists && right[i].exists && right[i].far < right[i - 1].near)
      right[i].far = right[i - 1].near = (right[i].far + right[i - 1].near) / 2;
  }
  const Real to_a = vertices_[t.a].distance, to_b = vertices_[t.b].distance;
  const Real to_p = vertices_[t.p].distance;
  const Real slack = slack_ * scale_;
  for (std::size_t i = 0; i < count; ++i) {
    const Window<Real>& w = list_[i].window;
    const Index source = list_[i].source;
    const auto go = [&](const Child& child, const Beam<Real>& seen, Real to_pivot, Real length,
                        bool is_left) {
      if (!child.exists || !(child.near < child.far)) return;
      Window<Real> c = {{seen.x, std::max(seen.h, Real(0)), child.near, child.far}, w.sigma, 0, 0,
                        w.error};
      c.at_begin = c.at(child.near);
      c.at_end = c.at(child.far);
      const Real give = slack * length;
      if (to_pivot + child.far < c.at_end - give) return;
      if (to_p + (length - child.near) < c.at_begin - give) return;
      if (is_left)
        leave(order, f, t.before, c, source);
      else
        leave(order, f, t.after, c.mirrored(length), source);
    };
    go(left[i], t.seen_left(w.beam.x, w.beam.h), to_a, t.left, true);
    go(right[i], t.seen_right(w.beam.x, w.beam.h), to_b, t.right, false);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::shine(Order& order, Index vertex) {
  const Vertex v = vertices_[vertex];
  const Real sigma = v.distance;
  if (sigma > radius_) return;
  const Index source = labels_ ? source_[vertex] : 0;
  const Real error = error_[vertex];
  const bool is_bent = v.corner != none && (v.corner & bent);
  const bool anywhere = v.corner == none;
  if (!is_bent && !anywhere && !(angles_.excess(vertex) > 4 * static_cast<double>(scale_))) return;
  const Arrival<double> arrival = {anywhere ? none : v.corner & ~bent,
                                   static_cast<double>(v.along), static_cast<double>(v.off)};
  const VertexAngles::Kind kind = angles_.kind[vertex];
  corners_.clear();
  if (anywhere || kind == VertexAngles::irregular) mesh_.corners_at(vertex, corners_);
  const double straight = is_bent ? std::numbers::pi / 2 : std::numbers::pi - static_cast<double>(scale_);
  pseudo_source_.shine(
      arrival, kind, angles_.total[vertex], corners_, straight,
      [&](const Lit& lit) {
        const TriangleRecord<Real>& t = triangles_[lit.face];
        const Real length = t.length[lit.edge];
        const Beam<Real> beam = {t.apex_x(lit.edge), t.apex_h(lit.edge),
                                 static_cast<Real>(lit.begin), static_cast<Real>(lit.end)};
        Window<Real> window = {beam.mirrored(length), sigma, 0, 0, error};
        if (!(window.beam.begin < window.beam.end)) return;
        window.begin_at(window.beam.begin);
        window.end_at(window.beam.end);
        leave(order, lit.face, lit.edge, window, source);
      },
      [&](const FanWalk& walk) {
        const TriangleRecord<Real>& t = triangles_[walk.face];
        const Index e = walk.leaving_edge();
        const Index far = static_cast<Index>(walk.by_start ? edge_after(e) : e);
        offer(order, t.corner[far], sigma + t.length[e], 3 * walk.face + far,
              walk.by_start ? t.cosine[far] : Real(1), walk.by_start ? t.sine(far) : Real(0),
              source, error);
      });
}

template <class Real>
template <class Order>
void MergedWindows<Real>::seed(Order& order, std::span<const PointSource> sources) {
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const Index number = static_cast<Index>(n);
    const Real sigma = static_cast<Real>(s.offset / mesh_.unit());
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, none, 0, 0, number, 0);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const auto corner = std::find(b.begin(), b.begin() + 3, 1.);
    if (corner != b.begin() + 3) {
      offer(order, t.corner[corner - b.begin()], sigma, none, 0, 0, number, 0);
      continue;
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t i = edge_after(e), p = edge_before(e);
      const double length = static_cast<double>(t.length[e]);
      const double x = b[i] * length + b[p] * static_cast<double>(t.apex_x(e));
      const double h = b[p] * static_cast<double>(t.apex_h(e));
      const Beam<double> beam = Beam<double>{x, h, 0, length}.mirrored(length);
      Window<Real> window = {{static_cast<Real>(beam.x), static_cast<Real>(beam.h), 0, t.length[e]},
                             sigma, 0, 0, 0};
      window.begin_at(0);
      window.end_at(t.length[e]);
      leave(order, f, e, window, number);
      offer(order, t.corner[e], sigma + static_cast<Real>(std::sqrt(x * x + h * h)),
            static_cast<Index>(3 * f + e), static_cast<Real>(x), static_cast<Real>(h), number, 0);
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
        offer(order, w, vertices_[v].distance + t.length[e], none, 0, 0,
              labels_ ? source_[v] : 0, error_[v]);
        any = true;
      }
  }
  return any;
}

template <class Real>
std::size_t MergedWindows<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(vertices_) + of(source_) + of(error_) + of(pending_) + of(blocks_) +
         of(entries_) + of(corners_);
}

template class MergedWindows<float>;
template class MergedWindows<double>;

}  // namespace plexway::windows
