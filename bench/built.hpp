#pragma once

#include <array>
#include <span>

#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "harness.hpp"

namespace bench {

/// Calls add(name, make) for what can be built of a surface; make() returns it.
template <class Add>
void built_of_surface(const Surface& s, int threads, const Add& add) {
  plexway::SurfaceHints hints;
  hints.threads = threads;
  add("surface, float", [&] { return plexway::TriangleMesh<float>(s.positions, s.faces, hints); });
  add("surface, double",
      [&] { return plexway::TriangleMesh<double>(s.positions, s.faces, hints); });
  add("surface or what pays, float",
      [&] { return plexway::triangulate<float>(s.positions, s.faces, {}, threads); });
  add("by Delaunay, float", [&] {
    return plexway::triangulate<float>(s.positions, s.faces, plexway::Retriangulation::flips,
                                       threads);
  });
}

/// The same of a solid.
template <class Add>
void built_of_solid(std::span<const std::array<double, 3>> positions,
                    std::span<const std::array<plexway::Index, 4>> tets, int threads,
                    const Add& add) {
  add("solid, float", [&] { return plexway::TetMesh<float>(positions, tets, threads); });
}

}  // namespace bench
