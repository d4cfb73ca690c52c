#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <variant>

#include <plexway/domain/concept.hpp>
#include <plexway/error.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// What a source may name.
struct SourceDomain {
  std::size_t vertices, simplices;
  const char* simplex;  ///< what one is called
  std::size_t corners;  ///< of one
};

template <SimplexDomainType D>
SourceDomain source_domain(const D& domain) {
  constexpr const char* names[] = {"face", "tet", "edge"};
  constexpr auto kind = static_cast<std::size_t>(D::kind);
  return {domain.vertex_count(), domain.simplex_count(), kind < 3 ? names[kind] : "simplex",
          static_cast<std::size_t>(D::dimension) + 1};
}

/// Of a mixed domain: corners are those of the piece in which the source lies.
template <class Mixed>
SourceDomain source_domain(const Mixed& domain, const PointSource& at) {
  std::size_t corners = 4;
  for (const auto& piece : domain.pieces())
    if (at.simplex >= piece.first_simplex && at.simplex - piece.first_simplex < piece.simplices)
      corners = std::visit([]<class C>(const C&) { return std::size_t{C::dimension} + 1; },
                           domain.complex(piece));
  return {domain.vertex_count(), domain.simplex_count(), "simplex", corners};
}

/// Throws UsageError for a vertex or a point that `domain` does not have, or an offset below 0.
inline void check_source(const PointSource& s, const SourceDomain& domain) {
  const auto check_number = [](const char* what, Index number, std::size_t count) {
    if (number >= count)
      throw UsageError(std::string("source ") + what + " " + std::to_string(number) +
                       " is out of range, there are " + std::to_string(count));
  };
  if (s.vertex != none) {
    check_number("vertex", s.vertex, domain.vertices);
  } else {
    check_number(domain.simplex, s.simplex, domain.simplices);
    double sum = 0;
    bool inside = true;
    for (std::size_t i = 0; i < s.barycentric.size(); ++i) {
      const double b = s.barycentric[i];
      inside = inside && b >= 0 && (i < domain.corners || b == 0);
      sum += b;
    }
    if (!inside || !(std::abs(sum - 1) < 1e-6))
      throw UsageError(
          "a source's barycentric coordinates must be >= 0 and sum to 1, one a corner");
  }
  if (!(s.offset >= 0) || !std::isfinite(s.offset))
    throw UsageError("a source's offset must be a number >= 0");
}

/// Throws UsageError for a table that aims elsewhere than it may.
inline void check(const ProbeTable& table) {
  for (const double threshold : {table.slender, table.uneven, table.low})
    if (!std::isfinite(threshold))
      throw UsageError("a threshold of the table of probes must be finite");
  for (const double share : table.share)
    if (!(share >= 0 && share <= 1.5))
      throw UsageError("a share in the table of probes must be from 0 to 1.5");
}

/// Throws UsageError for no source, or options out of range.
inline void check(std::span<const PointSource> sources, const PropagateOptions& options) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  if (!(options.step > 0)) throw UsageError("the step must be > 0");
  if (!(options.radius >= 0)) throw UsageError("the radius must be >= 0");
  if (!(options.accuracy.error() >= 0 && options.accuracy.error() < 1))
    throw UsageError("the accuracy must be a relative error from 0 to below 1");
  check(options.probe);
}

inline void check(std::span<const PointSource> sources, const PropagateOptions& options,
                  const SourceDomain& domain) {
  check(sources, options);
  for (const PointSource& s : sources) check_source(s, domain);
}

template <SimplexDomainType D>
void check(std::span<const PointSource> sources, const PropagateOptions& options, const D& domain) {
  check(sources, options, source_domain(domain));
}

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
