#pragma once

#include <filesystem>
#include <memory>

#include <plexway/shape/field.hpp>
#include <plexway/shape/shape.hpp>

#include "complexes/common/kept_archive.hpp"
#include "shape/kept_shape.hpp"

namespace plexway {

struct BuildOptions;

/// A domain that was built already, in the file that its shape was read from.
struct KeptBuild {
  Precision precision = Precision::float32;
  Triangulation triangulation = Triangulation::automatic;  ///< as it was requested
  bool is_surface = false;                                 ///< else that means nothing
  std::unique_ptr<const KeptShape> shape;  ///< what AnyShape::State::data leaves out
  KeptIn complex;                          ///< at its first part

  /// Is it what they ask for? If not, the shape is built anew.
  [[nodiscard]] bool answers(const BuildOptions& options) const;
};

/// By its extension, .plexway.
[[nodiscard]] bool is_kept_build(const std::filesystem::path& file);

/// The shape in such a file, and the build. Throws InputError "FILE: cause" for a file that is
/// none, foreign or damaged.
[[nodiscard]] AnyShape::State read_kept_build(const std::filesystem::path& file);
/// The same for a file that stands for another one, which messages name.
[[nodiscard]] AnyShape read_kept_for(const std::filesystem::path& file,
                                     const std::filesystem::path& name);
/// Of what KeptIn reads.
[[nodiscard]] AnyShape::State read_kept_build(KeptIn in);

/// Writes what comes before the complex. Throws UsageError for a kind that cannot be kept.
void write_kept_shape(KeptOut& out, const AnyShape& shape, const BuildOptions& options);

}  // namespace plexway
