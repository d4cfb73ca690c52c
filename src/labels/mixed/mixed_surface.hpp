#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "labels/alone.hpp"
#include "labels/mixed/mixed_front.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/read_out.hpp"
#include "labels/read_out_edges.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"

namespace plexway {

/// A surface in a mixed domain.
template <class Real>
class MixedSurface final : public MixedPiece<Real> {
 public:
  using typename MixedPiece<Real>::Member;
  using typename MixedPiece<Real>::Found;
  using Wave = MixedFront<Real, SaddleLabel<Real>>;
  using Rule = SaddleRule<Real, Wave>;

  MixedSurface(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace,
               const PropagateOptions& options, Real step)
      : mesh_(mesh),
        workspace_(prepare(mesh, workspace)),
        options_(options),
        unit_(static_cast<Real>(mesh.unit())),
        wave_({workspace.marks, workspace.saddles.reserve(mesh.face_count() + 1),
               DualQueue<Real>(workspace.front, step), workspace.source.data(), mesh.face_count(),
               mesh.unit(), options_},
              this->expanded_),
        rule_(mesh.triangles(), wave_, options.vectorised),
        propagation_(mesh, workspace, rule_, wave_, options_) {}

  void seed(const PointSource& source, Index number) override { propagation_.seed(source, number); }
  void run(Real horizon, std::size_t budget) override {
    options_.max_expansions = budget;
    wave_.withdraw_all_but(budget - wave_.expansions());
    wave_.queue().set_horizon(horizon / unit_);
    propagation_.spread(propagation_.last_resort(revivals_));
  }
  Real nearest() const override { return wave_.queue().nearest() * unit_; }
  void hold() override { wave_.queue().set_horizon(0); }
  bool repair() override {
    if (propagation_.repair(revivals_)) return true;
    revivals_ = 0;
    return false;
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

  bool enter_vertex(Index vertex, Real distance, Index source, bool bends) override {
    if (bends)
      distance *= 1 + this->bend_loss;
    else if (!this->gains(at_vertex(vertex).distance, distance))
      return false;
    bool any = false;
    mesh_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners)
      any |= rule_.seed_corner(c / 3, c % 3, distance / unit_, source);
    return any;
  }

  Real distance(Index f) const override {
    return wave_.reached(f) ? rule_.distance(f) * unit_ : infinity;
  }

  Index vertex_of(Index simplex, std::size_t corner) const override {
    return mesh_.triangles()[simplex].corner[corner];
  }
  HingeShape<Real> shape(const Member& m, int dimension) const override {
    const TriangleRecord<Real>& t = mesh_.triangles()[m.simplex];
    if (dimension == 1) return {t.length[edge_of(m).first] * unit_};
    const Frame frame(t, 0, m);
    return {frame.length * unit_, frame.x2 * unit_, frame.y2 * unit_};
  }

  PosedSource<Real> leave(const Member& m, int dimension,
                          const HingePlace<Real>& b) const override {
    Member all = m;  // of an edge, with the triangle's third corner
    if (dimension == 1) all.corner[2] = static_cast<std::uint8_t>(3 - m.corner[0] - m.corner[1]);
    const Frame frame(mesh_.triangles()[m.simplex], wave_.hinge(m.simplex), all);
    const Real along = b[0] * frame.length + b[1] * frame.x2, off = b[1] * frame.y2;
    const auto p = rule_.seen_from(m.simplex, {{frame.x0 + along * frame.ux + off * frame.wx},
                                               frame.y0 + along * frame.uy + off * frame.wy});
    const Real dx = p.source.x[0] - frame.x0, dy = -p.source.h - frame.y0;
    const Real x = dx * frame.ux + dy * frame.uy, y = dx * frame.wx + dy * frame.wy;
    const Real sigma = p.sigma * unit_;
    if (dimension == 1) return {x * unit_, 0, std::abs(y) * unit_, sigma, wave_.source(m.simplex)};
    return {x * unit_, y * unit_, 0, sigma, wave_.source(m.simplex)};
  }

