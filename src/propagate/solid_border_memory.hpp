#pragma once

#include <cstddef>
#include <vector>

#include <plexway/complex/ids.hpp>

#include "propagate/solid_label.hpp"

namespace plexway {

/// What SolidBorders notes down; kept from solve to solve.
template <class Real>
struct SolidBorderMemory {
  /// All numbers are places in the lists below, or none.
  struct Vertex {
    Index around = none;  ///< its neighbours, once listed
    Index asked = none;   ///< the last way that it was asked about
    Index way = none;     ///< by which its distance came, once asked for
    Index listed = none;  ///< the last vertex in whose list of neighbours it is
  };
  struct Around {
    Index begin, end;
    Real longest;  ///< edge
  };
  struct Neighbour {
    Index vertex;
    Index corner;  ///< 4 t + i in a tetrahedron that has the edge
  };
  struct Asked {
    Index way, before;
  };
  struct Way {
    SolidLabel<Real> label;
    Index source;
    Index before;  ///< of the same hash
  };
  struct Waiting {
    Index vertex, way;
    Real distance;
  };

  std::vector<Vertex> vertices;
  std::vector<Around> around;
  std::vector<Neighbour> neighbours;
  std::vector<Asked> asked;
  std::vector<Way> ways;
  std::vector<Index> way_of_hash;
  std::vector<Waiting> waiting;

  void start(std::size_t vertex_count) {
    vertices.assign(vertex_count, Vertex{});
    around.clear();
    neighbours.clear();
    asked.clear();
    ways.clear();
    way_of_hash.assign(least_hashes, none);
    waiting.clear();
  }

  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return of(vertices) + of(around) + of(neighbours) + of(asked) + of(ways) + of(way_of_hash) +
           of(waiting);
  }

  static constexpr std::size_t least_hashes = 1024;  ///< a power of two
};

}  // namespace plexway
