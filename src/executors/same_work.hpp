#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <plexway/domain/domains.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/source_list.hpp>

#include "labels/label_memory.hpp"

namespace plexway::detail {

/// Have all processes the same work? Those that solve one field together would else wait for each
/// other without end, or make one of two. All call it, with what each has. Throws InputError where
/// a domain differs, UsageError where sources or options do, in every process. Cost: a reduction,
/// and reading the domain where it is not the last one of `memory`.
template <class D>
void check_same_work(PieceRanks& ranks, const D& domain, const SourceList& sources,
                     const PropagateOptions& options, std::size_t piece, PieceMemory& memory);

/// Likewise where the domain is in parts.
void check_same_work(PieceRanks& ranks, const SourceList& sources, const PropagateOptions& options,
                     std::size_t piece);

/// Likewise for words, such as the names of outputs: throws UsageError that says of `what` they
/// differ, in every process.
void check_same_words(PieceRanks& ranks, std::span<const std::string> words, const char* what);

/// Have all processes the same rows? Each row is read by the process whose range it is in, and by
/// another; who that is changes within the range. What is in nobody's way, a row that differs where
/// no process takes it from, is not looked for. All processes call it. Throws InputError in all
/// of them where the two do not agree, and what reading throws. Cost: two reads of a process's
/// share, and a reduction.
void check_same_rows(PieceRanks& ranks, const SurfaceRows& rows);

#define PLEXWAY_SAME_WORK(...)                                                             \
  extern template void check_same_work(PieceRanks&, const __VA_ARGS__&, const SourceList&, \
                                       const PropagateOptions&, std::size_t, PieceMemory&);
PLEXWAY_DOMAINS(PLEXWAY_SAME_WORK)
#undef PLEXWAY_SAME_WORK

}  // namespace plexway::detail
