#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <plexway/error.hpp>

#include "complexes/common/geometry.hpp"
#include "io/surface/polygons.hpp"

namespace plexway::io {
using namespace detail;

/// Where a file puts what it has: the images of the axes and of 0.
struct Affine {
  std::array<Point3, 4> to = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

  [[nodiscard]] Point3 operator()(const Point3& p, double shift = 1) const {
    Point3 q{};
    for (std::size_t k = 0; k < 3; ++k)
      q[k] = p[0] * to[0][k] + p[1] * to[1][k] + p[2] * to[2][k] + shift * to[3][k];
    return q;
  }
  /// This one after `first`.
  [[nodiscard]] Affine after(const Affine& first) const {
    return {{(*this)(first.to[0], 0), (*this)(first.to[1], 0), (*this)(first.to[2], 0),
             (*this)(first.to[3])}};
  }
  [[nodiscard]] bool mirrors() const { return dot(to[0], cross(to[1], to[2])) < 0; }
};

/// The parts of a file may name each other any number of times, or in a circle: how much that may
/// make of so many bytes is bounded.
struct Repeats {
  std::uint64_t bytes, made = 0;

  /// Throws InputError where so many more elements are too many, or the parts too deep.
  void take_room(std::uint64_t more, std::size_t depth, std::string_view name) {
    made += more;
    if (depth > 1000 || made > most_elements(bytes))
      throw InputError(std::string(name) +
                       ": its parts repeat each other out of proportion or go round in a circle");
  }
};

/// Adds a copy of a part. Throws InputError where a point is not finite, there or here.
template <class Cells>
void append(Cells& cells, const Cells& part, const Affine& where, std::string_view name) {
  const auto first = static_cast<std::uint32_t>(cells.positions.size());
  for (const Point3& p : part.positions) {
    const Point3 q = cells.positions.emplace_back(where(p));
    if (!std::isfinite(q[0]) || !std::isfinite(q[1]) || !std::isfinite(q[2]))
      throw InputError(std::string(name) + ": has a coordinate that is not finite");
  }
  // What is seen in a mirror has its corners the other way round.
  const bool mirrored = where.mirrors();
  for (const auto& [a, b, c] : part.triangles)
    cells.triangles.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  if constexpr (requires { part.edges; })
    for (const auto& [a, b] : part.edges) cells.edges.push_back({first + a, first + b});
}

}  // namespace plexway::io
