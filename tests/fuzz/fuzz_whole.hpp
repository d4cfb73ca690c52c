#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "fuzz_plan.hpp"

/// Pieces welded to a whole whose distances are known.
namespace fuzz {

using plexway::PointSource;

/// Simplices of numbered places in pieces of their own, each with a speed, welded where they have
/// places in common.
class Whole {
 public:
  explicit Whole(const std::vector<Place>& places) : places_(places) {}

  /// A piece on which paths run at `speed`; nothing where there are no simplices.
  template <std::size_t Corners>
  void add(const std::vector<std::array<Index, Corners>>& simplices, double speed) {
    if (simplices.empty()) return;
    std::map<Index, Index> number;
    std::vector<Place> timed, at_size;
    std::vector<std::array<Index, Corners>> own = simplices;
    for (auto& simplex : own)
      for (Index& v : simplex) {
        const auto [found, is_new] = number.try_emplace(v, static_cast<Index>(timed.size()));
        if (is_new) {
          const Place& at = places_[v];
          timed.push_back({at[0] / speed, at[1] / speed, at[2] / speed});
          at_size.push_back(at);
          place_.push_back(v);
        }
        v = found->second;
      }
    const auto complex = [&] {
      if constexpr (Corners == 2)
        return plexway::Wireframe<double>(timed, own);
      else if constexpr (Corners == 3)
        return plexway::TriangleMesh<double>(timed, own);
      else
        return plexway::TetMesh<double>(timed, own);
    }();
    pieces_.push_back(mixed_.add(complex, at_size));
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      std::vector<std::array<Index, 2>> pairs;
      for (const auto& [place, own_number] : number)
        if (const auto other = numbers_[i].find(place); other != numbers_[i].end())
          pairs.push_back({other->second, own_number});
      mixed_.weld(pieces_[i], pieces_.back(), pairs);
    }
    numbers_.push_back(std::move(number));
  }

  /// The number of each vertex's place.
  [[nodiscard]] const std::vector<Index>& places() const { return place_; }
  /// From a place to each vertex; none where no piece has it.
  [[nodiscard]] std::vector<double> solve(Index source) const {
    const auto at = std::find(place_.begin(), place_.end(), source);
    if (at == place_.end()) return {};
    const auto from = PointSource::at(static_cast<Index>(at - place_.begin()));
    return plexway::solve(plexway::Serial{}, mixed_, from).distance;
  }

  /// From a place to each, by `truth`; a place of no piece counts for nothing.
  void check(Index source, const std::vector<double>& truth, Bounds bounds) const {
    const auto d = solve(source);
    if (d.empty()) return;
    require(d.size() == place_.size(), "one distance a vertex");
    std::vector<double> known;
    for (const Index v : place_) known.push_back(truth[v]);
    check_truth(d, known, bounds);
    std::map<Index, double> once;  // welded vertices are as far
    for (std::size_t v = 0; v < d.size(); ++v)
      require(once.try_emplace(place_[v], d[v]).first->second == d[v],
              "one distance for what is welded: vertex " + std::to_string(v));
  }

 private:
  const std::vector<Place>& places_;
  plexway::MixedComplex<double> mixed_;
  std::vector<plexway::MixedComplex<double>::Piece> pieces_;
  std::vector<std::map<Index, Index>> numbers_;  // of places, in each piece
  std::vector<Index> place_;                     // of each vertex of the whole
};

/// Deals simplices among as many pieces as `label` has values.
template <std::size_t Corners, class Label>
std::vector<std::vector<std::array<Index, Corners>>> dealt(
    const std::vector<std::array<Index, Corners>>& simplices, const std::vector<Place>& places,
    std::size_t pieces, const Label& label) {
  std::vector<std::vector<std::array<Index, Corners>>> parts(pieces);
  for (const auto& s : simplices) {
    Place middle{};
    for (const Index v : s)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += places[v][k] / double{Corners};
    parts[label(middle)].push_back(s);
  }
  return parts;
}

}  // namespace fuzz
