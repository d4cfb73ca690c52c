#include "cli/options/input.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>

namespace plexway::cli {

void add_piece_options(CLI::App& command, PieceArguments& pieces) {
  command.add_option("MORE", pieces.more, "further files: parts of one mixed domain, with --weld")
      ->type_name("FILE");
  command
      .add_option("--weld", pieces.weld,
                  "vertices of several files are one where they are this close (0: at one place)")
      ->type_name("TOLERANCE");
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

ReadOptions read_options(const std::string& as, const FillArguments& fill,
                         const CloudPreparation& cloud, ProgressLine& progress) {
  ReadOptions options;
  options.spelling = Spelling::flags;
  if (!as.empty()) {
    options.as = kind_named(as);
    if (!options.as || *options.as == DomainKind::simplices)
      throw UsageError("--as " + as +
                       ": no such kind; the kinds are surface, solid, cloud, wireframe, mixed");
  }
  options.fill = filling(fill);
  options.volume = fill.volume;
  options.cloud = cloud;
  options.progress = read_progress(progress);
  return options;
}

Domain load_domain(const std::string& file, const std::string& as, const FillArguments& fill,
                   const CloudPreparation& cloud, ProgressLine& progress,
                   const PieceArguments& pieces) {
  const ReadOptions options = read_options(as, fill, cloud, progress);
  if (pieces.more.empty() && !pieces.weld) return Domain::read(file, options);
  if (pieces.more.empty()) throw UsageError("--weld needs several files");
  if (!pieces.weld)
    throw UsageError(pieces.more.front() +
                     ": a second INPUT needs --weld TOLERANCE, which of their vertices are one; "
                     "try 'plexway distance --help'");
  std::vector<std::filesystem::path> files = {file};
  files.insert(files.end(), pieces.more.begin(), pieces.more.end());
  return Domain::read(files, *pieces.weld, options);
}

}  // namespace plexway::cli
