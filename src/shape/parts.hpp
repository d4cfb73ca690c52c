#pragma once

#include <cstddef>
#include <span>

#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// Parts of a domain, each what simplices (of a cloud: neighbours) hold together.
struct Parts {
  std::size_t count = 0;
  std::size_t vertices = 0;  ///< in all of them
};

/// Those in which none of the points lies. A vertex in no simplex is no part. Cost: linear, nearly.
[[nodiscard]] Parts parts_without(const AnyShape& shape, std::span<const PointSource> points);

}  // namespace plexway
