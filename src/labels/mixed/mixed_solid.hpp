#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "labels/mixed/mixed_front.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/solid/plain_solid_rule.hpp"
#include "labels/solid/solid_propagation.hpp"
#include "labels/solid/solid_read_out.hpp"
#include "strings/solid_strings.hpp"

namespace plexway {

/// A solid in a mixed domain where strings do not go, by the plain step.
template <class Real>
class MixedSolid final : public MixedPiece<Real> {
 public:
  using typename MixedPiece<Real>::Member;
  using typename MixedPiece<Real>::Found;
  using Point = Vector3<Real>;
  using Label = PlainSolidLabel<Real>;
  using Wave = MixedFront<Real, Label>;
  using Rule = PlainSolidRule<Real, Wave>;

  MixedSolid(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace,
             const PropagateOptions& options, Real step)
      : mesh_(mesh),
        workspace_(prepare(mesh, workspace)),
        options_(options),
        unit_(static_cast<Real>(mesh.unit())),
        wave_({workspace.marks, workspace.plain_solids.reserve(mesh.tet_count() + 1),
               DualQueue<Real>(workspace.front, step), workspace.source.data(), mesh.tet_count(),
               mesh.unit(), options_},
              this->expanded_),
        propagation_(mesh, Rule(mesh, wave_), wave_, options_),
        rule_(propagation_.rule()) {
    if (!sees_all()) space_ = space_of(mesh)->media()[0].room;
  }

