#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <plexway/complex/ids.hpp>
#include <plexway/error.hpp>

namespace plexway {

/// Of 600 bytes each.
inline constexpr std::size_t most_parts = none >> 6;

class TooManyParts : public UsageError {
 public:
  using UsageError::UsageError;
};

/// A complex of N-simplices whose long edges are bisected, the longest first, each in all its
/// simplices at once, so that it stays conforming. It needs lengths only (the median of a triangle
/// is known from its sides), so it serves any metric, embedded or not.
///
/// Edges are numbered, not found by their vertices: two vertices may share several. But no edge may
/// be two sides of one simplex, nor begin and end at the same vertex.
template <int N>
class Bisection {
 public:
  static constexpr std::size_t corners = N + 1, sides = N * (N + 1) / 2;
  /// Side j (j - 1) / 2 + i joins corners i < j.
  static constexpr std::size_t side(std::size_t i, std::size_t j) {
    return i < j ? j * (j - 1) / 2 + i : i * (i - 1) / 2 + j;
  }

  struct Simplex {
    std::array<Index, corners> vertex;
    std::array<Index, sides> edge;
    Index parent;                                      ///< the simplex given that it is a part of
    std::array<std::array<double, 4>, corners> place;  ///< corners as weights of the parent's
  };
  struct Edge {
    Index vertex[2];
    double length;
  };

  /// `edges[s]` numbers the sides of simplex s; `limits` has one value a vertex: an edge longer
  /// than that of either end is bisected. A vertex in the middle of an edge takes the mean.
  /// Throws TooManyParts where that makes more than `most` simplices.
  Bisection(std::span<const std::array<Index, corners>> simplices,
            std::span<const std::array<Index, sides>> edges, std::vector<Edge> lengths,
            std::vector<double> limits, std::size_t most = most_parts);

  [[nodiscard]] const std::vector<Simplex>& simplices() const { return simplices_; }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// One a vertex. New vertices follow those given.
  [[nodiscard]] const std::vector<double>& limits() const { return limits_; }
  /// Ends of the edge that new vertex i, from 0, halved.
  [[nodiscard]] const std::vector<std::pair<Index, Index>>& halved() const { return halved_; }

 private:
  [[nodiscard]] double excess(Index edge) const;
  void bisect(Index edge);

  std::size_t most_;
  std::vector<Simplex> simplices_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Index>> around_;  // simplices at an edge
  std::vector<double> limits_;
  std::vector<std::pair<Index, Index>> halved_;
};

extern template class Bisection<2>;
extern template class Bisection<3>;

}  // namespace plexway
