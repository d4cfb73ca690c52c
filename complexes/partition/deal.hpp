#pragma once

#include <cstddef>

namespace plexway {

/// Which pieces are whose: they are dealt to processes in turn. One in the order of a cut lies
/// beside the one before, so each process has some of every region, and each has work wherever the
/// front is.
struct Deal {
  std::size_t ours = 0;   ///< this process
  std::size_t count = 1;  ///< of so many

  [[nodiscard]] std::size_t owner(std::size_t piece) const { return piece % count; }
  [[nodiscard]] bool is_ours(std::size_t piece) const { return owner(piece) == ours; }
  /// Of a piece that is ours: its number among these.
  [[nodiscard]] std::size_t place(std::size_t piece) const { return piece / count; }
  bool operator==(const Deal&) const = default;
};

}  // namespace plexway
