#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/mask.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/read_options.hpp>
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
/// that are open (inside), which are all that a complex is built of. Of merged vertices
/// (AnyShape::merged) the first alone is inside. 9 bytes a simplex or vertex.
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
  /// Likewise.
  [[nodiscard]] PointSource outside(const PointSource& point) const;
  /// Is a vertex in an open simplex? If not it reaches nothing but itself. It must be one (not
  /// checked).
  [[nodiscard]] bool reached(Index vertex) const { return reached_[vertex] != 0; }

  ///@{
  /// The same place inside. A vertex, or nothing, stays as it is, but a merged one is the first at
  /// its place. Throws UsageError for a simplex that is closed or is not there.
  [[nodiscard]] PointSource inside(const PointSource& point) const;
  [[nodiscard]] Source inside(const Source& source) const;
  ///@}
  /// Throws UsageError for a source at a vertex that no open simplex has, or in a simplex that is
  /// closed or is not there.
  void require(const Source& source) const;
  /// Vertices inside of these columns, or of all where there are none; those given if none are
  /// merged.
  [[nodiscard]] std::vector<Index> columns(std::span<const Index> columns) const;
  /// Gives merged vertices what the first at their place has. Empty rows stay so.
  template <class Value>
  void spread(std::vector<Value>& of_vertices) const {
    if (of_vertices.empty()) return;
    for (std::size_t v = 0; v < first_.size(); ++v) of_vertices[v] = of_vertices[first_[v]];
  }
  /// Of a field likewise.
  void spread(AnyField& field) const;

 private:
  [[nodiscard]] Index numbered(Index simplex) const;

  std::vector<Index> inside_, outside_, first_;
  std::vector<char> reached_;
};

/// The mask that a text describes: `vertices:FILE` or `simplices:FILE`, a number (0-based) a line,
/// are closed; `FILE:3,7`, vertices with these labels (io::read_vertex_labels); `regions:3,7`,
/// simplices of these regions of the shape's own file (AnyShape::regions). Throws UsageError for
/// another text and for shapes that have no masks, InputError "FILE:LINE: cause", for a label or
/// region that nothing has, and where nothing stays open; messages name the option as `spelling`
/// has it.
[[nodiscard]] std::shared_ptr<const Mask> read_mask(const std::string& text, const AnyShape& shape,
                                                    Spelling spelling = Spelling::fields);

}  // namespace plexway
