// Error against mesh size: smooth surfaces, a polyhedral one, a regular grid, solids with
// obstacles. convergence.sh draws the plot.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "data/shapes.hpp"
#include "solver.hpp"
#ifdef PLEXWAY_HAS_TETGEN
#include "solid_domains.hpp"
#endif

namespace bench::convergence {

using samples::Point;
using samples::Shape;
using samples::operator-;

struct Sample {
  std::size_t simplices = 0;
  double edge = 0;  ///< mean, in the unit of the domain
  Errors::Summary errors{};
};

Sample measure(const Shape& shape, Index source, const std::vector<double>& exact) {
  const plexway::TriangleMesh<double> mesh(shape.points, shape.faces);
  Errors errors;
  errors.add({source, exact}, distances(mesh, plexway::PointSource::at(source), one_label()));
  return {shape.faces.size(), mesh.unit(), *errors.summary()};
}

Index nearest(const Shape& shape, const Point& at) {
  Index best = 0;
  const auto gap = [&](Index v) {
    const Point way = shape.points[v] - at;
    return samples::dot(way, way);
  };
  for (Index v = 0; v < shape.points.size(); ++v)
    if (gap(v) < gap(best)) best = v;
  return best;
}

/// Great circles; the vertices lie on the round sphere.
Sample sphere(Index n) {
  const Shape shape = samples::geodesic_sphere(n);
  const Index source = nearest(shape, samples::unit({1, 2, 3}));
  const Point s = shape.points[source];
  std::vector<double> exact;
  for (const Point& p : shape.points) {
    const Point across = samples::cross(s, p);
    exact.push_back(std::atan2(std::sqrt(samples::dot(across, across)), samples::dot(s, p)));
  }
  return measure(shape, source, exact);
}

Shape torus(Index rings) {
  Shape shape;
  const Index sides = rings / 2;
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sides; ++j) {
      const double u = 2 * samples::pi * i / rings, v = 2 * samples::pi * j / sides;
      const double r = 1 + 0.4 * std::cos(v);
      shape.add({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  samples::add_tube_faces(shape, rings, sides);
  return shape;
}

/// Its vertices are some of the finest mesh's, whose distances stand in for exact ones.
constexpr Index finest_torus = 1024;
Sample torus_sample(Index rings) {
  static const std::vector<double> reference = [] {
    const Shape fine = torus(finest_torus);
    return distances(plexway::TriangleMesh<double>(fine.points, fine.faces),
                     plexway::PointSource::at(0), one_label());
  }();
  const Index step = finest_torus / rings;
  std::vector<double> exact;
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < rings / 2; ++j)
      exact.push_back(reference[i * step * (finest_torus / 2) + j * step]);
  return measure(torus(rings), 0, exact);
}

/// The surface of the unit cube, from a corner: faces unfolded into a plane.
Sample cube(Index n) {
  Shape shape;
  samples::Noise noise(n);
  std::map<std::array<Index, 3>, Index> number;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Index side : {Index{0}, n}) {
      std::vector<Index> grid;
      for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j) {
          std::array<Index, 3> at{};
          at[axis] = side, at[(axis + 1) % 3] = i, at[(axis + 2) % 3] = j;
          const auto [found, is_new] = number.try_emplace(at, 0);
          if (is_new) {
            const bool inner = i > 0 && i < n && j > 0 && j < n;
            Point p{};
            p[axis] = side == 0 ? 0 : 1;
            p[(axis + 1) % 3] = (i + (inner ? .25 * noise() : 0)) / n;
            p[(axis + 2) % 3] = (j + (inner ? .25 * noise() : 0)) / n;
            found->second = shape.add(p);
          }
          grid.push_back(found->second);
        }
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Index a = i * (n + 1) + j;
          samples::add_quad(shape, grid[a], grid[a + n + 1], grid[a + n + 2], grid[a + 1]);
        }
    }
  std::vector<double> exact;
  for (const Point& p : shape.points) {
    double d = std::hypot(p[0], p[1], p[2]);
    if (p[0] > 0 && p[1] > 0 && p[2] > 0) {
      d = 4;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] < 1) continue;
        const double y = p[(axis + 1) % 3], z = p[(axis + 2) % 3];
        d = std::min({d, std::hypot(1 + y, z), std::hypot(1 + z, y)});
      }
    }
    exact.push_back(d);
  }
  return measure(shape, nearest(shape, {0, 0, 0}), exact);
}

