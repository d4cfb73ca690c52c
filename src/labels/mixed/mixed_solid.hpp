#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "labels/mixed/mixed_front.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/solid/solid_propagation.hpp"
#include "labels/solid/solid_read_out.hpp"
#include "labels/solid/solid_rule.hpp"

namespace plexway {

/// A solid in a mixed domain.
template <class Real>
class MixedSolid final : public MixedPiece<Real> {
 public:
  using typename MixedPiece<Real>::Member;
  using typename MixedPiece<Real>::Found;
  using Point = Vector3<Real>;
  using Wave = MixedFront<Real, SolidLabel<Real>>;
  using Rule = SolidRule<Real, Wave>;
  using Label = SolidLabel<Real>;

  MixedSolid(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace,
             const PropagateOptions& options, Real step)
      : mesh_(mesh),
        workspace_(prepare(mesh, workspace)),
        options_(options),
        unit_(static_cast<Real>(mesh.unit())),
        rings_(mesh.reflex_edges().begin(), mesh.reflex_edges().end()),
        wave_({workspace.marks, workspace.solids.reserve(mesh.tet_count() + 1),
               DualQueue<Real>(workspace.front, step), workspace.source.data(), mesh.tet_count(),
               mesh.unit(), options_},
              this->expanded_),
        propagation_(mesh, Rule(mesh, wave_), wave_, options_),
        rule_(propagation_.rule()) {
    find_torn();
  }

  void seed(const PointSource& source, Index number) override { propagation_.seed(source, number); }
  void run(Real horizon, std::size_t budget, Index first_front) override {
    options_.max_expansions = budget;
    wave_.withdraw_all_but(budget - wave_.expansions());
    wave_.queue().set_horizon(horizon / unit_);
    for (std::size_t before = this->expanded_.size();; before = this->expanded_.size()) {
      propagation_.spread(propagation_.last_resort(repairs_));
      for (std::size_t i = before; i < this->expanded_.size(); ++i)
        if (wave_.source(this->expanded_[i]) >= first_front)
          on_hinges_.push_back({this->expanded_[i], 0});
      if (wave_.out_of_budget() || !offer_around(horizon / unit_)) return;
    }
  }
  Real nearest() const override { return wave_.queue().nearest() * unit_; }
  void hold() override { wave_.queue().set_horizon(0); }
  bool repair() override {
    if (offer_around(infinity) || propagation_.repair(repairs_)) return true;
    repairs_ = 0;
    return false;
  }

  Found at_vertex(Index vertex) override {
    Found best = {infinity, none};
    for (const Index c : mesh_.corners_at(vertex)) {
      if (!wave_.reached(c / 4)) continue;
      const Real d = rule_.corner_distance(c / 4, c % 4) * unit_;
      if (d < best.distance) best = {d, wave_.source(c / 4)};
    }
    return best;
  }

  bool enter_vertex(Index vertex, Real distance, Index source, bool bends) override {
    if (bends)
      distance *= 1 + this->bend_loss;
    else if (!this->gains(at_vertex(vertex).distance, distance))
      return false;
    bool any = false;
    for (const Index c : mesh_.corners_at(vertex))
      any |= rule_.seed_corner(c / 4, c % 4, distance / unit_, source);
    return any;
  }

  Real distance(Index t) const override {
    return wave_.reached(t) ? rule_.distance(t) * unit_ : infinity;
  }

  Index vertex_of(Index simplex, std::size_t corner) const override {
    return mesh_.tets()[simplex].corner[corner];
  }
  HingeShape<Real> shape(const Member& m, int dimension) const override {
    const Frame frame(*this, m, dimension);
    if (dimension == 1) return {dot(frame.to[0], frame.u) * unit_};
    return {dot(frame.to[0], frame.u) * unit_, dot(frame.to[1], frame.u) * unit_,
            dot(frame.to[1], frame.w) * unit_};
  }

  PosedSource<Real> leave(const Member& m, int dimension,
                          const HingePlace<Real>& b) const override {
    const Frame frame(*this, m, dimension);
    const auto sight = rule_.reached_from(m.simplex, frame.place(b));
    const HingeEnd<Real> end = frame.pose(sight.eye, unit_);
    return {end.x, end.y, end.h, sight.sigma * unit_, wave_.source(m.simplex)};
  }

