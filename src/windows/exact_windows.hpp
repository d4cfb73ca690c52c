#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "windows/kept_windows.hpp"
#include "windows/merge.hpp"
#include "windows/messages.hpp"
#include "windows/node_orders.hpp"
#include "windows/pseudo_source.hpp"
#include "windows/sheet.hpp"
#include "windows/vertex_angles.hpp"
#include "windows/window_sources.hpp"

namespace plexway::detail::windows {
/// What a solve by windows may take before it is given up.
struct Patience {
  std::size_t windows = 0;  ///< propagated in all
  std::size_t waiting = 0;  ///< at a time
};
/// For so many triangles. Who did not ask for windows `by_name` waits about twenty times as long as
/// usual for them, or a second. Are they `kept`?
[[nodiscard]] Patience patience(std::size_t triangles, bool by_name, bool kept);

/// Exact distances: every window that may hold a shortest path is propagated, in double.
///
/// A window is the light of one source on one edge, an interval. It goes on through a triangle to
/// one or two edges, until vertices or other windows serve all of its interval as well. Vertices
/// with more than 2 pi around (pi on a boundary) are sources themselves, into their shadow. What
/// decides that a window is needless: its edge's ends and, for wide ones, the vertex behind (Xin
/// and Wang, Improving Chen and Han's algorithm, TOG 2009), and one angle, one split (Chen and Han,
/// SoCG 1990).
///
/// All of these only drop what is longer by more than rounding, so the order of work does not
/// matter: it gives the same bits, sooner or later. What is kept from solve to solve is memory.
/// On a surface, or as one piece of it (pieced_windows.hpp).
template <class Real>
class ExactWindows {
 public:
  using Number = double;
  using Limit = Patience;

  /// What the sheet refers to must outlive this.
  explicit ExactWindows(const Sheet<Real>& sheet);

  /// The sources must be checked. Windows are put into `kept` as well, unless it is null. Throws
  /// Cancelled as the progress callback says. False, and no result, where more windows are needed
  /// than `patience` allows.
  [[nodiscard]] bool solve(const WindowSources& sources, const PropagateOptions& options,
                           const Patience& patience, KeptWindows<Real>* kept = nullptr);

  // ---- As a piece, which others tell when to do what ----

  /// A solve from `sources`, which are then given one by one.
  void begin(const WindowSources& sources, const PropagateOptions& options,
             const Patience& patience);
  /// Calls seed(g, barycentric) for the triangles that a source inside f is to be given to.
  template <class Seed>
  static void for_each_place(std::span<const TriangleRecord<Real>>, Index f,
                             const std::array<double, 4>& barycentric, const Seed& seed) {
    seed(f, barycentric);
  }
  /// A source at a vertex or inside a triangle of this piece.
  void seed_vertex(Index vertex, double sigma, Index number);
  void seed_inside(Index f, const std::array<double, 4>& barycentric, double sigma, Index number);
  /// Light that reaches a vertex in no way that windows know.
  void seed_hole(Index vertex, double distance, Index source, double);
  /// From another piece; the message's corner by the numbers here.
  void take(const Message<double>& message);
  /// As far as the horizon, or so many windows.
  void run_to(double horizon, std::size_t most);
  /// Nothing waits that is nearer.
  [[nodiscard]] double nearest() const { return ring_.nearest(); }
  /// When a window has its turn.
  [[nodiscard]] static double turn_of(const Window<double>& window) { return window.nearest(); }
  [[nodiscard]] Leaving<double>& leaving() { return leaving_; }
  [[nodiscard]] const Leaving<double>& leaving() const { return leaving_; }
  [[nodiscard]] double vertex_distance(Index vertex) const { return distance_[vertex]; }
  [[nodiscard]] double vertex_error(Index) const { return 0; }
  [[nodiscard]] Arrival<double> arrival(Index vertex) const { return arrival_[vertex]; }
  static constexpr Index corner_flags = 0;
  /// So many windows were at most waiting at a time.
  [[nodiscard]] std::size_t most_waiting() const { return nodes_.size(); }
  /// Are ties still broken in favour of both after so many windows on so many triangles?
  [[nodiscard]] static bool ties_end(std::size_t windows, std::size_t triangles);
  void end_ties();

