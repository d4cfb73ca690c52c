#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/support.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/simplex_numbers.hpp"
#include "labels/front.hpp"
#include "labels/surface/saddle_offers.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

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

/// On a surface: by labels.
template <class Real>
class Growth<TriangleMesh<Real>> {
 public:
  using Number = Real;
  using Label = SaddleLabel<Real>;
  using Queue = RecentQueue<Real>;
  using Wave = Wavefront<Real, Label, Queue, true>;
  static constexpr std::size_t corners = 3;
  static constexpr bool exact = false;

  Growth(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace)
      : complex_(mesh),
        simplices_(mesh.face_count()),
        workspace_(workspace),
        labels_(workspace.saddles.reserve(simplices_ + 1)),
        log_(std::bit_ceil(simplices_ + 1)),
        wave_(make_wave()) {
    support(Purpose::samples, mesh).require();
    workspace_.front.reserve(simplices_);
    clear();
  }
  Growth(const Growth&) = delete;  // the front points here
  Growth& operator=(const Growth&) = delete;

  [[nodiscard]] std::size_t simplices() const { return simplices_; }

  /// Nothing is reached.
  void clear() {
    workspace_.start(simplices_, true);
    totals_ = {};
    start_wave();
    (void)rule();  // which marks the sentinel
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
        each_neighbour(s, [&](Index t) {
          if (reached(t)) wave_.accept(t, hinge(t), Label(label(t)), distance(t), source(t));
        });
    });
  }

  /// Of a reached simplex's centre.
  [[nodiscard]] Real distance(Index f) const { return label(f).distance(); }
  [[nodiscard]] Real measure(Index f) const {
    const TriangleRecord<Real>& t = complex_.triangles()[f];
    return t.length[0] * t.apex_h(0) / 2;
  }
  /// Of any point of the simplex from its centre, at most.
  [[nodiscard]] Real size(Index f) const {
    const TriangleRecord<Real>& t = complex_.triangles()[f];
    return std::max({t.length[0], t.length[1], t.length[2]}) * Real(2) / 3;
  }
  [[nodiscard]] const Index* corners_of(Index f) const { return complex_.triangles()[f].corner; }
  /// A corner of a simplex at a vertex, packed as `corners * simplex + corner`, or none.
  [[nodiscard]] Index corner_at(Index vertex) const { return complex_.corner_at(vertex); }
  template <class Visit>
  void each_corner_at(Index vertex, Visit visit) {
    complex_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners) visit(c);
  }

  /// `found(source, distance)` for each label that reaches points of f, its own and those around
  /// it, until it says true; `distance(weights)` is the length of its path to one.
  template <class Found>
  void each_label(Index f, Found found) {
    const auto offers = this->offers();
    if (reached(f) && found(source(f), [&](const Weights& w) { return offers.distance_at(f, w); }))
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
  /// +inf where nothing leads.
  [[nodiscard]] Real vertex_distance(Index vertex) {
    Real nearest = std::numeric_limits<Real>::infinity();
    const auto rule = this->rule();
    each_corner_at(vertex, [&](Index c) {
      if (reached(c / 3)) nearest = std::min(nearest, rule.corner_distance(c / 3, c % 3));
    });
    return nearest;
  }

  template <class Visit>
  void each_neighbour(Index f, Visit visit) const {
    const auto triangles = complex_.triangles();
    for (const Index start : triangles[f].across)
      for (Index across = start; (across >> Across::face_shift) != simplices_;) {
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
    for (Index f = 0; f < simplices_; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        if (complex_.triangles()[f].across[i] >> Across::face_shift == simplices_)
          visit(corners_of(f)[i]), visit(corners_of(f)[edge_after(i)]);
  }

  using Rule = SaddleRule<Real, Wave>;
  [[nodiscard]] Rule rule() { return Rule(complex_.triangles(), wave_, true); }
  [[nodiscard]] SaddleOffers<Real, Wave> offers() { return {complex_.triangles(), wave_, true}; }

 private:
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
    auto propagation = this->propagation();
    seed(propagation);
    propagation.run();
    totals_.expansions += wave_.expansions();
    totals_.updates += wave_.updates();
    totals_.reached_simplices = wave_.reached_count();
  }

  auto propagation() {
    return TrianglePropagation<Real, Rule, Wave, true>(complex_, workspace_, rule(), wave_,
                                                       options_);
  }

  const TriangleMesh<Real>& complex_;
  std::size_t simplices_;
  WorkspaceState<Real>& workspace_;
  Label* labels_;
  PropagateOptions options_;
  std::vector<Index> log_;
  std::size_t log_room_ = log_.size();
  Wave wave_;
  PropagateStatistics totals_;
};

}  // namespace plexway::detail