  // The label starts at the crossing that is the best for the centre.
  bool enter_front(const Member& m, const HingeFront<Real>& front, Point& started) override {
    const Frame frame(*this, m, front.dimension);
    const TetRecord<Real>& t = mesh_.tets()[m.simplex];
    const auto path = front.shortest(shape(m, front.dimension), frame.pose(t.centre, unit_));
    if (!(path.extent < distance(m.simplex) * (1 - this->crossing_gain))) return false;
    std::array<double, 4> weight = {0, 0, 0, 0};
    weight[m.corner[1]] = path.crossing[0];
    if (front.dimension == 2) weight[m.corner[2]] = path.crossing[1];
    weight[m.corner[0]] = 1 - weight[m.corner[1]] - path.crossing[1];
    const std::size_t before = wave_.updates();
    rule_.seed_inside(m.simplex, weight, path.before / unit_, front.number);
    started = wave_.label(m.simplex).source;
    return wave_.updates() != before;
  }

  HingeEnd<Real> pose(const Member& m, int dimension, const Point& point) const override {
    return Frame(*this, m, dimension).pose(point, unit_);
  }
  Point place(const Member& m, int dimension, const HingePlace<Real>& b) const override {
    return Frame(*this, m, dimension).place(b);
  }

  Point place(Index vertex) const override { return mesh_.points()[vertex]; }
  Point place(const PointSource& source) const override {
    if (source.vertex != none) return unit_ * place(mesh_.inside_vertex(source.vertex));
    std::array<double, 4> b = source.barycentric;
    const auto [t, turned] = mesh_.inside_tet(source.simplex);
    if (turned) std::swap(b[2], b[3]);
    Point at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      at = at + static_cast<Real>(b[i]) * mesh_.points()[mesh_.tets()[t].corner[i]];
    return unit_ * at;
  }
  Real unit() const override { return unit_; }

  bool sees(const Member& m, int dimension, const HingePlace<Real>& b,
            Index vertex) const override {
    const auto around = mesh_.corners_at(vertex);
    const Point from = place(m, dimension, b);
    return std::any_of(around.begin(), around.end(),
                       [&](Index c) { return rule_.sees(m.simplex, from, c / 4, c % 4); });
  }
  bool sees_all() const override { return !rule_.drops() && mesh_.summary().components == 1; }

  bool is_solid() const override { return true; }
  void vertices_around(Index vertex, std::vector<Index>& around) const override {
    around.clear();
    for (const Index c : mesh_.corners_at(vertex))
      for (const Index v : mesh_.tets()[c / 4].corner)
        if (v != vertex) around.push_back(v);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }

  Index crossing_seen(Index vertex,
                      const std::function<const Point*(Index)>& starts) const override {
    const Point& q = mesh_.points()[vertex];
    Index nearest = none;
    Real least = infinity;
    for (const Index c : mesh_.corners_at(vertex)) {
      if (!wave_.reached(c / 4)) continue;
      const Index number = wave_.source(c / 4);
      const Point* start = starts(number);
      if (!start) continue;
      const Real d = wave_.label(c / 4).sigma + norm(q - *start);
      if (!(d < least) || !(norm(rule_.seen_from(c / 4, q).eye - *start) <= Real(1e-4))) continue;
      least = d;
      nearest = number;
    }
    return nearest;
  }

  bool enter(const Member& m, int dimension, const PosedSource<Real>& from, Index ring,
             const std::pair<Real, Real>&) override {
    const Frame frame(*this, m, dimension);
    const Point eye = frame.origin + (from.x / unit_) * frame.u + (from.y / unit_) * frame.w +
                      (from.h / unit_) * frame.out;
    std::size_t face = 0;  // one that contains the hinge
    for (const auto is_corner =
             [&](std::size_t i) {
               for (int k = 0; k <= dimension; ++k)
                 if (m.corner[static_cast<std::size_t>(k)] == i) return true;
               return false;
             };
         is_corner(face);)
      ++face;
    const Real sigma = from.sigma / unit_;
    if (dimension == 2) return rule_.enter_face(m.simplex, face, eye, sigma, from.source);
    return rule_.enter_edge(m.simplex, face, ring, eye, sigma, from.source);
  }

  Index open_ring(const Member& m, Real low, Real high) override {
    const Frame frame(*this, m, 1);
    ReflexEdge<Real> ring = {};
    ring.end[0] = frame.origin + (low / unit_) * frame.u;
    ring.end[1] = frame.origin + (high / unit_) * frame.u;
    ring.direction = frame.u;
    ring.extent = (high - low) / unit_;
    rings_.push_back(ring);
    rule_.set_rings(rings_);
    return static_cast<Index>(rings_.size() - 1);
  }