  /// Light that rounding lost, or that fell on nothing with an area: calls fill(from, to, way) for
  /// vertices that are farther than along an edge from a neighbour; distance(v) may then be
  /// another. False if there are none.
  template <class Distance, class Fill>
  static bool fill_holes(std::span<const TriangleRecord<Real>> triangles, Index own,
                         const Distance& distance, const Fill& fill) {
    bool any = false;
    const double tie = least_tie();
    const auto look = [&](Index v, Index w, double length) {
      const double way = distance(v) + length;
      if (!(way + tie * way < distance(w))) return;
      fill(v, w, way);
      any = true;
    };
    for (Index f = 0; f < own; ++f) {
      const TriangleRecord<Real>& t = triangles[f];
      for (std::size_t e = 0; e < 3; ++e) {
        const Index v = t.corner[e], w = t.corner[edge_after(e)];
        look(v, w, static_cast<double>(t.length[e]));
        look(w, v, static_cast<double>(t.length[e]));
      }
    }
    return any;
  }

  /// Afterwards, by the numbers inside, in mean edges; +inf where unreached.
  [[nodiscard]] double distance(Index vertex) const { return distance_[vertex]; }
  /// The nearest source of a reached vertex.
  [[nodiscard]] Index source(Index vertex) const { return labels_ ? source_[vertex] : 0; }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// What two ways must differ by to differ, relative.
  [[nodiscard]] static double least_tie();

  /// A window, one cache line; or a vertex that is to shine, `at_begin` away.
  struct alignas(64) Node {
    Beam<double> beam;
    double sigma, at_begin, at_end;
    Index edge;  ///< the halfedge it enters by, 4 f + i; or a vertex and vertex_bit
    Index next;
  };
  static constexpr Index vertex_bit = Index{1} << 31;
  /// The window that sees an edge's apex best: its distance there, rounded up, and where the ray to
  /// the apex crosses the edge, off by single precision at most.
  struct Split {
    float distance, foot;
  };

  template <class Order>
  bool run(Order& order, const PropagateOptions& options);
  [[nodiscard]] bool too_many() const {
    return statistics_.expansions > patience_.windows || nodes_.size() > patience_.waiting;
  }
  template <class Order>
  bool spread(Order& order, std::size_t most);
  template <class Order>
  void seed(Order& order, const WindowSources& sources);
  template <class Order>
  void seed_inside(Order& order, Index f, const std::array<double, 4>& barycentric, double sigma,
                   Index number);
  template <class Order>
  void expand(Order& order, Index n);
  template <class Order>
  void expand_wide(Order& order, Window<double> window, Index halfedge, Index source);
  template <class Order>
  void shine(Order& order, Index vertex);
  template <class Order>
  bool fill_holes(Order& order);

  /// A window over edge `edge` of f enters all triangles on the other side. It is measured from the
  /// edge's second corner, where a triangle that does not turn over has its first.
  template <class Order>
  void leave(Order& order, Index f, std::size_t edge, const Window<double>& window, Index source);
  template <class Order>
  void enter(Order& order, Index halfedge, const Window<double>& window, Index source);
  template <class Order>
  void offer(Order& order, Index vertex, double distance, const Arrival<double>& arrival,
             Index source);
  template <class Order>
  bool know(Order& order, Index vertex, double distance, const Arrival<double>& arrival,
            Index source);

  /// What two ways must differ by, to differ: more than rounding. An edge that they cross counts as
  /// part of them, since it is what places are measured along.
  [[nodiscard]] double rounding(double way) const { return tie_ * way; }
  /// Cuts off what the ends of its edge serve as well. False if nothing is left.
  [[nodiscard]] bool trim(Window<double>& window, double length, double to_first,
                          double to_second) const;
  template <class Order>
  void push(Order& order, const Node& node, double near, Index source);
  [[nodiscard]] static double nearest(const Node& node);
  void keep(const Node& node, Index source);

  Sheet<Real> sheet_;
  std::span<const TriangleRecord<Real>> triangles_;
  Index own_;  ///< what lies behind is another piece's, or a boundary
  PseudoSource<Real> pseudo_source_;
  KeptWindows<Real>* kept_ = nullptr;
  bool labels_ = false;
  bool splits_whole_ = true;  ///< may a window lose all of a side (see expand)?
  double tie_ = 0, radius_ = 0;
  Patience patience_;

  std::vector<double> distance_;
  std::vector<Arrival<double>> arrival_;
  std::vector<Index> source_;
  std::vector<Split> split_;  ///< a halfedge
  std::vector<Node> nodes_;
  std::vector<Index> node_source_;  ///< where there are several
  std::vector<Index> corners_;
  Index free_ = none;
  bool complete_ = true;
  PropagateStatistics statistics_;
  NearestOfAll nearest_;
  BucketRing ring_;
  Leaving<double> leaving_;
};

extern template class ExactWindows<float>;
extern template class ExactWindows<double>;

}  // namespace plexway::detail::windows
