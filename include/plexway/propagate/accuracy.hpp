#pragma once

namespace plexway {

/// How accurate distances on a surface shall be.
enum class Accuracy {
  /// One label a triangle (Visibility::saddles): mean errors of 3e-4 to 2e-3, single vertices more.
  fast,
  /// Merged windows: several sources an edge, each with the interval it serves; what differs by
  /// less
  /// than a limit becomes one.
  accurate,
  /// All windows, in double: nothing but rounding. Ask a TriangleMesh<double>: the other one's
  /// lengths are themselves rounded to 6e-8.
  exact,
};

}  // namespace plexway
