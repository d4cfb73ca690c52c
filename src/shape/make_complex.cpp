#include "shape/make_complex.hpp"

#include <utility>

#include "shape/shape_state.hpp"

namespace plexway::detail {
namespace {

constexpr std::optional<Retriangulation> asked_for(Triangulation wanted) {
  switch (wanted) {
    case Triangulation::input:
      return Retriangulation::keep;
    case Triangulation::delaunay:
      return Retriangulation::flips;
    case Triangulation::refined:
      return Retriangulation::refined;
    case Triangulation::automatic:
      break;
  }
  return std::nullopt;
}

template <class Real>
TriangulatedSurface<Real> triangulated(std::optional<Retriangulation> asked,
                                       const io::Triangles& surface, const Making& making) {
  if (making.lengths == nullptr)
    return triangulate<Real>(surface.positions, making.open(surface.triangles), asked,
                             making.threads);
  TriangleMesh<Real> mesh = make_complex<Real>(surface, making);
  const Retriangulation done = asked ? *asked : what_pays(measure_triangulation(mesh));
  if (done == Retriangulation::keep) return {std::move(mesh), std::nullopt, done};
  IntrinsicDelaunay delaunay(make_complex<double>(surface, making), refinement_for(done),
                             making.threads);
  if (delaunay.summary().flips + delaunay.summary().inserted_vertices > 0)
    mesh = delaunay.mesh<Real>();
  delaunay.release_triangles();
  return {std::move(mesh), std::move(delaunay), done};
}

}  // namespace

template <class Real>
TriangulatedSurface<Real> make_surface(Triangulation wanted, const Making& making,
                                       TriangulationReport& report) {
  report = {};
  const Stopwatch working;
  auto made =
      triangulated<Real>(asked_for(wanted), std::get<io::Triangles>(making.shape.data()), making);
  report.done = named(made.done);
  if (made.delaunay) {
    report.flips = made.delaunay->summary().flips;
    report.inserted_vertices = made.delaunay->summary().inserted_vertices;
    report.seconds = working.seconds();
  }
  return made;
}

template TriangulatedSurface<float> make_surface(Triangulation, const Making&,
                                                 TriangulationReport&);
template TriangulatedSurface<double> make_surface(Triangulation, const Making&,
                                                  TriangulationReport&);

}  // namespace plexway::detail
