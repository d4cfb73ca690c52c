#include "complexes/cloud/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <plexway/error.hpp>

namespace plexway::detail {

void check(std::span<const std::array<double, 3>> points, const Neighbours& neighbours) {
  check(neighbours);
  if (neighbours.point_count() != points.size())
    throw InputError("neighbour lists for " + std::to_string(neighbours.point_count()) +
                     " points, but there are " + std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : points[i])
      if (!std::isfinite(x))
        throw InputError("point " + std::to_string(i) + ": a coordinate is not finite");
}

void Neighbourhood::set_neighbours(std::span<const std::array<double, 3>> points,
                                   const Neighbours& neighbours, Index centre) {
  const auto around = neighbours.around(centre);
  members_.assign(around.begin(), around.end());
  place(points, centre);
}

void Neighbourhood::set_two_rings(std::span<const std::array<double, 3>> points,
                                  const Neighbours& neighbours, Index centre) {
  if (neighbours.around(centre).size() >= enough) return set_neighbours(points, neighbours, centre);
  members_.clear();
  table_.fill(none);
  add(centre);
  for (const Index first : neighbours.around(centre)) add(first);
  const std::size_t ring = members_.size();
  for (std::size_t i = 1; i < ring; ++i)
    for (const Index second : neighbours.around(members_[i]))
      if (members_.size() < most) add(second);
  members_.erase(members_.begin());
  place(points, centre);
}

bool Neighbourhood::add(Index point) {
  std::size_t at = point % slots;
  for (; table_[at] != none; at = (at + 1) % slots)
    if (table_[at] == point) return false;
  table_[at] = point;
  members_.push_back(point);
  return true;
}

void Neighbourhood::keep_nearest(std::size_t count) {
  offset.resize(std::min(count, offset.size()));
  measure();
}

void Neighbourhood::place(std::span<const std::array<double, 3>> points, Index centre) {
  offset.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) offset[i][d] = points[members_[i]][d] - points[centre][d];
  measure();
}

void Neighbourhood::measure() {
  weight.resize(offset.size());
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    weight[i] =
        offset[i][0] * offset[i][0] + offset[i][1] * offset[i][1] + offset[i][2] * offset[i][2];
    largest = std::max(largest, weight[i]);
    sum += weight[i];
  }
  // The farthest still count a little: no neighbourhood hangs on fewer points than it has.
  for (double& w : weight) w = largest > 0 ? 1 - w / (1.2 * largest) : 1;
  radius = std::sqrt(largest);
  mean_square = offset.empty() ? 0 : sum / static_cast<double>(offset.size());
}

}  // namespace plexway::detail
