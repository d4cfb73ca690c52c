#include "cli/commands/sampling_command.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help) {
  app.add_option("INPUT", command.input, "a surface, a solid or a cloud, as for 'plexway distance'")
      ->type_name("FILE")
      ->required();
  app.add_option("--out,-o", command.out, out_help)->type_name("FILE");
  app.add_option("--as", command.as, as_help)->type_name("KIND");
  app.add_option("--precision", command.precision, "float (default) or double")
      ->each([&command](const std::string&) { command.precision_given = true; })
      ->type_name("NAME");
  app.add_flag("--json", command.json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command.quiet, "no summary or progress; errors stay");
  add_fill_options(app, command.fill);
  add_cloud_options(app, command.cloud);
}

Precision precision_of(const SamplingCommand& command) {
  SolveOptions options;
  options.precision = command.precision;
  options.precision_given = command.precision_given;
  options.accuracy = command.accuracy;
  return precision_of(options);
}

PointSummary::PointSummary(const SamplingCommand& command, const Domain& domain,
                           std::size_t points) {
  json["input"] = command.input;
  json["kind"] = domain.kind_name();
  json["points"] = points;
  table.add("input", command.input);
  table.add("points", counted(points, "points"));
}

void PointSummary::finish(const SamplingCommand& command, const PropagateStatistics& work,
                          double seconds) {
  json["expansions"] = work.expansions;
  json["seconds"] = seconds;
  table.add("work", counted(work.expansions, "expansions"));
  table.add("time", short_time(seconds));
  add_written(table, {command.out, command.picture.file});
  print_summary(command, json, table);
}

void print_summary(const SamplingCommand& command, const Json& json, const Table& table) {
  if (command.json)
    write_output(json_text(json));
  else if (!command.quiet)
    write_output(table.text());
  flush_output();
}

}  // namespace plexway::cli
