#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {

/// 21 bits spread to every third place.
constexpr std::uint64_t every_third_bit(std::uint64_t q) {
  q = (q | q << 32) & 0x1f00000000ffff;
  q = (q | q << 16) & 0x1f0000ff0000ff;
  q = (q | q << 8) & 0x100f00f00f00f00f;
  q = (q | q << 4) & 0x10c30c30c30c30c3;
  return (q | q << 2) & 0x1249249249249249;
}

/// 12 bits spread to every third place.
constexpr std::uint64_t every_third_bit_of_12(std::uint64_t q) {
  q = (q | q << 16) & 0xf0000ff;
  q = (q | q << 8) & 0xf00f00f;
  q = (q | q << 4) & 0x0c30c30c3;
  return (q | q << 2) & 0x249249249;
}

/// A cell of the space-filling curve: three numbers of 21 bits.
using CurveCell = std::array<std::int64_t, 3>;
constexpr std::uint64_t curve_key(const CurveCell& cell) {
  return every_third_bit(static_cast<std::uint64_t>(cell[0])) |
         every_third_bit(static_cast<std::uint64_t>(cell[1])) << 1 |
         every_third_bit(static_cast<std::uint64_t>(cell[2])) << 2;
}
/// Its upper 36 bits.
constexpr std::uint64_t coarse_curve_key(const CurveCell& cell) {
  return every_third_bit_of_12(static_cast<std::uint64_t>(cell[0] >> 9)) |
         every_third_bit_of_12(static_cast<std::uint64_t>(cell[1] >> 9)) << 1 |
         every_third_bit_of_12(static_cast<std::uint64_t>(cell[2] >> 9)) << 2;
}

/// The numbers below `count` along the curve by the cells they are in, of those in one the lower
/// number first. cell_of(number) may be asked for again, by several threads at once. Cost: linear
/// as long as most differ in the upper 36 bits of their keys (32 beyond 2^28 numbers), n log n
/// else.
template <class CellOf>
std::vector<Index> sorted_along_curve(std::size_t count, int threads, CellOf cell_of) {
  // The upper bits of the key and the number in one word, sorted in four passes by 9 bits, or where
  // there are fewer words than digits, by comparing.
  constexpr int digit = 9, passes = 4;
  const int key_bits = count <= std::size_t{1} << 28 ? 36 : 32;
  const int shift = 64 - key_bits;
  const std::uint64_t number = (std::uint64_t{1} << shift) - 1;
  const auto place = [&](std::uint64_t word, int pass) {
    return (word >> shift >> (digit * pass)) & ((1 << digit) - 1);
  };
  Unfilled<std::uint64_t> words(count), other(count);
  // Of each block, how many words have a digit, and then where the next of them goes. One thread
  // takes all as one block, of which a pass does not change how many words have which digits.
  using Digits = std::array<Index, 1 << digit>;
  const std::size_t block =
      threads_for(threads) == 1 ? std::max<std::size_t>(count, 1) : building_block;
  std::vector<Digits> at(std::max<std::size_t>((count + block - 1) / block, 1));
  std::array<Digits, passes> of_all{};
  const bool in_one = at.size() == 1, few = count < std::size_t{1} << digit;
  const auto over = [&](const auto& work) { for_blocks(count, block, threads, {}, work); };
  over([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      words[i] = coarse_curve_key(cell_of(i)) >> (36 - key_bits) << shift | i;
      if (in_one && !few)
        for (int pass = 0; pass < passes; ++pass)
          ++of_all[static_cast<std::size_t>(pass)][place(words[i], pass)];
    }
  });
  if (few) std::sort(words.begin(), words.end());
  for (int pass = 0; pass < passes && !few; ++pass) {
    if (in_one)
      at[0] = of_all[static_cast<std::size_t>(pass)];
    else
      over([&](std::size_t first, std::size_t last) {
        auto& own = at[first / block];
        own.fill(0);
        for (std::size_t i = first; i < last; ++i) ++own[place(words[i], pass)];
      });
    Index sum = 0;
    bool alike = false;
    for (std::size_t d = 0; d < at[0].size(); ++d) {
      const Index before = sum;
      for (Digits& own : at) sum += std::exchange(own[d], sum);
      alike = alike || sum - before == count;
    }
    if (alike) continue;
    over([&](std::size_t first, std::size_t last) {
      auto& own = at[first / block];
      for (std::size_t i = first; i < last; ++i) other[own[place(words[i], pass)]++] = words[i];
    });
    words.swap(other);
  }
  Unfilled<std::uint64_t>().swap(other);
  std::vector<Index> order(count);
  over_blocks(count, threads, [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<std::uint64_t, Index>> run;
    const auto key = [&](std::size_t i) { return words[i] >> shift; };
    std::size_t i = first;  // a run is the block's that it begins in
    while (i > 0 && i < last && key(i) == key(i - 1)) ++i;
    for (std::size_t end = i; i < last; i = end) {
      for (end = i + 1; end < count && key(end) == key(i);) ++end;
      if (end == i + 1) {
        order[i] = static_cast<Index>(words[i] & number);
        continue;
      }
      run.clear();  // by the rest of the key
      for (std::size_t k = i; k < end; ++k) {
        const Index one = static_cast<Index>(words[k] & number);
        run.emplace_back(curve_key(cell_of(one)), one);
      }
      std::sort(run.begin(), run.end());
      for (std::size_t k = i; k < end; ++k) order[k] = run[k - i].second;
    }
  });
  return order;
}

