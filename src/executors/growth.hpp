#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/simplex_numbers.hpp"
#include "labels/front.hpp"
#include "labels/solid/solid_propagation.hpp"
#include "labels/solid/solid_rule.hpp"
#include "labels/surface/saddle_offers.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// A dual queue that keeps a list of what came to wait, the latest as many as there is room for.
template <class Real>
class RecentQueue {
 public:
  /// `room` is a power of two.
  RecentQueue(FrontStorage& storage, Real step, Index* log, std::size_t room)
      : queue_(storage, step), log_(log), mask_(room - 1) {}
  /// Written in any case and kept if wanted: no branch to mispredict.
  [[gnu::always_inline]] void push(Index simplex, Real distance, bool wanted = true) {
    log_[count_ & mask_] = simplex;
    count_ += wanted;
    queue_.push(simplex, distance, wanted);
  }
  template <class DistanceOf>
  [[gnu::always_inline]] bool pop(Index& simplex, DistanceOf distance_of) {
    return queue_.pop(simplex, distance_of);
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Was there room for all?
  [[nodiscard]] bool complete() const { return count_ <= mask_ + 1; }

 private:
  DualQueue<Real> queue_;
  Index* log_;
  std::size_t mask_, count_ = 0;
};

/// Propagation that goes on from what it left: labels stay, each new source is propagated only
/// where it is nearer than those before. Numbers and unit inside; GrowingField is the same for
/// callers. What surfaces and solids have in common; `Derived` knows the rule.
///
/// Cost of a source: what it reaches. Nothing is cleared, nothing is read out.
template <class Derived, class Real, class Complex, class Label>
class GrowthBase {
 public:
  using Queue = RecentQueue<Real>;
  using Wave = Wavefront<Real, Label, Queue, true>;

  [[nodiscard]] const Complex& complex() const { return complex_; }
  [[nodiscard]] std::size_t simplices() const { return simplices_; }

  /// Nothing is reached.
  void clear() {
    workspace_.start(simplices_, true);
    totals_ = {};
    start_wave();
    (void)self().rule();  // which marks the sentinel
  }

  [[nodiscard]] bool reached(Index s) const { return wave_.reached(s); }
  [[nodiscard]] Index source(Index s) const { return wave_.source(s); }
  [[nodiscard]] const Label& label(Index s) const { return wave_.label(s); }
  [[nodiscard]] std::size_t hinge(Index s) const { return wave_.hinge(s); }
  /// All sources together.
  [[nodiscard]] const PropagateStatistics& totals() const { return totals_; }
  /// Simplices that changed at the last source; some repeatedly. All, where it changed many.
  [[nodiscard]] std::span<const Index> touched() {
    if (wave_.queue().complete()) return std::span(log_).first(wave_.queue().count());
    std::iota(log_.begin(), log_.end(), Index{0});
    return std::span(log_).first(simplices_);
  }

  /// A source in a simplex or at a vertex, sigma walked to it; no farther than radius.
  void add(Index s, const Weights& weights, Real sigma, Index number, Real radius) {
    run(radius, [&](auto& propagation) { propagation.seed_inside(s, weights, sigma, number); });
  }
  void add_vertex(Index vertex, Real sigma, Index number, Real radius) {
    run(radius, [&](auto& propagation) { propagation.seed_vertex(vertex, sigma, number); });
  }

