#include "executors/source_parts.hpp"

#include <cmath>
#include <string>

#include <plexway/error.hpp>

namespace plexway::detail {
namespace {

void check_number(double value, const char* what) {
  if (!(value >= 0) || !std::isfinite(value))
    throw UsageError(std::string("a source's ") + what + " must be a number >= 0");
}

struct Taker {
  SourceParts& parts;
  Index number;
  bool edges_only;

  void point(const PointSource& at, double offset) {
    PointSource moved = at;
    moved.offset = offset;
    parts.points.push_back(moved);
    parts.owner.push_back(number);
  }

  void operator()(const PointSource& source) { point(source, source.offset); }
  void operator()(const VertexSource& source) {
    check_number(source.offset, "offset");
    if (source.vertices.empty()) throw UsageError("a source has no vertices: name at least one");
    if (!source.offsets.empty() && source.offsets.size() != source.vertices.size())
      throw UsageError(std::to_string(source.offsets.size()) + " offsets for " +
                       std::to_string(source.vertices.size()) +
                       " vertices: give one a vertex, or none");
    for (std::size_t i = 0; i < source.vertices.size(); ++i) {
      if (source.vertices[i] == none) throw UsageError("a source has a vertex without a number");
      const double offset = source.offsets.empty() ? 0 : source.offsets[i];
      check_number(offset, "offset");
      point(PointSource::at(source.vertices[i]), source.offset + offset);
    }
  }
  void operator()(const BallSource& source) {
    check_number(source.offset, "offset");
    check_number(source.radius, "radius");
    PointSource centre = source.centre;
    centre.offset = 0;
    parts.balls.push_back({centre, source.radius, source.offset, number});
  }
  void operator()(const CurveSource& source) {
    check_number(source.offset, "offset");
    if (source.points.empty()) throw UsageError("a curve has no points: give at least one");
    if (!edges_only && source.points.size() > 1) {
      parts.shapes.push_back(number);
      return;
    }
    for (const PointSource& at : source.points)
      if (!names_nothing(at)) point(at, source.offset);
  }
  void operator()(const SimplexSource& source) {
    check_number(source.offset, "offset");
    if (!edges_only) {
      parts.shapes.push_back(number);
      return;
    }
    point(PointSource::in(source.simplex, {1., 0.}), source.offset);
    point(PointSource::in(source.simplex, {0., 1.}), source.offset);
  }
};

}  // namespace

SourceParts take_apart(std::span<const Source> sources, bool edges_only) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  SourceParts parts;
  for (std::size_t n = 0; n < sources.size(); ++n)
    std::visit(Taker{parts, static_cast<Index>(n), edges_only}, sources[n]);
  return parts;
}

}  // namespace plexway::detail
