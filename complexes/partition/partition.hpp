#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// A domain's simplices in compact parts of about one size. Depends on the domain alone.
struct Partition {
  std::vector<Index> piece_of;  ///< of each simplex
  Index pieces = 0;             ///< none of them empty
};

/// By bisection: the points (one a simplex, finite) are halved where they reach farthest, and
/// again. Linear in them times the logarithm of the number of pieces.
[[nodiscard]] Partition bisected(std::span<const std::array<float, 3>> points, std::size_t size);

/// Without points: pieces grow breadth first, each from where the last one stopped, so that crumbs
/// are left. neighbours(s, visit) calls visit(t) for each simplex over a hinge of s.
template <class Neighbours>
[[nodiscard]] Partition grown(std::size_t count, std::size_t size, const Neighbours& neighbours) {
  Partition found;
  found.piece_of.assign(count, none);
  std::vector<Index> line;
  std::size_t lowest = 0;
  Index start = none;
  for (std::size_t left = count; left > 0;) {
    if (start == none) {
      while (found.piece_of[lowest] != none) ++lowest;
      start = static_cast<Index>(lowest);
    }
    const Index piece = found.pieces++;
    line.assign(1, start);
    found.piece_of[start] = piece;
    for (std::size_t i = 0; i < line.size() && line.size() < size; ++i)
      neighbours(line[i], [&](Index t) {
        if (found.piece_of[t] != none || line.size() == size) return;
        found.piece_of[t] = piece;
        line.push_back(t);
      });
    left -= line.size();
    start = none;
    for (auto s = line.rbegin(); s != line.rend() && start == none; ++s)
      neighbours(*s, [&](Index t) {
        if (start == none && found.piece_of[t] == none) start = t;
      });
  }
  return found;
}

/// Numbers pieces anew without those that are empty.
void leave_out_empty(Partition& partition);

/// Simplices go to the piece that most of their neighbours are in, where that is more than are in
/// their own: cuts get shorter. A few sweeps in the order of numbers.
template <class Neighbours>
void smooth_cuts(Partition& partition, const Neighbours& neighbours) {
  std::vector<Index>& piece_of = partition.piece_of;
  std::vector<Index> at_cut;
  for (Index s = 0; s < piece_of.size(); ++s) {
    bool cut = false;
    neighbours(s, [&](Index t) { cut |= piece_of[t] != piece_of[s]; });
    if (cut) at_cut.push_back(s);
  }
  constexpr int sweeps = 4;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool any = false;
    for (const Index s : at_cut) {
      constexpr std::size_t most = 8;  // of several on one hinge the first count
      std::array<std::pair<Index, int>, most> votes;
      std::size_t parties = 0;
      int own = 0;
      neighbours(s, [&](Index t) {
        const Index p = piece_of[t];
        if (p == piece_of[s]) {
          ++own;
          return;
        }
        std::size_t i = 0;
        while (i < parties && votes[i].first != p) ++i;
        if (i < parties)
          ++votes[i].second;
        else if (parties < most)
          votes[parties++] = {p, 1};
      });
      const auto best =
          std::max_element(votes.begin(), votes.begin() + static_cast<std::ptrdiff_t>(parties),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
      if (parties > 0 && best->second > own) piece_of[s] = best->first, any = true;
    }
    if (!any) break;
  }
}

/// Pieces of fewer than `least` simplices join the neighbour that they share most hinges with.
template <class Neighbours>
void join_crumbs(Partition& partition, std::size_t least, const Neighbours& neighbours) {
  std::vector<std::size_t> sizes(partition.pieces);
  for (const Index p : partition.piece_of) ++sizes[p];
  std::vector<Index> into(partition.pieces);
  std::iota(into.begin(), into.end(), Index{0});
  const auto root = [&](Index p) {
    while (into[p] != p) p = into[p] = into[into[p]];
    return p;
  };
  std::vector<std::pair<Index, Index>> shared;  // a small piece and one beside it, a hinge each
  for (Index s = 0; s < partition.piece_of.size(); ++s)
    if (const Index p = partition.piece_of[s]; sizes[p] < least)
      neighbours(s, [&](Index t) {
        if (partition.piece_of[t] != p) shared.push_back({p, partition.piece_of[t]});
      });
  std::sort(shared.begin(), shared.end());
  for (std::size_t i = 0; i < shared.size();) {
    const Index p = shared[i].first;
    Index best = none;
    std::size_t most = 0;
    while (i < shared.size() && shared[i].first == p) {
      const std::size_t begin = i;
      while (i < shared.size() && shared[i] == shared[begin]) ++i;
      if (i - begin > most) most = i - begin, best = shared[begin].second;
    }
    into[root(p)] = root(best);
  }
  for (Index& p : partition.piece_of) p = root(p);
}

/// Pieces of about `size` simplices, by a point each, or where there are none by neighbours alone.
template <class Neighbours>
[[nodiscard]] Partition partition(std::size_t count, std::size_t size,
                                  std::span<const std::array<float, 3>> points,
                                  const Neighbours& neighbours) {
  Partition found = points.empty() ? grown(count, size, neighbours) : bisected(points, size);
  smooth_cuts(found, neighbours);
  join_crumbs(found, size / 4, neighbours);
  leave_out_empty(found);
  return found;
}

}  // namespace plexway::detail
