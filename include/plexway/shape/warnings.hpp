#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>

/// @file
/// Warnings about distances though nothing failed: where they may be far off, what was
/// left out, why vertices are not reached.
///
///   for (const Warning& warning : warnings(domain, field, sources)) log(warning.text);
namespace plexway {

/// Who reads a warning: what it advises is named as this reader writes it.
enum class Reader {
  people,  ///< of a program that stands on the library: plain words
  tool,    ///< options of the command line, such as --accuracy fast
  python,  ///< arguments of the Python package, such as accuracy='fast'
};

/// One warning.
struct Warning {
  /// A sentence without a full stop, of one line.
  std::string text;
  /// Does it say that distances may be wrong by more than their accuracy promises? Else what was
  /// left out, or why vertices are not reached.
  bool doubtful = true;
};

/// The warnings that hold for every field on a domain. Cost: of a mixed domain a look at each of
/// its welds.
[[nodiscard]] std::vector<Warning> domain_warnings(const AnyDomain& domain,
                                                   Reader reader = Reader::people);

/// The warnings that hold for one of its fields besides; `sources` are those that it was solved
/// from. Cost: a look at each vertex, and of a cloud one for each of up to 16 sources; where it has
/// voids or a rim also 64 looks at what is within 25 spacings of each.
[[nodiscard]] std::vector<Warning> field_warnings(const AnyDomain& domain, const AnyField& field,
                                                  const SourceList& sources,
                                                  Reader reader = Reader::people);

/// Which vertices of a field are not reached, and why; empty where all are. `options` are those of
/// the solve. Cost: linear, of a cloud in several parts several times that of finding neighbours.
[[nodiscard]] std::vector<Warning> reach_warnings(const AnyDomain& domain, const AnyField& field,
                                                  const PropagateOptions& options = {},
                                                  Reader reader = Reader::people);

/// All of these, in this order.
[[nodiscard]] std::vector<Warning> warnings(const AnyDomain& domain, const AnyField& field,
                                            const SourceList& sources,
                                            const PropagateOptions& options = {},
                                            Reader reader = Reader::people);

/// The same where the kind of domain is known, of which only its summary and the field are looked
/// at: not whether vertices coincide, what a file left out, or where the rim of a cloud runs, all
/// of which AnyDomain knows. Compiled for the domains of the library. Link plexway::any.
///
///   for (const Warning& warning : warnings(mesh, field)) std::cerr << warning.text << '\n';
template <DomainType D>
[[nodiscard]] std::vector<Warning> warnings(const D& domain, const DistanceField<RealOf<D>>& field,
                                            const PropagateOptions& options = {});

/// The warnings for several fields besides those for their domain, as far as sums of their
/// statistics show: rows of a matrix (PairsReport). Few poor ones among many good are not seen.
/// `accuracy` is what was requested.
[[nodiscard]] std::vector<Warning> rows_warnings(const AnyDomain& domain,
                                                 const PropagateStatistics& sum, Accuracy accuracy,
                                                 std::size_t rows, Reader reader = Reader::people);

/// Simplices whose lengths no flat one has, of those that a mask leaves open, by their numbers in
/// the shape.
[[nodiscard]] metric::Violations violations_of(const AnyDomain& domain);

}  // namespace plexway
