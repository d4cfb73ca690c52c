#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "sampling/random.hpp"

namespace plexway::detail {

/// A bag from which pieces are drawn with chances in proportion to their weights, each in about
/// constant time: pieces of like weight lie together, and a draw that hits the lighter ones of them
/// too often is repeated.
template <class Piece>
class WeightedPieces {
 public:
  void add(Piece piece, double weight) {
    if (!(weight > 0)) return;
    bags_[std::ilogb(weight)].emplace_back(std::move(piece), weight);
    ++count_;
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// No less than the weight of all, and no more than twice as much.
  [[nodiscard]] double bound() const {
    double sum = 0;
    for (const auto& [exponent, bag] : bags_)
      sum += static_cast<double>(bag.size()) * std::ldexp(1., exponent + 1);
    return sum;
  }

  Piece draw(Random& random) {
    for (;;) {
      double at = random.uniform() * bound();
      for (auto& [exponent, bag] : bags_) {
        const double most = std::ldexp(1., exponent + 1);
        const double share = static_cast<double>(bag.size()) * most;
        if (at >= share) {
          at -= share;
          continue;
        }
        const std::size_t i = random.below(bag.size());
        if (random.uniform() * most >= bag[i].second) break;
        Piece piece = std::move(bag[i].first);
        if (i + 1 < bag.size()) bag[i] = std::move(bag.back());
        bag.pop_back();
        --count_;
        return piece;
      }
    }
  }

 private:
  std::map<int, std::vector<std::pair<Piece, double>>> bags_;
  std::size_t count_ = 0;
};

}  // namespace plexway::detail
