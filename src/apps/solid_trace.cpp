#include "apps/solid_trace.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "apps/edge_descent.hpp"
#include "apps/infinity.hpp"
#include "apps/solid_pull.hpp"
#include "apps/solid_walk.hpp"

namespace plexway {
namespace {

constexpr double label_margin = 0.98;   // promises of labels are not exact
constexpr double retry_factor = 1.002;  // a reason to look for another way

using Barycentric = std::array<double, 4>;

// The last two corners of a tetrahedron that is turned inside are exchanged.
Barycentric inside_turned(Barycentric b, bool turned) {
  if (turned) std::swap(b[2], b[3]);
  return b;
}

template <class Real>
class SolidTrace {
 public:
  SolidTrace(const TetMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved), walk_(mesh, solved.positions, solved.outer) {}

  Path trace(const PointSource& point) const {
    Index t = none;
    Barycentric b = {};
    Index vertex = point.vertex;
    if (vertex == none) {
      const auto [tet, turned] = mesh_.inside_tet(point.simplex);
      t = tet;
      b = inside_turned(point.barycentric, turned);
      if (const std::size_t i = corner_of(b); i < 4)
        vertex = solved_.outer[mesh_.tets()[t].corner[i]];
    }
    std::vector<Index> begins;
    Index v = none;
    if (vertex != none) {
      v = mesh_.inside_vertex(vertex);
      for (const Index c : mesh_.corners_at(v)) begins.push_back(c / 4);
      if (begins.empty() || !(distance(v) < infinity)) return {};
      t = begins[0];
      for (std::size_t i = 0; i < 4; ++i) b[i] = mesh_.tets()[t].corner[i] == v ? 1 : 0;
    } else {
      begins.push_back(t);
      if (std::none_of(std::begin(mesh_.tets()[t].corner), std::end(mesh_.tets()[t].corner),
                       [&](Index w) { return distance(w) < infinity; }))
        return {};
    }
    SolidPull<Real> puller(walk_);
    Way best;
    double shortest = infinity;
    const auto keep = [&](Way&& way) {
      puller.pull(way.knots);
      const double length = SolidPull<Real>::length(way.knots) + solved_.sources[way.source].offset;
      if (length < shortest) shortest = length, best = std::move(way);
    };
    const Vector3<double> at = v != none ? walk_.vertex(v) : walk_.place(t, b);
    double promise = infinity;
    if (solved_.labels) {
      std::vector<std::pair<double, Index>> order;
      for (const Index begin : begins)
        if (solved_.workspace.marks.reached(begin)) order.emplace_back(estimate(begin, at), begin);
      std::sort(order.begin(), order.end());
      if (!order.empty()) promise = order[0].first;
      std::vector<Index> tried;
      for (const auto& [promised, begin] : order) {
        if (promised * label_margin > shortest) break;
        const auto alike = [&, t = begin](Index u) { return same_scene(t, u); };
        if (std::any_of(tried.begin(), tried.end(), alike)) continue;
        tried.push_back(begin);
        Way way;
        if (follow(begin, at, v, way)) keep(std::move(way));
      }
    }
    if (!(shortest <= promise * retry_factor)) {
      Way way;
      if (descend(t, b, v, way)) keep(std::move(way));
    }
    return shortest < infinity ? to_path(best) : Path{};
  }

 private:
  struct Way {
    std::vector<Knot> knots;
    Index source = none;
  };

  [[nodiscard]] double distance(Index v) const {
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
  }

  [[nodiscard]] bool full_rule() const { return solved_.visibility == Visibility::saddles; }
  /// Labels that look at the same scene lead the same way.
  [[nodiscard]] bool same_scene(Index t, Index u) const {
    const auto& labels = solved_.workspace.solids.labels;
    return full_rule() && same_way(labels[t], labels[u]);
  }
  /// Length of a label's path to a point of its tetrahedron, more or less.
  [[nodiscard]] double estimate(Index t, const Vector3<double>& at) const {
    const Real centre = full_rule() ? solved_.workspace.solids.labels[t].centre
                                    : solved_.workspace.plain_solids.labels[t].centre;
    const Vector3<double> c = walk_.place(t, {.25, .25, .25, .25});
    return std::max(0., static_cast<double>(centre) * mesh_.unit() - norm(at - c));
  }

