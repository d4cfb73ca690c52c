#pragma once

#include <cstddef>
#include <optional>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>

#include "shape/info/rank_counts.hpp"
#include "shape/info/report.hpp"

namespace plexway::cli {

/// What came of a solve, as 'plexway distance' tells it, whoever had the domain.
struct DistanceReport {
  std::size_t vertices = 0, reached = 0;
  Index farthest = none;
  double max_distance = 0;
  std::optional<double> mean_distance;
  PropagateStatistics statistics;
  std::size_t ranks = 0;  ///< 0: a process alone
  RankCounts counts = {};
  bool of_surface = false;  ///< where vertices may be raised and lowered
};

///@{
/// How far it got, the work (in the table if it is verbose), and of ranks what they sent.
void add_report(const DistanceReport& report, Json& json);
void add_report(const DistanceReport& report, Table& table, bool verbose);
///@}

}  // namespace plexway::cli
