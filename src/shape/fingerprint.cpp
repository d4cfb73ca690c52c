#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include <plexway/io/block_journal.hpp>
#include <plexway/shape/pairs.hpp>
#include <plexway/version.hpp>

#include "shape/words.hpp"

namespace plexway {
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
