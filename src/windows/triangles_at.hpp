#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

#include "windows/cross_edge.hpp"
#include "windows/sheet.hpp"

namespace plexway::windows {

/// The triangles that a point of f lies in: calls visit(f, barycentric, 3) and, where it lies on an
/// edge, visit(g, barycentric, k) for the others there; edge k of g is that one.
template <class Real, class Visit>
void triangles_at(std::span<const TriangleRecord<Real>> triangles, Index f,
                  const std::array<double, 4>& b, const Visit& visit) {
  visit(f, b, std::size_t{3});
  const Index sentinel = static_cast<Index>(triangles.size() - 1);
  for (std::size_t e = 0; e < 3; ++e) {
    if (b[edge_before(e)] > on_edge<Real> ||
        triangles[f].across[e] >> Across::face_shift == sentinel)
      continue;
    cross_edge(triangles, f, e, [&](Index across, bool turned) {
      const std::size_t k = across & Across::edge_mask;
      std::array<double, 4> there = {0, 0, 0, 0};
      there[k] = b[turned ? e : edge_after(e)];
      there[edge_after(k)] = b[turned ? edge_after(e) : e];
      visit(across >> Across::face_shift, there, k);
    });
  }
}

}  // namespace plexway::windows