  bool enter(const Member& m, int dimension, const PosedSource<Real>& from,
             const std::pair<Real, Real>& line) override {
    const Real x = from.x / unit_, y = from.y / unit_, h = from.h / unit_;
    const Real sigma = from.sigma / unit_;
    if (dimension == 1) {
      const auto place = edge_of(m);
      const auto edge = place.first;
      const bool turned = place.second;
      const Real length = mesh_.triangles()[m.simplex].length[edge];
      const auto along = [&](Real at) { return turned ? length - at : at; };
      typename Rule::Posed p;
      p.source = p.limit[0] = p.limit[1] = {{along(x)}, h};
      p.sigma = sigma;
      if (std::isfinite(line.first)) {
        p.limit[turned ? 1 : 0] = {{along(line.first / unit_)}, Real(0)};
        p.limit[turned ? 0 : 1] = {{along(line.second / unit_)}, Real(0)};
      }
      const std::size_t updates = wave_.updates();
      rule_.enter_posed(m.simplex, edge, p, from.source);
      return wave_.updates() != updates;
    }
    const Frame frame(mesh_.triangles()[m.simplex], 0, m);
    return rule_.enter_from_above(m.simplex, frame.x0 + x * frame.ux + y * frame.wx,
                                  frame.y0 + x * frame.uy + y * frame.wy, h, sigma, from.source);
  }

  // Over an edge into the triangles there; over a triangle, over each of its edges: beyond the
  // critical angle a path runs along the surface.
  bool enter_front(const Member& m, const HingeFront<Real>& front, Vector3<Real>&) override {
    if (front.dimension == 1) {
      const auto [edge, turned] = edge_of(m);
      return enter_beam(m.simplex, edge, turned, front, {0, 0}, {1, 0});
    }
    static constexpr Real corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = i == 2 ? 0 : i + 1;
      Member of_edge = m;
      of_edge.corner[0] = m.corner[i];
      of_edge.corner[1] = m.corner[j];
      const auto [edge, turned] = edge_of(of_edge);
      any |= enter_beam(m.simplex, edge, turned, front, {corner[i][0], corner[i][1]},
                        {corner[j][0], corner[j][1]});
      const Index start = mesh_.triangles()[m.simplex].across[edge];
      bool flip = (start & Across::flip) != 0;
      for (Index across = start;;) {
        const Index g = across >> Across::face_shift;
        const std::size_t k = across & Across::edge_mask;
        if (g == mesh_.face_count() || (g == m.simplex && k == edge)) break;
        any |= enter_from_inside(m, front, edge, turned, g, k, turned == flip);
        any |= enter_beam(g, k, turned == flip, front, {corner[i][0], corner[i][1]},
                          {corner[j][0], corner[j][1]});
        if (!(across & Across::fan)) break;
        across = mesh_.triangles()[g].across[k];
        flip = flip == ((across & Across::flip) != 0);
      }
    }
    return any;
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
    return this->relax_with(mesh_, workspace_, distance, label, [&] {
      return read_out_edges<Real, true>(mesh_, workspace_, Alone{}).any;
    });
  }

  PropagateStatistics statistics() const override {
    return {wave_.expansions(), wave_.updates(), wave_.reached_count()};
  }
  bool out_of_budget() const override { return wave_.out_of_budget(); }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  static WorkspaceState<Real>& prepare(const TriangleMesh<Real>& mesh,
                                       WorkspaceState<Real>& workspace) {
    workspace.front.reserve(mesh.face_count());
    workspace.start(mesh.face_count(), true);
    return workspace;
  }

  // The triangle's edge between the hinge's vertices, and whether it runs from the second.
  static std::pair<std::size_t, bool> edge_of(const Member& m) {
    const std::size_t i = m.corner[0], j = m.corner[1];
    return j == edge_after(i) ? std::pair(i, false) : std::pair(j, true);
  }

