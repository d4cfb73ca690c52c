#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/alone.hpp"
#include "labels/read_out.hpp"
#include "labels/surface/repair_surface.hpp"
#include "labels/surface/saddle_offers.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wireframe/wire_propagation.hpp"
#include "strings/solid_strings.hpp"
#include "strings/to_field.hpp"

/// The pieces of a mixed domain while it is solved, each by the rule that it has alone: surfaces by
/// labels, solids by strings, wires along their edges. What a piece knows stays, and further
/// sources go on from there as far as they are nearer.
namespace plexway::detail {

/// In the piece's own numbers and the domain's unit; `number` is the caller's.
struct MixedSource {
  PointSource at;
  Index number;
  bool inside = false;  ///< it is a point of a simplex by the number inside
};

/// A distance in the domain's unit, and from which source.
struct MixedFound {
  double distance = std::numeric_limits<double>::infinity();
  Index source = none;
};

template <class Real>
class MixedPiece {
 public:
  MixedPiece() = default;
  MixedPiece(const MixedPiece&) = delete;
  MixedPiece& operator=(const MixedPiece&) = delete;
  virtual ~MixedPiece() = default;

  /// Returns what it took; `complete` becomes false if the options' expansions ended before it did.
  /// Throws Cancelled.
  virtual PropagateStatistics add(std::span<const MixedSource> sources,
                                  const PropagateOptions& options, bool& complete) = 0;
  /// Lowers distances and labels, one a vertex in the caller's order, to what is known now.
  virtual void read_out(std::span<Real> distance, std::span<Index> label) const = 0;
  /// To points of edges, inside.
  virtual void read_out(std::span<const PointSource> points, std::span<MixedFound> found) = 0;

 protected:
  static void lower(Real by, Index number, Real& distance, Index& label) {
    if (by < distance) distance = by, label = number;
  }
};

template <class Real>
class MixedSurface final : public MixedPiece<Real> {
 public:
  MixedSurface(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace)
      : mesh_(mesh), workspace_(workspace) {
    workspace.front.reserve(mesh.face_count());
    workspace.start(mesh.face_count(), true);
    workspace.vertex.assign(mesh.vertex_count(), infinity);
    workspace.vertex_source.assign(mesh.vertex_count(), none);
  }

  PropagateStatistics add(std::span<const MixedSource> sources, const PropagateOptions& options,
                          bool& complete) override {
    Wave wave = front(options);
    wave.resume(reached_);
    const SaddleRule<Real, Wave> rule(mesh_.triangles(), wave, options.vectorised);
    TrianglePropagation<Real, SaddleRule<Real, Wave>, Wave, true> propagation(mesh_, workspace_,
                                                                              rule, wave, options);
    for (const MixedSource& source : sources) {
      const auto number = static_cast<Index>(sources_.size());
      sources_.push_back(source.inside ? outside(source.at) : source.at);
      number_.push_back(source.number);
      propagation.seed(sources_.back(), number);
      offer_source(mesh_, sources_.back(), [&](Index v, double d) {
        this->lower(static_cast<Real>(d), number, workspace_.vertex[v],
                    workspace_.vertex_source[v]);
      });
    }
    propagation.run();
    read_out_triangles<Real, true>(mesh_.triangles(), rule, wave, workspace_);
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (!(workspace_.vertex[v] < infinity))
        read_out_around<Real, true>(mesh_, rule, wave, v, workspace_);
    const surface::Repaired repaired =
        surface::repair<Real, true>(mesh_, sources_, workspace_, Alone{});
    complete = !wave.out_of_budget();
    PropagateStatistics took = wave.statistics();
    took.reached_simplices -= std::exchange(reached_, took.reached_simplices);
    took.raised_vertices = repaired.raised;
    took.lowered_vertices = repaired.lowered;
    return took;
  }
  void read_out(std::span<Real> distance, std::span<Index> label) const override {
    const std::span<const Index> inside = mesh_.vertices_inside();
    for (std::size_t v = 0; v < inside.size(); ++v)
      if (const Index source = workspace_.vertex_source[inside[v]]; source != none)
        this->lower(workspace_.vertex[inside[v]] * static_cast<Real>(mesh_.unit()), number_[source],
                    distance[v], label[v]);
  }
  void read_out(std::span<const PointSource> points, std::span<MixedFound> found) override {
    Wave wave = front({});
    const SaddleOffers<Real, Wave> labels(mesh_.triangles(), wave, true);
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Index f = points[n].simplex;
      const std::array<double, 4>& b = points[n].barycentric;
      const auto ask = [&](Index g, const std::array<double, 4>& weights) {
        if (!wave.reached(g)) return;
        const double d = static_cast<double>(labels.distance_at(g, weights)) * mesh_.unit();
        if (d < found[n].distance) found[n] = {d, number_[wave.source(g)]};
      };
      ask(f, b);
      // The triangle beyond the edge may know better.
      const std::size_t edge = edge_after(b[0] == 0 ? 0 : b[1] == 0 ? 1 : 2);
      const Index across = mesh_.triangles()[f].across[edge], g = across >> Across::face_shift;
      if (g == mesh_.face_count() || (across & Across::fan)) continue;
      const std::size_t k = across & Across::edge_mask;
      const bool flip = (across & Across::flip) != 0;
      std::array<double, 4> there = {0, 0, 0, 0};
      there[k] = b[flip ? edge : edge_after(edge)];
      there[edge_after(k)] = b[flip ? edge_after(edge) : edge];
      ask(g, there);
    }
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  using Wave = Wavefront<Real, SaddleLabel<Real>, DualQueue<Real>, true>;
  Wave front(const PropagateOptions& options) {
    return Wave(workspace_.marks, workspace_.saddles.reserve(mesh_.face_count() + 1),
                DualQueue<Real>(workspace_.front, step_of<Real>(options)), workspace_.source.data(),
                mesh_.face_count(), mesh_.unit(), options);
  }
  [[nodiscard]] PointSource outside(PointSource at) const {
    const Index face = mesh_.triangles()[at.simplex].face;
    if (face & reversed) std::swap(at.barycentric[1], at.barycentric[2]);
    at.simplex = face & ~reversed;
    return at;
  }

