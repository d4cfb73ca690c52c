#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "paths/cloud_points.hpp"
#include "sampling/cell_contents.hpp"
#include "sampling/cell_moments.hpp"

namespace plexway {
using namespace detail;
namespace {

template <class Complex>
class Lloyd {
  using Field = Growth<Complex>;
  using Real = typename Field::Number;
  using Moments = CellMoments<Complex>;
  using Place = typename Moments::Place;
  using Vector = typename Moments::Vector;
  static constexpr double dimension = Field::corners - 1;

 public:
  Lloyd(const Complex& domain, std::span<const PointSource> seeds)
      : domain_(domain), numbers_(domain), field_(domain, workspace_), moments_(domain, field_) {
    for (const PointSource& seed : seeds) places_.push_back(place_of(seed));
    cells_.resize(seeds.size());
  }

  CentroidalVoronoi run(const VoronoiOptions& options) {
    CentroidalVoronoi result;
    const double unit = domain_.unit(), size = std::pow(unit, dimension);
    divide(result.statistics);
    for (std::size_t n = 0; n < options.max_iterations && !result.converged; ++n) {
      VoronoiStep step;
      step.energy = energy_ * size * unit * unit;
      double content = 0;
      for (const Cell& cell : cells_) content += cell.content;
      const double moved = options.centre == CellCentre::centroid ? to_centroids(result.statistics)
                                                                  : from_border(result.statistics);
      step.movement = moved * unit;
      result.steps.push_back(step);
      result.converged =
          moved <=
          options.tolerance * std::pow(content / static_cast<double>(cells_.size()), 1 / dimension);
      if (options.progress && !options.progress(step))
        throw Cancelled("cancelled by the progress callback");
    }
    result.energy = energy_ * size * unit * unit;
    for (const Place& place : places_)
      result.seeds.push_back(numbers_.outside(place.first, place.second));
    result.cell_content = cell_contents(field_, cells_.size());
    for (double& content : result.cell_content) content *= size;
    result.label.assign(field_.simplices(), none);
    for (Index s = 0; s < field_.simplices(); ++s)
      if (field_.reached(s)) result.label[numbers_.outside(s, {}).simplex] = field_.source(s);
    return result;
  }

 private:
  struct Cell {
    double content = 0;
    Vector vector{};  // content times the mean
  };

  Place place_of(const PointSource& seed) {
    if (seed.vertex == none) {
      const Place place = numbers_.inside(seed);
      return {place.first, Moments::inside(place.second)};
    }
    const Index corner = field_.corner_at(domain_.inside_vertex(seed.vertex));
    if (corner == none)
      throw UsageError("vertex " + std::to_string(seed.vertex) +
                       " lies in no simplex: it cannot be a seed");
    Weights w{};
    w[corner % Field::corners] = 1;
    return {corner / static_cast<Index>(Field::corners), Moments::inside(w)};
  }

  /// Cells, and what they are around their seeds.
  void divide(PropagateStatistics& statistics) {
    field_.clear();
    field_.add_all(places_, farthest_ * Real(1.1));
    add(statistics, field_.totals());
    if (farthest_ < infinity && field_.totals().reached_simplices < reached_) {
      field_.clear();  // cells grew by more than that
      field_.add_all(places_, infinity);
      add(statistics, field_.totals());
    }
    reached_ = field_.totals().reached_simplices;
    farthest_ = 0;
    std::fill(cells_.begin(), cells_.end(), Cell{});
    energy_ = 0;
    moments_.each(
        places_, [&](Index seed, double content, const Vector& vector, double squared, double own) {
          Cell& cell = cells_[seed];
          cell.content += content;
          for (std::size_t k = 0; k < vector.size(); ++k) cell.vector[k] += content * vector[k];
          energy_ += content * (squared + own);
          farthest_ = std::max(farthest_, static_cast<Real>(squared));
        });
    farthest_ = std::sqrt(farthest_) + 1;
  }

  /// Moves seeds and divides again. Where simplices are coarse or paths bend, the mean is not quite
  /// the best place: if the energy should rise, less of the way, and at last none (0).
  double to_centroids(PropagateStatistics& statistics) {
    const std::vector<Place> places = places_;
    const std::vector<Cell> cells = cells_;
    const double energy = energy_;
    for (double share = 1; share > 0.1; share /= 2) {
      double sum = 0;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!(cells[i].content > 0)) continue;
        Vector way = cells[i].vector;
        for (double& x : way) x *= share / cells[i].content, sum += x * x;
        places_[i] = moments_.walk(places[i], way);
      }
      divide(statistics);
      if (energy_ < energy) return std::sqrt(sum / static_cast<double>(cells.size()));
    }
    places_ = places;
    divide(statistics);
    return 0;
  }

