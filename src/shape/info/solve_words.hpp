#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "shape/info/report.hpp"

namespace plexway::detail {

///@{
/// What a report says of an executor: "serial", "openmp" or "gl"; how many threads it takes;
/// "openmp with 4 threads". And the names of those that this build has.
[[nodiscard]] std::string_view executor_name(const AnyExecutor& executor);
[[nodiscard]] std::size_t executor_threads(const AnyExecutor& executor);
[[nodiscard]] std::string describe(const AnyExecutor& executor);
[[nodiscard]] std::vector<std::string_view> built_executors();
///@}

/// Is there more than one accuracy on domains of a kind?
[[nodiscard]] bool has_accuracies(DomainKind kind);

///@{
/// What a report says of an accuracy: its name, or the mean error; and of a domain with more than
/// one accuracy "accuracy", and "windows_gave_up" where they did.
[[nodiscard]] Json json_of(Accuracy accuracy);
[[nodiscard]] std::string name_of(Accuracy accuracy);
void add_accuracy(DomainKind kind, Accuracy accuracy, const PropagateStatistics& statistics,
                  Json& json);
///@}

/// What a report says of it: "input", "delaunay" or "refined"; and a sentence for people.
[[nodiscard]] std::string_view name_of(Triangulation done);
[[nodiscard]] std::string describe(const TriangulationReport& report);

/// What `info` says of the triangles: their shape, and what `auto` makes of it.
void add_shape(const TriangulationShape& shape, Json& json, Table& table);

/// What a field cost several processes.
struct RankCounts {
  std::size_t sent_bytes = 0;             ///< from each to the others, together
  std::vector<std::uint64_t> peak_bytes;  ///< memory of each at its most
};

/// All processes call it, each with what it sent.
[[nodiscard]] RankCounts rank_counts(PieceRanks& ranks, std::size_t sent_bytes);

}  // namespace plexway::detail
