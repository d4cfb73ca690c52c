#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "shape/info/info_report.hpp"
#include "shape/info/report.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/report/console.hpp"

namespace plexway::detail::cli {
namespace {

struct InfoCommand : InputCommand {
  bool devices = false;
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
  const Domain domain = load_domain(command, progress);
  progress.phase("measuring");
  const InfoReport report =
      std::visit([&](const auto& shape) { return info_of(domain, shape); }, domain.data());
  progress.clear();
  Json json = {{"input", domain.file().string()}, {"kind", domain.kind_name()}};
  Table table;
  table.add("input", domain.file().string());
  add_file_report(domain, json, table);
  json.update(report.json);
  table.add(report.table);
  std::vector<std::string> warnings = report.warnings;
  for (const std::string& note : domain.report().notes) warnings.push_back(note);
  for (const std::string& warning : warnings) table.add("note", warning);
  json["warnings"] = warnings;
  write_output(command.json ? json_text(json) : table.text());
  flush_output();
}

}  // namespace

void add_info_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App& app = *tool.add_subcommand("info", "What a domain is made of, and possible problems");
  add_inputs(app, *command);
  app.get_option("INPUT")->required(false);
  app.add_flag("--devices", command->devices, "list executors and devices instead");
  add_input_options(app, *command, "no progress");
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

}  // namespace plexway::detail::cli
