#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "paths/strip.hpp"
#include "paths/surface_shape.hpp"

namespace plexway::detail {

/// Values by number, for a few of very many numbers: open addressing.
template <class Value>
class IndexTable {
 public:
  /// The value of a key, and whether it is new. A reference lasts until the next call.
  std::pair<Value&, bool> get(Index key) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = find(key);
    const bool fresh = slot.key != key;
    if (fresh) slot.key = key, slot.value = Value{}, ++count_;
    return {slot.value, fresh};
  }

 private:
  struct Slot {
    Index key = none;
    Value value{};
  };
  Slot& find(Index key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at =
        static_cast<std::size_t>((key * std::uint64_t{0x9E3779B97F4A7C15}) >> 20) & mask;
    while (slots_[at].key != none && slots_[at].key != key) at = (at + 1) & mask;
    return slots_[at];
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 256 : 2 * slots_.size());
    old.swap(slots_);
    for (Slot& slot : old)
      if (slot.key != none) find(slot.key) = std::move(slot);
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

/// A place that a search may end at.
struct WindowGoal {
  Index vertex = none;            ///< inside, or
  Index face = none;              ///< inside, and
  std::array<double, 3> at = {};  ///< there
  double left = 0;                ///< what is still to go
};

/// The shortest of all paths from a point to one of several goals, exactly, where it is shorter
/// than one that is known.
///
/// Windows are parts of edges that one straight fan of rays comes to (Mitchell, Mount,
/// Papadimitriou, The discrete geodesic problem, 1987). They are not trimmed against each other;
/// instead each corner lets but the nearest fan through on both sides (Chen, Han, Shortest paths on
/// a polyhedron, 1990), and what a vertex is nearer to is left out (Xin, Wang, Improving Chen and
/// Han's algorithm, 2009). New here: a field of approximate distances to the goals says what is
/// left to go, so that only windows in a corridor about the shortest path are looked at, nearest to
/// it first.
///
/// Cost: 0.2 us a window.
template <class Real>
class WindowSearch {
 public:
  /// `left(v)`: roughly how far vertex v (inside) is from the goals; +inf where unreachable.
  /// Lengths in the unit of `shape`.
  WindowSearch(const TriangleMesh<Real>& mesh, const SurfaceShape<Real>& shape,
               std::function<double(Index)> left, std::span<const WindowGoal> goals);

  struct Found {
    double length = 0;  ///< with what the goal has left
    Index goal = none;  ///< or none: nothing is shorter than the bound
    /// Straight ways from vertex to vertex.
    std::vector<Strip> strips;
    bool complete = true;  ///< false: there were too many windows
    std::size_t windows = 0;
  };
  /// From a point of triangle f. No path of length `bound` or more is wanted; `left` may be too
  /// large by a share of `margin`.
  Found find(Index f, const std::array<double, 3>& b, double bound, double margin,
             std::size_t most);

 private:
  struct Vertex {
    double distance = 0, left = 0;
    Index arrival = none;
    signed char bends = -1;  // may a path bend here? -1: not looked at yet
  };
  /// A way to a vertex that was the shortest when it was found.
  struct Arrival {
    Index vertex;
    double distance;
    Index face;
    std::size_t corner;
    Index window = none;            // the last on the way, or
    Index before = none;            // along an edge from this arrival, or straight from the start
    std::size_t before_corner = 3;  // which is at this corner of the face
  };
  struct Window {
    Crossing in;
    double begin, end;  // along the edge, from its first corner
    Vector2 source;     // there; below the edge
    double sigma;
    Index before;  // the window it came through, or none: the first after
    Index root;    // this arrival, or none: after the start
    Index first;   // and there left this triangle
    std::size_t first_corner;
  };
  /// A triangle's measures, which windows ask for again and again.
  struct Face {
    std::array<double, 3> length;
    std::array<Vector2, 3> apex;
  };
  struct Split {
    double distance = 0, crossing = 0;
    bool known = false;
  };
  struct Waiting {
    double bound;
    Index number;
    bool arrival;  // or a window
  };

  Vertex& vertex(Index v);
  const Face& face(Index f);
  bool may_bend(Index v);
  void wait(const Waiting& waiting);
  void arrive(const Arrival& arrival);
  void leave_vertex(Index arrival);
  void leave_point(Index f, const Vector2& at, double sigma, Index root, std::size_t corner,
                   std::size_t edge);
  void add(const Window& window);
  void spread(Index window);
  void try_goals(Index window);
  [[nodiscard]] std::vector<Strip> strips_to(Index window, Index arrival,
                                             const std::array<double, 3>& end) const;
  [[nodiscard]] Strip strip_of(Index window) const;

  const TriangleMesh<Real>& mesh_;
  const SurfaceShape<Real>& shape_;
  std::function<double(Index)> left_;
  std::span<const WindowGoal> goals_;
  IndexTable<Index> goal_at_;   // vertices: the best goal there
  IndexTable<Index> goals_in_;  // triangles: the first goal there, others follow in next_goal_
  std::vector<Index> next_goal_;
  bool goals_inside_ = false;

  IndexTable<Vertex> vertices_;
  IndexTable<Face> faces_;
  IndexTable<Split> splits_;  // by 3 f + edge
  std::vector<Arrival> arrivals_;
  std::vector<Window> windows_;
  std::vector<Waiting> waiting_;
  std::vector<Index> corners_;
  Index start_ = none;
  std::array<double, 3> start_at_ = {};
  double bound_ = 0, share_ = 1;
  std::size_t most_ = 0;
  Found found_;
  Index last_window_ = none, last_arrival_ = none;
};

}  // namespace plexway::detail
