#pragma once

#include <cstddef>

#include <plexway/source/source_list.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// Throws UsageError where a domain's metric, the options or one of the sources do not go together
/// with an executor and a domain.
void require_support(Combination what, MetricKind metric, const SourceList& sources,
                     const PropagateOptions& options);

/// Throws UsageError unless there is room for that many fields.
void check_rows(std::size_t room, std::size_t sources, std::size_t vertices);

}  // namespace plexway::detail