  /// Many: `points[i]` is number i. With a radius that every point of the domain is nearer to one
  /// of them than, those side by side are taken together and one lot after the other: what is under
  /// way then stays in the cache, which a thousand fronts at once do not. That is twice as fast,
  /// though lots overlap.
  void add_all(std::span<const std::pair<Index, Weights>> points, Real radius) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    if (radius < std::numeric_limits<Real>::infinity())  // simplices lie along a curve
      std::stable_sort(order.begin(), order.end(),
                       [&](Index a, Index b) { return points[a].first < points[b].first; });
    constexpr std::size_t together = 64;
    const std::size_t lot =
        radius < std::numeric_limits<Real>::infinity() ? together : points.size();
    for (std::size_t begin = 0; begin < points.size(); begin += lot) {
      if (lot == points.size()) log_room_ = 1;  // there is nothing to take back
      run(radius, [&](auto& propagation) {
        for (std::size_t n = begin; n < std::min(begin + lot, points.size()); ++n)
          propagation.seed_inside(points[order[n]].first, points[order[n]].second, 0, order[n]);
      });
    }
  }
  void add_all_vertices(std::span<const Index> vertices) {
    log_room_ = 1;
    run(std::numeric_limits<Real>::infinity(), [&](auto& propagation) {
      for (const Index v : vertices) propagation.seed_vertex(v, 0, 0);
    });
  }

  /// Takes the last source back: what it took goes to the neighbours' again.
  void remove_last(Index number, Real radius) {
    std::vector<Index> lost;
    for (const Index s : touched())
      if (reached(s) && source(s) == number) wave_.forget(s), lost.push_back(s);
    totals_.reached_simplices -= lost.size();
    run(radius, [&](auto&) {
      for (const Index s : lost)
        self().each_neighbour(s, [&](Index t) {
          if (reached(t)) wave_.accept(t, hinge(t), Label(label(t)), self().distance(t), source(t));
        });
    });
  }

 protected:
  GrowthBase(const Complex& complex, std::size_t simplices, WorkspaceState<Real>& workspace,
             Label* labels)
      : complex_(complex),
        simplices_(simplices),
        workspace_(workspace),
        labels_(labels),
        log_(std::bit_ceil(simplices + 1)),
        wave_(make_wave()) {
    workspace_.front.reserve(simplices);
  }
  GrowthBase(const GrowthBase&) = delete;  // the front points here
  GrowthBase& operator=(const GrowthBase&) = delete;

  Wave make_wave() {
    return Wave(
        workspace_.marks, labels_,
        Queue(workspace_.front, Real(1), log_.data(), std::exchange(log_room_, log_.size())),
        workspace_.source.data(), simplices_, complex_.unit(), options_);
  }
  void start_wave() {
    wave_ = make_wave();
    wave_.resume(totals_.reached_simplices);
  }

  template <class Seed>
  void run(Real radius, Seed seed) {
    options_.radius = static_cast<double>(radius) * complex_.unit();
    start_wave();
    auto propagation = self().propagation();
    seed(propagation);
    self().spread(propagation);
    totals_.expansions += wave_.expansions();
    totals_.updates += wave_.updates();
    totals_.reached_simplices = wave_.reached_count();
  }

  Derived& self() { return static_cast<Derived&>(*this); }

  const Complex& complex_;
  std::size_t simplices_;
  WorkspaceState<Real>& workspace_;
  Label* labels_;
  PropagateOptions options_;
  std::vector<Index> log_;
  std::size_t log_room_ = log_.size();
  Wave wave_;
  PropagateStatistics totals_;
};

template <class Complex>
class Growth;

