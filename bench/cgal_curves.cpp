// Curves as sources, against exact distances: on each surface given (OFF, OBJ, PLY or STL) the
// curve is the trace of a shortest path between two vertices, and the truth the least of CGAL's
// exact distances to 2000 points on it, corrected by none: so it is a little too long where the
// curve is near. The errors of its two ends as point sources on the same mesh stand beside it, the
// ratio is to their mean; and that of 200 points propagated as 200 sources.
//
//     bench_cgal_curves MESH...

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <plexway/apps/path_field.hpp>
#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

namespace {

using plexway::Index;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;
using Paths = CGAL::Surface_mesh_shortest_path<Traits>;

double seconds(const std::function<void()>& work) {
  double best = 1e300;
  for (int i = 0; i < 7; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

// Relative, beyond `near`, where the truth itself is good.
double mean_error(const std::vector<double>& found, const std::vector<double>& exact, double near) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (std::isfinite(exact[v]) && exact[v] > near)
      sum += std::abs(found[v] / exact[v] - 1), ++count;
  return sum / static_cast<double>(count);
}

void compare(const char* file) {
  const auto surface = plexway::io::read_triangles(file);
  const plexway::TriangleMesh<double> mesh(surface.positions, surface.triangles);
  Mesh exact_mesh;
  for (const auto& p : surface.positions) exact_mesh.add_vertex({p[0], p[1], p[2]});
  for (const auto& [a, b, c] : surface.triangles)
    exact_mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  Paths paths(exact_mesh);

  const Index from = 0, to = static_cast<Index>(surface.positions.size() / 2);
  plexway::PathField field(mesh, surface.positions);
  field.solve(plexway::Serial{}, plexway::PointSource::at(from));
  const plexway::Path path = field.trace(to);
  plexway::CurveSource curve;
  curve.points.push_back(plexway::PointSource::at(to));
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i)
    curve.points.push_back(
        {.simplex = path.points[i].simplex, .barycentric = path.points[i].barycentric});
  curve.points.push_back(plexway::PointSource::at(from));

  // Points at equal steps; each lies in the simplex of the point before it.
  constexpr std::size_t samples = 2000, few = 200;
  std::vector<plexway::PointSource> points;
  double walked = 0;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const auto &p = path.positions[i], &q = path.positions[i + 1];
    const double step = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    const Index f = path.points[i].simplex;
    const auto& corners = surface.triangles[f];
    while (points.size() < samples) {
      const double t =
          (path.length * (static_cast<double>(points.size()) + 0.5) / samples - walked) / step;
      if (t > 1) break;
      // Barycentric coordinates by areas.
      const auto at = [&](std::size_t k) { return p[k] + t * (q[k] - p[k]); };
      Kernel::Point_3 x(at(0), at(1), at(2));
      Kernel::Point_3 c[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& r = surface.positions[corners[k]];
        c[k] = {r[0], r[1], r[2]};
      }
      std::array<double, 3> w;
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += w[k] = std::sqrt(CGAL::squared_area(x, c[(k + 1) % 3], c[(k + 2) % 3]));
      for (double& b : w) b /= sum;
      points.push_back(plexway::PointSource::in(f, w));
    }
    walked += step;
  }

  std::vector<plexway::PointSource> some;
  for (std::size_t n = samples / few / 2; n < points.size(); n += samples / few)
    some.push_back(points[n]);

  const auto all_exact = [&] {
    paths.build_sequence_tree();
    std::vector<double> d;
    for (const auto v : exact_mesh.vertices()) {
      const double found = paths.shortest_distance_to_source_points(v).first;
      d.push_back(found < 0 ? INFINITY : found);
    }
    return d;
  };
  std::vector<double> exact_ends[2];
  for (const std::size_t i : {0, 1}) {
    paths.add_source_point(Mesh::Vertex_index(i == 0 ? from : to));
    exact_ends[i] = all_exact();
    paths.remove_all_source_points();
  }
  for (const auto& p : points) {
    // CGAL counts corners from the source of the face's halfedge.
    const auto half = exact_mesh.halfedge(Mesh::Face_index(p.simplex));
    const auto& corners = surface.triangles[p.simplex];
    const auto weight = [&](Mesh::Vertex_index v) {
      for (std::size_t k = 0; k < 3; ++k)
        if (corners[k] == static_cast<Index>(v)) return p.barycentric[k];
      return 0.;
    };
    paths.add_source_point(Mesh::Face_index(p.simplex),
                           {weight(exact_mesh.source(half)), weight(exact_mesh.target(half)),
                            weight(exact_mesh.target(exact_mesh.next(half)))});
  }
  const auto exact_curve = all_exact();

  plexway::Workspace<double> workspace;
  plexway::DistanceField<double> found;
  const double near = path.length / 20;
  double time_point = 0, error_ends[2];
  for (const std::size_t i : {0, 1}) {
    const auto one = plexway::PointSource::at(i == 0 ? from : to);
    time_point = seconds([&] {
      plexway::solve(plexway::Serial{}, mesh, {&one, 1}, {}, workspace, found);
    });
    error_ends[i] = mean_error(found.distance, exact_ends[i], near);
  }
  const double time_many =
      seconds([&] { plexway::solve(plexway::Serial{}, mesh, some, {}, workspace, found); });
  const double error_many = mean_error(found.distance, exact_curve, near);
  const plexway::Source source = curve;
  const double time_curve = seconds([&] {
    plexway::solve(plexway::Serial{}, mesh, std::span<const plexway::Source>(&source, 1), {},
                   workspace, found);
  });
  const double error_curve = mean_error(found.distance, exact_curve, near);
  const double face = 1e9 / static_cast<double>(surface.triangles.size());
  std::printf(
      "%-28s %8zu faces  ends %.2e %.2e %5.0f ns  curve %.2e %5.0f ns (%.2f)  200 points %.2e "
      "%5.0f ns\n",
      file, surface.triangles.size(), error_ends[0], error_ends[1], time_point * face, error_curve,
      time_curve * face, 2 * error_curve / (error_ends[0] + error_ends[1]), error_many,
      time_many * face);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  CLI::App app("A curve as source against exact distances to many points of it, by CGAL");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl)")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& mesh : meshes) compare(mesh.c_str());
    return 0;
  } catch (const plexway::Error& error) {
    std::fprintf(stderr, "bench_cgal_curves: %s\n", error.what());
    return 1;
  }
}