/// A ripple, z = .1 cos 6 r, over a regular grid whose squares are all cut the same way. From its
/// centre the meridians are shortest.
Sample ripple(Index n) {
  Shape shape;
  constexpr double high = .1, often = 6;
  std::vector<double> exact;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const double x = 2. * i / n - 1, y = 2. * j / n - 1, r = std::hypot(x, y);
      shape.add({x, y, high * std::cos(often * r)});
      double length = 0;  // Simpson's rule
      constexpr int parts = 200;
      for (int k = 0; k <= parts; ++k) {
        const double slope = high * often * std::sin(often * r * k / parts);
        length += (k == 0 || k == parts ? 1 : 2 + 2 * (k % 2)) * std::sqrt(1 + slope * slope);
      }
      exact.push_back(length * r / parts / 3);
    }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j;
      shape.faces.push_back({a, a + n + 1, a + n + 2});
      shape.faces.push_back({a, a + n + 2, a + 1});
    }
  return measure(shape, nearest(shape, {0, 0, high}), exact);
}

#ifdef PLEXWAY_HAS_TETGEN
Sample measure(const SolidDomain& domain) {
  const plexway::TetMesh<double> mesh(domain.positions, domain.tets);
  Errors errors;
  errors.add(domain.truth,
             distances(mesh, plexway::PointSource::at(domain.truth.source), one_label()));
  return {domain.tets.size(), mesh.unit(), *errors.summary()};
}
#endif

struct Series {
  std::string name, kind;
  std::string exact;  ///< what errors are against
  std::vector<double> sizes;
  std::function<Sample(double)> sample;
};

std::vector<Series> all_series(double most_tets) {
  const auto of = [](Sample (*sample)(Index)) {
    return [sample](double n) { return sample(static_cast<Index>(n)); };
  };
  std::vector<Series> all = {
      {"sphere", "smooth surface", "great circles", {8, 16, 32, 64, 128}, of(sphere)},
      {"torus",
       "smooth surface",
       "itself, 1 M triangles",
       {16, 32, 64, 128, 256},
       of(torus_sample)},
      {"cube", "polyhedral surface", "unfolding", {8, 16, 32, 64, 128}, of(cube)},
      {"ripple", "regular grid", "meridians", {16, 32, 64, 128, 256}, of(ripple)}};
#ifdef PLEXWAY_HAS_TETGEN
  std::vector<double> tets;
  for (const double n : {10e3, 30e3, 100e3, 250e3, 500e3})
    if (n <= most_tets) tets.push_back(n);
  const auto solid = [](SolidDomain (*make)(double)) {
    return [make](double n) { return measure(make(n)); };
  };
  all.push_back({"pipe", "solid", "the same prism", tets, solid(pipe_domain)});
  all.push_back({"cavity", "solid", "the round ball", tets, solid(cavity_domain)});
#else
  static_cast<void>(most_tets);
#endif
  return all;
}

void run(Arguments& arguments) {
  std::vector<std::string> only;
  double most_tets = 500e3;
  arguments.names("--only", &only, "Names of series");
  arguments.option("--most-tets", &most_tets, "Tetrahedra at most");
  Table& table = arguments.table(
      "series: domain; kind; exact: against; simplices; edge: mean edge %.3g;"
      "mean: error mean %.1e; p99 %.1e; max %.1e; below: most below %.1e; order %.1f");
  for (const Series& series : all_series(most_tets)) {
    if (!only.empty() && std::find(only.begin(), only.end(), series.name) == only.end()) continue;
    double edge = 0, mean = 0;
    for (const double size : series.sizes) {
      std::cerr << series.name << ' ' << size << std::endl;
      const Sample s = series.sample(size);
      Row row = {{"series", series.name},    {"kind", series.kind}, {"exact", series.exact},
                 {"simplices", s.simplices}, {"edge", s.edge},      {"mean", s.errors.mean},
                 {"p99", s.errors.p99},      {"max", s.errors.max}, {"below", s.errors.most_below}};
      if (edge > 0) row["order"] = std::log(mean / s.errors.mean) / std::log(edge / s.edge);
      edge = s.edge, mean = s.errors.mean;
      table.add(std::move(row));
    }
  }
}
const Command command("convergence", "error against mesh size (convergence.sh draws it)", run);

}  // namespace bench::convergence
