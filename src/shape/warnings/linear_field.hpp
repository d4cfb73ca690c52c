#pragma once

#include <functional>
#include <memory>
#include <span>

#include "shape/prepared.hpp"

namespace plexway {

/// The way from a point of a shape to its nearest source, and the distance of a point in a simplex.
struct Ways {
  std::function<Path(const PointSource&, const TraceOptions&)> trace;
  std::function<double(const PointSource&)> at;
};
/// Made for a field that was solved.
using MakeWays = std::function<Ways(const AnyField&)>;

/// A field that is read by its vertices' distances alone, linear within simplices: of mixed domains
/// and complexes of simplices. Where there are `ways`, levels other than linear ask them. Solves on
/// `domain`, which it keeps.
std::shared_ptr<const AnyPathField::State> linear_field(std::shared_ptr<const Prepared> domain,
                                                        const AnyShape& shape,
                                                        const AnyExecutor& executor,
                                                        std::span<const PointSource> sources,
                                                        const PropagateOptions& options,
                                                        const MakeWays& ways = {});

}  // namespace plexway