  const TriangleMesh<Real>& mesh_;
  WorkspaceState<Real>& workspace_;
  std::vector<PointSource> sources_;
  std::vector<Index> number_;  // of each, the caller's
  std::size_t reached_ = 0;
};

template <class Real>
class MixedSolid final : public MixedPiece<Real> {
 public:
  explicit MixedSolid(const TetMesh<Real>& mesh)
      : mesh_(mesh), space_(space_of(mesh)), solver_(*space_) {
    solver_.clear();
    solver_.keep_near(.25);  // all of it takes a hundred times as long from skins, and is no better
  }

  PropagateStatistics add(std::span<const MixedSource> sources, const PropagateOptions& options,
                          bool& complete) override {
    std::vector<strings::Source> from;
    std::vector<strings::Inside> inside(sources.size());
    for (const MixedSource& source : sources) {
      from.push_back(source_at(source, inside[from.size()]));
      number_.push_back(source.number);
    }
    const strings::Counts before = solver_.counts();
    complete = solver_.add(from, strings::limits_of(options, mesh_.unit(), mesh_.tet_count()));
    return {solver_.counts().expansions - before.expansions,
            solver_.counts().labels - before.labels};
  }
  void read_out(std::span<Real> distance, std::span<Index> label) const override {
    for (Index v = 0; v < distance.size(); ++v) {
      const Index inside = mesh_.inside_vertex(v), source = solver_.source(inside);
      if (source != none)
        this->lower(static_cast<Real>(solver_.distance(inside) * mesh_.unit()), number_[source],
                    distance[v], label[v]);
    }
  }
  void read_out(std::span<const PointSource> points, std::span<MixedFound> found) override {
    for (std::size_t n = 0; n < points.size(); ++n) {
      strings::Inside inside;
      const strings::Source at = source_at({points[n], none, true}, inside);
      solver_.attach(at.at, at.inside, {});
      const auto attached = static_cast<Index>(space_->points());
      if (solver_.source(attached) != none)
        found[n] = {solver_.distance(attached) * mesh_.unit(), number_[solver_.source(attached)]};
    }
  }

 private:
  strings::Source source_at(const MixedSource& source, strings::Inside& inside) const {
    if (!source.inside) return source_of(mesh_, *space_, source.at, inside);
    return source_in(mesh_, *space_, source.at.simplex, source.at.barycentric,
                     source.at.offset / mesh_.unit(), inside);
  }

  const TetMesh<Real>& mesh_;
  std::shared_ptr<const strings::MediaSpace> space_;
  strings::Solver solver_;
  std::vector<Index> number_;  // of the solver's sources
};

template <class Real>
class MixedWire final : public MixedPiece<Real> {
 public:
  MixedWire(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace)
      : wireframe_(wireframe), workspace_(workspace) {
    workspace.front.reserve(wireframe.vertex_count());
    start_wires<true>(wireframe, workspace);
  }

  PropagateStatistics add(std::span<const MixedSource> sources, const PropagateOptions& options,
                          bool& complete) override {
    WirePropagation<Real, true> propagation(wireframe_, workspace_, options);
    propagation.run(workspace_.front, [&](auto& front) {
      for (const MixedSource& source : sources) propagation.seed(source.at, source.number, front);
    });
    complete = !propagation.out_of_budget();
    return propagation.statistics();
  }
  void read_out(std::span<Real> distance, std::span<Index> label) const override {
    const std::span<const Index> inside = wireframe_.vertices_inside();
    for (std::size_t v = 0; v < inside.size(); ++v)
      this->lower(std::abs(workspace_.vertex[inside[v]]) * static_cast<Real>(wireframe_.unit()),
                  workspace_.vertex_source[inside[v]], distance[v], label[v]);
  }
  void read_out(std::span<const PointSource>, std::span<MixedFound>) override {}

 private:
  const Wireframe<Real>& wireframe_;
  WorkspaceState<Real>& workspace_;
};

template <class Real>
std::unique_ptr<MixedPiece<Real>> make_piece(const TriangleMesh<Real>& mesh,
                                             WorkspaceState<Real>& workspace) {
  return std::make_unique<MixedSurface<Real>>(mesh, workspace);
}
template <class Real>
std::unique_ptr<MixedPiece<Real>> make_piece(const TetMesh<Real>& mesh, WorkspaceState<Real>&) {
  return std::make_unique<MixedSolid<Real>>(mesh);
}
template <class Real>
std::unique_ptr<MixedPiece<Real>> make_piece(const Wireframe<Real>& wireframe,
                                             WorkspaceState<Real>& workspace) {
  return std::make_unique<MixedWire<Real>>(wireframe, workspace);
}

}  // namespace plexway::detail
