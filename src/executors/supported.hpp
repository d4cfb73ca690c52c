#pragma once

#include <cstddef>

#include <plexway/source/source_list.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// The cell of these options.
[[nodiscard]] Combination with(Combination what, MetricKind metric,
                               const PropagateOptions& options);

/// Do a domain's metric, the options and all sources go together with an executor and a domain?
[[nodiscard]] Support support_of(Combination what, MetricKind metric, const SourceList& sources,
                                 const PropagateOptions& options);

/// Throws UsageError where they do not.
void require_support(const Combination& what, MetricKind metric, const SourceList& sources,
                     const PropagateOptions& options);

/// Throws UsageError unless there is room for that many fields.
void check_rows(std::size_t room, std::size_t sources, std::size_t vertices);

}  // namespace plexway::detail
