#pragma once

#include <memory>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/shape/shape.hpp>

#include "shape/stopwatch.hpp"

namespace plexway {

struct KeptBuild;

struct AnyShape::State {
  std::filesystem::path file;
  double voxel = 0;  ///< of a .vdb to write; 0: to be chosen
  std::string level_set_note;
  Data data;  ///< of a prepared file its kind alone: KeptBuild::shape has what is in it
  std::optional<MeasuredLengths> lengths;  ///< alone, without positions
  std::size_t vertices = 0;
  Points places;  ///< of a SimplexShape of three coordinates or fewer
  double load_seconds = 0;
  std::optional<double> mesh_seconds, neighbour_seconds;
  std::shared_ptr<const KeptBuild> kept;  ///< of a prepared file
  io::FileReport report;                  ///< of what the file has
  std::vector<Index> collapsed;           ///< simplices with a corner twice, which are left out
};

/// Where the vertices of simplices are: AnyShape::State::places.
[[nodiscard]] AnyShape::Points places_of(const SimplexShape& shape);

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

}  // namespace plexway