  [[nodiscard]] std::optional<Barycentric> source_in(Index t, Index number) const {
    const PointSource& s = solved_.sources[number];
    Index vertex = s.vertex;
    if (vertex == none) {
      const auto [tet, turned] = mesh_.inside_tet(s.simplex);
      const Barycentric b = inside_turned(s.barycentric, turned);
      if (t == tet) return b;
      if (const std::size_t i = corner_of(b); i < 4)
        vertex = solved_.outer[mesh_.tets()[tet].corner[i]];
    }
    if (vertex == none) return std::nullopt;
    Barycentric b = {};
    for (std::size_t i = 0; i < 4; ++i)
      if (mesh_.tets()[t].corner[i] == mesh_.inside_vertex(vertex)) {
        b[i] = 1;
        return b;
      }
    return std::nullopt;
  }

  [[nodiscard]] Knot knot_at_vertex(Index v) const {
    Knot knot{walk_.vertex(v), {}, v};
    for (const Index c : mesh_.corners_at(v)) knot.tets.push_back(c / 4);
    return knot;
  }
  [[nodiscard]] Knot knot_at(Index t, const Barycentric& b) const {
    if (const std::size_t i = corner_of(b); i < 4) return knot_at_vertex(mesh_.tets()[t].corner[i]);
    Knot knot{walk_.place(t, b), {}, none};
    walk_.around(t, knot.at, knot.tets);
    return knot;
  }

  /// Back over the faces that labels came in by, through the faces' middles. No tetrahedron is
  /// entered twice, so it ends.
  bool follow(Index t, const Vector3<double>& at, Index v, Way& way) const {
    const Index sentinel = static_cast<Index>(mesh_.tet_count());
    std::unordered_set<Index> visited;
    way.knots.push_back(v != none ? knot_at_vertex(v) : Knot{at, {t}, none});
    for (;;) {
      if (!solved_.workspace.marks.reached(t) || !visited.insert(t).second) return false;
      const Index number = solved_.source_of(t);
      if (number >= solved_.sources.size()) return false;
      if (const auto end = source_in(t, number)) {
        way.knots.push_back(knot_at(t, *end));
        way.source = number;
        return true;
      }
      const std::size_t face = solved_.workspace.marks.hinge(t);
      if (face > 3) return false;
      const Index next = mesh_.tets()[t].across[face] >> TetAcross::tet_shift;
      if (next == sentinel) return false;
      Barycentric middle = {1. / 3, 1. / 3, 1. / 3, 1. / 3};
      middle[face] = 0;
      way.knots.push_back({walk_.place(t, middle), {t, next}, none});
      t = next;
    }
  }

  [[nodiscard]] double edge_length(Index corner, Index j) const {
    const Index t = corner / 4, i = corner % 4;
    return norm(walk_.vertex(mesh_.tets()[t].corner[j]) - walk_.vertex(mesh_.tets()[t].corner[i]));
  }
  /// Between two points of a tetrahedron, from its edges alone.
  [[nodiscard]] double within(Index t, const Barycentric& a, const Barycentric& b) const {
    double sum = 0;
    for (const auto& e : tet_edge_ends) {
      const double l = edge_length(4 * t + e[0], e[1]);
      sum -= (b[e[0]] - a[e[0]]) * (b[e[1]] - a[e[1]]) * l * l;
    }
    return std::sqrt(std::max(sum, 0.));
  }