  // Over edge k of f, which runs from `first` to `second` on the hinge or, `turned`, back. Beyond,
  // the front is along one ray that of a point, to second order: see saddle_refraction.hpp. The
  // point is put so near that no distance in its beam is shorter than what the front has at the
  // edge; the ends of the beam are its limits.
  bool enter_beam(Index f, std::size_t k, bool turned, const HingeFront<Real>& front,
                  HingePlace<Real> first, HingePlace<Real> second) {
    using Pose = typename Rule::Posed;
    const TriangleRecord<Real>& t = mesh_.triangles()[f];
    if (turned) std::swap(first, second);
    const auto p = front.shape.place(first), q = front.shape.place(second);
    const Real width = std::hypot(q[0] - p[0], q[1] - p[1]) / unit_, extent = t.length[k];
    if (!(width > 0 && extent > 0)) return false;
    const Real ux = (q[0] - p[0]) / (width * unit_), uy = (q[1] - p[1]) / (width * unit_);
    const Real scale = extent / width;
    // The source as a point of the edge sees it.
    const auto seen = [&](Real s) {
      const Real b = s / width;
      const PosedSource<Real> eye = front.seen_from(
          {first[0] + b * (second[0] - first[0]), first[1] + b * (second[1] - first[1])});
      const Real dx = eye.x - p[0], dy = eye.y - p[1], off = dx * uy - dy * ux;
      Pose posed;
      posed.source = {{(dx * ux + dy * uy) / unit_}, std::sqrt(off * off + eye.h * eye.h) / unit_};
      posed.sigma = eye.sigma / unit_;
      return posed;
    };
    const typename Rule::Point centre = {{(extent + t.apex_x(k)) / 3}, t.apex_h(k) / 3};
    Real s = width / 2, before = 0, distance = std::numeric_limits<Real>::infinity();
    Pose eye = seen(s);
    for (int i = 0; i < 4; ++i) {
      const Real next = detail::fermat_crossing<Real>(eye.source, centre, width, scale);
      const Pose there = seen(next);
      const Real reach = std::hypot(there.source.x[0] - next, there.source.h);
      const Real way = there.sigma + reach + std::hypot(centre.x[0] - scale * next, centre.h);
      if (!(way < distance)) break;
      distance = way, s = next, before = reach;
      const bool same = there.source.x[0] == eye.source.x[0] && there.source.h == eye.source.h;
      eye = there;
      if (same) break;
    }
    if (wave_.reached(f) && !(distance < rule_.distance(f) * (1 - this->crossing_gain)))
      return false;
    eye = seen(s);
    const typename Rule::Point S = eye.source;
    Pose label;
    if (s <= 0 || s >= width) {  // bends at an end
      label.sigma = eye.sigma + before;
      label.source = label.limit[0] = label.limit[1] = {{s <= 0 ? Real(0) : extent}, Real(0)};
    } else {
      // The beam: not farther along the edge than S, and what enters: beyond the critical angle
      // paths run along the edge.
      Real low = 0, high = width;
      if (scale < 1) {
        const Real critical = S.h * scale / std::sqrt(1 - scale * scale);
        low = std::max(low, S.x[0] - critical);
        high = std::min(high, S.x[0] + critical);
      }
      low = std::min(std::max(low, s - before / 2), s);
      high = std::max(std::min(high, s + before / 2), s);
      const Real after = std::hypot(centre.x[0] - scale * s, centre.h);
      const Real along_ray = after > 0 ? (centre.x[0] - scale * s) / after : Real(0);
      const Real out = after > 0 ? centre.h / after : Real(1);
      // Where light enters along the edge, the front beyond is straight.
      const Real farthest = extent * (sizeof(Real) == 4 ? Real(300) : Real(1e5));
      const Real in2 = before > 0 ? (S.h / before) * (S.h / before) : Real(1);
      const Real wanted = scale * scale * out * out * before;
      Real radius = wanted < in2 * farthest ? wanted / in2 : farthest;
      const Real rounding =
          64 * std::numeric_limits<Real>::epsilon() * (std::abs(S.x[0]) + std::abs(S.h) + width);
      for (const Real end : {low, high}) {
        const Pose there = seen(end);
        const Real longer =
            there.sigma + std::hypot(there.source.x[0] - end, there.source.h) - eye.sigma - before;
        const Real along = scale * (end - s), bow = longer - along * along_ray;
        if (bow > rounding)
          radius =
              std::min(radius, std::max((along * along - longer * longer) / (2 * bow), Real(0)));
      }
      label.sigma = eye.sigma + before - radius;
      label.source = {{scale * s - radius * along_ray}, radius * out};
      label.limit[0] = {{scale * low}, Real(0)};
      label.limit[1] = {{scale * high}, Real(0)};
    }
    const std::size_t updates = wave_.updates();
    rule_.enter_posed(f, k, label, front.source);
    return wave_.updates() != updates;
  }

