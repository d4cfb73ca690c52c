#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <variant>

#include <plexway/error.hpp>

#include "any/info/info_report.hpp"
#include "any/info/report.hpp"
#include "cli/commands/commands.hpp"
#include "cli/options/input.hpp"
#include "cli/report/console.hpp"
#include "cli/report/info_devices.hpp"
#include "cli/report/progress.hpp"

namespace plexway::cli {
namespace {

struct InfoCommand {
  std::string input;
  std::string as;
  FillArguments fill;
  CloudPreparation cloud;
  PieceArguments pieces;
  bool devices = false;
  bool json = false;
  bool quiet = false;
};

void run_info(const InfoCommand& command) {
  if (command.devices) {
    if (!command.input.empty()) throw UsageError("--devices takes no INPUT");
    const InfoReport devices = info_of_devices();
    write_output(command.json ? json_text(devices.json) : devices.table.text());
    flush_output();
    return;
  }
  if (command.input.empty()) throw UsageError("INPUT is required; try 'plexway info --help'");
  ProgressLine progress(command.quiet);
  const Domain domain =
      load_domain(command.input, command.as, command.fill, command.cloud, progress, command.pieces);
  progress.phase("measuring");
  const InfoReport report =
      std::visit([&](const auto& shape) { return info_of(domain, shape); }, domain.data());
  progress.clear();
  Json json = {{"input", domain.file().string()}, {"kind", domain.kind_name()}};
  json.update(report.json);
  Table table;
  table.add("input", domain.file().string());
  table.add(report.table);
  write_output(command.json ? json_text(json) : table.text());
  flush_output();
}

}  // namespace

void add_info_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App& app = *tool.add_subcommand("info", "What a domain is made of, and what may surprise");
  app.add_option("INPUT", command->input, input_help)->type_name("FILE");
  add_piece_options(app, command->pieces);
  app.add_option("--as", command->as, as_help)->type_name("KIND");
  app.add_flag("--devices", command->devices, "list executors and devices instead");
  app.add_flag("--json", command->json, "print one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no progress");
  add_fill_options(app, command->fill);
  add_cloud_options(app, command->cloud);
  app.footer(
      "Examples:\n"
      "  plexway info knot.ply\n"
      "  plexway info knot.ply --json\n"
      "  plexway info cavity.ele\n"
      "  plexway info vessels.obj\n"
      "  plexway info scan.ply --k 20\n"
      "  plexway info --devices");
  app.callback([command, &action] { action = [command] { run_info(*command); }; });
}

}  // namespace plexway::cli
