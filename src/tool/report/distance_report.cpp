#include "tool/report/distance_report.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>

#include "tool/report/console.hpp"

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
    json["messages"] = statistics.messages;
    json["message_bytes"] = statistics.message_bytes;
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
                ", " + counted(statistics.messages, "messages") + ", " +
                counted(report.counts.sent_bytes, "bytes") + " from rank to rank, at most " +
                std::to_string((most + 500'000) / 1'000'000) + " MB in one");
}

namespace {

template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

}  // namespace

void print_report(const Json& json, const Table& table, bool as_json, bool quiet,
                  std::initializer_list<std::string> files) {
  std::string text;
  if (as_json)
    text = json_text(json);
  else if (!quiet)
    text = table.text();
  if (std::any_of(files.begin(), files.end(), io::on_standard_output))
    write_diagnostics(text);
  else
    write_output(text);
  flush_output();
}

void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error) {
  std::string text = "vertex,distance";
  if (!label.empty()) text += ",label";
  if (!original.empty()) text += ",original";
  if (!error.empty()) text += ",error";
  text += '\n';
  for (std::size_t v = 0; v < distance.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distance[v]);
    if (!label.empty()) {
      text += ',';
      append(text, label[v]);
    }
    if (!original.empty()) {
      text += ',';
      append(text, original[v]);
    }
    if (!error.empty()) {
      text += ',';
      append(text, error[v]);
    }
    text += '\n';
    if (text.size() < (std::size_t{1} << 16)) continue;
    write_output(text);
    text.clear();
  }
  write_output(text);
  flush_output();
}

}  // namespace plexway::cli
