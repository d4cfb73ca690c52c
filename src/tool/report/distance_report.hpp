#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>

#include "io/output_place.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"

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

using io::check_output_name;
using io::check_output_place;
using io::check_outputs_differ;
using io::on_standard_output;

/// What a command says at its end: on standard output, but on standard error where one of its
/// results went there. JSON or a table, or nothing where `quiet`. Throws as write_output.
void print_report(const Json& json, const Table& table, bool as_json, bool quiet,
                  std::initializer_list<std::string> files);

/// CSV on standard output: `vertex,distance`, and `,label`, `,original` and `,error` where there
/// are such. Throws as write_output.
void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error);

}  // namespace plexway::cli
