#pragma once

#include <cstddef>
#include <memory>

#include <plexway/complex/triangle_mesh.hpp>

namespace plexway {

template <class Real>
class TrianglePatches;

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
  /// another size. About `size` triangles each. Cost of new ones: about a solve's.
  TrianglePatches<Real>& of(const TriangleMesh<Real>& mesh, std::size_t size);

  [[nodiscard]] std::size_t bytes() const;

 private:
  std::unique_ptr<TrianglePatches<Real>> patches_;
};

extern template class PieceMemory<float>;
extern template class PieceMemory<double>;

}  // namespace plexway
