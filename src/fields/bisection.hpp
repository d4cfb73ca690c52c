#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

#include "executors/simplex_numbers.hpp"

namespace plexway::detail {

/// Of 300 bytes each.
inline constexpr std::size_t most_parts = none >> 6;

class TooManyParts : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Which simplex was halved into which, so that points are found again in the parts.
class Splits {
 public:
  explicit Splits(std::size_t given = 0) : first_(given, none), last_(given, none) {}

  /// `simplex` keeps its corner i and gets the middle of its edge ij as corner j; the next new one
  /// is the other half.
  void halve(Index simplex, std::size_t i, std::size_t j);
  /// No more will follow.
  void end() { last_ = {}; }

  /// The part of a simplex given where a point is; its weights become those in that part. Cost:
  /// the halvings on the way.
  Index part(Index simplex, std::array<double, 4>& weights) const;

 private:
  struct Split {
    Index other;
    Index next[2];  // of the half that keeps the number, of the other one
    std::uint8_t i, j;
  };
  std::vector<Split> splits_;
  std::vector<Index> first_;  // of each simplex given, or none
  std::vector<Index> last_;   // of each simplex: twice its last split, + 1 if it is the other half
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
    Index parent;  ///< the simplex given that it is a part of
  };
  struct Edge {
    Index vertex[2];
    double length;
  };

  /// How much too long an edge is; it is bisected if that is > 1, the greatest first. It is asked
  /// for every edge, and after each bisection first for an edge that ends at the new vertex.
  using Excess = std::function<double(const Bisection&, Index edge)>;

  /// `edges[s]` numbers the sides of simplex s. `shape_kept`: before an edge the longest one near
  /// it is bisected, however short it may be for `excess`; without that, where `excess` is not in
  /// proportion to the length, simplices may become ever thinner and never end (Rivara, A
  /// grid generator based on 4-triangles conforming mesh-refinement algorithms, IJNME 1987).
  /// Throws TooManyParts where that makes more than `most` simplices.
  Bisection(std::size_t vertices, std::span<const std::array<Index, corners>> simplices,
            std::span<const std::array<Index, sides>> edges, std::vector<Edge> lengths,
            const Excess& excess, std::size_t most = most_parts, bool shape_kept = false);

  [[nodiscard]] const std::vector<Simplex>& simplices() const { return simplices_; }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// One of the simplices that an edge is a side of; only while `excess` is asked.
  [[nodiscard]] Index beside(Index edge) const { return around_[edge].front(); }
  /// Ends of the edge that new vertex i, from 0, halved. They follow the vertices given.
  [[nodiscard]] const std::vector<std::pair<Index, Index>>& halved() const { return halved_; }
  [[nodiscard]] const Splits& splits() const { return splits_; }

 private:
  void bisect(Index edge);
  /// From simplex to simplex, always to the longest edge, until none is longer.
  [[nodiscard]] Index longest_near(Index edge) const;

  std::size_t vertices_, most_;
  std::vector<Simplex> simplices_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Index>> around_;  // simplices at an edge
  std::vector<std::pair<Index, Index>> halved_;
  Splits splits_;
};

/// Where a vertex lies in a simplex given that holds it, as weights of its corners. `given`: so
/// many vertices were there before. Cost: the vertices that were halved to get there, some tens.
template <class Corners>
Weights place_in(std::span<const std::pair<Index, Index>> halved, std::size_t given,
                 const Corners& corners, Index vertex) {
  Weights weights{};
  const auto corner = [&](Index v) {
    return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  };
  if (vertex < given) {
    weights[corner(vertex)] = 1;
    return weights;
  }
  // Each vertex comes after those it lies between.
  std::map<Index, double, std::greater<>> shares = {{vertex, 1}};
  while (shares.begin()->first >= given) {
    const auto [v, share] = *shares.begin();
    shares.erase(shares.begin());
    shares[halved[v - given].first] += share / 2;
    shares[halved[v - given].second] += share / 2;
  }
  for (const auto& [v, share] : shares) weights[corner(v)] = share;
  return weights;
}

extern template class Bisection<2>;
extern template class Bisection<3>;

}  // namespace plexway::detail
