#include "sampling_command.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help) {
  app.add_option("INPUT", command.input, "a surface or a solid, as for 'plexway distance'")
      ->type_name("FILE")
      ->required();
  app.add_option("--out,-o", command.out, out_help)->type_name("FILE");
  app.add_option("--as", command.as, as_help)->type_name("KIND");
  app.add_option("--precision", command.precision, "float (default) or double")->type_name("NAME");
  app.add_flag("--json", command.json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command.quiet, "no summary or progress; errors stay");
  add_fill_options(app, command.fill);
  add_picture_options(app, command.picture);
}

Precision precision_of(const SamplingCommand& command) {
  SolveOptions options;
  options.precision = command.precision;
  return precision_of(options);
}

void print_summary(const SamplingCommand& command, const Json& json, const Table& table) {
  if (command.json)
    write_output(json_text(json));
  else if (!command.quiet)
    write_output(table.text());
  flush_output();
}

}  // namespace plexway::cli
