#include <sys/resource.h>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <thread>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/executors/gl.hpp>

#include "executors/threads/rank_mail.hpp"
#include "shape/info/info_report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/make_complex.hpp"

namespace plexway::detail {

std::string_view executor_name(const AnyExecutor& executor) {
  constexpr std::array<std::string_view, 3> names = {"serial", "openmp", "gl"};
  return names[executor.index()];
}

std::size_t executor_threads(const AnyExecutor& executor) {
  const OpenMP* const team = std::get_if<OpenMP>(&executor);
  return team == nullptr ? 1 : team_size(*team);
}

std::string describe(const AnyExecutor& executor) {
  const std::size_t threads = executor_threads(executor);
  return std::string(executor_name(executor)) +
         (threads > 1 ? " with " + counted(threads, "threads") : "");
}

std::vector<std::string_view> built_executors() {
  std::vector<std::string_view> built = {"serial"};
  if (openmp_built()) built.push_back("openmp");
#ifdef PLEXWAY_HAS_GL
  built.push_back("gl");
#endif
  return built;
}

bool has_accuracies(DomainKind kind) {
  return static_cast<bool>(support_of_accuracy(
      {.executor = ExecutorKind::serial,
       .domain = kind,
       .dimension = 2,
       .single_precision = true,
       .metric = kind == DomainKind::solid ? MetricKind::embedded : MetricKind::intrinsic}));
}

Json json_of(Accuracy accuracy) {
  if (accuracy == Accuracy::accurate()) return "accurate";
  switch (accuracy.kind()) {
    case Accuracy::Kind::fast:
      return "fast";
    case Accuracy::Kind::exact:
      return "exact";
    default:
      return accuracy.error();
  }
}

std::string name_of(Accuracy accuracy) {
  const Json json = json_of(accuracy);
  return json.is_string() ? json.get<std::string>() : short_number(json.get<double>());
}

void add_accuracy(DomainKind kind, Accuracy accuracy, const PropagateStatistics& statistics,
                  Json& json) {
  if (!has_accuracies(kind)) return;
  json["accuracy"] = json_of(accuracy);
  if (statistics.windows_gave_up > 0) json["windows_gave_up"] = statistics.windows_gave_up;
}

std::string_view name_of(Triangulation done) {
  return done == Triangulation::input      ? "input"
         : done == Triangulation::delaunay ? "delaunay"
                                           : "refined";
}

std::string describe(const TriangulationReport& report) {
  std::string text =
      report.done == Triangulation::input ? "as in the input" : "intrinsic Delaunay, ";
  if (report.done == Triangulation::input) return text;
  text += counted(report.flips, "flips");
  if (report.done == Triangulation::refined)
    text += " and " + counted(report.inserted_vertices, "vertices") + " put in";
  return text + ", " + short_time(report.seconds);
}

void add_shape(const TriangulationShape& shape, Json& json, Table& table) {
  Json& triangulation = json["triangulation"];
  triangulation["non_delaunay_share"] = shape.non_delaunay_share();
  triangulation["non_delaunay_edges"] = shape.non_delaunay_edges;
  triangulation["smallest_angle"] = shape.smallest_angle;
  triangulation["largest_angle"] = shape.largest_angle;
  triangulation["needle_share"] = shape.needle_share;
  triangulation["blunt_share"] = shape.blunt_share;
  triangulation["auto"] = name_of(named(what_pays(shape)));
  table.add("triangles", "angles " + short_number(shape.smallest_angle) + " to " +
                             short_number(shape.largest_angle) + " degrees; " +
                             short_number(100 * shape.non_delaunay_share()) +
                             " % of the inner edges are not Delaunay; --triangulation auto takes " +
                             std::string(name_of(named(what_pays(shape)))));
}

RankCounts rank_counts(PieceRanks& ranks, std::size_t sent_bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  // A number each: in its own place, and zeros elsewhere.
  std::vector<std::uint64_t> sums(ranks.count() + 1);
  sums[ranks.rank()] = 1024 * static_cast<std::uint64_t>(used.ru_maxrss);
  sums.back() = sent_bytes;
  add_up(&ranks, sums);
  RankCounts counts{static_cast<std::size_t>(sums.back()), sums};
  counts.peak_bytes.pop_back();
  return counts;
}

namespace {

#ifdef PLEXWAY_HAS_GL
// What EGL offers, or why it offers nothing: no reason to fail when one only asks.
void add_gl(InfoReport& report) {
  Json devices = Json::array();
  try {
    for (const GLDevice& d : gl_devices()) {
      const std::string name = "gl " + std::to_string(d.number);
      if (!d.problem.empty()) {
        devices.push_back({{"number", d.number}, {"problem", d.problem}});
        report.table.add(name, "cannot be used: " + d.problem);
        continue;
      }
      devices.push_back({{"number", d.number},
                         {"vendor", d.vendor},
                         {"renderer", d.renderer},
                         {"version", d.version},
                         {"software", d.software},
                         {"largest_buffer", d.largest_buffer},
                         {"group_size", d.group_size}});
      report.table.add(name, d.renderer + ", " + d.vendor + ", OpenGL " + d.version +
                                 (d.software ? ", in software" : "") + "; buffers up to " +
                                 std::to_string(d.largest_buffer >> 20) + " MiB");
    }
  } catch (const NotBuiltError& error) {
    report.json["gl_problem"] = error.what();
    report.table.add("gl", std::string("no device: ") + error.what());
  }
  report.json["gl_devices"] = devices;
}
#endif

}  // namespace

InfoReport info_of_devices() {
  InfoReport report;
  const auto built = built_executors();
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  report.json["executors"] = Json::array();
  for (const std::string_view name : built) report.json["executors"].push_back(name);
  report.json["cores"] = cores;
  for (const std::string_view name : built) {
    if (name == "serial") report.table.add("serial", "one thread");
    if (name == "openmp") report.table.add("openmp", "up to " + counted(cores, "cores"));
  }
#ifdef PLEXWAY_HAS_GL
  add_gl(report);
#endif
  return report;
}

}  // namespace plexway::detail
