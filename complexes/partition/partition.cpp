#include "complexes/partition/partition.hpp"

#include <limits>

namespace plexway::detail {
namespace {

// So many simplices that follow each other stay together until cuts are smoothed: domains number
// theirs along a curve.
constexpr std::size_t run_length = 2;

struct Place {
  std::array<float, 3> at;
  Index run;
};

void halve(std::span<Place> places, Index first, Index pieces, std::vector<Index>& piece_of) {
  if (pieces == 1) {
    for (const Place& place : places) piece_of[place.run] = first;
    return;
  }
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (const Place& place : places)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], place.at[i]);
      high[i] = std::max(high[i], place.at[i]);
    }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  const Index below = pieces / 2;
  const std::size_t middle = places.size() * below / pieces;
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(middle),
                   places.end(), [axis](const Place& a, const Place& b) {
                     return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.run < b.run;
                   });
  halve(places.first(middle), first, below, piece_of);
  halve(places.subspan(middle), first + below, pieces - below, piece_of);
}

}  // namespace

Partition bisected(std::span<const std::array<float, 3>> points, std::size_t size) {
  std::vector<Place> places((points.size() + run_length - 1) / run_length);
  for (std::size_t r = 0; r < places.size(); ++r) {
    const std::size_t begin = r * run_length, end = std::min(begin + run_length, points.size());
    places[r] = {{0, 0, 0}, static_cast<Index>(r)};
    for (std::size_t s = begin; s < end; ++s)
      for (std::size_t i = 0; i < 3; ++i)
        places[r].at[i] += points[s][i] / static_cast<float>(end - begin);
  }
  std::vector<Index> piece_of(places.size());
  Partition found;
  found.pieces = static_cast<Index>(
      std::clamp<std::size_t>((points.size() + size / 2) / size, 1, places.size()));
  halve(places, 0, found.pieces, piece_of);
  found.piece_of.resize(points.size());
  for (std::size_t s = 0; s < points.size(); ++s) found.piece_of[s] = piece_of[s / run_length];
  return found;
}

void leave_out_empty(Partition& partition) {
  std::vector<Index> number(partition.pieces, none);
  for (const Index p : partition.piece_of) number[p] = 0;
  Index count = 0;
  for (Index& n : number)
    if (n != none) n = count++;
  for (Index& p : partition.piece_of) p = number[p];
  partition.pieces = count;
}

}  // namespace plexway::detail
