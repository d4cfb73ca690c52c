#pragma once

#include <span>
#include <vector>

#include <plexway/shape/complex.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// What fields of points are solved on, one by one.
struct RowComplex {
  AnyComplex complex;  ///< as long as the domain lives; std::monostate where vertices have other
                       ///< numbers there: then ask the domain itself
  std::vector<PointSource> rows;  ///< as the complex has them
};

/// The complex that AnyDomain::solve takes, with the bits of that, for points of the shape. Its
/// first vertices are those of the shape.
[[nodiscard]] RowComplex row_complex(const AnyDomain& domain, std::span<const PointSource> rows);

}  // namespace plexway
