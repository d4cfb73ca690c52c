#pragma once

#include <cstdint>
#include <span>
#include <utility>

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

}  // namespace plexway::detail
