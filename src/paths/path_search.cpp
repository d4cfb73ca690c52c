#include <plexway/paths/path_search.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"
#include "paths/surface_trace.hpp"

namespace plexway {
using namespace detail;
namespace {

// What single precision may have done to lengths.
constexpr double rounding = 1e-5;

/// The least factor by which a direction in the triangle is longer than in its positions.
template <class Real>
double least_stretch(const TriangleRecord<Real>& t, double unit, const Vector3<double>& a,
                     const Vector3<double>& b, const Vector3<double>& c) {
  const Vector3<double> e = b - a, p = c - a;
  const double l = norm(e), flat_l = static_cast<double>(t.length[0]) * unit;
  double least = infinity;
  const double own[3] = {l, norm(c - b), norm(p)};
  for (std::size_t i = 0; i < 3; ++i)
    if (own[i] > 0) least = std::min(least, static_cast<double>(t.length[i]) * unit / own[i]);
  if (!(l > 0)) return least;
  const double x = dot(e, p) / l, h = norm(cross(e, p)) / l;
  if (!(h > 1e-6 * std::max(l, std::abs(x)))) return least;
  // From the plane of the positions to that of the lengths: ((m, s), (0, n)).
  const double m = flat_l / l, n = static_cast<double>(t.apex_h(0)) * unit / h;
  double s = (static_cast<double>(t.apex_x(0)) * unit - m * x) / h;
  const double blur = rounding * (std::abs(x) + l) / h;
  s = std::copysign(std::max(std::abs(s) - blur, 0.), s);
  const double trace = m * m + s * s + n * n, determinant = m * n;
  const double root = std::sqrt(std::max(trace * trace / 4 - determinant * determinant, 0.));
  return std::min(least, std::sqrt(std::max(trace / 2 - root, 0.)));
}

}  // namespace

/// What a guided queue shares with those who ask and stop it. Guide has
///   bound(simplex, distance)   of all paths that its label, this far at its centre, leads to
///   settled(bound)   true if nothing at this bound or above is wanted any more
template <class Real, class Guide>
struct GuidedFront {
  struct Entry {
    double bound;
    Real distance;
    Index simplex;
  };
  std::vector<Entry> heap;
  Guide* guide;
};

/// Least bound first. A simplex may wait several times; what is out of date is skipped.
template <class Real, class Guide>
class GuidedQueue {
 public:
  using Front = GuidedFront<Real, Guide>;
  explicit GuidedQueue(Front& front) : front_(&front) {}

  void push(Index simplex, Real distance, bool = true) {
    const double bound = front_->guide->bound(simplex, static_cast<double>(distance));
    front_->heap.push_back({bound, distance, simplex});
    std::push_heap(front_->heap.begin(), front_->heap.end(), later);
  }

  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    auto& heap = front_->heap;
    while (!heap.empty()) {
      const auto first = heap.front();
      if (first.distance == distance_of(first.simplex) && front_->guide->settled(first.bound))
        return false;
      std::pop_heap(heap.begin(), heap.end(), later);
      heap.pop_back();
      if (first.distance != distance_of(first.simplex)) continue;
      simplex = first.simplex;
      return true;
    }
    return false;
  }

 private:
  static bool later(const typename Front::Entry& a, const typename Front::Entry& b) {
    return a.bound > b.bound;
  }
  Front* front_;
};

template <class Real>
struct PathSearch<Real>::State {
  const TriangleMesh<Real>& mesh;
  GivenPoints positions;
  double scale = 0;
  std::vector<Index> outer;
  WorkspaceState<Real> workspace;
  DistanceField<Real> no_field;
  GuidedFront<Real, State> front;

  // Of the search under way, unit inside.
  const std::function<double(Index)>* heuristic = nullptr;
  struct Target {
    Vector3<double> at = {0, 0, 0};
    std::vector<Index> corners;    // 3 f + i, if a vertex
    Index face = none;             // else
    std::array<double, 3> b = {};  // there
    double best = infinity;
    bool settled = false;
  };
  std::vector<Target> targets;
  std::size_t unsettled = 0, countdown = 0;
  double next_settled = infinity;  // the least `best` of those not settled
  const SurfaceLabels<Real>* labels = nullptr;

  explicit State(const TriangleMesh<Real>& m)
      : mesh(m), outer(vertices_outside(m)), front{{}, this} {}

  [[nodiscard]] Vector3<double> position(Index inside) const {
    const auto& p = positions[outer[inside]];
    return {p[0], p[1], p[2]};
  }