  void close_ring() override { rings_.pop_back(); }

  void read_out(std::span<Real> distance, std::span<Index> label) override {
    plexway::read_out<Real, true>(mesh_, rule_, wave_, workspace_);
    this->take_out(mesh_, workspace_, distance, label);
  }

  bool relax(std::span<Real> distance, std::span<Index> label) override {
    return this->relax_with(mesh_, workspace_, distance, label,
                            [&] { return read_out_tet_edges<Real, true>(mesh_, workspace_); });
  }

  PropagateStatistics statistics() const override {
    return {wave_.expansions(), wave_.updates(), wave_.reached_count()};
  }
  bool out_of_budget() const override { return wave_.out_of_budget(); }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  static WorkspaceState<Real>& prepare(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace) {
    workspace.front.reserve(mesh.tet_count());
    workspace.start(mesh.tet_count(), true);
    return workspace;
  }

  // Places of several vertices, as on the faces of a crack or where holes touch. Where every point
  // sees every other there are none.
  void find_torn() {
    if (sees_all()) return;
    const auto points = mesh_.points();
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](Index v) { return std::array{points[v].x, points[v].y, points[v].z}; };
    std::sort(order.begin(), order.end(), [&](Index v, Index w) { return key(v) < key(w); });
    for (std::size_t i = 1; i < order.size(); ++i) {
      const Index v = order[i - 1], w = order[i];
      if (key(v) != key(w)) continue;
      torn_.resize(points.size(), 0);
      torn_[v] = torn_[w] = 1;
    }
    rule_.tell_sides(torn_);
  }
  // Labels that start on hinges are offered all around, as far as the horizon. True if some was
  // accepted.
  bool offer_around(Real horizon) {
    if (on_hinges_.empty()) return false;
    const std::size_t before = wave_.updates();
    std::erase_if(on_hinges_, [&](OnHinge& label) {
      if (label.next < horizon)
        label.next = rule_.offer_around(label.tet, this->crossing_gain, horizon);
      return !(label.next < infinity);
    });
    return wave_.updates() != before;
  }

  // The hinge's frame in space; `out` points away from the tetrahedron.
  struct Frame {
    Point origin, to[2] = {{0, 0, 0}, {0, 0, 0}};  // and from there to vertices 1 and 2
    Point u = {0, 0, 0}, w = {0, 0, 0}, out = {0, 0, 0};
    [[nodiscard]] Point place(const HingePlace<Real>& b) const {
      return origin + b[0] * to[0] + b[1] * to[1];
    }
    [[nodiscard]] HingeEnd<Real> pose(const Point& p, Real unit) const {
      const Point d = p - origin;
      const Real x = dot(d, u), y = dot(d, w);
      return {x * unit, y * unit, norm(d - x * u - y * w) * unit};
    }
    Frame(const MixedSolid& solid, const Member& m, int dimension) {
      const TetRecord<Real>& t = solid.mesh_.tets()[m.simplex];
      const auto points = solid.mesh_.points();
      const auto at = [&](std::size_t i) { return points[t.corner[m.corner[i]]]; };
      const auto unit = [](const Point& p) {
        const Real length = norm(p);
        return length > 0 ? 1 / length * p : p;
      };
      origin = at(0);
      to[0] = at(1) - origin;
      u = unit(to[0]);
      const Point in = t.centre - origin;
      if (dimension == 2) {
        to[1] = at(2) - origin;
        w = unit(to[1] - dot(to[1], u) * u);
        out = cross(u, w);
        if (dot(out, in) > 0) out = Real(-1) * out;
      } else {
        out = Real(-1) * unit(in - dot(in, u) * u);
      }
    }
  };

  const TetMesh<Real>& mesh_;
  WorkspaceState<Real>& workspace_;
  PropagateOptions options_;
  Real unit_;
  std::vector<ReflexEdge<Real>> rings_;
  Wave wave_;
  SolidPropagation<Real, Rule, Wave> propagation_;
  Rule& rule_;
  int repairs_ = 0;
  // Expanded labels from there that have more to offer, the nearest at `next`.
  struct OnHinge {
    Index tet;
    Real next;
  };
  std::vector<OnHinge> on_hinges_;
  std::vector<char> torn_;  // by vertex, if any
};

}  // namespace plexway
