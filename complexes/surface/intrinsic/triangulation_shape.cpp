#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "complexes/common/building_blocks.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/shape_blocks.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

// corner(f, i): cosine and sine of the angle there; across(f, i): packed as Across.
template <class Real, class Corner, class AcrossOf>
TriangulationShape measure(Index faces, int threads, Corner corner, AcrossOf across) {
  constexpr double degree = std::numbers::pi / 180;
  const Real blunt = static_cast<Real>(std::cos(150 * degree));
  const Real sharp = static_cast<Real>(std::cos(5 * degree));
  constexpr Real blur = sizeof(Real) == 4 ? Real(1e-4) : Real(1e-9);
  struct Seen {
    Real least = 1, most = -1;  // cosines
    std::size_t blunt = 0, needles = 0, inner = 0, non_delaunay = 0;
  };
  const auto look = [&](std::size_t first, std::size_t last, Seen& seen) {
    for (Index f = static_cast<Index>(first); f < last; ++f) {
      std::array<Real, 3> cosine;
      for (std::size_t i = 0; i < 3; ++i) cosine[i] = corner(f, i)[0];
      const Real low = std::min({cosine[0], cosine[1], cosine[2]});
      const Real high = std::max({cosine[0], cosine[1], cosine[2]});
      seen.least = std::min(seen.least, low);
      seen.most = std::max(seen.most, high);
      seen.blunt += low < blunt;
      seen.needles += high > sharp;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index o = across(f, i), g = o >> Across::face_shift;
        if (g == faces || (o & Across::fan) != 0 || g < f) continue;
        const std::size_t j = o & Across::edge_mask;
        if (g == f && j < i) continue;
        ++seen.inner;
        const auto [ca, sa] = corner(f, edge_before(i));
        const auto [cb, sb] = corner(g, edge_before(j));
        const Real sine = sa * cb + ca * sb;
        seen.non_delaunay += g != f && (sine < -blur || (ca < -blur && cb < -blur));
      }
    }
  };
  Seen all;
  gather_blocks<Seen>(faces, threads, look, [&](const Seen& seen) {
    all.least = std::min(all.least, seen.least);
    all.most = std::max(all.most, seen.most);
    all.blunt += seen.blunt;
    all.needles += seen.needles;
    all.inner += seen.inner;
    all.non_delaunay += seen.non_delaunay;
  });
  const auto degrees = [](Real cosine) {
    return std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0)) / degree;
  };
  TriangulationShape shape;
  shape.inner_edges = all.inner;
  shape.non_delaunay_edges = all.non_delaunay;
  shape.largest_angle = degrees(all.least);
  shape.smallest_angle = degrees(all.most);
  shape.blunt_share = static_cast<double>(all.blunt) / static_cast<double>(faces);
  shape.needle_share = static_cast<double>(all.needles) / static_cast<double>(faces);
  return shape;
}

}  // namespace

template <class Real>
TriangulationShape measure_triangulation(const FaceLayout& layout, const TriangleShapes& shapes,
                                         int threads) {
  const std::size_t m = layout.face_count();
  Unfilled<std::array<std::array<Real, 2>, 3>> corner(m);
  over_blocks(m, threads, [&](std::size_t begin, std::size_t end) {
    ShapeBlock block{};
    for (std::size_t first = begin; first < end; first += ShapeBlock::size) {
      const std::size_t count = std::min(ShapeBlock::size, end - first);
      shapes.look_up(std::span(layout.face).subspan(first, count), block);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t own = layout.is_turned(first + k) && i != 0 ? 3 - i : i;
          corner[first + k][i] = {static_cast<Real>(block.cosine[own][k]),
                                  static_cast<Real>(block.sine[own][k])};
        }
    }
  });
  return measure<Real>(
      static_cast<Index>(m),
      threads, [&](std::size_t f, std::size_t i) -> const auto& { return corner[f][i]; },
      [&](std::size_t f, std::size_t i) { return layout.across[f][i]; });
}

template TriangulationShape measure_triangulation<float>(const FaceLayout&, const TriangleShapes&,
                                                         int);
template TriangulationShape measure_triangulation<double>(const FaceLayout&, const TriangleShapes&,
                                                          int);

}  // namespace detail

template <class Real>
TriangulationShape measure_triangulation(const TriangleMesh<Real>& mesh) {
  const auto triangles = mesh.triangles();
  return measure<Real>(
      static_cast<Index>(mesh.face_count()), 1,
      [&](std::size_t f, std::size_t i) {
        return std::array{triangles[f].cosine[i], triangles[f].sine(i)};
      },
      [&](std::size_t f, std::size_t i) { return triangles[f].across[i]; });
}
template TriangulationShape measure_triangulation(const TriangleMesh<float>&);
template TriangulationShape measure_triangulation(const TriangleMesh<double>&);

Retriangulation what_pays(const TriangulationShape& shape) {
  if (shape.needle_share > 0.1) return Retriangulation::refined;
  return shape.non_delaunay_share() > 0.04 ? Retriangulation::flips : Retriangulation::keep;
}

}  // namespace plexway
