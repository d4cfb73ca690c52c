#pragma once

#include <cmath>
#include <limits>

#include <plexway/propagate/saddle_rule.hpp>

#include "propagate/mixed_piece.hpp"
#include "propagate/read_out.hpp"
#include "propagate/triangle_propagation.hpp"

namespace plexway {

/// A surface in a mixed domain.
template <class Real>
class MixedSurface final : public MixedPiece<Real> {
 public:
  using typename MixedPiece<Real>::Member;
  using typename MixedPiece<Real>::Found;
  using Wave = Wavefront<Real, SaddleLabel<Real>, DualQueue<Real>, true>;
  using Rule = SaddleRule<Real, Wave>;

  MixedSurface(const TriangleMesh<Real>& mesh, Workspace<Real>& workspace,
               const PropagateOptions& options, Real step)
      : mesh_(mesh),
        workspace_(prepare(mesh, workspace)),
        options_(options),
        unit_(static_cast<Real>(mesh.unit())),
        wave_(workspace.marks, workspace.saddles.reserve(mesh.face_count() + 1),
              DualQueue<Real>(workspace.front, step), workspace.source.data(), mesh.face_count(),
              mesh.unit(), options_),
        rule_(mesh.triangles(), wave_, options.vectorised),
        propagation_(mesh, workspace, rule_, wave_, options_) {}

  void seed(const PointSource& source, Index number) override { propagation_.seed(source, number); }
  void run(std::size_t budget) override {
    options_.max_expansions = budget;
    propagation_.run();
  }

  Found at_vertex(Index vertex) override {
    Found best = {infinity, none};
    mesh_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners) {
      if (!wave_.reached(c / 3)) continue;
      const Real d = rule_.corner_distance(c / 3, c % 3) * unit_;
      if (d < best.distance) best = {d, wave_.source(c / 3)};
    }
    return best;
  }

  bool enter_vertex(Index vertex, Real distance, Index source) override {
    if (!this->gains(at_vertex(vertex).distance, distance)) return false;
    bool any = false;
    mesh_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners)
      any |= rule_.seed_corner(c / 3, c % 3, distance / unit_, source);
    return any;
  }

  Real distance(Index f) const override {
    return wave_.reached(f) ? rule_.distance(f) * unit_ : infinity;
  }

  PosedSource<Real> leave(const Member& m, int dimension) const override {
    if (dimension == 1) {
      const auto [edge, turned] = edge_of(m);
      const auto p = rule_.seen_from(m.simplex, edge);
      const Real length = mesh_.triangles()[m.simplex].length[edge];
      const Real x = turned ? length - p.source.x[0] : p.source.x[0];
      return {x * unit_, 0, p.source.h * unit_, p.sigma * unit_, wave_.source(m.simplex)};
    }
    const std::size_t in = wave_.hinge(m.simplex);
    const auto p = rule_.seen_from_centre(m.simplex);
    const Frame frame(mesh_.triangles()[m.simplex], in, m);
    const Real dx = p.source.x[0] - frame.x0, dy = -p.source.h - frame.y0;
    return {(dx * frame.ux + dy * frame.uy) * unit_, (dx * frame.wx + dy * frame.wy) * unit_, 0,
            p.sigma * unit_, wave_.source(m.simplex)};
  }

  bool enter(const Member& m, int dimension, const PosedSource<Real>& from, Index) override {
    const Real x = from.x / unit_, y = from.y / unit_, h = from.h / unit_;
    const Real sigma = from.sigma / unit_;
    if (dimension == 1) {
      const auto [edge, turned] = edge_of(m);
      const Real length = mesh_.triangles()[m.simplex].length[edge];
      return rule_.enter_over(m.simplex, edge, turned ? length - x : x, h, sigma, from.source);
    }
    const Frame frame(mesh_.triangles()[m.simplex], 0, m);
    return rule_.enter_from_above(m.simplex, frame.x0 + x * frame.ux + y * frame.wx,
                                  frame.y0 + x * frame.uy + y * frame.wy, h, sigma, from.source);
  }

  void read_out(std::span<Real> distance, std::span<Index> label) override {
    const std::size_t vertices = mesh_.vertex_count();
    workspace_.vertex.assign(vertices, infinity);
    workspace_.vertex_source.assign(vertices, none);
    read_out_triangles<Real, true>(mesh_.triangles(), rule_, wave_, workspace_);
    for (Index v = 0; v < vertices; ++v)
      if (!(workspace_.vertex[v] < infinity))
        read_out_around<Real, true>(mesh_, rule_, wave_, v, workspace_);
    this->take_out(mesh_, workspace_, distance, label);
  }

  bool relax(std::span<Real> distance, std::span<Index> label) override {
    return this->relax_with(mesh_, workspace_, distance, label,
                            [&] { return read_out_edges<Real, true>(mesh_, workspace_).any; });
  }

  PropagateStatistics statistics() const override {
    return {wave_.expansions(), wave_.updates(), wave_.reached_count()};
  }
  bool out_of_budget() const override { return wave_.out_of_budget(); }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  static Workspace<Real>& prepare(const TriangleMesh<Real>& mesh, Workspace<Real>& workspace) {
    workspace.front.reserve(mesh.face_count());
    workspace.start(mesh.face_count(), true);
    return workspace;
  }

  // The triangle's edge between the hinge's vertices, and whether it runs from the second.
  static std::pair<std::size_t, bool> edge_of(const Member& m) {
    const std::size_t i = m.corner[0], j = m.corner[1];
    return j == edge_after(i) ? std::pair(i, false) : std::pair(j, true);
  }

  // The hinge's frame in the plane of a triangle, with one of its edges as the x axis.
  struct Frame {
    Real x0, y0, ux, uy, wx, wy;
    Frame(const TriangleRecord<Real>& t, std::size_t edge, const Member& m) {
      const auto at = [&](std::size_t corner) -> std::array<Real, 2> {
        if (corner == edge) return {0, 0};
        if (corner == edge_after(edge)) return {t.length[edge], 0};
        return {t.apex_x(edge), t.apex_h(edge)};
      };
      const auto a = at(m.corner[0]), b = at(m.corner[1]), c = at(m.corner[2]);
      x0 = a[0], y0 = a[1], ux = b[0] - a[0], uy = b[1] - a[1];
      const Real length = std::sqrt(ux * ux + uy * uy);
      if (length > 0) ux /= length, uy /= length;
      wx = -uy, wy = ux;
      if ((c[0] - x0) * wx + (c[1] - y0) * wy < 0) wx = -wx, wy = -wy;
    }
  };

  const TriangleMesh<Real>& mesh_;
  Workspace<Real>& workspace_;
  PropagateOptions options_;
  Real unit_;
  Wave wave_;
  Rule rule_;
  TrianglePropagation<Real, Rule, Wave, true> propagation_;
};

}  // namespace plexway
