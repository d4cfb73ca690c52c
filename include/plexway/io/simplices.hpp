#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace plexway::io {

/// Simplices of one dimension, 1 to 4, with coordinates of any number or with intrinsic lengths.
struct Simplices {
  /// 1 to 4.
  int dimension = 4;
  /// In a simplex or not.
  std::size_t vertices = 0;
  std::size_t axes = 0;                     ///< coordinates a vertex; 0: none
  std::vector<double> positions = {};       ///< vertices x axes
  std::vector<std::uint32_t> corners = {};  ///< dimension + 1 a simplex, each < vertices
  /// If there are no coordinates: dimension (dimension + 1) / 2 a simplex, ordered as
  /// SimplicialComplex has them.
  std::vector<double> lengths = {};
};

/// Reads a .simplices, a text of three parts, `#` starting a comment:
///
///   dimension N
///   vertices n axes   and, if axes > 0, n lines of so many coordinates
///   simplices m       and m lines of N + 1 vertices counted from 0, and, if axes = 0, behind them
///                     the lengths of the edges (0,1) (0,2) (1,2) (0,3) ...
///
/// Throws InputError "FILE:LINE: cause".
Simplices read_simplices(const std::filesystem::path& file);

}  // namespace plexway::io
