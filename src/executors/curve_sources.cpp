#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "executors/curve_sources.hpp"
#include "executors/solve_surface.hpp"
#include "propagate/alone.hpp"
#include "propagate/border_light.hpp"
#include "propagate/curve_pieces.hpp"
#include "propagate/curve_seeds.hpp"

/// Fields from curves and triangles on a surface.
namespace plexway::detail {
namespace {

void add_shapes(const TriangleMesh<double>& mesh, std::span<const Source> sources,
                SourceParts& parts, CurveSeeds& seeds) {
  const SourceDomain domain = source_domain(mesh);
  std::vector<std::vector<CurvePiece>> pieces;
  // Points first: they have the first numbers.
  for (const Index n : parts.shapes) {
    const auto take = [&, n](PointSource at, double offset) {
      at.offset = offset;
      parts.points.push_back(at);
      parts.owner.push_back(n);
    };
    if (const auto* curve = std::get_if<CurveSource>(&sources[n])) {
      for (const PointSource& at : curve->points)
        if (!names_nothing(at))
          check_source(PointSource{at.vertex, at.simplex, at.barycentric}, domain);
      pieces.push_back(cut_curve(mesh, curve->points));
      const std::vector<bool> shows = shows_as_point(mesh, curve->points, pieces.back());
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
  }
  auto next = pieces.begin();
  for (const Index n : parts.shapes) {
    const Index number = static_cast<Index>(parts.owner.size());
    parts.owner.push_back(n);
    if (const auto* curve = std::get_if<CurveSource>(&sources[n]))
      seeds.add_curve(mesh, *next++, curve->offset, number);
    else if (const auto* face = std::get_if<SimplexSource>(&sources[n]))
      seeds.add_face(mesh, face->simplex, face->offset, number);
  }
}

// A front that keeps light out of triangles that a curve crosses: there it would count heights from
// the one side as less than nothing on the other. These have the feet of their centres.
template <class Wave>
class SidedFront : public Wave {
 public:
  /// `keeps_light` has room for all triangles, 0 each.
  SidedFront(const Wave& wave, const CurveSeeds& curves, std::uint8_t* keeps_light)
      : Wave(wave), curves_(&curves), keeps_light_(keeps_light) {}

  [[nodiscard]] bool keeps_light(Index f) const { return keeps_light_[f] != 0; }

  [[gnu::always_inline]] void accept(Index f, std::size_t hinge, const SaddleLabel<double>& label,
                                     double distance, Index source) {
    const bool light = label.sigma() < 0;  // only light starts at less than 0
    if (light && curves_->crosses(source, f)) [[unlikely]]
      return;
    keeps_light_[f] = light;
    Wave::accept(f, hinge, label, distance, source);
  }

 private:
  const CurveSeeds* curves_;
  std::uint8_t* keeps_light_;
};

// Curves as a solve takes them.
template <bool kLabels>
class Curves {
 public:
  Curves(const TriangleMesh<double>& mesh, const CurveSeeds& seeds,
         WorkspaceState<double>& workspace)
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
      if constexpr (kLabels) workspace_.vertex_source[v] = number;
    };
    if (!front.out_of_budget()) BorderLight<Front>(mesh_, seeds_, front).offer_corners(offer);
    for (double& d : workspace_.vertex) d = std::max(d, 0.);
    seeds_.offer_corners(offer);
  }

 private:
  const TriangleMesh<double>& mesh_;
  const CurveSeeds& seeds_;
  WorkspaceState<double>& workspace_;
};

template <bool kLabels>
void solve(const TriangleMesh<double>& mesh, const SourceParts& parts, const CurveSeeds& seeds,
           const PropagateOptions& options, WorkspaceState<double>& workspace,
           DistanceField<double>& field) {
  workspace.front.reserve(mesh.face_count());
  workspace.start(mesh.face_count(), kLabels);
  std::vector<std::uint8_t> keeps_light(mesh.face_count() + 1, 0);
  with_queue<double>(options, workspace.front, [&](auto queue) {
    using Wave = Wavefront<double, SaddleLabel<double>, decltype(queue), kLabels>;
    SidedFront<Wave> front(
        Wave(workspace.marks, workspace.saddles.reserve(mesh.face_count() + 1), queue,
             workspace.source.data(), mesh.face_count(), mesh.unit(), options),
        seeds, keeps_light.data());
    const SaddleRule<double, SidedFront<Wave>> rule(mesh.triangles(), front, options.vectorised);
    surface::solve<double, kLabels>(mesh, parts.points, options, workspace, rule, front, Alone{},
                                    field, Curves<kLabels>(mesh, seeds, workspace));
  });
}

}  // namespace

void solve_shapes(const Serial&, const TriangleMesh<double>& mesh, std::span<const Source> sources,
                  SourceParts& parts, const PropagateOptions& options, Workspace<double>& kept,
                  DistanceField<double>& field) {
  WorkspaceState<double>& workspace = kept.state();
  CurveSeeds seeds;
  add_shapes(mesh, sources, parts, seeds);
  seeds.sort(mesh.face_count(), sources.size() == 1);
  check(parts.points, options, mesh);
  if (sources.size() > 1)
    solve<true>(mesh, parts, seeds, options, workspace, field);
  else
    solve<false>(mesh, parts, seeds, options, workspace, field);
}

}  // namespace plexway::detail
