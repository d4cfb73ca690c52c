#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/joined_rows.hpp>
#include <plexway/executors/surface_parts.hpp>
#include <plexway/io/ply_rows.hpp>
#include <plexway/io/pvtu.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/support.hpp>

#include "executors/same_work.hpp"
#include "executors/threads/rank_mail.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/stopwatch.hpp"
#include "shape/warnings/field_warnings.hpp"
#include "tool/app.hpp"
#include "tool/commands/distance_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

/// The table's word on all that was requested.
void check_support(const DistanceCommand& command, std::span<const SetArgument> arguments,
                   const Combination& cell) {
  require("--executor " + command.solve.executor.name, support(Purpose::ranks, cell));
  require("--in-parts", support(Purpose::in_parts, cell));
  const auto purpose = [&](const std::string& option, bool given, Purpose what) {
    if (given) require(option, support(what, cell));
  };
  const Triangulation triangulation = triangulation_of(command.triangulation);
  purpose("--isolines-out", !command.isolines.out.empty() || command.isolines.step.has_value(),
          Purpose::isolines);
  purpose("--picture", command.picture.wanted(), Purpose::pictures);
  purpose("--mask", !command.mask.text.empty(), Purpose::masks);
  purpose("--metric", !command.metric.text.empty(), Purpose::metrics);
  purpose("--triangulation " + command.triangulation.name,
          triangulation != Triangulation::automatic && triangulation != Triangulation::input,
          Purpose::triangulations);
  FileUse file{DomainKind::surface, DomainKind::surface, FileForm::parts};
  const auto reading = [&](const std::string& option, bool given, Reading what) {
    if (given) require(option, support(what, file));
  };
  reading("the further file " + (command.more.empty() ? "" : command.more.front()),
          !command.more.empty(), Reading::joining);
  reading("--weld", command.weld.has_value(), Reading::joining);
  reading("--merge", command.merge.has_value(), Reading::merging);
  reading("--repair", command.fill.volume.repair, Reading::repair);
  reading("--voxel", command.fill.volume.voxel.has_value(), Reading::voxel);
  reading("--grid", !command.fill.volume.grid.empty(), Reading::grid);
  reading("--max-volume and the like", command.fill.given(), Reading::filling);
  reading("points and their neighbours", command.cloud.given(), Reading::connecting);
  ProgressLine silent(true);
  file.wanted = read_options(command, silent).as.value_or(file.held);
  reading("--as " + command.as, true, Reading::kind);
  for (const SetArgument& argument : arguments)
    require("--source " + argument.text,
            support_of_sources(Purpose::in_parts, argument.kind == SetArgument::Kind::point));
  if (!command.out.empty() && !io::is_partitioned(command.out))
    throw UsageError("--out " + command.out +
                     ": with --in-parts each rank writes its own: name a .pvtu");
}

/// The surface does not know which file it is of; its rows do.
template <class Work>
auto with_file_name(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    const std::string text = error.what();
    throw InputError(text.starts_with(file) ? text : file + ": " + text);
  }
}

/// Where a solve starts, and how that is reported.
struct Sources {
  std::vector<PointSource> points;
  std::vector<std::string> texts;
};

/// Numbers of vertices are the file's; points are looked for.
template <class Real>
Sources sources_on(const SurfaceParts<Real>& surface, const DistanceCommand& command,
                   std::span<const SetArgument> arguments) {
  Sources sources;
  for (const SetArgument& argument : arguments) {
    const SourceArgument where = parse_source(argument.place);
    PointSource& source = sources.points.emplace_back();
    std::string& text = sources.texts.emplace_back(argument.place);
    if (const Index* const vertex = std::get_if<Index>(&where.where)) {
      if (*vertex >= surface.summary().vertices)
        throw InputError(command.input + ": source " + argument.place +
                         " is out of range: the vertices are 0 to " +
                         std::to_string(surface.summary().vertices - 1));
      source = PointSource::at(*vertex);
    } else {
      const PartPoint found = surface.nearest(std::get<std::array<double, 3>>(where.where));
      source = found.source;
      text += source.vertex != none ? " (vertex " + std::to_string(source.vertex)
                                    : " (triangle " + std::to_string(source.simplex);
      text += ", " + short_number(found.distance) + " away)";
    }
    source.offset = argument.offset;
    if (argument.offset > 0) text += " + " + short_number(argument.offset);
  }
  return sources;
}

/// Throws UsageError if what the ranks write would take the place of what they read.
void check_apart(std::span<const std::filesystem::path> files, const std::filesystem::path& out,
                 std::size_t ranks) {
  for (std::size_t r = 0; r < ranks; ++r)
    for (const std::filesystem::path& file : files)
      if (std::error_code absent;
          std::filesystem::equivalent(io::part_of(out, r), file, absent) && !absent)
        throw UsageError("--out " + out.string() + ": would take the place of the input's " +
                         file.string());
}