  /// The simplex of each cell that is farthest from the vertices at its border, and at the
  /// domain's.
  double from_border(PropagateStatistics& statistics) {
    std::vector<Index> label(domain_.vertex_count(), none), border;
    std::vector<bool> mixed(label.size(), false);
    for (Index s = 0; s < field_.simplices(); ++s) {
      if (!field_.reached(s)) continue;
      for (std::size_t i = 0; i < Field::corners; ++i) {
        const Index v = field_.corners_of(s)[i];
        if (label[v] == none) label[v] = field_.source(s);
        if (label[v] != field_.source(s) && !mixed[v]) mixed[v] = true, border.push_back(v);
      }
    }
    // A seed should not go to the rim of the domain.
    field_.each_rim_vertex([&](Index v) {
      if (!mixed[v]) mixed[v] = true, border.push_back(v);
    });
    if (border.empty()) return 0;
    Field away(domain_, border_workspace_);
    away.add_all_vertices(border);
    add(statistics, away.totals());
    std::vector<std::pair<Real, Index>> best(cells_.size(), {Real(-1), none});
    for (Index s = 0; s < field_.simplices(); ++s)
      if (field_.reached(s) && away.reached(s) && away.distance(s) > best[field_.source(s)].first)
        best[field_.source(s)] = {away.distance(s), s};
    double sum = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Index s = best[i].second;
      if (s == none) continue;
      const double d = static_cast<double>(field_.distance(s));
      if (s == places_[i].first) continue;
      sum += d * d;
      Weights w{};
      std::fill_n(w.begin(), Field::corners, 1. / static_cast<double>(Field::corners));
      places_[i] = {s, w};
    }
    divide(statistics);
    return std::sqrt(sum / static_cast<double>(cells_.size()));
  }

  static void add(PropagateStatistics& sum, const PropagateStatistics& more) {
    sum.expansions += more.expansions;
    sum.updates += more.updates;
    sum.reached_simplices = more.reached_simplices;
  }

  const Complex& domain_;
  SimplexNumbers<Complex> numbers_;
  WorkspaceState<Real> workspace_, border_workspace_;
  Field field_;
  Moments moments_;
  std::vector<Place> places_;
  std::vector<Cell> cells_;
  double energy_ = 0;
  Real farthest_ = std::numeric_limits<Real>::infinity();  // of a simplex from its seed, at most
  std::size_t reached_ = 0;
};

template <class Complex>
CentroidalVoronoi voronoi(const Complex& domain, std::span<const PointSource> seeds,
                          const VoronoiOptions& options, const SourceDomain& limits) {
  check(seeds, {}, limits);
  if (!(options.tolerance >= 0)) throw UsageError("the tolerance must be >= 0");
  return Lloyd<Complex>(domain, seeds).run(options);
}

/// The point of a cloud nearest to each place in its sheet, no point twice.
template <class Real>
std::vector<PointSource> nearest_points(const PointCloud<Real>& cloud,
                                        std::span<const PointSource> places) {
  const TriangleMesh<Real>& sheet = cloud.surface();
  const SimplexNumbers<TriangleMesh<Real>> numbers(sheet);
  std::vector<bool> taken(sheet.vertex_count(), false);
  // What joins two points is none.
  for (Index v = static_cast<Index>(cloud.point_count()); v < taken.size(); ++v)
    taken[sheet.inside_vertex(v)] = true;
  std::vector<PointSource> points;
  std::vector<Index> corners;
  for (const PointSource& place : places) {
    const auto [face, turned] = sheet.inside_face(place.simplex);
    std::array<double, 3> b = {place.barycentric[0], place.barycentric[turned ? 2 : 1],
                               place.barycentric[turned ? 1 : 2]};
    // Triangle by triangle around it, until one has a corner that is free.
    std::vector<Index> around = {face};
    Index best = none;
    for (std::size_t k = 0; k < around.size() && best == none; ++k) {
      const TriangleRecord<Real>& t = sheet.triangles()[around[k]];
      const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
      const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = k > 0 ? 0 : b[1] * px[1] + b[2] * px[2] - px[i];
        const double y = k > 0 ? 0 : b[2] * py[2] - py[i];
        if (!taken[t.corner[i]] && std::hypot(x, y) < least)
          least = std::hypot(x, y), best = t.corner[i];
      }
      for (const Index v : t.corner) {
        if (best != none) break;
        sheet.corners_at(v, corners);
        for (const Index c : corners)
          if (std::find(around.begin(), around.end(), c / 3) == around.end())
            around.push_back(c / 3);
      }
    }
    if (best == none)
      throw UsageError("there are more seeds than points: " + std::to_string(places.size()));
    taken[best] = true;
    points.push_back(PointSource::at(numbers.outside_vertex(best)));
  }
  return points;
}

}  // namespace

