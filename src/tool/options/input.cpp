#include <algorithm>

#include <plexway/error.hpp>
#include <plexway/io/formats.hpp>

#include "shape/arguments/arguments.hpp"
#include "tool/options/input.hpp"

namespace plexway::detail::cli {
void add_cloud_options(CLI::App& command, CloudPreparation& options) {
  const OptionGroup add(command, "How to make a complex of points");
  add("--k", options.k, "K",
      "neighbours of each point (default 16); with --neighbour-radius at most so\n"
      "many, and without --k all within it")
      ->check(CLI::Range(1, 1000));
  add("--neighbour-radius", options.neighbour_radius, "R",
      "no neighbour is farther away (default: any)");
  add("--max-normal-angle", options.max_normal_angle, "DEGREES",
      "refuse neighbours whose normals differ by more degrees (default 60), such as\n"
      "those across a thin gap");
  add.flag("--denoise", options.denoise,
           "first drop points that lie alone, by the distance to their neighbours\n"
           "(through PCL)");
  add("--deviations", options.deviations, "X",
      "with --denoise: how many standard deviations above the mean are too many\n"
      "(default 3; fewer drop more)");
  add.flag("--smooth", options.smooth,
           "measure along a smooth surface near the points: noise makes paths longer");
}

void add_fill_options(CLI::App& command, FillArguments& options) {
  const OptionGroup add(command, "How to fill a surface with tetrahedra");
  add("--max-volume", options.max_volume, "V", "no tetrahedron is larger (default: any)");
  add("--quality", options.quality, "R",
      "bound on circumradius over shortest edge, above 1 (default 2); 0: none");
  add.flag("--keep-surface", options.keep_surface,
           "add points inside only: the triangles of the surface stay");
  add("--max-seconds", options.max_seconds, "S", "stop TetGen after S seconds (default: never)");
  add("--hole", options.hole_texts, "X,Y,Z", "a point in a cavity that stays empty; repeat it")
      ->allow_extra_args(false);
  add_volume_options(command, options.volume);
}

FillOptions filling(const FillArguments& arguments) {
  FillOptions options = arguments;
  for (const std::string& text : arguments.hole_texts) {
    const auto point = parse_point(text);
    if (!point) throw UsageError("--hole '" + text + "': write X,Y,Z");
    options.holes.push_back(*point);
  }
  ReadOptions all;
  all.fill = options;
  all.volume = arguments.volume;
  all.spelling = Spelling::flags;
  check(all);
  return options;
}

void add_volume_options(CLI::App& command, VolumeOptions& options) {
  const OptionGroup add(command, "Voxels");
  add.flag("--repair", options.repair,
           "take what a surface encloses, by a level set (OpenVDB): closes holes, and\n"
           "triangles may cross, overlap and look either way");
  add("--voxel", options.voxel, "SIZE",
      "side of a voxel, in the file's unit: for --repair (default: chosen), to cut a\n"
      ".vdb into tetrahedra (default: its own), for --out of a .vdb; a cloud is\n"
      "thinned first, to one point for each cube of this side (PCL)");
  add("--grid", options.grid, "NAME", "which level set of a .vdb (default: the only one)");
}

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
         "its first bytes; all but .3mf .drc .node .ele .poly .smesh .pcd .vdb may be packed\n"
         "(.gz); .plexway: see 'plexway prepare'";
}

void add_input(CLI::App& app, InputCommand& command, const std::string& help) {
  const OptionGroup add(app);
  add("INPUT", command.input, "FILE", help)->required();
}

void add_inputs(CLI::App& app, InputCommand& command) {
  const OptionGroup add(app);
  add_input(app, command);
  add("MORE", command.more, "FILE", "further files: parts of one mixed domain, with --weld");
  add("--weld", command.weld, "TOLERANCE",
      "vertices of several files are one where they are this close (0: at one place)");
}

void add_merge_option(CLI::App& app, InputCommand& command) {
  const OptionGroup add(app);
  add("--merge", command.merge, "TOLERANCE",
      "vertices of a surface, solid or wireframe that are this close are one: the sides\n"
      "of a seam, triangles with corners of their own (0: at one place)");
}

void add_report_options(CLI::App& app, InputCommand& command, const char* quiet) {
  app.add_flag("--json", command.json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command.quiet, quiet);
}

void add_verbose_option(CLI::App& app, InputCommand& command) {
  app.add_flag("--verbose", command.verbose, "the summary also counts the work that was done");
}

void add_input_options(CLI::App& app, InputCommand& command, const char* quiet) {
  const OptionGroup add(app);
  add("--as", command.as, "KIND", as_help);
  app.add_flag("--strict", command.strict,
               "refuse a file of which something is left out, guessed or repaired, such as a face\n"
               "with a corner twice");
  add_merge_option(app, command);
  add_report_options(app, command, quiet);
  add_fill_options(app, command.fill);
  add_cloud_options(app, command.cloud);
}

void add_output(CLI::App& command, const std::string& name, std::string& out,
                const std::string& help, const char* usual) {
  const std::string on_output = std::string(usual) + ":-";
  const OptionGroup add(command);
  add(name, out, "FILE", help)->transform([on_output](const std::string& given) {
    return given == "-" ? on_output : given;
  });
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
  options.merge = command.merge;
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

}  // namespace plexway::detail::cli
