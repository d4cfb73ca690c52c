#pragma once

#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>

namespace plexway {

/// Have all processes the same rows? Each row is read by the process whose range it is in, and by
/// another; who that is changes within the range. What is in nobody's way, a row that differs where
/// no process takes it from, is not looked for. All processes call it. Throws InputError in all
/// of them where the two do not agree, and what reading throws. Cost: two reads of a process's
/// share, and a reduction.
void check_same_rows(PieceRanks& ranks, const SurfaceRows& rows);

}  // namespace plexway