  bool descend(Index t, const Barycentric& b, Index v, Way& way) const {
    struct End {
      double left = infinity;
      Index number = none;
    };
    std::unordered_map<Index, End> ends;
    const auto offer = [&](Index w, double left, std::size_t n) {
      End& known = ends[w];
      if (left < known.left) known = {left, static_cast<Index>(n)};
    };
    const auto corner = [](std::size_t i) {
      Barycentric at = {};
      at[i] = 1;
      return at;
    };
    for (std::size_t n = 0; n < solved_.sources.size(); ++n) {
      const PointSource& s = solved_.sources[n];
      if (s.vertex != none) {
        offer(mesh_.inside_vertex(s.vertex), s.offset, n);
        continue;
      }
      const auto [tet, turned] = mesh_.inside_tet(s.simplex);
      for (std::size_t i = 0; i < 4; ++i)
        offer(mesh_.tets()[tet].corner[i],
              s.offset + within(tet, inside_turned(s.barycentric, turned), corner(i)), n);
    }
    const auto end = [&](Index w) {
      const auto found = ends.find(w);
      return found == ends.end() ? infinity : found->second.left;
    };
    const auto edges = [&](Index w, auto visit) {
      for (const Index c : mesh_.corners_at(w))
        for (Index j = 0; j < 4; ++j)
          if (j != c % 4) visit(mesh_.tets()[c / 4].corner[j], edge_length(c, j));
    };
    Index first = v;
    if (first == none) {
      double least = infinity;
      for (std::size_t i = 0; i < 4; ++i) {
        const double d = distance(mesh_.tets()[t].corner[i]) + within(t, b, corner(i));
        if (d < least) least = d, first = mesh_.tets()[t].corner[i];
      }
      if (first == none) return false;
    }
    const std::vector<Index> vertices = descend_edges(
        first, [&](Index w) { return distance(w); }, end, edges);
    if (vertices.empty()) return false;
    way.source = ends.at(vertices.back()).number;
    if (v == none) way.knots.push_back(Knot{walk_.place(t, b), {t}, none});
    for (const Index w : vertices) way.knots.push_back(knot_at_vertex(w));
    const PointSource& s = solved_.sources[way.source];
    if (s.vertex == none) {
      const auto [tet, turned] = mesh_.inside_tet(s.simplex);
      way.knots.push_back(knot_at(tet, inside_turned(s.barycentric, turned)));
    }
    if (way.knots.size() == 1) way.knots.push_back(way.knots.front());
    return true;
  }

  void push(Path& path, Index t, const Barycentric& b) const {
    const Index number = solved_.outer_simplices[t];
    path.points.push_back({number, inside_turned(b, mesh_.inside_tet(number).second)});
    if (solved_.positions.empty()) return;
    const Vector3<double> p = walk_.place(t, b);
    path.positions.push_back({p.x, p.y, p.z});
  }

  /// The knots as points of the tetrahedra between.
  Path to_path(const Way& way) const {
    Path path;
    path.source = way.source;
    path.length = 0;
    std::vector<typename SolidWalk<Real>::Step> steps;
    Index last = way.knots.front().tets.front();
    Vector3<double> before = way.knots.front().at;
    const auto add = [&](Index t, const Vector3<double>& at) {
      Barycentric b = walk_.barycentric(t, at);
      double sum = 0;
      for (double& x : b) {
        if (!(x > 1e-15)) x = 0;
        sum += x;
      }
      if (!(sum > 0)) return;
      for (double& x : b) x /= sum;
      const Vector3<double> placed = walk_.place(t, b);
      if (!path.points.empty()) path.length += norm(placed - before);
      before = placed;
      push(path, t, b);
    };
    for (std::size_t k = 0; k + 1 < way.knots.size(); ++k) {
      const Vector3<double>&p = way.knots[k].at, &q = way.knots[k + 1].at;
      walk_.walk(way.knots[k].tets, p, q, &steps);
      for (const auto& step : steps) {
        if (!(step.end > step.begin)) continue;
        add(step.tet, p + step.begin * (q - p));
        last = step.tet;
      }
    }
    add(last, way.knots.back().at);
    return path;
  }

  const TetMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  SolidWalk<Real> walk_;
};

}  // namespace

template <class Real>
Path trace_solid(const TetMesh<Real>& mesh, const Solved<Real>& solved, const PointSource& point) {
  return SolidTrace<Real>(mesh, solved).trace(point);
}

template Path trace_solid(const TetMesh<float>&, const Solved<float>&, const PointSource&);
template Path trace_solid(const TetMesh<double>&, const Solved<double>&, const PointSource&);

}  // namespace plexway
