#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/shape/open_simplices.hpp>
#include <plexway/shape/shape.hpp>

#include "io/field/field_formats.hpp"
#include "shape/stopwatch.hpp"

namespace plexway::detail {

struct KeptBuild;

}  // namespace plexway::detail

namespace plexway {

struct AnyShape::State {
  std::filesystem::path file;
  double voxel = 0;  ///< of a .vdb to write; 0: to be chosen
  std::string level_set_note;
  Data data;  ///< of a prepared file its kind alone: KeptBuild::shape has what is in it
  std::optional<MeasuredLengths> lengths;  ///< alone, without positions
  std::size_t vertices = 0;
  double load_seconds = 0;
  std::optional<double> mesh_seconds, neighbour_seconds;
  std::shared_ptr<const detail::KeptBuild> kept;  ///< of a prepared file
  io::FileReport report;                          ///< of what the file has
  std::vector<Index> merged;                      ///< AnyShape::merged_vertices
  double merge_tolerance = 0;

  ///@{
  /// What follows from these: AnyShape::of makes it.
  std::vector<Index> collapsed;  ///< simplices with a corner twice, which are left out
  std::vector<io::Cells> cells;  ///< all simplices in the order of their numbers, list after list
  std::span<const std::array<double, 3>> positions;
  Points places;  ///< of a SimplexShape of three coordinates or fewer
  ///@}
};

}  // namespace plexway

namespace plexway::detail {

/// Calls use(list) with the simplices that a shape holds, list after list in the order of their
/// numbers; a SimplexShape has no lists.
template <class Data, class Use>
void each_list(Data& data, const Use& use) {
  std::visit(
      [&](auto& of) {
        if constexpr (requires { of.parts; })
          for (auto& part : of.parts) use(part.edges), use(part.triangles), use(part.tets);
        else if constexpr (requires { of.triangles; })
          use(of.triangles);
        else if constexpr (requires { of.tets; })
          use(of.tets);
        else if constexpr (requires { of.edges; })
          use(of.edges);
      },
      data);
}

/// Cells as rows of `N` corners; io::cells_of is the way back.
template <std::size_t N>
[[nodiscard]] std::span<const std::array<Index, N>> rows_of(const io::Cells& cells) {
  return {reinterpret_cast<const std::array<Index, N>*>(cells.connectivity.data()), cells.count()};
}

/// What a file of fields has of a shape's simplices: of a cloud its points, and where vertices lie
/// nowhere, or simplices may have any dimension, nothing.
class FieldCells {
 public:
  explicit FieldCells(const AnyShape& shape);
  FieldCells(const FieldCells&) = delete;
  FieldCells& operator=(const FieldCells&) = delete;

  std::vector<io::Cells> all;
  std::span<const Index> original;  ///< numbers of a cloud's points in its file

 private:
  std::array<std::vector<Index>, 3> lists_;
};

/// Simplices whose lengths no flat one has.
[[nodiscard]] metric::Violations violations_in(const MeasuredLengths& lengths);

/// Gives a path the positions that its points have in a shape.
inline void place(Path& path, const AnyShape& shape) {
  path.positions.clear();
  for (const PathPoint& at : path.points)
    path.positions.push_back(
        shape.position({.simplex = at.simplex, .barycentric = at.barycentric}));
}

/// What `build` makes of a shape, with its file's name put in front of what is wrong with it: a
/// complex knows vertices and faces, but not where they came from.
template <class Build>
auto with_file_name(const AnyShape& shape, Build build) {
  if (shape.file().empty()) return build();
  try {
    return build();
  } catch (const InputError& error) {
    throw InputError(shape.file().string() + ": " + error.what());
  }
}

/// Makes vertices one that are no farther apart than `tolerance`: AnyShape::merged. Of other kinds
/// than surfaces, solids and wireframes with positions nothing. Simplices that lose a corner by it
/// are still to be found.
void merge_vertices(AnyShape::State& state, double tolerance);

/// Looks for simplices with a corner twice. They have no area and no place in a complex, but keep
/// their numbers: they are as if masked. (An edge from a vertex to itself is one that no path
/// takes.)
void find_collapsed(AnyShape::State& state);

/// "2 triangles have a corner twice and are left out, 17 is the first"; empty where none has.
[[nodiscard]] std::string collapsed_sentence(const AnyShape& shape);

}  // namespace plexway::detail
