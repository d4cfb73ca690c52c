#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// The caller's sources of a mixed domain, by the piece that they are in: one at a welded vertex is
/// in each of the pieces there.
template <class Point, class Real>
class PieceSources {
 public:
  struct Source {
    Index piece, number;
    Point at;  // in the domain's unit
    Real offset;
  };
  using Iterator = typename std::vector<Source>::const_iterator;

  void add(const Source& source) { sources_.push_back(source); }
  /// All are there.
  void sort() {
    std::stable_sort(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) {
      return std::pair(a.piece, a.number) < std::pair(b.piece, b.number);
    });
  }
  /// Those of a piece, if they are few enough to ask each of them.
  [[nodiscard]] std::pair<Iterator, Iterator> few(Index piece) const {
    constexpr std::ptrdiff_t most = 8;
    const Iterator first = at(piece, 0), last = at(piece + 1, 0);
    return {first, last - first > most ? first : last};
  }
  /// The same, and of more the one of that number.
  [[nodiscard]] std::pair<Iterator, Iterator> few_or(Index piece, Index number) const {
    const auto some = few(piece);
    if (some.first != some.second) return some;
    const Iterator found = at(piece, number);
    const bool is = found != sources_.end() && found->piece == piece && found->number == number;
    return {found, is ? found + 1 : found};
  }

 private:
  [[nodiscard]] Iterator at(Index piece, Index number) const {
    return std::lower_bound(
        sources_.begin(), sources_.end(), std::pair(piece, number),
        [](const Source& s, const auto& key) { return std::pair(s.piece, s.number) < key; });
  }

  std::vector<Source> sources_;
};

}  // namespace plexway
