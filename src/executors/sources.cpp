#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "executors/solve_surface.hpp"
#include "executors/sources.hpp"
#include "labels/alone.hpp"
#include "labels/curve_seeds.hpp"
#include "windows/window_solver.hpp"
#include "windows/window_sources.hpp"

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

namespace {

// A curve or a triangle, cut.
struct Shape {
  Index source;  ///< a place in the list
  std::vector<CurvePiece> pieces;
  std::size_t first, last;  ///< its points, among all
};

// Cuts curves, and adds what of them are points to the points. After those the shapes have numbers.
template <class Real>
std::vector<Shape> cut_shapes(const TriangleMesh<Real>& mesh, std::span<const Source> sources,
                              SourceParts& parts) {
  const SourceDomain domain = source_domain(mesh);
  std::vector<Shape> shapes;
  for (const Index n : parts.shapes) {
    Shape shape{n, {}, parts.points.size(), 0};
    const auto take = [&](PointSource at, double offset) {
      at.offset = offset;
      parts.points.push_back(at);
      parts.owner.push_back(n);
    };
    if (const auto* curve = std::get_if<CurveSource>(&sources[n])) {
      for (const PointSource& at : curve->points)
        if (!names_nothing(at))
          check_source(PointSource{at.vertex, at.simplex, at.barycentric}, domain);
      shape.pieces = cut_curve(mesh, std::span<const PointSource>(curve->points));
      const std::vector<bool> shows =
          shows_as_point(mesh, std::span<const PointSource>(curve->points),
                         std::span<const CurvePiece>(shape.pieces));
      for (std::size_t i = 0; i < shows.size(); ++i)
        if (shows[i]) take(curve->points[i], curve->offset);
    } else {
      const auto& face = std::get<SimplexSource>(sources[n]);
      check_source(PointSource::in(face.simplex, {1., 0., 0.}), domain);
      for (std::size_t i = 0; i < 3; ++i) {
        PointSource at{.simplex = face.simplex};
        at.barycentric[i] = 1;
        take(at, face.offset);
      }
    }
    shape.last = parts.points.size();
    shapes.push_back(std::move(shape));
  }
  for (const Shape& shape : shapes) parts.owner.push_back(shape.source);
  return shapes;
}

// Of labels or of windows.
template <class Real, class Seeds>
void add_shapes(const TriangleMesh<Real>& mesh, std::span<const Source> sources,
                std::span<const Shape> shapes, std::size_t points, Seeds& seeds) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Index number = static_cast<Index>(points + i);
    const Source& source = sources[shapes[i].source];
    if (const auto* curve = std::get_if<CurveSource>(&source))
      seeds.add_curve(mesh, shapes[i].pieces, curve->offset, number);
    else if (const auto* face = std::get_if<SimplexSource>(&source))
      seeds.add_face(mesh, face->simplex, face->offset, number);
  }
}

// False where windows become too many.
template <class Real>
bool solve_by_windows(const TriangleMesh<Real>& mesh, std::span<const Source> sources,
                      std::span<const Shape> shapes, const SourceParts& parts, Accuracy accuracy,
                      const PropagateOptions& options, WorkspaceState<Real>& workspace,
                      DistanceField<Real>& field) {
  windows::CurveLights seeds;
  add_shapes(mesh, sources, shapes, parts.points.size(), seeds);
  // A curve's points are that curve's, so that their light merges with its own.
  std::vector<Index> numbers(parts.points.size());
  for (Index n = 0; n < numbers.size(); ++n) numbers[n] = n;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t n = shapes[i].first; n < shapes[i].last; ++n)
      numbers[n] = static_cast<Index>(parts.points.size() + i);
  windows::WindowSources from;
  from.points = parts.points;
  from.numbers = numbers;
  from.lights = seeds.lights;
  from.corners = seeds.corners;
  from.labels = sources.size() > 1;
  return workspace.windows.on(mesh).solve_by(Alone{}, from, accuracy, options, workspace, field);
}

// A front that keeps light out of triangles that a curve crosses: there it would count heights from
// the one side as less than nothing on the other. These have the feet of their centres.
template <class Wave>
class SidedFront : public Wave {
 public:
  SidedFront(const Wave& wave, const CurveSeeds& curves) : Wave(wave), curves_(&curves) {}

  [[gnu::always_inline]] void accept(Index f, std::size_t hinge, const SaddleLabel<double>& label,
                                     double distance, Index source) {
    if (label.sigma() < 0 && curves_->crosses(source, f)) [[unlikely]]
      return;  // only light starts at less than 0
    Wave::accept(f, hinge, label, distance, source);
  }

