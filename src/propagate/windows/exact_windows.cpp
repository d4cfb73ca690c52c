#include "propagate/windows/exact_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plexway/error.hpp>

#include "propagate/windows/bucket_ring.hpp"
#include "propagate/windows/trim.hpp"

namespace plexway::windows {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What the triangles' own numbers are worth.
template <class Real>
struct Rounding {
  static constexpr double tie = 1e-12;     ///< paths that differ by less are equal, relative
  static constexpr double cover = 1e-9;    ///< by this share of an edge light may miss a vertex
  static constexpr double excess = 1e-12;  ///< what may be the sum of angles of a flat fan, radians
};
template <>
struct Rounding<float> {
  static constexpr double tie = 1e-6, cover = 1e-5, excess = 2e-6;
};

/// No source lies nearer to a line of sight's edge than this, in mean edges: one on the edge itself
/// then lights both of its sides.
constexpr double least_height = 1e-14;
/// Shadows are so much wider than they are, in radians.
constexpr double shadow_slack = 1e-9;
/// So many windows a triangle, and ties are no longer broken in favour of both: where lengths are
/// no metric, or nothing has any length, light could go around for ever.
constexpr std::size_t patience = 1000;
/// In mean edges.
constexpr double bucket_width = 0.5;

}  // namespace

template <class Real>
ExactWindows<Real>::ExactWindows(const TriangleMesh<Real>& mesh, const VertexAngles& angles)
    : triangles_(mesh.triangles()), mesh_(mesh), angles_(angles), pseudo_source_(triangles_) {}

