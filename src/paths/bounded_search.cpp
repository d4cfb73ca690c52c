#include <plexway/paths/bounded_search.hpp>

#include <algorithm>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "labels/finish.hpp"
#include "labels/read_out.hpp"
#include "labels/straight_lines.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {
using namespace detail;

namespace {

/// A queue that writes down what was ever pushed: simplices may be listed several times.
template <class Real, class Queue>
class LoggedQueue {
 public:
  LoggedQueue(Queue queue, std::vector<Index>& log) : queue_(queue), log_(&log) {}
  void push(Index simplex, Real distance, bool wanted = true) {
    if (wanted) log_->push_back(simplex);
    queue_.push(simplex, distance, wanted);
  }
  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    return queue_.pop(simplex, distance_of);
  }

 private:
  Queue queue_;
  std::vector<Index>* log_;
};

}  // namespace

template <class Real>
BoundedSearch<Real>::BoundedSearch(const TriangleMesh<Real>& mesh) : mesh_(&mesh) {
  support(Purpose::searches, mesh).require();
  const std::size_t vertices = mesh.vertex_count();
  WorkspaceState<Real>& workspace = workspace_.state();
  workspace.start(mesh.face_count(), true);
  workspace.front.reserve(mesh.face_count());
  workspace.saddles.reserve(mesh.face_count() + 1);
  workspace.vertex.resize(vertices);
  workspace.vertex_source.resize(vertices);
  stamp_.assign(vertices, 0);
  outer_ = vertices_outside(mesh);
}

template <class Real>
const Surroundings<Real>& BoundedSearch<Real>::find(Serial, const SourceList& given,
                                                    const PropagateOptions& options,
                                                    bool simplices) {
  const std::span<const PointSource> sources = points_of(Purpose::searches, given);
  check(sources, options, {mesh_->vertex_count(), mesh_->face_count(), "face", 3});
  support(Purpose::searches, *mesh_, options).require();
  with_queue<Real>(options, workspace_.state().front, [&](auto queue) {
    find_with(LoggedQueue<Real, decltype(queue)>(queue, reached_), sources, options, simplices);
  });
  return found_;
}

template <class Real>
template <class Queue>
void BoundedSearch<Real>::find_with(Queue queue, std::span<const PointSource> sources,
                                    const PropagateOptions& options, bool simplices) {
  const TriangleMesh<Real>& mesh = *mesh_;
  const std::span<const TriangleRecord<Real>> triangles = mesh.triangles();
  reached_.clear();
  WorkspaceState<Real>& workspace = workspace_.state();
  workspace.start(mesh.face_count(), true);
  Wavefront<Real, SaddleLabel<Real>, Queue, true> front(
      workspace.marks, workspace.saddles.labels.get(), queue, workspace.source.data(),
      mesh.face_count(), mesh.unit(), options);
  const SaddleRule<Real, decltype(front)> rule(triangles, front, options.vectorised);
  TrianglePropagation<Real, std::decay_t<decltype(rule)>, decltype(front), true> propagation(
      mesh, workspace, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));

  // Where fans only touch, among what is reached by then.
  const std::span<const Index> pinched = mesh.pinched();
  std::vector<Index> pinches;
  const auto find_pinches = [&] {
    pinches.clear();
    if (pinched.empty()) return;
    for (const Index f : reached_)
      for (const Index v : triangles[f].corner)
        if (std::binary_search(pinched.begin(), pinched.end(), v)) pinches.push_back(v);
    std::sort(pinches.begin(), pinches.end());
    pinches.erase(std::unique(pinches.begin(), pinches.end()), pinches.end());
  };
  if (options.radius == infinity) {
    propagation.run();
  } else {
    do {
      propagation.spread(false);
      if (front.out_of_budget()) break;
      find_pinches();
    } while (propagation.pass_pinches(pinches));
  }

  // Distances of the vertices: the least that their triangles offer, no farther than a neighbour
  // and the edge between.
  std::sort(reached_.begin(), reached_.end());
  reached_.erase(std::unique(reached_.begin(), reached_.end()), reached_.end());
  if (++search_ == 0) {  // after 2^32 searches
    std::fill(stamp_.begin(), stamp_.end(), Index{0});
    search_ = 1;
  }
  touched_.clear();
  Real* const d = workspace.vertex.data();
  Index* const label = workspace.vertex_source.data();
  const auto offer = [&](Index v, Real distance, Index number, bool tie = false) {
    if (stamp_[v] != search_) {
      stamp_[v] = search_;
      d[v] = infinity;
      label[v] = none;
      touched_.push_back(v);
    }
    if (distance < d[v] || (tie && distance == d[v])) d[v] = distance, label[v] = number;
  };
  Real longest = 0;
  for (const Index f : reached_)
    for (std::size_t i = 0; i < 3; ++i) {
      offer(triangles[f].corner[i], rule.corner_distance(f, i), front.source(f));
      longest = std::max(longest, triangles[f].length[i]);
    }
  for (std::size_t n = sources.size(); n-- > 0;)
    offer_source(mesh, sources[n], [&](Index v, double distance) {
      offer(v, static_cast<Real>(distance), static_cast<Index>(n), true);
    });
  const StraightLines<Real> lines(mesh, sources);
  for (const Index v : touched_) d[v] = lines.raised(v, d[v], label[v]);
  // Each pass lowers some distance to that of a path along edges; there are only so many.
  for (bool any = true; any;) {
    any = false;
    for (const Index f : reached_)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = triangles[f].corner[i], w = triangles[f].corner[edge_after(i)];
        const Real length = triangles[f].length[i];
        if (d[v] + length < d[w]) d[w] = d[v] + length, label[w] = label[v], any = true;
        if (d[w] + length < d[v]) d[v] = d[w] + length, label[v] = label[w], any = true;
      }
  }

  const Real unit = static_cast<Real>(mesh.unit()), radius = static_cast<Real>(options.radius);
  found_.vertices.clear();
  for (const Index v : touched_) {
    const Real distance = d[v] * unit;
    if (distance <= radius && distance < infinity)
      found_.vertices.push_back({outer_[v], distance, label[v]});
  }
  found_.simplices.clear();
  if (simplices)
    for (const Index f : reached_) found_.simplices.push_back(triangles[f].face & ~reversed);
  found_.complete = !front.out_of_budget();
  found_.longest_edge = static_cast<double>(longest) * mesh.unit();
  found_.statistics = {front.expansions(), front.updates(), front.reached_count()};
}

template <class Real>
std::size_t BoundedSearch<Real>::bytes() const {
  return workspace_.bytes() +
         (outer_.capacity() + stamp_.capacity() + reached_.capacity() + touched_.capacity() +
          found_.simplices.capacity()) *
             sizeof(Index) +
         found_.vertices.capacity() * sizeof(found_.vertices[0]);
}

template class BoundedSearch<float>;
template class BoundedSearch<double>;

}  // namespace plexway
