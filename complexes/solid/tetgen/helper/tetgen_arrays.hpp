#pragma once

#define TETLIBRARY
#include <tetgen.h>
#undef REAL

#include <algorithm>

#include <plexway/tetgen/piecewise_linear_complex.hpp>

namespace plexway::tetgen {

/// Copies points to TetGen's array, `stride` numbers each; it frees the array itself.
inline double* new_points(const std::vector<std::array<double, 3>>& points) {
  if (points.empty()) return nullptr;
  double* const list = new double[3 * points.size()];
  for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 3, list + 3 * i);
  return list;
}

/// The complex in TetGen's own arrays. Facets get the markers 1, 2, ...
inline void to_tetgen(const PiecewiseLinearComplex& complex, tetgenio& io) {
  io.pointlist = new_points(complex.positions);
  io.numberofpoints = static_cast<int>(complex.positions.size());
  io.holelist = new_points(complex.holes);
  io.numberofholes = static_cast<int>(complex.holes.size());

  io.facetlist = new tetgenio::facet[complex.facets.size()];
  io.facetmarkerlist = new int[complex.facets.size()];
  for (const auto& facet : complex.facets) {
    const int number = io.numberoffacets++;
    io.facetmarkerlist[number] = number + 1;
    tetgenio::facet& to = io.facetlist[number];
    tetgenio::init(&to);
    to.holelist = new_points(facet.holes);
    to.numberofholes = static_cast<int>(facet.holes.size());
    to.polygonlist = new tetgenio::polygon[facet.polygons.size()];
    for (const auto& polygon : facet.polygons) {
      tetgenio::polygon& corners = to.polygonlist[to.numberofpolygons++];
      corners.numberofvertices = static_cast<int>(polygon.size());
      corners.vertexlist = new int[polygon.size()];
      std::copy(polygon.begin(), polygon.end(), corners.vertexlist);
    }
  }

  if (complex.regions.empty()) return;
  io.regionlist = new double[5 * complex.regions.size()];
  for (const auto& region : complex.regions) {
    double* const to = io.regionlist + 5 * io.numberofregions++;
    std::copy_n(region.point.data(), 3, to);
    to[3] = region.attribute;
    to[4] = region.max_volume > 0 ? region.max_volume : -1;
  }
}

}  // namespace plexway::tetgen
