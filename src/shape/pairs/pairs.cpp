#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/io/block_journal.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/pairs.hpp>
#include <plexway/support.hpp>
#include <plexway/version.hpp>

#include "pairs/row_work.hpp"
#include "shape/inside.hpp"
#include "shape/words.hpp"

namespace plexway {
using namespace detail;
namespace {

// Calls run(executor) with one that takes a source a thread.
template <class Run>
PairsReport by(const AnyExecutor& executor, const AnyDomain& domain, const Run& run) {
  if (const auto* team = std::get_if<OpenMP>(&executor)) return run(*team);
  if (std::holds_alternative<GL>(executor))
    support(Purpose::rows, domain.kind(), ExecutorKind::gl).require();
  return run(Serial{});
}

// A row is a solve of all; `take(row, distances)`, all vertices.
template <class Take>
struct AnyWorker {
  const AnyDomain& domain;
  const Take& take;
  PairsReport report = {};
  AnyField field = {};
  std::vector<double> distance = {};

  void solve(const apps::RowSource& source, std::size_t row, const PropagateOptions& options) {
    domain.solve(Serial{}, source.list(), options, field);
    std::visit(
        [&](const auto& f) {
          apps::add(report.statistics, f.statistics);
          distance.assign(f.distance.begin(), f.distance.end());
        },
        field.data);
    report.complete = report.complete && field.complete();
    take(row, distance);
  }
};

template <class Take>
PairsReport every_row(const AnyExecutor& executor, const AnyDomain& domain,
                      const PairsRequest& request, const std::function<void(std::size_t)>& block,
                      const Take& take) {
  using Worker = AnyWorker<Take>;
  apps::check(request, domain.vertices());
  return by(executor, domain, [&](const auto& with) {
    return apps::deal_rows<std::decay_t<decltype(with)>, Worker>(
        with, domain.vertices(), request, block, [&] {
          return std::unique_ptr<Worker>(new Worker{domain, take});
        });
  });
}

}  // namespace

PairsReport all_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                      const PairsRequest& request, const PairsSink<DenseRow<double>>& sink) {
  return every_row(executor, domain, request, sink.block,
                   [&](std::size_t row, const std::vector<double>& distance) {
                     if (request.columns.empty()) return sink.row(row, distance);
                     std::vector<double> chosen;
                     chosen.reserve(request.columns.size());
                     for (const Index v : request.columns) chosen.push_back(distance[v]);
                     sink.row(row, chosen);
                   });
}

PairsReport near_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                       const PairsRequest& request, const NearLimits& limits,
                       const PairsSink<SparseRow<double>>& sink) {
  if (domain.kind() == DomainKind::mixed) {  // its complex has numbers of its own
    apps::check(limits, request, domain.vertices());
    return every_row(executor, domain, request, sink.block,
                     [&](std::size_t row, const std::vector<double>& distance) {
                       std::vector<NearEntry<double>> entries;
                       for (std::size_t c = 0; c < request.column_count(distance.size()); ++c) {
                         const double d =
                             distance[request.columns.empty() ? c : request.columns[c]];
                         if (d <= limits.radius && d < std::numeric_limits<double>::infinity())
                           entries.push_back({static_cast<Index>(c), d});
                       }
                       apps::keep_nearest(entries, limits.nearest);
                       sink.row(row, entries);
                     });
  }
  // Rows are found in the complex itself.
  const OpenSimplices* const open = domain.open_simplices();
  std::vector<PointSource> rows;
  if (open != nullptr && !request.rows)
    for (const Index v : open->columns({})) rows.push_back(PointSource::at(v));
  const Inside inside(open, request.rows.value_or(SourceList(rows)));
  PairsRequest within = request;
  if (request.rows || !rows.empty()) within.rows = inside.list();
  std::vector<Index> columns;
  if (open != nullptr) within.columns = columns = open->columns(request.columns);
  return by(executor, domain, [&](const auto& with) {
    return with_complex(domain, [&](const auto& complex) {
      using Real = RealOf<std::decay_t<decltype(complex)>>;
      return near_pairs(with, complex, within, limits,
                        {[&](std::size_t row, SparseRow<Real> near) {
                           std::vector<NearEntry<double>> entries;
                           entries.reserve(near.size());
                           for (const auto& [column, distance] : near)
                             entries.push_back({column, static_cast<double>(distance)});
                           sink.row(row, entries);
                         },
                         sink.block});
    });
  });
}