/// Simplices (points, if N is 1) along a space-filling (Morton) curve through their centroids.
/// Positions are finite; those of no simplex do not matter. Cost: that of sorted_along_curve.
template <std::size_t N>
std::vector<Index> along_curve(std::span<const std::array<double, 3>> positions,
                               std::span<const std::array<Index, N>> simplices, int threads = 1) {
  std::vector<char> used(positions.size(), 0);
  over_blocks(simplices.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s)
      for (const Index v : simplices[s]) set_mark(used[v]);
  });
  Box3 box;
  gather_blocks<Box3>(
      positions.size(), threads,
      [&](std::size_t first, std::size_t last, Box3& own) {
        for (std::size_t v = first; v < last; ++v)
          if (used[v] != 0) own.take(positions[v]);
      },
      [&](const Box3& own) { box.take(own); });
  std::vector<char>().swap(used);
  // Divided first, and halves: no overflow near 1e308.
  constexpr double cells = 2097151;  // 21 bits
  constexpr double share = N > 1 ? N : 2;
  double width = 0;
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, box.high[d] / 2 - box.low[d] / 2);
  const double scale = width > 0 ? share / N * 0.5 * cells / width : 0;
  for (double& x : box.low) x /= share;
  Unfilled<std::array<double, 3>> parts(positions.size());  // of a centroid, in cells
  over_blocks(positions.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (std::size_t d = 0; d < 3; ++d)
        parts[v][d] = (positions[v][d] / share - box.low[d]) * scale;
  });
  return sorted_along_curve(simplices.size(), threads, [&](std::size_t s) {
    CurveCell cell;
    for (std::size_t d = 0; d < 3; ++d) {
      double centre = 0;
      for (const Index v : simplices[s]) centre += parts[v][d];
      centre = centre < cells ? centre : cells;
      cell[d] = static_cast<std::int64_t>(centre > 0 ? centre : 0.0);
    }
    return cell;
  });
}

/// Simplices by component and, in each, breadth first. across[s][i] is N t + j, side j of the
/// simplex t that side i of s is glued to, or none.
template <std::size_t N>
std::vector<Index> breadth_first(std::span<const std::array<Index, N>> across) {
  std::vector<Index> order;
  order.reserve(across.size());
  std::vector<char> seen(across.size(), 0);
  for (Index seed = 0; seed < across.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    std::size_t head = order.size();
    order.push_back(seed);
    while (head < order.size())
      for (const Index side : across[order[head++]]) {
        const Index other = side / static_cast<Index>(N);
        if (side == none || seen[other]) continue;
        seen[other] = 1;
        order.push_back(other);
      }
  }
  return order;
}

}  // namespace plexway::detail