/// Throws InputError, in all ranks, if what they have by the name of a .pvtu names other files or
/// files of other sizes: parts of several surfaces would else make one. A rank need not have the
/// files that others read.
void check_same_files(PieceRanks& ranks, const std::filesystem::path& input,
                      std::span<const std::filesystem::path> files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files)
    names.push_back(file.lexically_relative(input.parent_path()).string());
  check_same_words(ranks, names, "domain");
  constexpr auto absent = static_cast<std::uintmax_t>(-1);
  std::vector<std::uintmax_t> sizes;
  std::vector<std::uint64_t> sums;  // of a file: how many ranks see it, and how large in all
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    sizes.push_back(std::filesystem::file_size(file, ignored));
    sums.push_back(sizes.back() != absent);
    sums.push_back(sizes.back() != absent ? sizes.back() : 0);
  }
  add_up(&ranks, sums);
  // Where sizes are not all the same, some rank's is not their mean.
  std::vector<std::uint64_t> differ(files.size(), 0);
  for (std::size_t i = 0; i < files.size(); ++i)
    differ[i] = sizes[i] != absent && sizes[i] * sums[2 * i] != sums[2 * i + 1];
  add_up(&ranks, differ);
  for (std::size_t i = 0; i < files.size(); ++i)
    if (differ[i] != 0)
      throw InputError("the ranks of one solve need the same domain: " + files[i].string() +
                       " has other sizes on some");
}

/// What the user should know of how several files became one surface.
std::vector<std::string> warnings_on(const JoinedCounts& joined) {
  std::vector<std::string> warnings;
  if (!joined.by_ids && joined.shared > 0)
    warnings.push_back(
        "taken as one, for they lie in one place: " + counted(joined.shared, "points") +
        " of several files; GlobalPointIds in the files would tell");
  if (joined.apart > 0)
    warnings.push_back("in " + counted(joined.apart, "places") +
                       " points of several files have different numbers and are not taken as one" +
                       (joined.shared > 0 ? ""
                                          : "; no number is in two files: is each file "
                                            "numbered on its own?"));
  if (joined.parts > 1 && joined.alone > 0)
    warnings.push_back(
        std::to_string(joined.alone) + " of " + counted(joined.parts, "files") +
        (joined.alone == 1 ? " shares" : " share") +
        " no point with another, so they are not reached" +
        (joined.by_ids ? "" : " (points are one where they are so to the last bit)"));
  return warnings;
}

/// A file that each rank reads some rows of, or files that each reads some of. `joined`: what
/// became of the points of several.
std::unique_ptr<SurfaceRows> open_rows(const DistanceCommand& command,
                                       std::optional<JoinedCounts>& joined) {
  const Among& among = *command.among;
  if (!io::is_partitioned(command.input)) {
    const std::string extension = std::filesystem::path(command.input).extension().string();
    if (!extension.empty() && extension != ".ply" && extension != ".PLY")
      throw InputError(command.input +
                       ": in parts a binary .ply of triangles or a .pvtu is read, no " + extension);
    auto rows = std::make_unique<io::PlyRows>(command.input);
    among.all_come();
    // Another file of that name, or another command, would end in a wait without end.
    check_same_rows(among.pieces, *rows);
    return rows;
  }
  const std::vector<std::filesystem::path> files = io::read_pvtu(command.input);
  if (!command.out.empty()) check_apart(files, command.out, among.pieces.count());
  std::vector<SurfaceFilePart> parts;
  for (std::size_t p = among.pieces.rank(); p < files.size(); p += among.pieces.count())
    parts.push_back(io::read_surface_part(files[p], p));
  among.all_come();
  check_same_files(among.pieces, command.input, files);
  auto rows = with_file_name(
      command.input, [&] { return std::make_unique<JoinedRows>(&among.pieces, std::move(parts)); });
  joined = rows->joined();
  return rows;
}