  /// Over the edge that the label came in by: the target is turned into the plane about it.
  [[nodiscard]] double over_edge(Index f, double sigma, const Vector2& source) const {
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    const std::size_t in = labels->hinge(f);
    const Vector3<double> a = position(t.corner[in]);
    const Vector3<double> edge = position(t.corner[edge_after(in)]) - a;
    const double length = norm(edge), inside_length = static_cast<double>(t.length[in]);
    // Nothing is known of a metric within the triangle.
    if (!(source.y <= 0) || !(length > 0) ||
        !(std::abs(length / mesh.unit() - inside_length) <= rounding * inside_length))
      return 0;
    double least = infinity;
    for (const Target& target : targets) {
      if (target.settled) continue;
      const Vector3<double> to = target.at - a;
      const double x = dot(to, edge) / (length * mesh.unit());
      const double h = norm(cross(to, edge)) / (length * mesh.unit()), sum = h - source.y;
      const double straight = sum > 0 ? (source.x * h - x * source.y) / sum : x;
      const double at = std::clamp(straight, 0., inside_length);
      least = std::min(least, std::hypot(at - source.x, source.y) + scale * std::hypot(at - x, h));
    }
    return least < infinity ? (sigma + least) * (1 - rounding) : 0;
  }

  [[nodiscard]] double bound(Index f, double distance) const {
    double least = distance + to_go(f);
    if (heuristic == nullptr && scale > 0)
      least = std::max(least, over_edge(f, labels->sigma(f), labels->virtual_source(f)));
    return least;
  }

  /// What a path through f has to go at least, less its own size; may be negative.
  [[nodiscard]] double to_go(Index f) const {
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    const double longest = static_cast<double>(std::max({t.length[0], t.length[1], t.length[2]}));
    const double r = longest * 2 / 3;  // no median is longer than the longest edge
    if (heuristic != nullptr) {
      double most = 0;
      for (const Index v : t.corner) most = std::max(most, (*heuristic)(outer[v]));
      return std::max(0., most / mesh.unit() - longest) - r;
    }
    if (!(scale > 0)) return -r;
    const Vector3<double> c =
        1. / 3 * (position(t.corner[0]) + position(t.corner[1]) + position(t.corner[2]));
    double least = infinity;
    for (const Target& target : targets)
      if (!target.settled) least = std::min(least, norm(target.at - c));
    if (least == infinity) least = 0;
    return std::max(0., least * scale / mesh.unit() - r) - r;
  }

  [[nodiscard]] double best_of(const Target& target) const {
    double best = infinity;
    for (const Index c : target.corners)
      if (labels->reached(c / 3)) best = std::min(best, labels->corner_distance(c / 3, c % 3));
    if (target.face == none) return best;
    const TriangleRecord<Real>& t = mesh.triangles()[target.face];
    if (labels->reached(target.face)) {  // straight there from a corner: an upper bound
      const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
      const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
      const double x = target.b[1] * px[1] + target.b[2] * px[2], y = target.b[2] * py[2];
      for (std::size_t i = 0; i < 3; ++i)
        best = std::min(best,
                        labels->corner_distance(target.face, i) + std::hypot(px[i] - x, py[i] - y));
    }
    return best;
  }

  /// Looks at the targets now and then; between, at one number.
  bool settled(double bound) {
    if (unsettled == 0) return true;
    if (bound < next_settled && countdown-- > 0) return false;
    countdown = 32 + targets.size();
    next_settled = infinity;
    for (Target& target : targets) {
      if (target.settled) continue;
      target.best = best_of(target);
      if (target.best <= bound) {
        target.settled = true;
        --unsettled;
      } else {
        next_settled = std::min(next_settled, target.best);
      }
    }
    return unsettled == 0;
  }
};

template <class Real>
PathSearch<Real>::PathSearch(const TriangleMesh<Real>& mesh)
    : state_(std::make_unique<State>(mesh)) {
  support(Purpose::searches, mesh).require();
}

template <class Real>
PathSearch<Real>::PathSearch(const TriangleMesh<Real>& mesh, GivenPoints positions, double scale)
    : PathSearch(mesh) {
  State& s = *state_;
  if (positions.size() != mesh.vertex_count())
    throw UsageError(std::to_string(positions.size()) + " positions for " +
                     std::to_string(mesh.vertex_count()) + " vertices: give one a vertex");
  if (!(scale >= 0) || !std::isfinite(scale)) throw UsageError("the scale must be a number >= 0");
  s.positions = std::move(positions);
  double least = infinity;
  Index worst = none;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    const double stretch = least_stretch(t, mesh.unit(), s.position(t.corner[0]),
                                         s.position(t.corner[1]), s.position(t.corner[2]));
    if (stretch < least) least = stretch, worst = t.face & ~reversed;
  }
  if (scale > least * (1 + rounding))
    throw UsageError("the straight line is no lower bound: paths in face " + std::to_string(worst) +
                     " are shorter than between its positions; a scale of at most " +
                     std::to_string(std::floor(least * (1 + 1e-6) * 1e6) * 1e-6) + " would do");
  s.scale = scale * (1 - rounding);
}

template <class Real>
PathSearch<Real>::~PathSearch() = default;
template <class Real>
PathSearch<Real>::PathSearch(PathSearch&&) noexcept = default;
template <class Real>
PathSearch<Real>& PathSearch<Real>::operator=(PathSearch&&) noexcept = default;

