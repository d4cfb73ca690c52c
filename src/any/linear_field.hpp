#pragma once

#include <memory>
#include <span>

#include "any/prepared.hpp"

namespace plexway {

/// A field that is read by its vertices' distances alone, linear within simplices: of mixed domains
/// and complexes of simplices. It leads no paths. Solves on `domain`, which it keeps.
std::shared_ptr<const AnyPathField::State> linear_field(std::shared_ptr<const Prepared> domain,
                                                        const AnyShape& shape,
                                                        const AnyExecutor& executor,
                                                        std::span<const PointSource> sources,
                                                        const PropagateOptions& options);

}  // namespace plexway
