#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace plexway::detail {

/// Random numbers that are the same everywhere: splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Another one made from it goes on with the same numbers.
  [[nodiscard]] std::uint64_t state() const { return state_; }

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Below `n`, which is at most 2^32; the bias is below 2^-32.
  std::uint64_t below(std::uint64_t n) { return ((bits() >> 32) * n) >> 32; }

  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::uint64_t state_;
};

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
