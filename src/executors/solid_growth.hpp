#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/distance_field.hpp>

#include "executors/simplex_numbers.hpp"
#include "labels/workspace_state.hpp"
#include "strings/solid_strings.hpp"

namespace plexway::detail {

/// In a solid with coordinates: by strings, so that all distances are exact.
template <class Real>
class Growth<TetMesh<Real>> {
 public:
  using Number = Real;
  using Point = strings::Point;
  static constexpr std::size_t corners = 4;
  static constexpr bool exact = true;

  Growth(const TetMesh<Real>& mesh, WorkspaceState<Real>&) : mesh_(mesh) {}
  Growth(const Growth&) = delete;
  Growth& operator=(const Growth&) = delete;

  [[nodiscard]] std::size_t simplices() const { return mesh_.tet_count(); }

  /// Nothing is reached.
  void clear() {
    if (solver_) solver_->clear();
    seeds_.clear();
    in_tet_.clear();
    centre_.tet = none;
  }

  /// The next source in a tetrahedron or at a vertex, sigma walked to it; no farther than radius.
  void add(Index t, const Weights& weights, Real sigma, Index /*number*/, Real radius) {
    strings::Inside inside;
    const strings::Source source = in(t, weights, static_cast<double>(sigma), inside);
    grow({&source, 1}, radius);
  }
  void add_vertex(Index vertex, Real sigma, Index /*number*/, Real radius) {
    const strings::Source source = at(vertex, static_cast<double>(sigma));
    grow({&source, 1}, radius);
  }
  /// Many: `points[i]` is number i.
  void add_all(std::span<const std::pair<Index, Weights>> points, Real radius) {
    std::vector<strings::Source> sources;
    std::vector<strings::Inside> inside(points.size());
    for (const auto& [t, weights] : points)
      sources.push_back(in(t, weights, 0, inside[sources.size()]));
    grow(sources, radius);
  }
  void add_all_vertices(std::span<const Index> vertices) {
    std::vector<strings::Source> sources;
    for (const Index v : vertices) sources.push_back(at(v, 0));
    grow(sources, std::numeric_limits<Real>::infinity());
  }

  /// Would a source be nearer to an earlier one than `reach(number)`? Earlier ones are looked for
  /// as far as 1.5 `radius`.
  template <class Reach>
  [[nodiscard]] bool is_near_another(Index vertex, Index t, const Weights& weights, Real radius,
                                     const Reach& reach) {
    strings::Inside inside;
    const strings::Source source = vertex != none
                                       ? source_at(space(), vertex, 0)
                                       : source_in(mesh_, space(), t, weights, 0, inside);
    std::vector<Index> near;
    double farthest = 0;
    each_source_around(vertex != none ? std::span(&vertex, 1) : std::span(corners_of(t), 4),
                       source.at, 1.5 * static_cast<double>(radius), [&](Index n) {
                         const double least = static_cast<double>(reach(n));
                         if (norm(seeds_[n].at - source.at) < least) {
                           near.push_back(n);
                           farthest = std::max(farthest, least);
                         }
                       });
    if (near.empty()) return false;
    // Through space they are; and around what is between?
    if (!alone_) alone_.emplace(space());
    strings::Limits limits;
    limits.radius = 1.2 * farthest;
    alone_->solve({&source, 1}, limits);
    return std::any_of(near.begin(), near.end(), [&](Index n) {
      const Seed& seed = seeds_[n];
      Index at = seed.vertex;
      if (at == none) {
        const Index own = 0;
        attach(*alone_, seed.tet, seed.at,
               std::span(&own, vertex == none && seed.tet == t ? std::size_t{1} : 0));
        at = attached();
      }
      return alone_->distance(at) < static_cast<double>(reach(n));
    });
  }

  [[nodiscard]] bool reached(Index t) const {
    return solver_ && std::any_of(corners_of(t), corners_of(t) + 4,
                                  [&](Index v) { return solver_->source(v) != none; });
  }
  /// The nearest to the centre of a reached tetrahedron, and how far it is.
  [[nodiscard]] Index source(Index t) { return centre(t).source; }
  [[nodiscard]] Real distance(Index t) { return centre(t).distance; }
  /// Where the path from there to the centre bends first, or the centre.
  [[nodiscard]] Point first_bend(Index t) {
    centre_.tet = none;
    (void)centre(t);
    return solver_->path(attached()).points[1];
  }
  [[nodiscard]] Real vertex_distance(Index vertex) const {
    return solver_ ? static_cast<Real>(solver_->distance(vertex))
                   : std::numeric_limits<Real>::infinity();
  }

