#pragma once

#include <cstddef>
#include <memory>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/deal.hpp"

namespace plexway {

template <class Real>
class TrianglePatches;

/// What the last solve by pieces was like, whatever the threads.
struct SuperstepCounts {
  std::size_t supersteps = 0;
  std::size_t runs = 0;      ///< of a piece in a superstep
  std::size_t messages = 0;  ///< labels sent to other pieces
  std::size_t bytes = 0;     ///< of messages
  std::size_t sent = 0;      ///< bytes from this process to others

  /// Adds what a solve did.
  void tell(PropagateStatistics& statistics) const {
    statistics.supersteps += supersteps;
    statistics.messages += messages;
    statistics.message_bytes += bytes;
    statistics.sent_bytes += sent;
  }
  /// Before a solve.
  void start() { *this = {}; }
};

/// What solves by several threads keep of a surface that is cut into pieces, and the pieces' own
/// memory. Holds nothing before the first.
template <class Real>
class PieceMemory {
 public:
  PieceMemory() noexcept;
  ~PieceMemory();
  PieceMemory(PieceMemory&&) noexcept;
  PieceMemory& operator=(PieceMemory&&) noexcept;

  /// The pieces of this surface: those of the last call, unless that was for another surface or
  /// another size. About `size` triangles each, with room for those that are ours. Cost of new
  /// ones: about a solve's.
  TrianglePatches<Real>& of(const TriangleMesh<Real>& mesh, std::size_t size, Deal deal = {});

  /// What the last solve was like.
  [[nodiscard]] SuperstepCounts& counts() { return counts_; }

  [[nodiscard]] std::size_t bytes() const;

 private:
  std::unique_ptr<TrianglePatches<Real>> patches_;
  SuperstepCounts counts_;
};

extern template class PieceMemory<float>;
extern template class PieceMemory<double>;

}  // namespace plexway
