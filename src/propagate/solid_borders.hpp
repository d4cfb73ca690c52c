#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "propagate/progress_counter.hpp"
#include "propagate/solid_border_memory.hpp"
#include "propagate/solid_read_out.hpp"
#include "propagate/workspace_state.hpp"

namespace plexway {

/// From several sources, after the read-out: vertices between the cells of two sources. A
/// tetrahedron keeps one label, so that such a vertex may have none that comes from its own source.
/// Neighbours that have another source ask about it: a front over vertices, which takes ways by
/// labels' strings, wherever these labels lie.
///
/// A vertex hands on its own way, and others that might be the shortest at some point around it:
/// which are longer by no more than the two can differ between the vertex and that point. So a cell
/// that tapers off between vertices is followed to its end.
///
/// By one thread, so with any number of them the same. Cost: the vertices at borders, times the
/// cells around each. It can be cancelled; a budget of expansions does not count it.
///
/// TetOf: tetrahedron(v) is the one whose label gave vertex v its distance, or none.
template <class Real, class Rule, class Front, class TetOf>
class SolidBorders {
  using Memory = SolidBorderMemory<Real>;
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;

 public:
  SolidBorders(const TetMesh<Real>& mesh, const Rule& rule, const Front& front,
               WorkspaceState<Real>& workspace, const PropagateOptions& options,
               const TetOf& tetrahedron)
      : mesh_(mesh),
        options_(options),
        tets_(mesh.tets()),
        rule_(rule),
        front_(front),
        tetrahedron_(tetrahedron),
        distance_(workspace.vertex),
        source_(workspace.vertex_source),
        memory_(workspace.borders),
        radius_(static_cast<Real>(options.radius / mesh.unit())),
        walks_(rule.walks()) {}

  /// What vertices know was read out, and the distances at the sources. Throws Cancelled.
  void run(std::span<const PointSource> sources) {
    memory_.start(mesh_.vertex_count());
    start_at_borders();
    for (std::size_t n = 0; n < sources.size(); ++n) start_at(sources[n], static_cast<Index>(n));
    ProgressCounter told(options_, 1024);  // that takes some hundredths of a second
    for (std::size_t next = 0; next < memory_.waiting.size(); ++next) {
      const Waiting waiting = memory_.waiting[next];
      told.count(next, [&] {
        return Progress{front_.expansions(), mesh_.tet_count(), mesh_.tet_count(),
                        static_cast<double>(waiting.distance) * mesh_.unit()};
      });
      hand_on(waiting);
    }
  }

 private:
  using Waiting = typename Memory::Waiting;
  using Around = typename Memory::Around;
  using Neighbour = typename Memory::Neighbour;

  /// As a share of the longest edge at a vertex: no point of a face is farther from the nearest of
  /// its corners.
  static constexpr Real nearest_corner = Real(0.5);
  /// Within rounding of its own way a vertex stays with that one.
  static constexpr Real gain = 1 - 16 * std::numeric_limits<Real>::epsilon();

  void start_at_borders() {
    const Index count = static_cast<Index>(mesh_.tet_count());
    for (Index t = 0; t < count; ++t) {
      if (!front_.reached(t)) continue;
      const Index here = front_.source(t);
      const Index* corner = tets_[t].corner;
      if (source_[corner[0]] == here && source_[corner[1]] == here && source_[corner[2]] == here &&
          source_[corner[3]] == here)
        continue;
      for (Index i = 0; i < 4; ++i) {
        const Index v = corner[i], way = own_way(v);
        if (way != none && note(v, way)) memory_.waiting.push_back({v, way, distance_[v]});
      }
    }
  }

  void start_at(const PointSource& source, Index number) {
    const Index way = number_of(label_of(source), number);
    offer_corners(mesh_, source, [&](Index v, double d) {
      const Real distance = static_cast<Real>(d);
      if (!(distance <= radius_) || !note(v, way)) return;
      if (source_[v] == number && !(distance > distance_[v])) memory_.vertices[v].way = way;
      memory_.waiting.push_back({v, way, distance});
    });
  }
  /// As it was seeded.
  Label label_of(const PointSource& source) const {
    const Real sigma = static_cast<Real>(source.offset / mesh_.unit());
    if (source.vertex != none)
      return Rule::point_label(mesh_.points()[mesh_.inside_vertex(source.vertex)], sigma);
    std::array<double, 4> b = source.barycentric;
    const auto [t, turned] = mesh_.inside_tet(source.simplex);
    if (turned) std::swap(b[2], b[3]);
    return Rule::point_label(rule_.place(t, b), sigma);
  }

  void hand_on(const Waiting waiting) {
    const Label label = memory_.ways[waiting.way].label;
    const Index source = memory_.ways[waiting.way].source;
    const Around around = around_of(waiting.vertex);
    const Real room = nearest_corner * around.longest;
    if (waiting.distance > distance_[waiting.vertex] &&
        !may_be_best_near(waiting.vertex, waiting.distance, label, room))
      return;
    for (Index n = around.begin; n < around.end; ++n) {
      const Neighbour to = memory_.neighbours[n];
      if (source_[to.vertex] == none || (source_[to.vertex] == source && !walks_)) continue;
      if (note(to.vertex, waiting.way)) ask(to, waiting, label, source, room);
    }
  }

