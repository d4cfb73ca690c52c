#pragma once

#include <functional>
#include <memory>
#include <span>

#include "any/prepared.hpp"

namespace plexway {

/// The way from a point of a shape to its nearest source.
using TraceFrom = std::function<Path(const PointSource&, const TraceOptions&)>;
/// Made for a field that was solved.
using MakeTrace = std::function<TraceFrom(const AnyField&)>;

/// A field that is read by its vertices' distances alone, linear within simplices: of mixed domains
/// and complexes of simplices. Where there is a `trace`, it leads paths, and levels other than
/// linear are their lengths. Solves on `domain`, which it keeps.
std::shared_ptr<const AnyPathField::State> linear_field(std::shared_ptr<const Prepared> domain,
                                                        const AnyShape& shape,
                                                        const AnyExecutor& executor,
                                                        std::span<const PointSource> sources,
                                                        const PropagateOptions& options,
                                                        const MakeTrace& trace = {});

}  // namespace plexway
