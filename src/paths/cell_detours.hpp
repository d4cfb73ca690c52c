#pragma once

#include "paths/cell_string.hpp"

namespace plexway {

/// Makes a taut string locally shortest: where it is held by a vertex or an edge of a face that it
/// crosses, other cells around that are tried, and further cells at a face (a sheet glued on it).
/// False if nothing was gained. Every change gains, so repeating it ends.
bool improve(const Cells& all, CellString& string);

}  // namespace plexway