  void seed(const PointSource& source, Index number) override {
    propagation_.seed(source, number);
    Index t = none;
    if (source.vertex == none)
      t = mesh_.inside_tet(source.simplex).first;
    else if (const auto corners = mesh_.corners_at(mesh_.inside_vertex(source.vertex));
             !corners.empty())
      t = corners[0] / 4;
    if (t == none) return;
    const Point at = 1 / unit_ * place(source);
    starts_.push_back({number, at, static_cast<Real>(source.offset) / unit_, beside(at, t)});
  }
  void run(Real horizon, std::size_t budget) override {
    options_.max_expansions = budget;
    wave_.withdraw_all_but(budget - wave_.expansions());
    wave_.queue().set_horizon(horizon / unit_);
    for (std::size_t before = this->expanded_.size();; before = this->expanded_.size()) {
      propagation_.spread(propagation_.last_resort(repairs_));
      for (std::size_t i = before; i < this->expanded_.size(); ++i)
        started_.push_back({this->expanded_[i], 0});
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

  PosedSource<Real> leave(const Member& m, int dimension, const HingePlace<Real>&) const override {
    const Label& label = wave_.label(m.simplex);
    const HingeShape<Real> shape = this->shape(m, dimension);
    const auto square = [&](std::size_t i) {
      return label.distance2[m.corner[i]] * (unit_ * unit_);
    };
    const Real s = square(0);
    PosedSource<Real> eye = {0, 0, 0, label.sigma * unit_, wave_.source(m.simplex)};
    if (shape.length > 0)
      eye.x = (s - square(1) + shape.length * shape.length) / (2 * shape.length);
    if (dimension == 2 && shape.y > 0)
      eye.y = (s - square(2) + shape.x * shape.x + shape.y * shape.y - 2 * shape.x * eye.x) /
              (2 * shape.y);
    eye.h = std::sqrt(std::max(s - eye.x * eye.x - eye.y * eye.y, Real(0)));
    return eye;
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
    started = frame.place(path.crossing);
    if (wave_.updates() != before)
      starts_.push_back({front.number, started, path.before / unit_, beside(started, m.simplex)});
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
    if (!space_) return true;
    const strings::Point from = beside(place(m, dimension, b), m.simplex);
    return !space_->sight().is_blocked(from, space_->beside(vertex, from, from));
  }
  bool sees_all() const override {
    return mesh_.reflex_edges().empty() && mesh_.pinched().empty() &&
           mesh_.pinched_edges().empty() && mesh_.summary().degenerate_tets == 0 &&
           mesh_.summary().components == 1;
  }

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
    Index nearest = none;
    Real least = infinity;
    for (const Index c : mesh_.corners_at(vertex)) {
      if (!wave_.reached(c / 4)) continue;
      const Index number = wave_.source(c / 4);
      if (!starts(number)) continue;
      const Real d = rule_.corner_distance(c / 4, c % 4);
      if (!(d < least)) continue;
      least = d;
      nearest = number;
    }
    return nearest;
  }

  // What comes from other pieces bends on the hinge.
  bool enter(const Member&, int, const PosedSource<Real>&, const std::pair<Real, Real>&) override {
    return false;
  }

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

  // Labels are offered all around straight from where they start, as far as the horizon. True if
  // some was accepted.
  bool offer_around(Real horizon) {
    if (started_.empty()) return false;
    const std::size_t before = wave_.updates();
    std::erase_if(started_, [&](Started& label) {
      if (label.next < horizon) label.next = offer_around(label.tet, horizon);
      return !(label.next < infinity);
    });
    return wave_.updates() != before;
  }
  // To its neighbours, straight from where it starts, even where the line misses the face between:
  // of many starts of nearly the same distance each tetrahedron keeps one, and the strip that would
  // bring another one may be taken. Offers at the horizon or beyond are not made: gives the nearest
  // such, or +inf.
  Real offer_around(Index t, Real horizon) {
    const Index number = wave_.source(t);
    const auto start =
        std::lower_bound(starts_.begin(), starts_.end(), number,
                         [](const Start& s, Index of_front) { return s.number < of_front; });
    if (start == starts_.end() || start->number != number) return infinity;
    Real left = infinity;
    for (Index i = 0; i < 4; ++i) {
      const Index across = mesh_.tets()[t].across[i], u = across >> TetAcross::tet_shift;
      if (u == mesh_.tet_count()) continue;
      Label label;
      label.sigma = start->sigma;
      for (std::size_t j = 0; j < 4; ++j) {
        const Point off = mesh_.points()[mesh_.tets()[u].corner[j]] - start->at;
        label.distance2[j] = dot(off, off);
      }
      label.centre = rule_.centre_distance(u, label);
      if (!(label.centre < rule_.distance_or_inf(u) * (1 - this->crossing_gain))) continue;
      if (!(label.centre < horizon))
        left = std::min(left, label.centre);
      else if (!space_ || !space_->sight().is_blocked(start->beside, middle_of(u)))
        wave_.accept(u, across & TetAcross::face_mask, label, label.centre, number);
    }
    return left;
  }
  [[nodiscard]] strings::Point middle_of(Index t) const {
    const Point& p = mesh_.tets()[t].centre;
    return {double(p.x), double(p.y), double(p.z)};
  }
  // A little off a point of tetrahedron t, into it.
  [[nodiscard]] strings::Point beside(const Point& p, Index t) const {
    const strings::Point at = {double(p.x), double(p.y), double(p.z)};
    return at + 1e-6 * (middle_of(t) - at);
  }
  // The hinge's frame in space.
  struct Frame {
    Point origin, to[2] = {{0, 0, 0}, {0, 0, 0}};  // and from there to vertices 1 and 2
    Point u = {0, 0, 0}, w = {0, 0, 0};
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
      if (dimension == 2) {
        to[1] = at(2) - origin;
        w = unit(to[1] - dot(to[1], u) * u);
      }
    }
  };

  const TetMesh<Real>& mesh_;
  WorkspaceState<Real>& workspace_;
  PropagateOptions options_;
  Real unit_;
  Wave wave_;
  SolidPropagation<Real, Rule, Wave> propagation_;
  Rule& rule_;
  int repairs_ = 0;
  std::shared_ptr<const strings::SolidSpace> space_;  // where not every point sees every other
  // Expanded labels from there that have more to offer, the nearest at `next`.
  struct Started {
    Index tet;
    Real next;
  };
  std::vector<Started> started_;
  struct Start {  // of labels: a source, or where a front crossed a hinge
    Index number;
    Point at;
    Real sigma;
    strings::Point beside;
  };
  std::vector<Start> starts_;  // ascending
};

}  // namespace plexway