  // From a crossing inside the hinge, a triangle of this surface, over its edge into g: the front
  // beyond is that of a point to second order, as above, now by what the ends of the beam get over
  // all of the hinge.
  bool enter_from_inside(const Member& m, const HingeFront<Real>& front, std::size_t edge,
                         bool turned, Index g, std::size_t k, bool turned_there) {
    const TriangleRecord<Real>& t = mesh_.triangles()[g];
    const Real extent = t.length[k];
    const Real own = mesh_.triangles()[m.simplex].length[edge];
    if (!(std::abs(extent - own) <= this->crossing_gain * own) || !(extent > 0)) return false;
    const HingeShape<Real> shape = this->shape(m, 2);
    const Frame frame(mesh_.triangles()[m.simplex], edge, m);
    // A point beside edge k of g, (along, beyond), in the hinge's frame.
    const auto place = [&](Real along, Real beyond) -> HingeEnd<Real> {
      // Edge `edge` of the member runs as k does, or against it.
      const Real x = turned_there == turned ? along : own - along;
      const Real dx = x - frame.x0, dy = -beyond - frame.y0;
      return {(dx * frame.ux + dy * frame.uy) * unit_, (dx * frame.wx + dy * frame.wy) * unit_, 0};
    };
    const typename Rule::Point centre = {{(extent + t.apex_x(k)) / 3}, t.apex_h(k) / 3};
    const auto path = front.shortest(shape, place(centre.x[0], centre.h));
    if (wave_.reached(g) && !(path.extent < distance(g) * (1 - this->crossing_gain))) return false;
    // The crossing, posed on k.
    const auto b = shape.place(path.crossing);
    const Real bx = (b[0] * frame.ux + b[1] * frame.wx) / unit_ + frame.x0;
    const Real by = (b[0] * frame.uy + b[1] * frame.wy) / unit_ + frame.y0;
    const Real along = turned_there == turned ? bx : own - bx;
    if (!(by > Real(1e-3) * extent)) return false;  // as good as on the edge
    const Real before = path.before / unit_, after = std::hypot(centre.x[0] - along, centre.h + by);
    const Real rx = (centre.x[0] - along) / after, ry = (centre.h + by) / after;
    const Real s = along + rx / ry * by;
    if (!(s > 0 && s < extent)) return false;
    const Real low = std::max(Real(0), s - extent / 2), high = std::min(extent, s + extent / 2);
    Real radius = extent * (sizeof(Real) == 4 ? Real(300) : Real(1e5));
    const Real rounding = 64 * std::numeric_limits<Real>::epsilon() * (before + extent);
    for (const Real end : {low, high}) {
      const Real longer = front.shortest(shape, place(end, 0)).extent / unit_ - before;
      const Real dx = (end - along) * rx + by * ry, dy = (end - along) * ry - by * rx;
      const Real bow = longer - dx;
      if (bow > rounding)
        radius =
            std::min(radius, std::max((dx * dx + dy * dy - longer * longer) / (2 * bow), Real(0)));
    }
    typename Rule::Posed label;
    label.sigma = before - radius;
    label.source = {{along - radius * rx}, by + radius * ry};
    label.limit[0] = {{low}, Real(0)};
    label.limit[1] = {{high}, Real(0)};
    const std::size_t updates = wave_.updates();
    rule_.enter_posed(g, k, label, front.source);
    return wave_.updates() != updates;
  }

  // The hinge's frame in the plane of a triangle, with one of its edges as the x axis.
  struct Frame {
    Real x0, y0, ux, uy, wx, wy;
    Real length, x2, y2;  // the hinge's vertices in it: (0, 0), (length, 0), (x2, y2)
    Frame(const TriangleRecord<Real>& t, std::size_t edge, const Member& m) {
      const auto at = [&](std::size_t corner) -> std::array<Real, 2> {
        if (corner == edge) return {0, 0};
        if (corner == edge_after(edge)) return {t.length[edge], 0};
        return {t.apex_x(edge), t.apex_h(edge)};
      };
      const auto a = at(m.corner[0]), b = at(m.corner[1]), c = at(m.corner[2]);
      x0 = a[0], y0 = a[1], ux = b[0] - a[0], uy = b[1] - a[1];
      length = std::sqrt(ux * ux + uy * uy);
      if (length > 0) ux /= length, uy /= length;
      wx = -uy, wy = ux;
      if ((c[0] - x0) * wx + (c[1] - y0) * wy < 0) wx = -wx, wy = -wy;
      x2 = (c[0] - x0) * ux + (c[1] - y0) * uy;
      y2 = (c[0] - x0) * wx + (c[1] - y0) * wy;
    }
  };

  const TriangleMesh<Real>& mesh_;
  WorkspaceState<Real>& workspace_;
  PropagateOptions options_;
  Real unit_;
  Wave wave_;
  Rule rule_;
  TrianglePropagation<Real, Rule, Wave, true> propagation_;
  int revivals_ = 0;
};

}  // namespace plexway
