#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/detail/triangle_record.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "windows/entered_triangle.hpp"
#include "windows/gather.hpp"
#include "windows/kept_windows.hpp"
#include "windows/messages.hpp"
#include "windows/node_orders.hpp"
#include "windows/pseudo_source.hpp"
#include "windows/sheet.hpp"
#include "windows/vertex_angles.hpp"
#include "windows/window_sources.hpp"

namespace plexway::detail::windows {
/// The triangles that a point of f lies in: calls visit(f, barycentric, 3) and, where it lies on an
/// edge, visit(g, barycentric, k) for the others there; edge k of g is that one.
template <class Real, class Visit>
void triangles_at(std::span<const TriangleRecord<Real>> triangles, Index f,
                  const std::array<double, 4>& b, const Visit& visit) {
  visit(f, b, std::size_t{3});
  const Index sentinel = static_cast<Index>(triangles.size() - 1);
  for (std::size_t e = 0; e < 3; ++e) {
    if (b[edge_before(e)] > on_edge<Real> ||
        triangles[f].across[e] >> Across::face_shift == sentinel)
      continue;
    cross_edge(triangles, f, e, [&](Index across, bool turned) {
      const std::size_t k = across & Across::edge_mask;
      std::array<double, 4> there = {0, 0, 0, 0};
      there[k] = b[turned ? e : edge_after(e)];
      there[edge_after(k)] = b[turned ? edge_after(e) : e];
      visit(across >> Across::face_shift, there, k);
    });
  }
}

/// How different windows may be to become one.
struct MergeLimit {
  /// The merged distance may be off by so much of the length of the edge that it serves,
  double limit = 3e-3;
  /// times sqrt(D / reach) at distance D, in mean edges: misses add up at random, so this makes
  /// relative errors even. Infinite: the limit alone, at any distance.
  double reach = 20;
  /// Beyond so many edges only this share of it. Of what waits the nearest is kept, so misses to
  /// the short side stay: little, but the same at each of so many edges.
  double far = 4096, share_far = .05;
};

/// The limit that gives this mean relative error, as measured on scans and CAD parts from 2e-5 to
/// 3e-4.
constexpr MergeLimit merge_limit(double error) { return {43 * error, 20}; }

/// Distances by windows of which neighbours that nearly agree become one, so that an edge has one
/// or two at a time. On a surface, or as one piece of it (pieced_windows.hpp).
template <class Real>
class MergedWindows {
 public:
  using Number = Real;
  using Limit = MergeLimit;

  /// What the sheet refers to must outlive this.
  explicit MergedWindows(const Sheet<Real>& sheet);

  /// The sources must be checked. Windows are put into `kept` as well, unless it is null. Throws
  /// Cancelled as the progress callback says. False, and no result, where merging does not pay:
  /// among needles windows do not become fewer, and what comes out is no good. Works in `distance`,
  /// which must outlive what is asked afterwards.
  [[nodiscard]] bool solve(const WindowSources& sources, const PropagateOptions& options,
                           const MergeLimit& limit, std::vector<Real>& distance,
                           KeptWindows<Real>* kept = nullptr);

  // ---- As a piece, which others tell when to do what ----

  /// A solve from `sources`, which are then given one by one.
  void begin(const WindowSources& sources, const PropagateOptions& options,
             const MergeLimit& limit) {
    begin(sources, options, limit, own_distance_);
  }
  /// Calls seed(g, barycentric) for the triangles that a source inside f is to be given to: where
  /// it lies on an edge, all at that edge. As a window over that edge it would light them through a
  /// single point, and what cuts off a part of the edge would cut off all light to one side.
  template <class Seed>
  static void for_each_place(std::span<const TriangleRecord<Real>> triangles, Index f,
                             const std::array<double, 4>& barycentric, const Seed& seed) {
    triangles_at(triangles, f, barycentric,
                 [&](Index g, const std::array<double, 4>& b, std::size_t) { seed(g, b); });
  }
  /// A source at a vertex or inside a triangle of this piece.
  void seed_vertex(Index vertex, double sigma, Index number);
  void seed_inside(Index f, const std::array<double, 4>& barycentric, double sigma, Index number);
  /// Light that reaches a vertex in no way that windows know.
  void seed_hole(Index vertex, Real distance, Index source, Real error);
  /// From another piece; the message's corner by the numbers here.
  void take(const Message<Real>& message);
  /// As far as the horizon, or so many turns.
  void run_to(double horizon, std::size_t most);
  /// Nothing waits that is nearer.
  [[nodiscard]] double nearest() const {
    return waits_ ? std::min(ring_.distance(), ring_.nearest()) : ring_.nearest();
  }
  /// When a window has its turn: between its nearest and its farthest distance.
  [[nodiscard]] static Real turn_of(const Window<Real>& window) {
    constexpr double at = 0.3;
    return std::min(window.at_begin, window.at_end) * static_cast<Real>(1 - at) +
           std::max(window.at_begin, window.at_end) * static_cast<Real>(at);
  }
  [[nodiscard]] Leaving<Real>& leaving() { return leaving_; }
  [[nodiscard]] const Leaving<Real>& leaving() const { return leaving_; }
  [[nodiscard]] Real vertex_distance(Index vertex) const { return distance_[vertex]; }
  [[nodiscard]] Real vertex_error(Index vertex) const { return static_cast<Real>(error_[vertex]); }
  /// At a vertex that other pieces have, too.
  [[nodiscard]] Arrival<Real> arrival(Index shared) const {
    const Arrival<float>& a = arrivals_[shared];
    return {a.corner, static_cast<Real>(a.along), static_cast<Real>(a.off)};
  }
  /// Is what arrived bent at that vertex? Part of Arrival::corner, beside `none`.
  static constexpr Index corner_flags = Index{1} << 31;
  /// Is this too much for so many triangles?
  [[nodiscard]] static bool too_many(std::size_t turns, std::size_t triangles);

