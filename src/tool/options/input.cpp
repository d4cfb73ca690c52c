#include "tool/options/input.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

#include <plexway/error.hpp>
#include <plexway/io/formats.hpp>

namespace plexway::cli {

std::string input_help() {
  // Lines of help are this wide.
  constexpr std::size_t width = 84;
  std::string text;
  const auto add = [&](DomainKind kind, const std::string& what) {
    std::string line = what + ":";
    const std::string names = io::extensions_of(kind);
    for (std::size_t from = 0; from < names.size();) {
      const std::size_t end = std::min(names.find(' ', from), names.size());
      if (line.size() + end - from + 1 > width) text += line + "\n", line = "  ";
      line += " " + names.substr(from, end - from);
      from = end + 1;
    }
    text += line + "\n";
  };
  add(DomainKind::surface, "a surface");
  add(DomainKind::solid, "a solid (.poly .smesh through TetGen, a level set .vdb through OpenVDB)");
  add(DomainKind::wireframe, "a wireframe");
  add(DomainKind::cloud, "a cloud of points (.pcd through PCL)");
  add(DomainKind::simplices, "simplices of dimension 1 to 4");
  return text +
         "what may hold several is what has most dimensions; a file of another name is known by\n"
         "its first bytes, and any may be packed (.gz); .plexway: see 'plexway prepare'";
}

void add_input(CLI::App& app, InputCommand& command, const std::string& help) {
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

void add_verbose_option(CLI::App& app, InputCommand& command) {
  app.add_flag("--verbose", command.verbose, "the summary also counts the work that was done");
}

void add_input_options(CLI::App& app, InputCommand& command, const char* quiet) {
  app.add_option("--as", command.as, as_help)->type_name("KIND");
  app.add_flag("--strict", command.strict,
               "refuse a file of which something is left out, guessed or repaired, such as a face\n"
               "with a corner twice");
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
  options.strict = command.strict;
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
