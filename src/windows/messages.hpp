#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/ids.hpp>

#include "windows/merge.hpp"
#include "windows/pseudo_source.hpp"

namespace plexway::detail::windows {

/// What one piece tells another: a window that enters there, or how far a vertex is that both have,
/// where its path comes from, and what merging may have cost.
template <class Real>
struct Message {
  static constexpr Index is_vertex = Index{1} << 31;

  Index to;  ///< the halfedge that it enters by, 4 f + i; or a vertex and `is_vertex`
  Index source;
  Index corner;         ///< of a vertex, as Arrival has it
  Window<Real> window;  ///< of a vertex: `at_begin` the distance, beam.x and h the direction

  [[nodiscard]] static Message of_vertex(Index vertex, Real distance, const Arrival<Real>& arrival,
                                         Index source, Real error) {
    return {vertex | is_vertex,
            source,
            arrival.corner,
            {{arrival.along, arrival.off, 0, 0}, 0, distance, 0, error}};
  }
  [[nodiscard]] bool is_of_vertex() const { return (to & is_vertex) != 0; }
  [[nodiscard]] Index vertex() const { return to & ~is_vertex; }
  [[nodiscard]] Arrival<Real> arrival() const { return {corner, window.beam.x, window.beam.h}; }
};

/// What leaves a piece until it is posted: windows that entered ghosts, by their numbers here, and
/// vertices that got nearer.
template <class Real>
struct Leaving {
  std::vector<Message<Real>> windows;
  std::vector<Index> vertices;

  void start(std::size_t shared) {
    windows.clear();
    vertices.clear();
    is_sent_.assign(shared, 0);
  }
  void tell(Index vertex) {
    if (is_sent_[vertex] == 0) vertices.push_back(vertex);
    is_sent_[vertex] = 1;
  }
  /// Forgets the vertices of which known(vertex) is true.
  template <class Known>
  void leave_out(const Known& known) {
    std::erase_if(vertices, [&](Index v) {
      if (!known(v)) return false;
      is_sent_[v] = 0;
      return true;
    });
  }
  /// All has been posted.
  void clear() {
    windows.clear();
    for (const Index v : vertices) is_sent_[v] = 0;
    vertices.clear();
  }
  [[nodiscard]] std::size_t bytes() const {
    return windows.capacity() * sizeof(windows[0]) + vertices.capacity() * sizeof(Index) +
           is_sent_.capacity();
  }

 private:
  std::vector<std::uint8_t> is_sent_;
};

}  // namespace plexway::detail::windows