template <class Real>
CentroidalVoronoi centroidal_voronoi(Serial, const TriangleMesh<Real>& mesh,
                                     std::span<const PointSource> seeds,
                                     const VoronoiOptions& options) {
  return voronoi(mesh, seeds, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
}

template <class Real>
CentroidalVoronoi centroidal_voronoi(Serial, const TetMesh<Real>& mesh,
                                     std::span<const PointSource> seeds,
                                     const VoronoiOptions& options) {
  support(Purpose::samples, mesh).require();
  return voronoi(mesh, seeds, options, {mesh.vertex_count(), mesh.tet_count(), "tet", 4});
}

template <class Real>
CentroidalVoronoi centroidal_voronoi(Serial executor, const PointCloud<Real>& cloud,
                                     std::span<const PointSource> seeds,
                                     const VoronoiOptions& options) {
  const TriangleMesh<Real>& sheet = cloud.surface();
  const std::vector<PointSource> start = first_at_place(cloud, seeds);
  CentroidalVoronoi result =
      centroidal_voronoi(executor, sheet, std::span<const PointSource>(start), options);
  result.seeds = nearest_points(cloud, result.seeds);
  VoronoiOptions stay;
  stay.max_iterations = 0;
  const CentroidalVoronoi there =
      centroidal_voronoi(executor, sheet, std::span<const PointSource>(result.seeds), stay);
  result.energy = there.energy;
  result.cell_content = there.cell_content;
  const auto field = solve(executor, cloud, std::span<const PointSource>(result.seeds));
  result.label = field.label;
  if (result.label.empty())  // a single seed
    for (const Real d : field.distance)
      result.label.push_back(d < std::numeric_limits<Real>::infinity() ? 0 : none);
  return result;
}

template CentroidalVoronoi centroidal_voronoi(Serial, const PointCloud<float>&,
                                              std::span<const PointSource>, const VoronoiOptions&);
template CentroidalVoronoi centroidal_voronoi(Serial, const PointCloud<double>&,
                                              std::span<const PointSource>, const VoronoiOptions&);
template CentroidalVoronoi centroidal_voronoi(Serial, const TriangleMesh<float>&,
                                              std::span<const PointSource>, const VoronoiOptions&);
template CentroidalVoronoi centroidal_voronoi(Serial, const TriangleMesh<double>&,
                                              std::span<const PointSource>, const VoronoiOptions&);
template CentroidalVoronoi centroidal_voronoi(Serial, const TetMesh<float>&,
                                              std::span<const PointSource>, const VoronoiOptions&);
template CentroidalVoronoi centroidal_voronoi(Serial, const TetMesh<double>&,
                                              std::span<const PointSource>, const VoronoiOptions&);

DualTriangulation dual_triangulation(std::span<const std::array<Index, 3>> faces,
                                     std::span<const Index> vertex_label, std::size_t seeds) {
  DualTriangulation dual;
  std::map<std::pair<Index, Index>, int> sides;  // mesh edges between two cells: faces there
  std::map<std::pair<Index, Index>, bool> ends;  // pairs of cells: does their border reach the rim?
  const auto ordered = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& face : faces) {
    std::array<Index, 3> l;
    for (std::size_t i = 0; i < 3; ++i) l[i] = vertex_label[face[i]];
    for (std::size_t i = 0; i < 3; ++i)
      if (l[i] != l[(i + 1) % 3]) ++sides[ordered(face[i], face[(i + 1) % 3])];
    if (l[0] != none && l[1] != none && l[2] != none && l[0] != l[1] && l[1] != l[2] &&
        l[2] != l[0])
      dual.triangles.push_back(l);
  }
  for (const auto& [edge, count] : sides)
    if (count == 1) ends[ordered(vertex_label[edge.first], vertex_label[edge.second])] = true;

  std::vector<bool> irregular(seeds, false);
  std::map<std::pair<Index, Index>, int> edges;
  std::vector<std::vector<std::pair<Index, Index>>> link(seeds);  // edges opposite a seed
  for (const auto& t : dual.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[ordered(t[i], t[(i + 1) % 3])];
      link[t[i]].emplace_back(t[(i + 1) % 3], t[(i + 2) % 3]);
    }
  for (const auto& [edge, count] : edges)
    if (count != (ends.count(edge) ? 1 : 2)) irregular[edge.first] = irregular[edge.second] = true;
  for (Index s = 0; s < seeds; ++s) {
    // One fan: from edge to edge around the seed, all are met.
    auto& open = link[s];
    if (open.empty()) {
      irregular[s] = true;
      continue;
    }
    std::map<Index, std::vector<Index>> next;
    for (const auto& [a, b] : open) next[a].push_back(b), next[b].push_back(a);
    std::vector<Index> todo = {open[0].first};
    std::map<Index, bool> seen = {{todo[0], true}};
    while (!todo.empty()) {
      const Index at = todo.back();
      todo.pop_back();
      for (const Index to : next[at])
        if (!std::exchange(seen[to], true)) todo.push_back(to);
    }
    if (seen.size() != next.size()) irregular[s] = true;
  }
  for (Index s = 0; s < seeds; ++s)
    if (irregular[s]) dual.irregular.push_back(s);
  dual.manifold = dual.irregular.empty();
  return dual;
}

}  // namespace plexway
