#include <plexway/executors/source_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "executors/alone.hpp"
#include "executors/checks.hpp"
#include "executors/solve_surface.hpp"
#include "propagate/border_light.hpp"
#include "propagate/curve_seeds.hpp"

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

void add_shapes(const TriangleMesh<double>& mesh, std::span<const Source> sources,
                SourceParts& parts, CurveSeeds& seeds) {
  const SourceDomain domain = {mesh.vertex_count(), mesh.face_count(), "face", 3};
  // Points first: they have the first numbers.
  for (const Index n : parts.shapes) {
    Taker take{parts, n, false};
    if (const auto* curve = std::get_if<CurveSource>(&sources[n])) {
      for (std::size_t i = 0; i < curve->points.size(); ++i) {
        PointSource at = curve->points[i];
        if (names_nothing(at)) continue;
        at.offset = 0;
        check_source(at, domain);
        const auto& b = at.barycentric;
        const bool corner = at.vertex != none || b[0] == 1 || b[1] == 1 || b[2] == 1;
        const bool end = i == 0 || i + 1 == curve->points.size() ||
                         names_nothing(curve->points[i - 1]) || names_nothing(curve->points[i + 1]);
        if (corner || end) take.point(at, curve->offset);
      }
    } else {
      const auto& face = std::get<SimplexSource>(sources[n]);
      check_source(PointSource::in(face.simplex, {1., 0., 0.}), domain);
      for (std::size_t i = 0; i < 3; ++i) {
        PointSource at{.simplex = face.simplex};
        at.barycentric[i] = 1;
        take.point(at, face.offset);
      }
    }
  }
  for (const Index n : parts.shapes) {
    const Index number = static_cast<Index>(parts.owner.size());
    parts.owner.push_back(n);
    if (const auto* curve = std::get_if<CurveSource>(&sources[n]))
      seeds.add_curve(mesh, curve->points, curve->offset, number);
    else if (const auto* face = std::get_if<SimplexSource>(&sources[n]))
      seeds.add_face(mesh, face->simplex, face->offset, number);
  }
}

// A front that keeps light out of triangles that a curve crosses: there it would count heights from
// the one side as less than nothing on the other. These have the feet of their centres.
template <class Wave>
class SidedFront : public Wave {
 public:
  SidedFront(const Wave& wave, const CurveSeeds& curves) : Wave(wave), curves_(&curves) {}

  [[gnu::always_inline]] void accept(Index f, std::size_t hinge, const SaddleLabel<double>& label,
                                     double distance, Index source) {
    // Only light starts at less than 0.
    if (label.sigma() < 0 && curves_->crosses(source, f)) [[unlikely]]
      return;
    Wave::accept(f, hinge, label, distance, source);
  }

 private:
  const CurveSeeds* curves_;
};

// Curves as a solve takes them.
class Curves {
 public:
  Curves(const TriangleMesh<double>& mesh, const CurveSeeds& seeds, Workspace<double>& workspace)
      : mesh_(mesh), seeds_(seeds), workspace_(workspace) {}

  template <class Rule, class Front>
  void seed(const Rule& rule, Front& front) const {
    seeds_.seed(rule, front);
  }
  // Light in triangles that keep another label, then the corners of triangles that curves pass,
  // exactly; no light is nearer than its source.
  template <class Front>
  void read_out(const Front& front) const {
    const auto offer = [&](Index v, double d, Index number) {
      if (!(d < workspace_.vertex[v])) return;
      workspace_.vertex[v] = d;
      workspace_.vertex_source[v] = number;
    };
    BorderLight<Front>(mesh_, seeds_, front).offer_corners(offer);
    for (double& d : workspace_.vertex) d = std::max(d, 0.);
    seeds_.offer_corners(offer);
  }

 private:
  const TriangleMesh<double>& mesh_;
  const CurveSeeds& seeds_;
  Workspace<double>& workspace_;
};

void check_policy(const PropagateOptions& options) {
  if (options.visibility != Visibility::saddles)
    throw UsageError(
        "curves and triangles as sources need labels with limits: use the policy saddles");
}

void prepare(const TriangleMesh<double>& mesh, std::span<const Source> sources, SourceParts& parts,
             const PropagateOptions& options, CurveSeeds& seeds) {
  check_policy(options);
  add_shapes(mesh, sources, parts, seeds);
  seeds.sort(mesh.face_count());
  check(parts.points, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
}

}  // namespace

SourceParts take_apart(std::span<const Source> sources, bool edges_only) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  SourceParts parts;
  for (std::size_t n = 0; n < sources.size(); ++n)
    std::visit(Taker{parts, static_cast<Index>(n), edges_only}, sources[n]);
  return parts;
}

void refuse_shapes(bool surface, bool single_precision) {
  if (surface && single_precision)
    throw UsageError(
        "curves and triangles as sources need double precision: their virtual sources are far "
        "away");
  if (surface) throw UsageError("curves and triangles as sources are for the executor Serial");
  throw UsageError(
      "curves and simplices as sources are for surfaces and wireframes: name points or vertices "
      "here");
}

void propagate_shapes(const Serial&, const TriangleMesh<double>& mesh,
                      std::span<const Source> sources, SourceParts& parts,
                      const PropagateOptions& options, Workspace<double>& workspace,
                      DistanceField<double>& field) {
  CurveSeeds seeds;
  prepare(mesh, sources, parts, options, seeds);
  workspace.front.reserve(mesh.face_count());
  workspace.start(mesh.face_count(), true);
  with_queue<double>(options, workspace.front, [&](auto queue) {
    using Wave = Wavefront<double, SaddleLabel<double>, decltype(queue), true>;
    SidedFront<Wave> front(
        Wave(workspace.marks, workspace.saddles.reserve(mesh.face_count() + 1), queue,
             workspace.source.data(), mesh.face_count(), mesh.unit(), options),
        seeds);
    const SaddleRule<double, SidedFront<Wave>> rule(mesh.triangles(), front, options.vectorised);
    surface::solve<double, true>(mesh, parts.points, options, workspace, rule, front, Alone{},
                                 field, Curves(mesh, seeds, workspace));
  });
}

}  // namespace plexway::detail