 private:
  const CurveSeeds* curves_;
};

// Curves as a solve takes them.
template <bool kLabels>
class Curves {
 public:
  Curves(const CurveSeeds& seeds, WorkspaceState<double>& workspace)
      : seeds_(seeds), workspace_(workspace) {}

  template <class Rule, class Front>
  void seed(const Rule& rule, Front& front) const {
    seeds_.seed(rule, front);
  }
  // The corners of triangles that curves pass, exactly; no light is nearer than its source.
  template <class Front>
  void read_out(const Front&) const {
    const auto offer = [&](Index v, double d, Index number) {
      if (!(d < workspace_.vertex[v])) return;
      workspace_.vertex[v] = d;
      if constexpr (kLabels) workspace_.vertex_source[v] = number;
    };
    for (double& d : workspace_.vertex) d = std::max(d, 0.);
    seeds_.offer_corners(offer);
  }

 private:
  const CurveSeeds& seeds_;
  WorkspaceState<double>& workspace_;
};

template <bool kLabels>
void solve(const TriangleMesh<double>& mesh, const SourceParts& parts, const CurveSeeds& seeds,
           const PropagateOptions& options, WorkspaceState<double>& workspace,
           DistanceField<double>& field) {
  workspace.front.reserve(mesh.face_count());
  workspace.start(mesh.face_count(), kLabels);
  with_queue<double>(options, workspace.front, [&](auto queue) {
    using Wave = Wavefront<double, SaddleLabel<double>, decltype(queue), kLabels>;
    SidedFront<Wave> front(
        Wave(workspace.marks, workspace.saddles.reserve(mesh.face_count() + 1), queue,
             workspace.source.data(), mesh.face_count(), mesh.unit(), options),
        seeds);
    const SaddleRule<double, SidedFront<Wave>> rule(mesh.triangles(), front, options.vectorised);
    surface::solve<double, kLabels>(mesh, parts.points, options, workspace, rule, front, Alone{},
                                    field, Curves<kLabels>(seeds, workspace));
  });
}

}  // namespace

template <class E, class Real>
void solve_shapes(const E& executor, const TriangleMesh<Real>& mesh,
                  std::span<const Source> sources, SourceParts& parts,
                  const PropagateOptions& options, Workspace<Real>& kept,
                  DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  const std::vector<Shape> shapes = cut_shapes(mesh, sources, parts);
  check(std::span<const PointSource>(parts.points), options, mesh);
  const Accuracy accuracy =
      resolved(options.accuracy,
               with(combination<E, TriangleMesh<Real>>(SourceKind::curve), mesh.metric(), options));
  const bool by_windows = accuracy.kind() != Accuracy::Kind::fast;
  if (by_windows) {
    if constexpr (E::kind == ExecutorKind::openmp)
      static_cast<void>(team_size(executor));  // throws if it is none
    if (solve_by_windows(mesh, sources, std::span<const Shape>(shapes), parts, accuracy, options,
                         workspace, field)) {
      field.accuracy = accuracy;
      return;
    }
    field.error.clear();
  }
  if constexpr (E::kind == ExecutorKind::serial && std::is_same_v<Real, double>) {
    CurveSeeds seeds;
    add_shapes(mesh, sources, std::span<const Shape>(shapes), parts.points.size(), seeds);
    seeds.sort(mesh.face_count(), sources.size() == 1);
    if (sources.size() > 1)
      solve<true>(mesh, parts, seeds, options, workspace, field);
    else
      solve<false>(mesh, parts, seeds, options, workspace, field);
    field.statistics.windows_gave_up = by_windows;
  } else {
    throw EndlessError(
        "windows from a curve or a triangle became too many: solve by the executor Serial in "
        "double precision, where labels can take over, or look for triangles that lie on each "
        "other");
  }
}

#define PLEXWAY_SHAPES_ON(E, Real)                                                         \
  template void solve_shapes(const E&, const TriangleMesh<Real>&, std::span<const Source>, \
                             SourceParts&, const PropagateOptions&, Workspace<Real>&,      \
                             DistanceField<Real>&);
PLEXWAY_SHAPES_ON(Serial, float)
PLEXWAY_SHAPES_ON(Serial, double)
PLEXWAY_SHAPES_ON(OpenMP, float)
PLEXWAY_SHAPES_ON(OpenMP, double)
#undef PLEXWAY_SHAPES_ON

}  // namespace plexway::detail
