#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "shape/info/report.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/options/solve_options.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct PrepareCommand : InputCommand {
  std::string out;
  std::string precision = "float";
  TriangulationArgument triangulation;
  int threads = 0;
};

void run_prepare(const PrepareCommand& command) {
  constexpr std::array<std::string_view, 1> extensions = {".plexway"};
  check_output_name(command.out, command.input, extensions);
  SolveOptions precision;
  precision.precision = command.precision;
  BuildOptions options{.precision = precision_of(precision),
                       .triangulation = triangulation_of(command.triangulation),
                       .threads = command.threads};
  ProgressLine progress(command.quiet);
  const Domain shape = load_domain(command, progress);
  check_triangulation(options.triangulation, shape);
  progress.phase("building");
  options.progress = progress.share_callback();
  const AnyDomain domain(shape, options);
  progress.phase("writing " + command.out);
  domain.keep(command.out);
  progress.clear();
  std::error_code unknown;  // a pipe has no size
  std::uintmax_t bytes = std::filesystem::file_size(command.out, unknown);
  if (unknown) bytes = 0;
  Summary summary(command.input, shape.kind_name());
  summary.json["out"] = command.out;
  summary.json["vertices"] = domain.vertices();
  summary.json["simplices"] = domain.simplices();
  summary.json["precision"] = command.precision;
  summary.table.add(std::string(kind_noun(domain.kind())),
                    size_text(shape, domain.simplices()) + ", " + command.precision);
  if (domain.kind() == DomainKind::surface) {
    summary.json["triangulation"] = name_of(domain.triangulation().done);
    summary.table.add("triangles", describe(domain.triangulation()));
  }
  summary.add("bytes", bytes, counted(bytes, "bytes"));
  summary.took("load", shape.load_seconds());
  summary.took("build", domain.build_seconds());
  summary.print(command, {command.out});
}

}  // namespace

void add_prepare_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<PrepareCommand>();
  CLI::App& app = *tool.add_subcommand(
      "prepare", "Builds a domain once and keeps it in a file that opens at once");
  const OptionGroup add(app);
  add_input(app, *command);
  add("--out,-o", command->out, "FILE",
      "write NAME.plexway, an INPUT for every command: for this version of plexway and\n"
      "machines of this byte order. A command that asks for another precision or\n"
      "triangulation than what was prepared builds anew, from the file alone")
      ->required();
  add("--precision", command->precision, "NAME", "float (default) or double");
  add_triangulation_option(app, command->triangulation);
  add("--threads", command->threads, "N", "that build it (default: all cores)")
      ->check(CLI::Range(1, 1024));
  add_input_options(app, *command);
  app.footer(
      "Examples:\n"
      "  plexway prepare scan.ply --out scan.plexway\n"
      "  plexway distance scan.plexway --source vertex:0 --out distance.ply\n"
      "  plexway prepare organ.off --as solid --max-volume 1e-3 --out organ.plexway");
  app.callback([command, &action] { action = [command] { run_prepare(*command); }; });
}

}  // namespace plexway::detail::cli