template <class Real>
SearchResult PathSearch<Real>::find(Serial, const SourceList& from, const SourceList& to,
                                    const SearchOptions& options) {
  const std::span<const PointSource> sources = points_of(Purpose::searches, from),
                                     targets = points_of(Purpose::searches, to);
  State& s = *state_;
  const TriangleMesh<Real>& mesh = s.mesh;
  const SourceDomain domain = {mesh.vertex_count(), mesh.face_count(), "face", 3};
  PropagateOptions propagate;
  propagate.max_expansions = options.max_expansions;
  propagate.progress = options.progress;
  check(sources, propagate, domain);
  detail::check(options.trace, mesh);
  if (targets.empty()) throw UsageError("there is no target: name at least one");

  s.heuristic = options.heuristic ? &options.heuristic : nullptr;
  s.targets.clear();
  for (const PointSource& point : targets) {
    PointSource p = point;
    p.offset = 0;
    check_source(p, domain);
    typename State::Target target;
    if (p.vertex != none) {
      mesh.corners_at(mesh.inside_vertex(p.vertex), target.corners);
      if (!s.positions.empty()) target.at = s.position(mesh.inside_vertex(p.vertex));
    } else {
      const auto [f, turned] = mesh.inside_face(p.simplex);
      target.face = f;
      target.b = {p.barycentric[0], p.barycentric[turned ? 2 : 1], p.barycentric[turned ? 1 : 2]};
      for (std::size_t i = 0; i < 3 && !s.positions.empty(); ++i)
        target.at = target.at + target.b[i] * s.position(mesh.triangles()[f].corner[i]);
    }
    s.targets.push_back(std::move(target));
  }
  s.unsettled = s.targets.size();
  s.countdown = 0;
  s.next_settled = infinity;
  s.front.heap.clear();

  WorkspaceState<Real>& workspace = s.workspace;
  workspace.start(mesh.face_count(), true);
  SaddleLabel<Real>* const labels = workspace.saddles.reserve(mesh.face_count() + 1);
  using Queue = GuidedQueue<Real, State>;
  Wavefront<Real, SaddleLabel<Real>, Queue, true> front(workspace.marks, labels, Queue(s.front),
                                                        workspace.source.data(), mesh.face_count(),
                                                        mesh.unit(), propagate);
  const SaddleRule<Real, decltype(front)> rule(mesh.triangles(), front, true);
  // SurfaceTrace reads the labels' sources if there are several; one is the first of several.
  const Solved<Real> solved = {workspace, s.no_field, sources, s.positions,
                               {},        s.outer,    {},      Visibility::saddles};
  const SurfaceLabels<Real> known(mesh, solved);
  s.labels = &known;
  TrianglePropagation<Real, std::decay_t<decltype(rule)>, decltype(front), true> propagation(
      mesh, workspace, rule, front, propagate);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  do {
    propagation.spread(false);
  } while (!front.out_of_budget() && propagation.pass_pinches(mesh.pinched()));
  // All is settled, or nothing waits and some target may be in what dropped offers left out.
  if (s.unsettled > 0 && !front.out_of_budget()) propagation.run();

  SearchResult result;
  const SurfaceTrace<Real> trace(mesh, solved);
  for (std::size_t n = 0; n < targets.size(); ++n) {
    result.distance.push_back(s.best_of(s.targets[n]) * mesh.unit());
    result.paths.push_back(
        or_no_way_at_all(trace.trace(targets[n], options.trace), solved, targets[n]));
  }
  s.labels = nullptr;
  s.heuristic = nullptr;
  result.complete = !front.out_of_budget();
  result.statistics = {front.expansions(), front.updates(), front.reached_count()};
  const auto is_capped = [](const Path& path) { return path.capped; };
  if (!result.complete || std::none_of(result.paths.begin(), result.paths.end(), is_capped))
    return result;
  // Windows ran out, as labels say too little of what is left to go: distances at all vertices say
  // more.
  PathField field(mesh, s.positions);
  const PropagateStatistics more = field.solve(Serial{}, sources).statistics;
  for (std::size_t n = 0; n < targets.size(); ++n) {
    if (!result.paths[n].capped) continue;
    PointSource target = targets[n];
    target.offset = 0;
    Path path = field.trace(target, options.trace);
    const auto whole = [&](const Path& p) {
      return p.source == none ? infinity : p.length + sources[p.source].offset;
    };
    result.paths[n].capped = path.capped;
    if (whole(path) < whole(result.paths[n])) result.paths[n] = std::move(path);
  }
  result.statistics.expansions += more.expansions;
  result.statistics.updates += more.updates;
  return result;
}

template <class Real>
std::size_t PathSearch<Real>::bytes() const {
  return state_->workspace.bytes() + state_->outer.capacity() * sizeof(Index) +
         state_->front.heap.capacity() * sizeof(state_->front.heap[0]);
}

template class PathSearch<float>;
template class PathSearch<double>;

}  // namespace plexway
