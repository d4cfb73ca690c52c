#pragma once

#include <plexway/surface/intrinsic_delaunay.hpp>

namespace plexway::detail {

class FaceLayout;
class TriangleShapes;

/// The same as of a mesh, before there is one. By any number of threads.
template <class Real>
TriangulationShape measure_triangulation(const FaceLayout& layout, const TriangleShapes& shapes,
                                         int threads);

}  // namespace plexway::detail
