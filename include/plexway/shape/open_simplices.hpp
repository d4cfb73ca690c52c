#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/mask.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// What is open of a shape: what `mask` leaves (null: all) but simplices with a corner twice
/// (AnyShape::collapsed), of which domains are built without a word; null where that is all of it.
/// Throws InputError where nothing is left.
[[nodiscard]] std::shared_ptr<const Mask> without_collapsed(const AnyShape& shape,
                                                            std::shared_ptr<const Mask> mask);

/// What a mask leaves of a shape: simplices by their numbers in the shape (outside) and among those
/// that are open (inside), which are all that a complex is built of. 9 bytes a simplex or vertex.
class OpenSimplices {
 public:
  /// Throws UsageError for a mask of another size, InputError where
  /// nothing is open. Cost: linear.
  OpenSimplices(const Mask& mask, const AnyShape& shape);

  /// How many there are.
  [[nodiscard]] std::size_t size() const { return outside_.size(); }
  /// The number inside of a simplex of the shape, which must be one (not checked); none where it is
  /// closed.
  [[nodiscard]] Index inside(Index simplex) const { return inside_[simplex]; }
  /// The number in the shape of one inside, which must be one (not checked).
  [[nodiscard]] Index outside(Index simplex) const { return outside_[simplex]; }
  /// The same of every point of a path inside; a vertex without a simplex stays as it is.
  void outside(Path& path) const;
  /// Is a vertex in an open simplex? If not it reaches nothing but itself. It must be one (not
  /// checked).
  [[nodiscard]] bool reach(Index vertex) const { return reached_[vertex] != 0; }

  ///@{
  /// The same place inside. What names a vertex, or nothing, stays as it is. Throws UsageError for
  /// a simplex that is closed or is not there.
  [[nodiscard]] PointSource inside(const PointSource& point) const;
  [[nodiscard]] Source inside(const Source& source) const;
  ///@}

 private:
  [[nodiscard]] Index numbered(Index simplex) const;

  std::vector<Index> inside_, outside_;
  std::vector<char> reached_;
};

}  // namespace plexway
