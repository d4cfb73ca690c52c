#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "propagate/windows/bucket_ring.hpp"
#include "propagate/windows/entered_triangle.hpp"
#include "propagate/windows/gather.hpp"
#include "propagate/windows/kept_windows.hpp"
#include "propagate/windows/node_orders.hpp"
#include "propagate/windows/pseudo_source.hpp"
#include "propagate/windows/spread.hpp"
#include "propagate/windows/vertex_angles.hpp"

namespace plexway::windows {

/// How different windows may be to become one.
struct MergeLimit {
  /// The merged distance may be off by so much of the length of the edge that it serves,
  double limit = 3e-3;
  /// times sqrt(D / reach) at distance D, in mean edges: misses add up at random, so this makes
  /// relative errors even. Infinite: the limit alone, at any distance.
  double reach = 20;
};

/// The limit that gives this mean relative error, as measured on scans and CAD parts from 2e-5 to
/// 3e-4.
constexpr MergeLimit merge_limit(double error) { return {43 * error, 20}; }

/// Distances by windows of which neighbours that nearly agree become one, so that an edge has one
/// or two at a time.
template <class Real>
class MergedWindows {
 public:
  /// `mesh` and `angles` must outlive this.
  MergedWindows(const TriangleMesh<Real>& mesh, const VertexAngles& angles);

  /// The sources must be checked. Windows are put into `kept` as well, unless it is null. Throws
  /// Cancelled as the progress callback says. False, and no result, where merging does not pay:
  /// among needles windows do not become fewer, and what comes out is no good.
  [[nodiscard]] bool solve(std::span<const PointSource> sources, const PropagateOptions& options,
                           const MergeLimit& limit, KeptWindows<Real>* kept = nullptr);

  /// Afterwards, by the numbers inside, in mean edges; +inf where unreached.
  [[nodiscard]] Real distance(Index vertex) const { return vertices_[vertex].distance; }
  /// The nearest source of a reached vertex.
  [[nodiscard]] Index source(Index vertex) const { return labels_ ? source_[vertex] : 0; }
  /// How far off the distance may be, estimated from what merging cost on the way. No bound.
  [[nodiscard]] Real error(Index vertex) const { return error_[vertex]; }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// 16 bytes in float.
  struct Vertex {
    Real distance;
    Index corner;  ///< where the path comes from, as Arrival has it; `bent` may be added
    Towards<Real> from;
  };
  static constexpr Index bent = Index{1} << 31;

  /// The windows that wait on one halfedge, 4 f + i. What waits in the queue: the number of a
  /// block, or a vertex with `bent` set; each once.
  static constexpr std::size_t room = 8;
  struct alignas(64) Block {
    Real near;  ///< when it has its turn: told by the window that came first
    Index halfedge;
    Index count;
    Index next;  ///< in the queue, or of the free ones
    std::array<Window<Real>, room> window;
    std::array<Index, room> source;  ///< where there are several
  };
  static constexpr Index idle = none - 1;  ///< next of a vertex that does not wait

  /// One halfedge's turn: what its windows come to on the triangle's other edges, before vertices
  /// are looked at.
  struct Turn {
    Index face;
    Real scale;
    EnteredTriangle<Real> triangle;
    Gathered<Real> windows;
    std::array<Spread<Real>, Overlay<Real>::most> spread;
    Real to_apex;  ///< straight; +inf where the apex lies in shadow as far as these windows know
    std::size_t seen;  ///< from this window
  };
  static constexpr std::size_t batch = 4;  ///< turns at a time
  enum class Outcome { done, stopped, too_much };

  template <class Order>
  Outcome run(Order& order, const PropagateOptions& options);
  template <class Order>
  void seed(Order& order, std::span<const PointSource> sources);
  template <class Order>
  bool fill_holes(Order& order);
  Block& start(Turn& turn, Index block);
  void fetch(Index node) const;
  template <class Order>
  void commit_any(Order& order, const Turn& turn);
  template <class Order>
  void commit_one(Order& order, const Turn& turn);
  void prepare(Turn& turn);
  template <class Order>
  void commit(Order& order, const Turn& turn);
  template <class Order>
  void shine(Order& order, Index vertex);
  template <class Order>
  void leave(Order& order, Index f, std::size_t edge, const Window<Real>& window, Index source);
  template <class Order>
  void leave_special(Order& order, Index f, std::size_t edge, const Window<Real>& window,
                     Index source);
  template <class Order>
  void enter(Order& order, Index across, const Window<Real>& window, Index source);
  template <class Order>
  void offer(Order& order, Index vertex, Real distance, Index corner, Towards<Real> from,
             Index source, Real error);

  void gather(Gathered<Real>& windows, const Block& block) const;
  [[nodiscard]] Real scale_at(double distance) const;
  [[nodiscard]] double near(Index node) const;
  void go_on_to(double distance);
  /// The distance of a vertex, as windows count.
  [[nodiscard]] Real distance_to(Index vertex) const {
    return vertices_[vertex].distance - static_cast<Real>(base_);
  }
  [[nodiscard]] Index& next(Index node);

  std::span<const TriangleRecord<Real>> triangles_;
  const TriangleMesh<Real>& mesh_;
  const VertexAngles& angles_;
  PseudoSource<Real> pseudo_source_;
  Index sentinel_;  ///< beyond a boundary
  MergeLimit limit_;
  KeptWindows<Real>* kept_ = nullptr;
  bool labels_ = false;
  Real scale_ = 0;           ///< the limit for an edge of length 1, at the distance in turn
  double least_offset_ = 0;  ///< of a source: distances count from there for the limit
  Real radius_ = 0;
  double base_ = 0;  ///< lengths of windows are counted from here, which keeps them small

  std::vector<Real> excess_;  ///< of each vertex, as VertexAngles has it
  std::vector<Vertex> vertices_;
  std::vector<Index> source_;
  std::vector<Real> error_;
  std::vector<Real> low_;  ///< what vertices' distances were rounded by; empty while nothing is
  std::vector<Index> pending_;  ///< a block for each halfedge 4 f + i, or none; none after a solve
  std::vector<Block> blocks_;
  std::vector<Index> vertex_next_;
  std::vector<Index> corners_;
  Index free_block_ = none;
  std::array<Turn, batch> turns_;
  bool complete_ = true;
  PropagateStatistics statistics_;
  NearestOfAll nearest_;
};

extern template class MergedWindows<float>;
extern template class MergedWindows<double>;

}  // namespace plexway::windows
