#include "tool/report/distance_report.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace plexway::cli {

void add_report(const DistanceReport& report, Json& json) {
  const PropagateStatistics& statistics = report.statistics;
  json["reached"] = report.reached;
  json["unreached"] = report.vertices - report.reached;
  json["max_distance"] = json_number(report.max_distance);
  json["farthest"] = report.reached > 0 ? Json(report.farthest) : Json(nullptr);
  if (report.mean_distance) json["mean_distance"] = json_number(*report.mean_distance);
  json["expansions"] = statistics.expansions;
  json["updates"] = statistics.updates;
  if (statistics.supersteps > 0) {
    json["supersteps"] = statistics.supersteps;
    json["letters"] = statistics.letters;
    json["letter_bytes"] = statistics.letter_bytes;
  }
  if (report.ranks > 0) {
    json["ranks"] = report.ranks;
    json["sent_bytes"] = report.counts.sent_bytes;
    json["peak_bytes"] = report.counts.peak_bytes;
  }
  if (report.of_surface) {
    json["lowered_vertices"] = statistics.lowered_vertices;
    json["raised_vertices"] = statistics.raised_vertices;
  }
}

void add_report(const DistanceReport& report, Table& table, bool verbose) {
  const PropagateStatistics& statistics = report.statistics;
  std::string reached =
      std::to_string(report.reached) + " of " + counted(report.vertices, "vertices");
  if (report.reached > 0)
    reached += "; the farthest is vertex " + std::to_string(report.farthest) + " at " +
               short_number(report.max_distance);
  if (report.reached > 0 && report.mean_distance)
    reached += ", the mean " + short_number(*report.mean_distance);
  table.add("reached", reached);
  if (verbose)
    table.add("work", counted(statistics.expansions, "expansions") + ", " +
                          counted(statistics.updates, "updates"));
  if (report.ranks == 0) return;
  std::uint64_t most = 0;
  for (const std::uint64_t bytes : report.counts.peak_bytes) most = std::max(most, bytes);
  table.add("ranks",
            std::to_string(report.ranks) + ", " + counted(statistics.supersteps, "supersteps") +
                ", " + counted(statistics.letters, "letters") + ", " +
                counted(report.counts.sent_bytes, "bytes") + " from rank to rank, at most " +
                std::to_string((most + 500'000) / 1'000'000) + " MB in one");
}

}  // namespace plexway::cli
