#pragma once

#include <string>

#include <plexway/any_domain.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/pairs/all_pairs.hpp>

// Distance matrices of a domain whose kind and precision are hidden: see pairs/all_pairs.hpp. With
// this io::write_pairs and io::write_near_pairs take it, too.

namespace plexway {

/// As plexway::all_pairs, on any domain, mixed ones too: rows have the bits of AnyDomain::solve by
/// Serial, on whatever triangles that takes. UsageError for the executor GL.
PairsReport all_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                      const PairsRequest& request, const PairsSink<DenseRow<double>>& sink);

/// As plexway::near_pairs. On surfaces rows are found on the triangles of the shape, on mixed
/// domains each is a solve of all.
PairsReport near_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                       const PairsRequest& request, const NearLimits& limits,
                       const PairsSink<SparseRow<double>>& sink);

/// Whatever the precision.
template <>
struct io::RowNumber<AnyDomain> {
  /// See plexway::all_pairs of an AnyDomain.
  using Type = double;
};

///@{
/// Tells inputs apart, for the description of a journal: hexadecimal digits.
[[nodiscard]] std::string fingerprint_of(const AnyShape& shape);
[[nodiscard]] std::string fingerprint_of(const MeasuredLengths& lengths);
[[nodiscard]] std::string fingerprint_of(const SourceList& sources);
[[nodiscard]] std::string fingerprint_of(const Mask& mask);
///@}

/// All that the numbers of a matrix depend on, for the description of its journal: the library's
/// version, the domain, how it is built, rows, columns, and how they are solved. What is made of
/// the numbers comes behind it. Cost: linear in the shape, rows and columns.
[[nodiscard]] io::BlockJournal::Description description_of(const AnyShape& shape,
                                                           const BuildOptions& building,
                                                           const PairsRequest& request);

}  // namespace plexway