  /// Calls fill(from, to, way) for vertices of these triangles that are reached along an edge and
  /// in no other way; distance(v) may then be another. False if there are none.
  template <class Distance, class Fill>
  static bool fill_holes(std::span<const TriangleRecord<Real>> triangles, Index own,
                         const Distance& distance, const Fill& fill) {
    constexpr Real unreached = std::numeric_limits<Real>::infinity();
    bool any = false;
    for (Index f = 0; f < own; ++f) {
      const TriangleRecord<Real>& t = triangles[f];
      for (std::size_t e = 0; e < 3; ++e)
        for (const auto& [from, to] : {std::pair(e, edge_after(e)), std::pair(edge_after(e), e)}) {
          const Index v = t.corner[from], w = t.corner[to];
          if (distance(w) < unreached || !(distance(v) < unreached)) continue;
          fill(v, w, distance(v) + t.length[e]);
          any = true;
        }
    }
    return any;
  }

  /// Afterwards, by the numbers inside, in mean edges; +inf where unreached.
  [[nodiscard]] Real distance(Index vertex) const { return distance_[vertex]; }
  /// The nearest source of a reached vertex.
  [[nodiscard]] Index source(Index vertex) const { return labels_ ? source_[vertex] : 0; }
  /// How far off the distance may be, estimated from what merging cost on the way. No bound.
  [[nodiscard]] Real error(Index vertex) const { return vertex_error(vertex); }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  static constexpr Index bent = corner_flags;

  /// A vertex that waits for its turn to shine, and from where its path comes, as Arrival has it;
  /// `bent` may be added to the corner. Of the direction single precision is enough: merged light
  /// is off by more.
  struct Shining {
    Index place;  ///< the vertex
    Arrival<float> arrival;
    Index next;  ///< in the queue, or of the free ones
    Index link;  ///< of shining_at_
  };

  /// The windows that wait on one halfedge, 4 f + i. What waits in the queue: the number of a
  /// block, or that of a Shining with `bent` set; each once. Only blocks with room are found.
  static constexpr std::size_t room = 8;
  struct alignas(64) Block {
    Real near;    ///< when it has its turn: told by the window that came first
    Index place;  ///< the halfedge
    Index count;
    Index next;  ///< in the queue, or of the free ones
    Index link;  ///< of waiting_at_
    std::array<Window<Real>, room> window;
    std::array<Index, room> source;  ///< where there are several
  };
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
  static constexpr std::size_t batch = 2;  ///< turns at a time
  enum class Outcome { done, stopped, too_much };

  void begin(const WindowSources& sources, const PropagateOptions& options, const MergeLimit& limit,
             std::vector<Real>& distance);
  template <class Order>
  Outcome run(Order& order, const PropagateOptions& options);
  template <class Order>
  Outcome left_over(Order& order);
  template <class Order>
  bool spread(Order& order, std::size_t most);
  template <class Order>
  void seed(Order& order, const WindowSources& sources);
  template <class Order>
  void seed_inside(Order& order, Index f, const std::array<double, 4>& barycentric, Real sigma,
                   Index number);
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
  void shine(Order& order, Index vertex, const Arrival<float>& arrival);
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
  template <class Order>
  bool know(Order& order, Index vertex, Real distance, Index corner, Towards<Real> from,
            Index source, Real error);

  Index will_shine(const Shining& vertex);
  void gather(Gathered<Real>& windows, const Block& block) const;
  [[nodiscard]] Real scale_at(double distance) const;
  [[nodiscard]] Real excess(Index vertex) const {
    return static_cast<Real>(sheet_.angles->excess[vertex]);
  }
  [[nodiscard]] Real near(Index node) const;
  [[nodiscard]] Index& next(Index node);

  Sheet<Real> sheet_;
  std::span<const TriangleRecord<Real>> triangles_;
  Index own_;  ///< what lies behind is another piece's, or a boundary
  PseudoSource<Real> pseudo_source_;
  MergeLimit limit_;
  KeptWindows<Real>* kept_ = nullptr;
  bool labels_ = false;
  Real scale_ = 0;           ///< the limit for an edge of length 1, at the distance in turn
  double least_offset_ = 0;  ///< of a source: distances count from there for the limit
  Real radius_ = 0;

  Real* distance_ = nullptr;  ///< one a vertex, as are:
  std::vector<float> error_;
  std::vector<Index> source_;
  std::vector<Arrival<float>> arrivals_;  ///< at the first vertices, which are shared
  std::vector<Real> own_distance_;        ///< of a piece
  WaitingTable waiting_at_, shining_at_;
  std::vector<Block> blocks_;
  std::vector<Shining> shining_;
  std::vector<Index> corners_;
  Index free_block_ = none, free_shining_ = none;
  std::array<Turn, batch> turns_;
  std::size_t current_ = 0;  ///< the turn to be prepared next
  bool waits_ = false;       ///< is the other one still to be committed?
  bool complete_ = true;
  PropagateStatistics statistics_;
  NearestOfAll nearest_;
  BucketRing ring_;
  Leaving<Real> leaving_;
};

extern template class MergedWindows<float>;
extern template class MergedWindows<double>;

}  // namespace plexway::detail::windows