template <class Real>
void ExactWindows<Real>::solve(std::span<const PointSource> sources,
                               const PropagateOptions& options) {
  distance_.assign(mesh_.vertex_count(), infinity);
  arrival_.resize(mesh_.vertex_count());
  source_.assign(mesh_.vertex_count(), none);
  split_.assign(3 * mesh_.face_count(), {infinity, 0});
  nodes_.clear();
  free_ = none;
  complete_ = true;
  statistics_ = {};
  tie_ = Rounding<Real>::tie;
  radius_ = options.radius / mesh_.unit();
  // A source inside a triangle may lie in another's light, and over an edge with several triangles
  // light comes from several sheets.
  splits_whole_ = mesh_.summary().non_manifold_edges == 0 &&
                  std::all_of(sources.begin(), sources.end(),
                              [](const PointSource& s) { return s.vertex != none; });
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
template <class Order>
void ExactWindows<Real>::run(Order& order, const PropagateOptions& options) {
  const auto next = [this](Index n) -> Index& { return nodes_[n].next; };
  const auto near = [this](Index n) { return nodes_[n].near; };
  constexpr std::size_t share = 65536;
  for (;;) {
    if (statistics_.expansions >= options.max_expansions) {
      complete_ = order.pop(next, near) == none;
      return;
    }
    if (statistics_.expansions % share == 0 && statistics_.expansions > 0) {
      if (options.progress &&
          !options.progress({statistics_.expansions, statistics_.reached_simplices,
                             mesh_.face_count(), order.distance() * mesh_.unit()}))
        throw Cancelled("cancelled by the progress callback");
      if (statistics_.expansions / patience > mesh_.face_count()) tie_ = -Rounding<Real>::tie;
    }
    const Index n = order.pop(next, near);
    if (n == none) return;
    ++statistics_.expansions;
    const Node node = nodes_[n];
    nodes_[n].next = free_;
    free_ = n;
    if (node.edge == none)
      shine(order, node.source);
    else
      expand(order, node);
  }
}

template <class Real>
Index ExactWindows<Real>::allot() {
  if (free_ == none) {
    nodes_.emplace_back();
    return static_cast<Index>(nodes_.size() - 1);
  }
  return std::exchange(free_, nodes_[free_].next);
}

template <class Real>
bool ExactWindows<Real>::trim(Beam<double>& beam, double length, double to_first, double to_second,
                              double sigma) const {
  const double way = rounding(sigma + std::abs(beam.x) + beam.h);
  const double low = served_from_end(beam.x, beam.h, to_first + way - sigma);
  const double high = length - served_from_end(length - beam.x, beam.h, to_second + way - sigma);
  if (low > beam.begin) beam.begin = low;
  if (high < beam.end) beam.end = high;
  return beam.begin < beam.end;
}

template <class Real>
template <class Order>
void ExactWindows<Real>::offer(Order& order, Index vertex, double distance,
                               const Arrival<double>& arrival, Index source) {
  if (!(distance < distance_[vertex])) return;
  distance_[vertex] = distance;
  source_[vertex] = source;
  arrival_[vertex] = arrival;
  ++statistics_.updates;
  if (arrival.corner != none && !(angles_.excess(vertex) > Rounding<Real>::excess)) return;
  const Index n = allot();
  nodes_[n] = {{}, 0, distance, none, vertex, none};
  order.push(n, distance, [this](Index i) -> Index& { return nodes_[i].next; });
}

template <class Real>
template <class Order>
void ExactWindows<Real>::enter(Order& order, Index across, const Beam<double>& beam, double sigma,
                               Index source) {
  const double foot = std::clamp(beam.x, beam.begin, beam.end) - beam.x;
  const double near = sigma + std::sqrt(foot * foot + beam.h * beam.h);
  const Index n = allot();
  nodes_[n] = {beam,   sigma,
               near,   across >> Across::face_shift << 2 | (across & Across::edge_mask),
               source, none};
  order.push(n, near, [this](Index i) -> Index& { return nodes_[i].next; });
}

template <class Real>
template <class Order>
void ExactWindows<Real>::leave(Order& order, Index f, std::size_t edge, const Beam<double>& beam,
                               double sigma, Index source) {
  Index across = triangles_[f].across[edge];
  if (across >> Across::face_shift == mesh_.face_count()) return;
  if (!(across & Across::special)) [[likely]] {
    enter(order, across, beam, sigma, source);
    return;
  }
  const Beam<double> turned = beam.mirrored(static_cast<double>(triangles_[f].length[edge]));
  bool flip = (across & Across::flip) != 0;
  if (!(across & Across::fan)) {
    enter(order, across, turned, sigma, source);
    return;
  }
  // All the way around the edge; each turn is told from the one before.
  for (;;) {
    const Index g = across >> Across::face_shift, k = across & Across::edge_mask;
    if (g == f && k == edge) return;
    enter(order, across, flip ? turned : beam, sigma, source);
    across = triangles_[g].across[k];
    flip ^= !(across & Across::flip);
  }
}

template <class Real>
template <class Order>
void ExactWindows<Real>::expand(Order& order, const Node& node) {
  const Index f = node.edge >> 2;
  const EnteredTriangle<double> t(triangles_[f], node.edge & 3);
  Beam<double> beam = node.beam;
  const double x = beam.x, h = std::max(beam.h, least_height), sigma = node.sigma;
  double to_a = distance_[t.a], to_b = distance_[t.b];
  if (node.near > radius_ || !trim(beam, t.width, to_a, to_b, sigma)) return;

  // The apex.
  const double foot = t.foot(x, h), slack = Rounding<Real>::cover * t.width;
  const double dx = t.apex_x - x, dy = t.apex_h + h;
  bool go_left = beam.begin<foot, go_right = beam.end> foot;
  double left_limit = foot, right_limit = foot;  // how far in from the foot
  if (foot >= beam.begin - slack && foot <= beam.end + slack) {
    const double way = sigma + std::sqrt(dx * dx + dy * dy);
    if (way < distance_[t.p])
      offer(order, t.p, way,
            {static_cast<Index>(3 * f + t.before), t.apex_h * dy + t.apex_x * dx,
             t.apex_x * dy - t.apex_h * dx},
            node.source);
    // One angle, one split: of two windows that see the apex the one that is farther from it has
    // nothing to say beyond the other's ray.
    Split& best = split_[3 * f + t.in];
    if (way < best.distance) best = {way, foot};
    if (way > best.distance + rounding(way)) {
      // What starts between the two rays and crosses the nearer one's is needless. What starts
      // beyond that ray would have crossed it before, or met its source.
      if (foot < best.foot) {
        if (splits_whole_)
          go_right = false;
        else
          right_limit = best.foot;
      } else if (foot > best.foot) {
        if (splits_whole_)
          go_left = false;
        else
          left_limit = best.foot;
      }
    }
  }
  const double to_p = distance_[t.p];
  const double least = rounding(sigma + std::abs(x) + h);

  // A window ends exactly at the apex where it holds it. Light that enters over AB and meets AP at
  // some point has crossed the line from B to the first such point: if B reaches that one sooner,
  // all of it is needless.
  if (go_left && beam.begin < left_limit) {
    Beam<double> seen = t.seen_left(x, h);
    seen.begin = t.onto_left(x, h, beam.begin);
    if (left_limit < beam.end && left_limit < foot)
      seen.end = t.onto_left(x, h, left_limit);
    else if (beam.end < foot)
      seen.end = t.onto_left(x, h, beam.end);
    const double u = seen.begin - seen.x;
    const double px = t.cos_a * t.width - seen.begin, ph = t.sin_a * t.width;
    const double in = sigma + std::sqrt(u * u + seen.h * seen.h) - to_b - least;
    const bool behind = in > 0 && px * px + ph * ph < in * in;
    if (!behind && trim(seen, t.left, to_a, to_p, sigma))
      leave(order, f, t.before, seen, sigma, node.source);
  }
  if (go_right && beam.end > right_limit) {
    Beam<double> seen = t.seen_right(x, h);
    seen.begin = t.onto_right(x, h, beam.end);
    if (right_limit > beam.begin && right_limit > foot)
      seen.end = t.onto_right(x, h, right_limit);
    else if (beam.begin > foot)
      seen.end = t.onto_right(x, h, beam.begin);
    const double u = seen.begin - seen.x;
    const double px = t.cos_b * t.width - seen.begin, ph = t.sin_b * t.width;
    const double in = sigma + std::sqrt(u * u + seen.h * seen.h) - to_a - least;
    const bool behind = in > 0 && px * px + ph * ph < in * in;
    if (!behind && trim(seen, t.right, to_b, to_p, sigma))
      leave(order, f, t.after, seen.mirrored(t.right), sigma, node.source);
  }
}

template <class Real>
template <class Order>
void ExactWindows<Real>::shine(Order& order, Index vertex) {
  const double sigma = distance_[vertex];
  if (sigma > radius_) return;
  const Index source = source_[vertex];
  const Arrival<double> arrival = arrival_[vertex];
  const VertexAngles::Kind kind = angles_.kind[vertex];
  const auto lit = [&](const Lit& part) {
    const TriangleRecord<Real>& t = triangles_[part.face];
    const Beam<double> beam = {static_cast<double>(t.apex_x(part.edge)),
                               static_cast<double>(t.apex_h(part.edge)), part.begin, part.end};
    leave(order, part.face, part.edge, beam.mirrored(static_cast<double>(t.length[part.edge])),
          sigma, source);
  };
  const auto along = [&](const FanWalk& walk) {
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
    mesh_.corners_at(vertex, corners_);
    pseudo_source_.shine_all(corners_, lit, along);
  } else {
    pseudo_source_.shine(arrival, kind == VertexAngles::boundary, {1, shadow_slack}, lit, along);
  }
}

template <class Real>
template <class Order>
void ExactWindows<Real>::seed(Order& order, std::span<const PointSource> sources) {
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const Index number = static_cast<Index>(n);
    const double sigma = s.offset / mesh_.unit();
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, {}, number);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const auto corner = std::find(b.begin(), b.begin() + 3, 1.);
    if (corner != b.begin() + 3) {
      offer(order, t.corner[corner - b.begin()], sigma, {}, number);
      continue;
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t i = edge_after(e), p = edge_before(e);
      const double length = static_cast<double>(t.length[e]);
      const double x = b[i] * length + b[p] * static_cast<double>(t.apex_x(e));
      const double h = b[p] * static_cast<double>(t.apex_h(e));
      leave(order, f, e, Beam<double>{x, h, 0, length}.mirrored(length), sigma, number);
      // The corner at the edge's start; the source in the frame of that edge.
      const double back = std::sqrt(x * x + h * h);
      offer(order, t.corner[e], sigma + back, {static_cast<Index>(3 * f + e), x, h}, number);
    }
  }
}

/// Light that rounding lost, or that fell on nothing with an area: triangles that have a reached
/// corner and another that is not. False if there is none.
template <class Real>
template <class Order>
bool ExactWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity) return false;
  bool any = false;
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const TriangleRecord<Real>& t = triangles_[f];
    for (std::size_t e = 0; e < 3; ++e)
      for (const auto& [from, to] : {std::pair(e, edge_after(e)), std::pair(edge_after(e), e)}) {
        const Index v = t.corner[from], w = t.corner[to];
        if (distance_[w] < infinity || !(distance_[v] < infinity)) continue;
        offer(order, w, distance_[v] + static_cast<double>(t.length[e]), {}, source_[v]);
        any = true;
      }
  }
  return any;
}

template <class Real>
std::size_t ExactWindows<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(distance_) + of(arrival_) + of(source_) + of(split_) + of(nodes_) +
         of(corners_);
}

template class ExactWindows<float>;
template class ExactWindows<double>;

}  // namespace plexway::windows
