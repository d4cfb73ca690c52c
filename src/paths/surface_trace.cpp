#include "paths/surface_trace.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "paths/infinity.hpp"

namespace plexway {
namespace {

// A label is tried if its path promises to be shorter than the best so far, times this: promises
// are not exact.
constexpr double doubt = 0.98;
// A path longer than promised by this is a reason to try the descent over the vertices as well.
constexpr double disappointment = 1.002;
// And by this for trying the shortest way along edges.
constexpr double failure = 1.01;

}  // namespace

template <class Real>
SurfaceTrace<Real>::SurfaceTrace(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
    : mesh_(mesh),
      solved_(solved),
      strips_(mesh, solved.positions, solved.outer),
      shape_(strips_.shape()),
      labels_(mesh, solved) {}

template <class Real>
std::optional<std::array<double, 3>> SurfaceTrace<Real>::source_in(Index f, Index number) const {
  const PointSource& s = solved_.sources[number];
  Index vertex = s.vertex;
  if (vertex == none) {
    const auto [face, turned] = mesh_.inside_face(s.simplex);
    const std::array<double, 3> b = inside(s.barycentric, turned);
    if (f == face) return b;
    if (const std::size_t i = corner_of(b); i < 3)
      vertex = solved_.outer[mesh_.triangles()[face].corner[i]];
  }
  if (vertex == none) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh_.triangles()[f].corner[i] == mesh_.inside_vertex(vertex)) return at_corner(i);
  return std::nullopt;
}

/// Over the edge a label came in by, to the triangle it came from: of several there, the nearest.
template <class Real>
std::optional<Crossing> SurfaceTrace<Real>::back_from(Index f) const {
  std::optional<Crossing> back;
  double best = infinity;
  across_edge(mesh_, f, labels_.hinge(f), [&](const Crossing& c) {
    if (!labels_.reached(c.face)) return;
    const double d = labels_.centre_distance(c.face);
    if (d < best) best = d, back = c;
  });
  return back;
}

template <class Real>
Index SurfaceTrace<Real>::beyond_pinch(Index vertex) const {
  std::vector<Index> corners;
  mesh_.corners_at(vertex, corners);
  Index best_corner = none;
  double best = infinity;
  for (const Index c : corners) {
    if (!labels_.reached(c / 3) || labels_.starts_at(c / 3, c % 3)) continue;
    const double d = labels_.corner_distance(c / 3, c % 3);
    if (d < best) best = d, best_corner = c;
  }
  return best_corner;
}

/// From the end of a leg, a point of its last triangle, straight to where the label there says that
/// the path bends last. `at` becomes the vertex it ends at, looking back.
///
/// Triangles that look at the same virtual source say themselves where they had it from; in the
/// others, and they are why this is needed, the line decides.
template <class Real>
typename SurfaceTrace<Real>::Seen SurfaceTrace<Real>::look(Strip& leg, Heading& at,
                                                           Index number) const {
  Index f = leg.last();
  const std::size_t in = labels_.hinge(f);
  const std::array<double, 3> b = leg.end;
  const double unit = mesh_.unit();
  std::array<Vector2, 3> corner;  // of f by number, in the plane
  corner[in] = {0, 0};
  corner[edge_after(in)] = {shape_.length(f, in), 0};
  corner[edge_before(in)] = shape_.apex(f, in);
  const auto place = [&](const std::array<double, 3>& c) {
    return c[0] * corner[0] + c[1] * corner[1] + c[2] * corner[2];
  };
  const Vector2 q = place(b);
  const auto sight = labels_.sight(f, 1 / unit * q);
  const Vector2 source = unit * sight.source, aim = unit * sight.bend, d = aim - q;
  const double near = 1e-4 * std::max(norm(d), norm(source - q));  // as exact as labels are
  bool mirrored = false;
  std::size_t entered = 3;  // the edge it came in by

  // Where the line does not come nearer, as among triangles without area, the count ends it.
  for (std::size_t steps = 0; steps <= mesh_.face_count(); ++steps) {
    if (const auto end = source_in(f, number); end && norm(place(*end) - aim) <= near) {
      leg.end = *end;
      return Seen::source;
    }
    std::size_t arrived = 3;
    double off = near;
    for (std::size_t i = 0; i < 3; ++i)
      if (!(entered == 3 && b[i] == 1) && norm(corner[i] - aim) <= off)
        off = norm(corner[i] - aim), arrived = i;
    if (arrived < 3) {
      double angle = shape_.angle_to(f, arrived, b);
      if (entered < 3) {  // looking back over the edge it came in by
        const Vector2 e = corner[edge_after(arrived)] - corner[arrived];
        angle =
            std::clamp(std::atan2(std::abs(cross(e, d)), -dot(e, d)), 0., shape_.angle(f, arrived));
      }
      leg.end = at_corner(arrived);
      at = {f, arrived, angle};
      return Seen::vertex;
    }

    std::size_t out = 3;
    if (entered == 3) {
      out = in;
    } else {
      // The apex on the left of the line: out over the edge on the right.
      const std::size_t apex = edge_before(entered);
      const bool left = cross(d, corner[apex] - q) > 0;
      out = left != mirrored ? edge_before(apex) : apex;
      if (labels_.reached(f) && labels_.hinge(f) != entered) {
        const std::size_t own = labels_.hinge(f);
        const Vector2 &first = corner[own], w = corner[edge_after(own)] - first;
        const double length = norm(w);
        if (length > 0) {
          const Vector2 s = unit * labels_.virtual_source(f), along = 1 / length * w;
          const Vector2 up = mirrored ? Vector2{along.y, -along.x} : Vector2{-along.y, along.x};
          if (norm(first + s.x * along + s.y * up - source) <= near) out = own;
        }
      }
    }
    // Over an edge of several triangles: to the nearest to the source.
    std::optional<Crossing> next;
    double best = infinity;
    across_edge(mesh_, f, out, [&](const Crossing& c) {
      const double known = labels_.reached(c.face) ? labels_.centre_distance(c.face) : infinity;
      if (!next || known < best) next = c, best = known;
    });
    if (!next) break;
    const Vector2 one = corner[next->flip ? out : edge_after(out)];
    const Vector2 two = corner[next->flip ? edge_after(out) : out], w = two - one;
    if (!(norm(w) > 0)) break;
    mirrored = mirrored != next->flip;
    leg.crossings.push_back(*next);
    f = next->face;
    entered = next->edge;
    const Vector2 apex = shape_.apex(f, entered), along = 1 / norm(w) * w;
    const Vector2 up = mirrored ? Vector2{along.y, -along.x} : Vector2{-along.y, along.x};
    corner[entered] = one;
    corner[edge_after(entered)] = two;
    corner[edge_before(entered)] = one + apex.x * along + apex.y * up;
    // Well past it: the line has gone astray.
    if (dot(corner[edge_before(entered)] - aim, d) > 0 && dot(one - aim, d) > 0 &&
        dot(two - aim, d) > 0)
      break;
  }
  return Seen::nothing;
}

/// From bend to bend, each time by the best label at the vertex.
template <class Real>
bool SurfaceTrace<Real>::see(const Strip& begin, StripWay& way) const {
  Strip leg = begin;
  if (!leg.crossings.empty()) return follow(std::move(leg), way);
  leg.end = leg.start;
  Index f = leg.first;
  double known = infinity;
  std::vector<Index> corners;
  for (;;) {
    if (!labels_.reached(f)) return false;
    const Index number = solved_.source_of(f);
    Heading at{};
    const std::size_t crossings = leg.crossings.size();
    const std::array<double, 3> here = leg.end;
    const Seen seen = look(leg, at, number);
    if (seen == Seen::nothing) {  // the rest by the other way
      leg.crossings.resize(crossings);
      leg.end = here;
      return follow(std::move(leg), way);
    }
    if (seen == Seen::source) {
      way.legs.push_back(std::move(leg));
      way.source = number;
      return true;
    }
    // On from the vertex, by a label that does not come from there itself.
    const Index v = mesh_.triangles()[at.face].corner[at.corner];
    way.bends.push_back(v);
    mesh_.corners_at(v, corners);
    Index next = none;
    double best = known;
    for (const Index c : corners) {
      if (!labels_.reached(c / 3)) continue;
      const Index n = solved_.source_of(c / 3);
      if (const auto end = source_in(c / 3, n); end && corner_of(*end) == c % 3) {
        way.legs.push_back(std::move(leg));
        way.source = n;
        return true;
      }
      if (labels_.starts_at(c / 3, c % 3)) continue;
      const double d = labels_.corner_distance(c / 3, c % 3);
      if (d < best) best = d, next = c;
    }
    if (next == none) return false;
    known = best;
    f = next / 3;
    // Which way it goes on there is not known before it is pulled: any direction will do.
    strips_.add(way, leg, at, {f, next % 3, shape_.angle(f, next % 3) / 2});
    leg.end = at_corner(next % 3);
  }
}

/// Back over the hinges. Every triangle is entered once at most, so it ends; false if it comes to
/// one twice or finds no way on.
template <class Real>
bool SurfaceTrace<Real>::follow(Strip leg, StripWay& way) const {
  std::unordered_set<Index> visited;
  Index f = leg.last();
  const auto pinched = mesh_.pinched();
  for (;;) {
    if (!labels_.reached(f) || !visited.insert(f).second) return false;
    const Index number = solved_.source_of(f);
    if (number >= solved_.sources.size()) return false;
    if (const auto end = source_in(f, number)) {
      leg.end = *end;
      way.legs.push_back(std::move(leg));
      way.source = number;
      return true;
    }
    bool passes = false;
    for (std::size_t i = 0; i < 3 && !passes && !pinched.empty(); ++i) {
      const Index v = mesh_.triangles()[f].corner[i];
      if (!labels_.starts_at(f, i) || !std::binary_search(pinched.begin(), pinched.end(), v))
        continue;
      const Index on = beyond_pinch(v);
      if (on == none) continue;
      passes = true;
      leg.end = at_corner(i);
      way.legs.push_back(std::move(leg));
      leg = Strip{};
      f = leg.first = on / 3;
      leg.start = at_corner(on % 3);
    }
    if (passes) continue;
    const std::optional<Crossing> back = back_from(f);
    if (!back) return false;
    leg.crossings.push_back(*back);
    f = back->face;
  }
}

template <class Real>
PulledWay SurfaceTrace<Real>::find(const PointSource& point, const TraceOptions& options) const {
  Index f = none;
  std::array<double, 3> b = {};
  Index vertex = point.vertex;
  if (vertex == none) {
    const auto [face, turned] = mesh_.inside_face(point.simplex);
    f = face;
    b = inside(point.barycentric, turned);
    if (const std::size_t i = corner_of(b); i < 3)
      vertex = solved_.outer[mesh_.triangles()[f].corner[i]];
  }
  std::vector<Index> corners;
  // A search leaves labels only.
  const auto known = [&](Index v) {
    if (solved_.field.distance.empty()) return true;
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]) < infinity;
  };
  if (vertex != none) {
    const Index v = mesh_.inside_vertex(vertex);
    if (mesh_.corner_at(v) == none || !known(v)) return {};
    mesh_.corners_at(v, corners);
    f = corners[0] / 3;
    b = at_corner(corners[0] % 3);
  } else if (!std::any_of(std::begin(mesh_.triangles()[f].corner),
                          std::end(mesh_.triangles()[f].corner), known)) {
    return {};
  }

  PulledWay best;
  const auto whole = [&](const PulledWay& t) {
    return t.length + solved_.sources[t.source].offset;
  };
  const auto keep = [&](PulledWay traced) {
    if (best.source == none || whole(traced) < whole(best)) best = std::move(traced);
  };
  if (StripWay way; solved_.windows && follow_windows(f, b, way)) {
    best = strips_.straighten(std::move(way));
    // Exact ones leave nothing to be found.
    if (options.margin && solved_.field.accuracy != Accuracy::exact())
      search_windows(f, b, options, best);
    return best;
  }

  // The strips to try begin with: the triangle of the point, or one of those around its vertex.
  struct Begin {
    double estimate;
    Strip strip;
  };
  std::vector<Begin> begins;
  if (solved_.labels && vertex != none) {
    for (const Index c : corners) {
      if (!labels_.reached(c / 3)) continue;
      Strip strip;
      strip.first = c / 3;
      strip.start = at_corner(c % 3);
      begins.push_back({labels_.corner_distance(c / 3, c % 3), std::move(strip)});
    }
  } else if (solved_.labels) {
    Strip own;
    own.first = f;
    own.start = b;
    if (labels_.reached(f)) begins.push_back({0, own});
    // And by each neighbour's label, over the edge between.
    for (std::size_t e = 0; e < 3; ++e)
      across_edge(mesh_, f, e, [&](const Crossing& c) {
        if (!labels_.reached(c.face)) return;
        Strip strip = own;
        strip.crossings.push_back(c);
        begins.push_back({0, strip});
      });
  }
  std::stable_sort(begins.begin(), begins.end(),
                   [](const Begin& l, const Begin& r) { return l.estimate < r.estimate; });

  const double unit = mesh_.unit();
  std::vector<std::pair<Index, std::vector<Index>>> tried;
  for (const Begin& begin : begins) {
    if (best.source != none && begin.estimate * unit * doubt > whole(best)) break;
    StripWay way;
    if (see(begin.strip, way)) {
      // Over the same vertices it would be the same path.
      const auto bends = std::make_pair(way.source, way.bends);
      if (std::find(tried.begin(), tried.end(), bends) == tried.end()) {
        tried.push_back(bends);
        keep(strips_.straighten(std::move(way)));
      }
    }
  }
  if (solved_.field.distance.empty()) {
    if (best.source == none) return {};
    search_windows(f, b, options, best);
    return best;
  }
  double promise = infinity;  // by a corner, as the field has it
  for (std::size_t i = 0; i < 3; ++i)
    promise = std::min(
        promise, static_cast<double>(
                     solved_.field.distance[shape_.outer_vertex(mesh_.triangles()[f].corner[i])]) +
                     shape_.distance(f, at_corner(i), b));
  for (const bool blindly : {false, true}) {
    const double allowed = promise * (blindly ? failure : disappointment);
    StripWay way;
    if (!(best.source != none && whole(best) <= allowed) && descend(f, b, blindly, way))
      keep(strips_.straighten(std::move(way)));
  }
  if (best.source == none) return {};
  search_windows(f, b, options, best);
  return best;
}

template class SurfaceTrace<float>;
template class SurfaceTrace<double>;

}  // namespace plexway