namespace {

using io::Fingerprint;

void add(Fingerprint& print, const MeasuredLengths& lengths) {
  print.add_numbers(lengths.triangles);
  print.add_numbers(lengths.tets);
  print.add_numbers(lengths.edges);
  print.add_numbers(lengths.speeds);
}

void add(Fingerprint& print, const PointSource& point) {
  print.add_numbers(std::array{point.vertex, point.simplex});
  print.add_numbers(point.barycentric);
  print.add_numbers(std::array{point.offset});
}
void add(Fingerprint& print, const VertexSource& source) {
  print.add_numbers(source.vertices);
  print.add_numbers(source.offsets);
  print.add_numbers(std::array{source.offset});
}
void add(Fingerprint& print, const BallSource& ball) {
  add(print, ball.centre);
  print.add_numbers(std::array{ball.radius, ball.offset});
}
void add(Fingerprint& print, const CurveSource& curve) {
  for (const PointSource& point : curve.points) add(print, point);
  print.add_numbers(std::array{curve.offset});
}
void add(Fingerprint& print, const SimplexSource& source) {
  print.add_numbers(std::array{source.simplex});
  print.add_numbers(std::array{source.offset});
}

template <class Numbers>
std::string fingerprint_of_numbers(const Numbers& numbers) {
  Fingerprint print;
  print.add_numbers(numbers);
  return print.text();
}

// In the order of Visibility, Schedule and Triangulation.
constexpr std::array<std::string_view, 4> visibilities = {"saddles", "tuned", "centroid",
                                                          "upper_bound"};
constexpr std::array<std::string_view, 3> schedules = {"dual_queue", "fifo", "priority"};
constexpr std::array<std::string_view, 4> triangulations = {"input", "delaunay", "refined", "auto"};
template <class Names, class Enum>
std::string name_in(const Names& names, Enum value) {
  return std::string(names[static_cast<std::size_t>(value)]);
}

std::string text_of_value(Accuracy accuracy) {
  switch (accuracy.kind()) {
    case Accuracy::Kind::usual:
      return "usual";
    case Accuracy::Kind::fast:
      return "fast";
    case Accuracy::Kind::exact:
      return "exact";
    case Accuracy::Kind::merged:
      break;
  }
  return accuracy == Accuracy::accurate() ? "accurate" : exact_number(accuracy.error());
}

}  // namespace

std::string fingerprint_of(const MeasuredLengths& lengths) {
  Fingerprint print;
  add(print, lengths);
  return print.text();
}

std::string fingerprint_of(const AnyShape& shape) {
  Fingerprint print;
  print.add(shape.kind_name());
  print.add_numbers(shape.positions());
  for (std::size_t i = 0; i < shape.simplices(); ++i) print.add_numbers(shape.corners(i));
  if (const MeasuredLengths* lengths = shape.lengths()) add(print, *lengths);
  if (const auto* wire = std::get_if<io::Edges>(&shape.data())) print.add_numbers(wire->lengths);
  if (const auto* simplices = std::get_if<SimplexShape>(&shape.data())) {
    print.add_numbers(simplices->positions);
    print.add_numbers(simplices->lengths);
  }
  if (const auto* mixed = std::get_if<MixedShape>(&shape.data())) {
    for (const MixedShape::Part& part : mixed->parts)
      print.add_numbers(std::array{part.first_vertex, part.vertices});
    print.add_numbers(std::array{mixed->tolerance});
  }
  if (const CloudShape* cloud = shape.cloud()) {
    print.add_numbers(cloud->measured());
    print.add_numbers(cloud->neighbours.begin);
    print.add_numbers(cloud->neighbours.of);
  }
  return print.text();
}

std::string fingerprint_of(const Mask& mask) {
  Fingerprint print;
  print.add_numbers(mask.closed_vertices());
  print.add_numbers(mask.closed_simplices());
  return print.text();
}

std::string fingerprint_of(const SourceList& sources) {
  Fingerprint print;
  if (sources.only_points()) {
    for (const PointSource& point : sources.points()) add(print, point);
    return print.text();
  }
  for (const Source& source : sources.sources()) {
    print.add_numbers(std::array{source.index()});
    std::visit([&](const auto& of) { add(print, of); }, source);
  }
  return print.text();
}

io::BlockJournal::Description description_of(const AnyShape& shape, const BuildOptions& building,
                                             const PairsRequest& request) {
  const PropagateOptions& solve = request.solve;
  io::BlockJournal::Description lines = {
      {"plexway", version_string},
      {"input", fingerprint_of(shape) + " " + std::string(shape.kind_name())},
      {"rows", std::to_string(request.row_count(shape.vertices())) + " " +
                   (request.rows ? fingerprint_of(*request.rows) : "all")},
      {"columns", std::to_string(request.column_count(shape.vertices())) + " " +
                      fingerprint_of_numbers(request.columns)},
      {"precision", building.precision == Precision::float64 ? "double" : "float"},
      {"accuracy", text_of_value(solve.accuracy)},
      {"visibility", name_in(visibilities, solve.visibility)},
      {"schedule", name_in(schedules, solve.schedule) + " " + exact_number(solve.step)},
      {"triangulation", name_in(triangulations, building.triangulation)}};
  if (solve.visibility == Visibility::tuned)
    lines.emplace_back("table", fingerprint_of_numbers(solve.probe.share));
  if (building.lengths) lines.emplace_back("metric", fingerprint_of(*building.lengths));
  if (building.mask) lines.emplace_back("mask", fingerprint_of(*building.mask));
  if (std::isfinite(solve.radius)) lines.emplace_back("radius", exact_number(solve.radius));
  return lines;
}

}  // namespace plexway