/// On a surface.
template <class Real>
class Growth<TriangleMesh<Real>>
    : public GrowthBase<Growth<TriangleMesh<Real>>, Real, TriangleMesh<Real>, SaddleLabel<Real>> {
  using Base = GrowthBase<Growth, Real, TriangleMesh<Real>, SaddleLabel<Real>>;
  friend Base;

 public:
  using Number = Real;
  using typename Base::Wave;
  static constexpr std::size_t corners = 3;

  Growth(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace)
      : Base(mesh, mesh.face_count(), workspace, workspace.saddles.reserve(mesh.face_count() + 1)) {
    support(Purpose::samples, mesh).require();
    this->clear();
  }

  /// Of a reached simplex's centre.
  [[nodiscard]] Real distance(Index f) const { return this->label(f).distance(); }
  [[nodiscard]] Real measure(Index f) const {
    const TriangleRecord<Real>& t = this->complex_.triangles()[f];
    return t.length[0] * t.apex_h(0) / 2;
  }
  /// Of any point of the simplex from its centre, at most.
  [[nodiscard]] Real size(Index f) const {
    const TriangleRecord<Real>& t = this->complex_.triangles()[f];
    return std::max({t.length[0], t.length[1], t.length[2]}) * Real(2) / 3;
  }
  [[nodiscard]] const Index* corners_of(Index f) const {
    return this->complex_.triangles()[f].corner;
  }
  /// A corner of a simplex at a vertex, packed as `corners * simplex + corner`, or none.
  [[nodiscard]] Index corner_at(Index vertex) const { return this->complex_.corner_at(vertex); }
  template <class Visit>
  void each_corner_at(Index vertex, Visit visit) {
    this->complex_.corners_at(vertex, this->workspace_.corners);
    for (const Index c : this->workspace_.corners) visit(c);
  }

  /// `found(source, distance)` for each label that reaches points of f, its own and those around
  /// it, until it says true; `distance(weights)` is the length of its path to one.
  template <class Found>
  void each_label(Index f, Found found) {
    const auto offers = this->offers();
    if (this->reached(f) &&
        found(this->source(f), [&](const Weights& w) { return offers.distance_at(f, w); }))
      return;
    offers.offers_around(f,
                         [&](const auto& length, Index source) { return found(source, length); });
  }
  /// `found(length, source)` for paths from the source of f through its edges to others.
  template <class Found>
  void each_meeting(Index f, Found found) {
    const auto offers = this->offers();
    for (std::size_t edge = 0; edge < 3; ++edge) offers.meetings_over(f, edge, found);
  }
  [[nodiscard]] Real corner_distance(Index f, std::size_t i) {
    return this->rule().corner_distance(f, i);
  }

  template <class Visit>
  void each_neighbour(Index f, Visit visit) const {
    const auto triangles = this->complex_.triangles();
    for (const Index start : triangles[f].across)
      for (Index across = start; (across >> Across::face_shift) != this->simplices_;) {
        const Index g = across >> Across::face_shift;
        if (g == f) break;
        visit(g);
        if (!(across & Across::fan)) break;
        across = triangles[g].across[across & Across::edge_mask];
      }
  }

  /// Ends of boundary edges, some repeatedly.
  template <class Visit>
  void each_rim_vertex(Visit visit) const {
    for (Index f = 0; f < this->simplices_; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        if (this->complex_.triangles()[f].across[i] >> Across::face_shift == this->simplices_)
          visit(corners_of(f)[i]), visit(corners_of(f)[edge_after(i)]);
  }

  using Rule = SaddleRule<Real, Wave>;
  [[nodiscard]] Rule rule() { return Rule(this->complex_.triangles(), this->wave_, true); }
  [[nodiscard]] SaddleOffers<Real, Wave> offers() {
    return {this->complex_.triangles(), this->wave_, true};
  }

 private:
  auto propagation() {
    return TrianglePropagation<Real, Rule, Wave, true>(this->complex_, this->workspace_, rule(),
                                                       this->wave_, this->options_);
  }
  template <class Propagation>
  void spread(Propagation& propagation) {
    propagation.run();
  }
};

/// In a solid with coordinates.
template <class Real>
class Growth<TetMesh<Real>>
    : public GrowthBase<Growth<TetMesh<Real>>, Real, TetMesh<Real>, SolidLabel<Real>> {
  using Base = GrowthBase<Growth, Real, TetMesh<Real>, SolidLabel<Real>>;
  friend Base;

 public:
  using Number = Real;
  using typename Base::Wave;
  static constexpr std::size_t corners = 4;

  Growth(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace)
      : Base(mesh, mesh.tet_count(), workspace, workspace.solids.reserve(mesh.tet_count() + 1)) {
    this->clear();
  }

  [[nodiscard]] Real distance(Index t) const { return this->label(t).centre; }
  [[nodiscard]] Real measure(Index t) const {
    const Index* v = corners_of(t);
    const auto p = this->complex_.points();
    return dot(p[v[1]] - p[v[0]], cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[0]])) / 6;
  }
  [[nodiscard]] Real size(Index t) const {
    Real longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
      longest = std::max(longest, norm(this->complex_.points()[corners_of(t)[i]] -
                                       this->complex_.tets()[t].centre));
    return longest;
  }
  [[nodiscard]] const Index* corners_of(Index t) const { return this->complex_.tets()[t].corner; }
  [[nodiscard]] Index corner_at(Index vertex) const {
    const auto at = this->complex_.corners_at(vertex);
    return at.empty() ? none : at[0];
  }
  template <class Visit>
  void each_corner_at(Index vertex, Visit visit) {
    for (const Index c : this->complex_.corners_at(vertex)) visit(c);
  }
  [[nodiscard]] Vector3<Real> position(Index t, const Weights& w) const {
    Vector3<Real> at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      at = at + static_cast<Real>(w[i]) * this->complex_.points()[corners_of(t)[i]];
    return at;
  }

  template <class Found>
  void each_label(Index t, Found found) {
    const auto rule = this->rule();
    const auto ask = [&](Index u) {
      return found(this->source(u),
                   [&](const Weights& w) { return rule.distance_at(u, t, position(t, w)); });
    };
    if (this->reached(t) && ask(t)) return;
    Index heard[16] = {this->reached(t) ? this->source(t) : none};
    std::size_t count = 1;
    for (std::size_t i = 0; i < 4; ++i)
      for (const Index c : this->complex_.corners_at(corners_of(t)[i])) {
        const Index u = c / 4;
        if (!this->reached(u)) continue;
        if (std::find(heard, heard + count, this->source(u)) != heard + count) continue;
        if (count < 16) heard[count++] = this->source(u);
        if (ask(u)) return;
      }
  }
  template <class Found>
  void each_meeting(Index t, Found found) {
    const auto rule = this->rule();
    for (Index face = 0; face < 4; ++face) {
      const Index u = this->complex_.tets()[t].across[face] >> TetAcross::tet_shift;
      if (u == this->simplices_ || !this->reached(u) || this->source(u) == this->source(t))
        continue;
      found(rule.meeting_over(t, face), this->source(u));
    }
  }
  [[nodiscard]] Real corner_distance(Index t, std::size_t i) {
    return rule().corner_distance(t, static_cast<Index>(i));
  }

  template <class Visit>
  void each_neighbour(Index t, Visit visit) const {
    for (const Index across : this->complex_.tets()[t].across)
      if ((across >> TetAcross::tet_shift) != this->simplices_)
        visit(across >> TetAcross::tet_shift);
  }

  /// Corners of boundary faces, some repeatedly.
  template <class Visit>
  void each_rim_vertex(Visit visit) const {
    for (Index t = 0; t < this->simplices_; ++t)
      for (std::size_t i = 0; i < 4; ++i)
        if (this->complex_.tets()[t].across[i] >> TetAcross::tet_shift == this->simplices_)
          for (const Index k : tet_face_corners[i]) visit(corners_of(t)[k]);
  }

  using Rule = SolidRule<Real, Wave>;
  [[nodiscard]] Rule rule() { return Rule(this->complex_, this->wave_); }

 private:
  auto propagation() {
    return SolidPropagation<Real, Rule, Wave>(this->complex_, rule(), this->wave_, this->options_);
  }
  template <class Propagation>
  void spread(Propagation& propagation) {
    // Where all of the log is there, around that only.
    struct {
      const Wave& wave;
      const std::vector<Index>& log;
      [[nodiscard]] bool complete() const { return wave.queue().complete(); }
      [[nodiscard]] std::size_t size() const { return wave.queue().count(); }
      Index operator[](std::size_t i) const { return log[i]; }
    } const changed = {this->wave_, this->log_};
    propagation.run_around(changed);
  }
};

}  // namespace plexway
