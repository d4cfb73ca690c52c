#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Numbers below a bound, taken out in order: a bit each, and how far any are set.
class SlotSet {
 public:
  explicit SlotSet(std::size_t bound) : words_(bound / 64 + 1, 0), first_(words_.size()) {}

  void add(Index slot) {
    const std::size_t word = slot / 64;
    words_[word] |= std::uint64_t{1} << (slot % 64);
    first_ = std::min(first_, word);
    end_ = std::max(end_, word + 1);
  }

  /// Adds all to `slots`, in order; it is empty then.
  void drain(std::vector<Index>& slots) {
    for (std::size_t word = first_; word < end_; ++word) {
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1)
        slots.push_back(static_cast<Index>(64 * word) + static_cast<Index>(std::countr_zero(bits)));
      words_[word] = 0;
    }
    first_ = words_.size();
    end_ = 0;
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t first_, end_ = 0;  // of words that are not 0
};

}  // namespace plexway
