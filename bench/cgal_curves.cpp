// Curves as sources, against exact distances: on each surface given (OFF, OBJ, PLY or STL) the
// curve is the trace of a shortest path between two vertices, and the truth the least of CGAL's
// exact distances to 2000 points on it, corrected by none: so it is a little too long where the
// curve is near. The errors of its two ends as point sources on the same mesh stand beside it, the
// ratio is to their mean; and that of 200 points propagated as 200 sources.

#include <algorithm>
#include <cmath>

#include "cgal_exact.hpp"
#include "path_points.hpp"
#include "solver.hpp"

namespace bench::cgal_curves {

using cgal::Mesh;

// Relative, beyond `near`, where the truth itself is good.
double mean_error(const std::vector<double>& found, const std::vector<double>& exact, double near) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (std::isfinite(exact[v]) && exact[v] > near)
      sum += std::abs(found[v] / exact[v] - 1), ++count;
  return sum / static_cast<double>(count);
}

Row compare(const Surface& surface) {
  const plexway::TriangleMesh<double> mesh(surface.positions, surface.faces);
  const Mesh exact_mesh = cgal::make_mesh(surface);
  cgal::Paths paths(exact_mesh);

  const Index from = 0, to = static_cast<Index>(surface.positions.size() / 2);
  plexway::PathField field(mesh, surface.positions);
  field.solve(plexway::Serial{}, plexway::PointSource::at(from));
  const plexway::Path path = field.trace(to);
  constexpr std::size_t samples = 2000, few = 200;
  const plexway::CurveSource curve = curve_of(path, from, to);
  const auto points = points_along(path, surface.positions, surface.faces, samples);
  std::vector<plexway::PointSource> some;
  for (std::size_t n = samples / few / 2; n < points.size(); n += samples / few)
    some.push_back(points[n]);

  std::vector<double> exact_ends[2];
  for (const std::size_t i : {0, 1}) {
    paths.add_source_point(Mesh::Vertex_index(i == 0 ? from : to));
    exact_ends[i] = cgal::all_distances(exact_mesh, paths);
    paths.remove_all_source_points();
  }
  for (const auto& p : points) {
    // CGAL counts corners from the source of the face's halfedge.
    const auto half = exact_mesh.halfedge(Mesh::Face_index(p.simplex));
    const auto& corners = surface.faces[p.simplex];
    const auto weight = [&](Mesh::Vertex_index v) {
      for (std::size_t k = 0; k < 3; ++k)
        if (corners[k] == static_cast<Index>(v)) return p.barycentric[k];
      return 0.;
    };
    paths.add_source_point(Mesh::Face_index(p.simplex),
                           {weight(exact_mesh.source(half)), weight(exact_mesh.target(half)),
                            weight(exact_mesh.target(exact_mesh.next(half)))});
  }
  const auto exact_curve = cgal::all_distances(exact_mesh, paths);

  Solver solver(mesh);
  const double near = path.length / 20;
  const auto error = [&](const plexway::SourceList& sources, const std::vector<double>& exact,
                         double& best) {
    best = 1e300;
    for (int i = 0; i < 7; ++i) best = std::min(best, seconds([&] { solver.solve(sources, {}); }));
    best *= 1e9 / static_cast<double>(surface.faces.size());
    return mean_error(solver.distance(), exact, near);
  };
  double point_ns = 0, curve_ns = 0, many_ns = 0, ends[2];
  for (const std::size_t i : {0, 1})
    ends[i] = error(plexway::PointSource::at(i == 0 ? from : to), exact_ends[i], point_ns);
  const double of_many = error(some, exact_curve, many_ns);
  const double of_curve = error(curve, exact_curve, curve_ns);
  return {{"mesh", surface.name}, {"faces", surface.faces.size()},
          {"first", ends[0]},     {"last", ends[1]},
          {"ends_ns", point_ns},  {"curve", of_curve},
          {"curve_ns", curve_ns}, {"ratio", 2 * of_curve / (ends[0] + ends[1])},
          {"many", of_many},      {"many_ns", many_ns}};
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  arguments.required("MESH", &meshes, "Surfaces (.obj .off .ply .stl)");
  Table& table = arguments.table(
      "mesh; faces; first: one end %.2e; last: other end %.2e; ends_ns: ns a face %.0f;"
      "curve %.2e; curve_ns: ns a face %.0f; ratio: error to the ends' %.2f;"
      "many: 200 points %.2e; many_ns: ns a face %.0f");
  for (const std::string& mesh : meshes) table.add(compare(read_surface(mesh)));
}
const Command command("curves", "a curve as source beside exact distances to points of it", run);

}  // namespace bench::cgal_curves