  /// All sources together.
  [[nodiscard]] PropagateStatistics totals() const {
    PropagateStatistics totals;
    if (!solver_) return totals;
    totals.expansions = solver_->counts().expansions;
    totals.updates = solver_->counts().labels;
    for (Index t = 0; t < simplices(); ++t) totals.reached_simplices += reached(t);
    return totals;
  }

  [[nodiscard]] Real measure(Index t) const {
    const Index* v = corners_of(t);
    const auto p = mesh_.points();
    return static_cast<Real>(dot(p[v[1]] - p[v[0]], cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[0]])) /
                             6);
  }
  /// Of any point of the tetrahedron from its centre, at most.
  [[nodiscard]] Real size(Index t) {
    const Point centre = position(t, {.25, .25, .25, .25});
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
      longest = std::max(longest, norm(mesh_.points()[corners_of(t)[i]] - centre));
    return static_cast<Real>(longest);
  }
  [[nodiscard]] const Index* corners_of(Index t) const { return mesh_.tets()[t].corner; }
  [[nodiscard]] Index corner_at(Index vertex) const {
    const auto at = mesh_.corners_at(vertex);
    return at.empty() ? none : at[0];
  }
  template <class Visit>
  void each_corner_at(Index vertex, Visit visit) const {
    for (const Index c : mesh_.corners_at(vertex)) visit(c);
  }
  /// Corners of boundary faces, some repeatedly.
  template <class Visit>
  void each_rim_vertex(Visit visit) const {
    for (Index t = 0; t < simplices(); ++t)
      for (Index i = 0; i < 4; ++i)
        if (mesh_.tets()[t].across[i] >> TetAcross::tet_shift == simplices())
          for (Index k = 0; k < 4; ++k)
            if (k != i) visit(corners_of(t)[k]);
  }
  [[nodiscard]] Point position(Index t, const Weights& weights) {
    Point at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) at = at + weights[i] * space().point(corners_of(t)[i]);
    return at;
  }

  /// `found(source, distance)` for each source that may be the nearest to points of the
  /// tetrahedron, those that its corners know first, until it says true; `distance(weights)` is the
  /// length of the path to a point.
  template <class Found>
  void each_label(Index t, Found found) {
    ends_.clear();
    const auto [first, last] = in_tet_.equal_range(t);
    for (auto own = first; own != last; ++own) ends_.push_back({own->second, none, {}});
    const std::span<const Index> corner(corners_of(t), 4);
    const Point middle = position(t, {.25, .25, .25, .25});
    double farthest = std::numeric_limits<double>::infinity();
    for (const Index v : corner) add_ends(v, middle, farthest);
    if (each_end(t, middle, 0, found)) return;
    const std::size_t near = ends_.size();
    // What is farther everywhere in the tetrahedron than the nearest is of no use.
    for (const Index v : corner) farthest = std::min(farthest, solver_->distance(v));
    farthest += 3 * static_cast<double>(size(t));
    for (const Index v : corner)
      for (const Index w : space_->neighbours(v)) add_ends(w, middle, farthest);
    (void)each_end(t, middle, near, found);
  }

 private:
  struct Seed {
    Point at;
    Index vertex, tet;  // that it is at, or in
    double sigma;
  };
  struct End {
    Index source, vertex;  // none: the source itself is in the tetrahedron
    strings::Label label;
  };
  struct Centre {
    Index tet, source;
    Real distance;
  };

  const strings::MediaSpace& space() {
    if (!space_) space_ = space_of(mesh_);
    return *space_;
  }
  strings::Solver& solver() {
    if (!solver_) {
      solver_.emplace(space());
      solver_->clear();
    }
    return *solver_;
  }
  [[nodiscard]] Index attached() const { return static_cast<Index>(space_->points()); }

  // A source that is added next.
  strings::Source at(Index vertex, double sigma) {
    strings::Source source = source_at(space(), vertex, sigma);
    seeds_.push_back({source.at, vertex, none, sigma});
    return source;
  }
  strings::Source in(Index t, const Weights& weights, double sigma, strings::Inside& inside) {
    for (std::size_t i = 0; i < 4; ++i)
      if (weights[i] == 1) return at(corners_of(t)[i], sigma);
    strings::Source source = source_in(mesh_, space(), t, weights, sigma, inside);
    in_tet_.emplace(t, static_cast<Index>(seeds_.size()));
    seeds_.push_back({source.at, none, t, sigma});
    return source;
  }
  void grow(std::span<const strings::Source> sources, Real radius) {
    strings::Limits limits;
    limits.radius = static_cast<double>(radius);
    solver().add(sources, limits);
    centre_.tet = none;
  }

  void attach(strings::Solver& solver, Index t, const Point& at,
              std::span<const Index> sources) const {
    const strings::Inside inside = inside_of(mesh_, *space_, t, at);
    solver.attach(at, {&inside, 1}, sources);
  }
  // Those of a vertex that may come to a point in less than that.
  void add_ends(Index vertex, const Point& point, double most) {
    for (const strings::Label& label : solver().labels(vertex)) {
      if (!(least(vertex, label, point) < most)) continue;
      const auto same = [&](const End& end) { return end.label.chain == label.chain; };
      if (std::none_of(ends_.begin(), ends_.end(), same))
        ends_.push_back({label.source, vertex, label});
    }
  }
  // No less than that is a vertex' string moved to a point: its length is convex in its end.
  [[nodiscard]] double least(Index vertex, const strings::Label& label, const Point& at) const {
    return label.distance + dot(label.last, at - space_->point(vertex));
  }
  // The sources of ends from `begin` on that none before has.
  template <class Found>
  bool each_end(Index t, const Point& middle, std::size_t begin, Found& found) {
    for (std::size_t n = begin; n < ends_.size(); ++n) {
      const Index source = ends_[n].source;
      const auto of_source = [&](const End& end) { return end.source == source; };
      if (std::any_of(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(n), of_source))
        continue;
      const auto length = [&](const Weights& weights) {
        const Point at = position(t, weights);
        const Point beside = at + space_->aside() * strings::unit(middle - at);
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t k = n; k < ends_.size(); ++k) {
          const End& end = ends_[k];
          if (end.source != source) continue;
          if (end.vertex == none)
            shortest = std::min(shortest, seeds_[source].sigma + norm(at - seeds_[source].at));
          else if (least(end.vertex, end.label, at) < shortest)
            shortest = std::min(shortest, solver_->moved(end.vertex, end.label, at, beside));
        }
        return static_cast<Real>(shortest);
      };
      if (found(source, length)) return true;
    }
    return false;
  }

  const Centre& centre(Index t) {
    if (centre_.tet == t) return centre_;
    std::vector<Index> own;
    const auto [first, last] = in_tet_.equal_range(t);
    for (auto n = first; n != last; ++n) own.push_back(n->second);
    attach(solver(), t, position(t, {.25, .25, .25, .25}), own);
    centre_ = {t, solver_->source(attached()), static_cast<Real>(solver_->distance(attached()))};
    return centre_;
  }

  // Calls visit(source) for those that vertices as near to a point as that know of.
  template <class Visit>
  void each_source_around(std::span<const Index> start, const Point& at, double radius,
                          const Visit& visit) {
    seen_.resize(space().points(), 0);
    known_.resize(seeds_.size(), 0);
    ++turn_;
    around_.assign(start.begin(), start.end());
    for (const Index v : start) seen_[v] = turn_;
    for (std::size_t k = 0; k < around_.size(); ++k) {
      const Index v = around_[k];
      for (const strings::Label& label : solver().labels(v)) {
        const Index n = label.source;
        if (n != none && std::exchange(known_[n], turn_) != turn_) visit(n);
      }
      for (const Index w : space_->neighbours(v))
        if (seen_[w] != turn_ && norm(space_->point(w) - at) <= radius) {
          seen_[w] = turn_;
          around_.push_back(w);
        }
    }
  }

  const TetMesh<Real>& mesh_;
  std::shared_ptr<const strings::MediaSpace> space_;
  std::optional<strings::Solver> solver_, alone_;
  std::vector<Seed> seeds_;
  std::unordered_multimap<Index, Index> in_tet_;  // sources by the tetrahedron that they are in
  Centre centre_ = {none, none, 0};
  std::vector<End> ends_;
  std::vector<Index> around_, seen_, known_;  // of each_source_around
  Index turn_ = 0;
};

}  // namespace plexway::detail
