#include "tool/report/summary.hpp"

#include <algorithm>
#include <cstdint>

#include "tool/report/console.hpp"

namespace plexway::detail::cli {
void Notes::say(bool quiet) const {
  if (quiet) return;
  for (const std::string& text : texts_) say_note(text);
}

Summary::Summary(const std::string& input, std::string_view kind) {
  add("input", input, input);
  json["kind"] = kind;
}

void Summary::took(const std::string& part, double seconds) {
  json["seconds"][part] = seconds;
  time_ += (time_.empty() ? "" : ", ") + part + " " + short_time(seconds);
}

void Summary::took_loading(const Domain& domain) {
  took("load", domain.load_seconds());
  if (domain.mesh_seconds()) took("mesh", *domain.mesh_seconds());
  if (domain.neighbour_seconds()) took("neighbours", *domain.neighbour_seconds());
}

void Summary::print(const InputCommand& command, const std::vector<std::string>& files,
                    const Notes& notes) {
  if (!time_.empty()) table.add("time", time_);
  add_written(table, files);
  notes.tell(json);
  std::string text;
  if (command.json)
    text = json_text(json);
  else if (!command.quiet)
    text = table.text();
  if (std::any_of(files.begin(), files.end(), on_standard_output))
    write_diagnostics(text);
  else
    write_output(text);
  flush_output();
}

std::string size_text(const Domain& domain, std::size_t simplices) {
  return counted(domain.vertices(), "vertices") + ", " + counted(simplices, domain.simplex_name());
}

void DistanceReport::add_to(Summary& summary, bool verbose) const {
  Json& json = summary.json;
  json["reached"] = reached;
  json["unreached"] = vertices - reached;
  json["max_distance"] = json_number(max_distance);
  json["farthest"] = reached > 0 ? Json(farthest) : Json(nullptr);
  if (mean_distance) json["mean_distance"] = json_number(*mean_distance);
  json["expansions"] = statistics.expansions;
  json["updates"] = statistics.updates;
  if (statistics.supersteps > 0) {
    json["supersteps"] = statistics.supersteps;
    json["messages"] = statistics.messages;
    json["message_bytes"] = statistics.message_bytes;
  }
  if (ranks > 0) {
    json["ranks"] = ranks;
    json["sent_bytes"] = counts.sent_bytes;
    json["peak_bytes"] = counts.peak_bytes;
  }
  if (of_surface) {
    json["lowered_vertices"] = statistics.lowered_vertices;
    json["raised_vertices"] = statistics.raised_vertices;
  }
  std::string text = std::to_string(reached) + " of " + counted(vertices, "vertices");
  if (reached > 0)
    text += "; the farthest is vertex " + std::to_string(farthest) + " at " +
            short_number(max_distance);
  if (reached > 0 && mean_distance) text += ", the mean " + short_number(*mean_distance);
  summary.table.add("reached", text);
  if (verbose)
    summary.table.add("work", counted(statistics.expansions, "expansions") + ", " +
                                  counted(statistics.updates, "updates"));
  if (ranks == 0) return;
  std::uint64_t most = 0;
  for (const std::uint64_t bytes : counts.peak_bytes) most = std::max(most, bytes);
  summary.table.add(
      "ranks", std::to_string(ranks) + ", " + counted(statistics.supersteps, "supersteps") + ", " +
                   counted(statistics.messages, "messages") + ", " +
                   counted(counts.sent_bytes, "bytes") + " from rank to rank, at most " +
                   std::to_string((most + 500'000) / 1'000'000) + " MB in one");
}

}  // namespace plexway::detail::cli
