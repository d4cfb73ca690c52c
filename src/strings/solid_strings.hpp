#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/solve.hpp"

/// Solids by strings (src/strings): between the library's sources, options and fields, and theirs.
namespace plexway {

/// Is a solve in this solid by strings? Lengths alone have none, and other policies than
/// Visibility::saddles are of labels.
template <class Real>
bool is_by_strings(const TetMesh<Real>& mesh, const PropagateOptions& options) {
  return mesh.embedded() && options.visibility == Visibility::saddles &&
         options.accuracy.kind() != Accuracy::Kind::fast;
}

/// What strings need of a solid, and what a solve leaves; reused from call to call.
class SolidStrings {
 public:
  /// By one thread: whatever the executor, the same bits.
  template <class Real>
  void solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
             const PropagateOptions& options, DistanceField<Real>& field);
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::uint64_t identity_ = 0;  // of the solid below
  std::unique_ptr<strings::SolidSpace> space_;
  std::unique_ptr<strings::Solver> solver_;
  std::vector<strings::Source> sources_;
};

}  // namespace plexway