  void ask(const Neighbour to, const Waiting from, const Label& label, Index source, Real room) {
    const Index v = to.vertex;
    const Real to_beat = distance_[v] * gain;
    const Real straight = label.sigma + norm(mesh_.points()[v] - label.source);
    if (!(straight < to_beat + 2 * room && straight <= radius_)) return;
    if (!walks_) {
      if (straight < to_beat)
        take(v, from.way, source, straight);
      else if (may_be_best_near(v, straight, label, room))
        memory_.waiting.push_back({v, from.way, straight});
      return;
    }
    Label there = label;
    bool wanted = false;
    const Real found =
        rule_.carry_on(there, from.vertex, to.corner / 4, to.corner % 4, to_beat, [&](Real extent) {
          wanted = extent < to_beat ||
                   (source_[v] != source && may_be_best_near(v, extent, label, room));
          return wanted;
        });
    if (!(found < std::numeric_limits<Real>::infinity())) {
      if (wanted) forget(v);  // from another side what hides it may be found
      return;
    }
    if (found > radius_) return;
    Index way = from.way;
    if (!is_same(there, label)) {  // around a further edge
      way = number_of(there, source);
      if (!note(v, way)) return;
    }
    if (found < to_beat)
      take(v, way, source, found);
    else
      memory_.waiting.push_back({v, way, found});
  }

  void take(Index v, Index way, Index source, Real distance) {
    distance_[v] = distance;
    source_[v] = source;
    memory_.vertices[v].way = way;
    memory_.waiting.push_back({v, way, distance});
    if (!walks_ || !std::binary_search(mesh_.pinched().begin(), mesh_.pinched().end(), v)) return;
    // Where tetrahedra only touch in the vertex, paths bend there.
    const Index bent = number_of(Rule::point_label(mesh_.points()[v], distance), source);
    if (note(v, bent)) memory_.waiting.push_back({v, bent, distance});
  }

  /// Where a way to v is no shorter than that of v: may it be so at a point that is no farther from
  /// v than `room`? On the way there the two get longer and shorter by the directions they have.
  bool may_be_best_near(Index v, Real distance, const Label& label, Real room) {
    const Real longer = distance - distance_[v];
    if (!(longer < 2 * room)) return false;
    const Index own = own_way(v);
    if (own == none) return true;
    const Point& q = mesh_.points()[v];
    const Point a = q - rule_.last_bend(label, q);
    const Point b = q - rule_.last_bend(memory_.ways[own].label, q);
    const Real size2 = dot(a, a) * dot(b, b);
    if (!(size2 > 0)) return true;
    return longer * longer < 2 * room * room * (1 - dot(a, b) / std::sqrt(size2));
  }

  Index own_way(Index v) {
    Index& way = memory_.vertices[v].way;
    if (way == none)
      if (const Index t = tetrahedron_(v); t != none)
        way = number_of(front_.label(t), front_.source(t));
    return way;
  }

  Around around_of(Index v) {
    Index& number = memory_.vertices[v].around;
    if (number != none) return memory_.around[number];
    const std::span<const Point> points = mesh_.points();
    Around around = {static_cast<Index>(memory_.neighbours.size()), 0, 0};
    Real longest2 = 0;
    for (const Index c : mesh_.corners_at(v)) {
      const Index t = c / 4;
      for (Index k = 1; k < 4; ++k) {
        const Index i = (c + k) & 3, w = tets_[t].corner[i];
        if (memory_.vertices[w].listed == v) continue;
        memory_.vertices[w].listed = v;
        const Point edge = points[w] - points[v];
        longest2 = std::max(longest2, dot(edge, edge));
        memory_.neighbours.push_back({w, 4 * t + i});
      }
    }
    around.end = static_cast<Index>(memory_.neighbours.size());
    around.longest = std::sqrt(longest2);
    number = static_cast<Index>(memory_.around.size());
    memory_.around.push_back(around);
    return around;
  }

  /// Notes that v is asked about a way. False if it was before.
  bool note(Index v, Index way) {
    Index& last = memory_.vertices[v].asked;
    for (Index n = last; n != none; n = memory_.asked[n].before)
      if (memory_.asked[n].way == way) return false;
    memory_.asked.push_back({way, last});
    last = static_cast<Index>(memory_.asked.size() - 1);
    return true;
  }

  /// The last that v was asked about.
  void forget(Index v) {
    memory_.vertices[v].asked = memory_.asked[memory_.vertices[v].asked].before;
  }

  static bool is_same(const Label& a, const Label& b) { return same_way(a, b) && a.door == b.door; }
  /// One a way, whichever tetrahedra keep it.
  Index number_of(const Label& label, Index source) {
    auto& first = memory_.way_of_hash;
    auto& ways = memory_.ways;
    Index& known = first[hash_of(label) & (first.size() - 1)];
    for (Index n = known; n != none; n = ways[n].before)
      if (is_same(ways[n].label, label)) return n;
    const Index number = static_cast<Index>(ways.size());
    ways.push_back({label, source, known});
    known = number;
    if (ways.size() > first.size()) {
      first.assign(2 * first.size(), none);
      for (Index n = 0; n <= number; ++n)
        ways[n].before = std::exchange(first[hash_of(ways[n].label) & (first.size() - 1)], n);
    }
    return number;
  }
  static std::size_t hash_of(const Label& label) {
    std::uint64_t hash = label.bend[0];
    for (const Real x : {label.source.x, label.source.y, label.source.z, label.sigma})
      hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(x + Real(0)))) *
             0x9e3779b97f4a7c15U;
    return static_cast<std::size_t>(hash >> 20);
  }

  const TetMesh<Real>& mesh_;
  const PropagateOptions& options_;
  const std::span<const TetRecord<Real>> tets_;
  const Rule& rule_;
  const Front& front_;
  const TetOf& tetrahedron_;
  std::vector<Real>& distance_;
  std::vector<Index>& source_;
  Memory& memory_;
  const Real radius_;
  const bool walks_;
};

}  // namespace plexway
