#pragma once

#include <array>
#include <span>
#include <utility>

#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "harness.hpp"

namespace bench {

/// As bench/built.hpp, of the library before building was rewritten, which bench/first.py --before
/// puts this into: one thread, and Delaunay triangles by way of a mesh that is looked at first.
template <class Add>
void built_of_surface(const Surface& s, int, const Add& add) {
  struct ByDelaunay {
    plexway::IntrinsicDelaunay delaunay;
    plexway::TriangleMesh<float> mesh;
  };
  add("surface, float", [&] { return plexway::TriangleMesh<float>(s.positions, s.faces); });
  add("surface, double", [&] { return plexway::TriangleMesh<double>(s.positions, s.faces); });
  add("by Delaunay, float", [&] {
    plexway::TriangleMesh<float> mesh(s.positions, s.faces);
    volatile bool pays =
        plexway::what_pays(plexway::measure_triangulation(mesh)) != plexway::Retriangulation::keep;
    static_cast<void>(pays);
    plexway::IntrinsicDelaunay delaunay(plexway::TriangleMesh<double>(s.positions, s.faces));
    mesh = delaunay.mesh<float>();
    return ByDelaunay{std::move(delaunay), std::move(mesh)};
  });
}

/// The same of a solid.
template <class Add>
void built_of_solid(std::span<const std::array<double, 3>> positions,
                    std::span<const std::array<plexway::Index, 4>> tets, int, const Add& add) {
  add("solid, float", [&] { return plexway::TetMesh<float>(positions, tets); });
}

}  // namespace bench