template <class Real>
void solve_in_parts(DistanceCommand& command, const PropagateOptions& wanted,
                    std::span<const SetArgument> arguments) {
  const Among& among = *command.among;
  ProgressLine progress(command.quiet);
  progress.phase("reading " + command.input);
  const Stopwatch building;
  std::optional<JoinedCounts> joined;
  const std::unique_ptr<SurfaceRows> rows = open_rows(command, joined);
  std::vector<std::string> words = command.sources;
  check_same_words(among.pieces, words, "sources");
  words = {command.solve.precision};
  check_same_words(among.pieces, words, "options");
  words = {command.out};
  check_same_words(among.pieces, words, "outputs");

  OpenMP team{.threads = command.solve.executor.threads.value_or(among.threads)};
  team.ranks = &among.pieces;
  SurfaceParts<Real> surface =
      with_file_name(command.input, [&] { return SurfaceParts<Real>(team, *rows); });
  const SurfacePartsSummary& made = surface.summary();
  const Sources sources = sources_on(surface, command, arguments);
  const double build = building.seconds();

  progress.phase("solving");
  PropagateOptions options = wanted;
  options.progress = progress.callback();
  const Stopwatch solving;
  const PartField<Real> field =
      with_file_name(command.input, [&] { return surface.solve(sources.points, options); });
  const double solve = solving.seconds();

  SurfacePart part;
  std::vector<std::size_t> parts;  // that have a vertex
  if (!command.out.empty()) {
    part = surface.part(*rows);
    std::vector<std::uint64_t> vertices(among.pieces.count(), 0);
    vertices[among.pieces.rank()] = part.vertex.size();
    add_up(&among.pieces, vertices);
    for (std::size_t r = 0; r < vertices.size(); ++r)
      if (vertices[r] > 0) parts.push_back(r);
  }
  const RankCounts ranks = rank_counts(among.pieces, field.statistics.sent_bytes);
  among.all_come();
  if (!command.out.empty()) {
    progress.phase("writing " + command.out);
    const std::vector<double> distance(field.distance.begin(), field.distance.end()),
        error(field.error.begin(), field.error.end());
    std::vector<std::int32_t> label;
    for (const Index one : field.label) label.push_back(static_cast<std::int32_t>(one));
    write_part(part, command.out, distance, label, error,
               {among.pieces.rank(), among.pieces.count(), among.all_come}, parts);
  }
  progress.clear();
  const auto check_reached = [&] {
    if (field.beside_source == 0)
      throw NothingReached(command.input +
                           ": nothing reached: no vertex but the source itself has "
                           "a finite distance");
  };
  if (!command.leads()) return check_reached();

  const PropagateStatistics& statistics = field.statistics;
  Summary summary(command.input, "surface");
  Json& json = summary.json;
  json["in_parts"] = true;
  json["vertices"] = made.vertices;
  json["simplices"] = made.faces;
  json["pieces"] = made.pieces;
  json["ghosts"] = made.ghosts;
  summary.table.add("surface", counted(made.vertices, "vertices") + ", " +
                                   counted(made.faces, "triangles") + ", in " +
                                   counted(made.pieces, "pieces") + " with " +
                                   counted(made.ghosts, "ghosts"));
  if (joined) {
    json["files"]["joined_by"] = joined->by_ids ? "ids" : "places";
    json["files"]["shared_points"] = joined->shared;
    json["files"]["apart"] = joined->apart;
    json["files"]["alone"] = joined->alone;
  }
  for (std::size_t i = 0; i < sources.texts.size(); ++i)
    summary.table.add(sources.texts.size() == 1 ? "source" : "source " + std::to_string(i),
                      sources.texts[i]);
  summary.took("build", build);
  summary.took("solve", solve);
  summary.time_note(" (" + describe(team) + ", " + name_of(field.accuracy) + ", " +
                    command.solve.precision + ")");
  DistanceReport{.vertices = made.vertices,
                 .reached = field.reached,
                 .farthest = field.farthest,
                 .max_distance = field.max_distance,
                 .mean_distance = field.mean_distance,
                 .statistics = statistics,
                 .ranks = among.ranks.count(),
                 .counts = ranks,
                 .of_surface = true}
      .add_to(summary, command.verbose);
  json["executor"] = "openmp";
  json["threads"] = team_size(team);
  json["precision"] = std::is_same_v<Real, float> ? "float" : "double";
  add_accuracy(DomainKind::surface, field.accuracy, statistics, json);
  Notes on_files, notes;
  if (joined) on_files.add(warnings_on(*joined));
  notes.add(work_warnings({.statistics = statistics,
                           .accuracy = field.accuracy,
                           .complete = field.complete,
                           .has_windows = true,
                           .vertices = made.vertices,
                           .edges = std::is_same_v<Real, float> && made.mean_edge > 0
                                        ? field.max_distance / made.mean_edge
                                        : 0},
                          Reader::tool));
  if (const std::size_t left = made.vertices - field.reached; left > 0)
    notes.add({unreached_warning(
        left,
        made.unreferenced_vertices > 0
            ? counted(made.unreferenced_vertices, "vertices") + " in none of its triangles"
            : "",
        is_bounded(options), Reader::tool)});
  Notes all = on_files;
  all.add(notes);
  summary.print(command, {command.out}, all);
  // Also where nothing is reached: that may be why.
  on_files.say(command.quiet);
  check_reached();
  notes.say(command.quiet);
}

}  // namespace

void run_distance_in_parts(DistanceCommand command) {
  if (command.among == nullptr)
    throw UsageError(
        "--in-parts is for ranks: mpirun -n 4 plexway-mpi distance FILE.ply --in-parts ...");
  if (!command.leads()) command.quiet = true;
  const std::vector<SetArgument> arguments = parse_source_sets(command.sources);
  check_picture(command.picture, command.input);
  check_isolines(command.isolines, command.input);
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  if (precision == Precision::float64 && command.solve.precision == "float")
    command.solve.precision = "double, which exact distances need";
  const Combination cell = with({.executor = kind_of(command.solve.executor),
                                 .domain = DomainKind::surface,
                                 .dimension = 2,
                                 .single_precision = precision == Precision::float32,
                                 .in_parts = true},
                                options);
  check_support(command, arguments, cell);
  const std::vector<std::string> read = {command.input};
  check_output_place(command.out, read, "--out");
  if (precision == Precision::float32)
    solve_in_parts<float>(command, options, arguments);
  else
    solve_in_parts<double>(command, options, arguments);
}

}  // namespace plexway::detail::cli
