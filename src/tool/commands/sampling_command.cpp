#include "tool/commands/sampling_command.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>

#include "shape/files/files.hpp"
#include "shape/warnings/survey.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

/// Parts of a domain, each what simplices (of a cloud: neighbours) hold together.
struct Parts {
  std::size_t count = 0;
  std::size_t vertices = 0;  ///< in all of them
};

/// Those in which none of the points lies. A vertex in no simplex is no part. Cost: linear, nearly.
Parts parts_without(const AnyShape& shape, std::span<const PointSource> points) {
  const std::size_t n = shape.vertices();
  DisjointSets sets = joined_vertices(shape);
  std::vector<bool> used(n, shape.cloud() != nullptr);
  for (std::size_t s = 0; s < shape.simplices(); ++s)
    for (const Index v : shape.corners(s)) used[v] = true;
  std::vector<bool> taken(n, false);
  for (const PointSource& point : points)
    taken[sets.find(point.vertex != none ? point.vertex : shape.corners(point.simplex).front())] =
        true;
  Parts left;
  for (Index v = 0; v < n; ++v) {
    const Index root = sets.find(v);
    if (!used[v] || taken[root]) continue;
    ++left.vertices;
    left.count += v == root;
  }
  return left;
}

}  // namespace

void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help) {
  const OptionGroup add(app);
  add_input(app, command, "a surface, a solid or a cloud, as for 'plexway distance'");
  add_output(app, "--out,-o", command.out, std::string(out_help) + output_help, "csv");
  add("--precision", command.precision, "NAME", "float (default) or double")
      ->each([&command](const std::string&) { command.precision_given = true; });
  add_input_options(app, command);
}

Precision precision_of(const SamplingCommand& command) {
  SolveOptions options;
  options.precision = command.precision;
  options.precision_given = command.precision_given;
  return precision_of(options);
}

void check_outputs(const SamplingCommand& command, const std::string& other,
                   const std::string& third) {
  check_output_name(command.out, command.input, point_file_extensions());
  check_picture(command.picture, command.input);
  check_outputs_differ({command.out, other, third, command.picture.file, command.picture.html});
}

void draw_points(const SamplingCommand& command, const Domain& domain,
                 std::span<const PointSource> points, SceneContent content) {
  if (!command.picture.wanted()) return;
  for (const PointSource& point : points) content.dots.push_back(domain.position(point));
  write_picture(command.picture, domain, content, command.quiet);
}

void add_parts_without(Notes& notes, const Domain& domain, std::span<const PointSource> points,
                       std::string_view plural) {
  const Parts left = parts_without(domain, points);
  if (left.count == 0) return;
  notes.add("no " + singular(plural) + " in " + counted(left.count, "parts") + " of the " +
            std::string(kind_noun(domain.kind())) + " (" + counted(left.vertices, "vertices") +
            "): there are more parts than " + std::string(plural) +
            ", or they went to larger ones; what lies there belongs to none");
}

Summary points_summary(const SamplingCommand& command, const Domain& domain,
                       const std::string& name, std::size_t points, const std::string& more) {
  Summary summary(command.input, domain.kind_name());
  summary.add(name, points, counted(points, name) + more);
  return summary;
}

void finish(Summary& summary, const SamplingCommand& command, const PropagateStatistics& work,
            const Phases& phases, const Notes& notes) {
  summary.json["expansions"] = work.expansions;
  if (command.verbose) summary.table.add("work", counted(work.expansions, "expansions"));
  phases.tell(summary);
  summary.print(command, {command.out, command.picture.file, command.picture.html}, notes);
  notes.say(command.quiet);
}

}  // namespace plexway::detail::cli
