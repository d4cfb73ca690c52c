#include "cli/options/input.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>

namespace plexway::cli {

void add_input(CLI::App& app, InputCommand& command, const char* help) {
  app.add_option("INPUT", command.input, help)->type_name("FILE")->required();
}

void add_inputs(CLI::App& app, InputCommand& command) {
  add_input(app, command);
  app.add_option("MORE", command.more, "further files: parts of one mixed domain, with --weld")
      ->type_name("FILE");
  app.add_option("--weld", command.weld,
                 "vertices of several files are one where they are this close (0: at one place)")
      ->type_name("TOLERANCE");
}

void add_report_options(CLI::App& app, InputCommand& command, const char* quiet) {
  app.add_flag("--json", command.json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command.quiet, quiet);
}

void add_input_options(CLI::App& app, InputCommand& command, const char* quiet) {
  app.add_option("--as", command.as, as_help)->type_name("KIND");
  add_report_options(app, command, quiet);
  add_fill_options(app, command.fill);
  add_cloud_options(app, command.cloud);
}

ReadProgress read_progress(ProgressLine& progress) {
  return {.stage = [&](std::string_view what) { progress.phase(what); },
          .share = progress.share_callback(),
          .seconds =
              [&](double seconds) {
                progress.seconds_passed(seconds);
                return true;
              },
          .note = [&](std::string_view text) { progress.note(text); }};
}

ReadOptions read_options(const InputCommand& command, ProgressLine& progress) {
  ReadOptions options;
  options.spelling = Spelling::flags;
  if (!command.as.empty()) {
    options.as = kind_named(command.as);
    if (!options.as)
      throw UsageError("--as " + command.as +
                       ": no such kind; the kinds are surface, solid, cloud, wireframe, simplices, "
                       "mixed");
  }
  options.fill = filling(command.fill);
  options.volume = command.fill.volume;
  options.cloud = command.cloud;
  options.progress = read_progress(progress);
  return options;
}

Domain load_domain(const InputCommand& command, ProgressLine& progress) {
  const ReadOptions options = read_options(command, progress);
  if (command.more.empty() && !command.weld) return Domain::read(command.input, options);
  if (command.more.empty()) throw UsageError("--weld needs several files");
  if (!command.weld)
    throw UsageError(command.more.front() +
                     ": a second INPUT needs --weld TOLERANCE, which of their vertices are one; "
                     "try 'plexway distance --help'");
  std::vector<std::filesystem::path> files = {command.input};
  files.insert(files.end(), command.more.begin(), command.more.end());
  return Domain::read(files, *command.weld, options);
}

}  // namespace plexway::cli
