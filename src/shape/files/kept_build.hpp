#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <variant>

#include <plexway/common/detail/storage.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/shape.hpp>

#include "complexes/common/kept_archive.hpp"
#include "io/field/field_formats.hpp"

namespace plexway {
struct BuildOptions;
}  // namespace plexway

namespace plexway::detail {

/// What a shape holds, where it lies in a prepared file. Who solves on what is built does not need
/// it, so it is copied only when it is requested as a whole.
class KeptShape {
 public:
  /// Takes the parts of a shape of that kind from `in`. Throws InputError where they cannot be.
  KeptShape(KeptIn& in, DomainKind kind);

  /// May a shape of so many vertices, with these lengths or null, hold it? What the readers of
  /// other files see to.
  [[nodiscard]] bool is_sound(std::size_t vertices, const MeasuredLengths* lengths) const;

  ///@{
  /// As AnyShape's.
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const;
  [[nodiscard]] std::vector<io::Cells> cells() const;
  ///@}
  /// A copy, made by the first who asks; any number of threads may at once.
  [[nodiscard]] const AnyShape::Data& data() const;

  /// Without anything in it.
  [[nodiscard]] static AnyShape::Data empty(DomainKind kind, const KeptIn& in);
  static void write(KeptOut& out, const AnyShape& shape);

 private:
  template <std::size_t N>
  using Simplices = Rows<std::array<Index, N>>;
  using Positions = Rows<std::array<double, 3>>;
  struct Triangles {
    Positions positions;
    Simplices<3> triangles;
  };
  struct Tets {
    Positions positions;
    Simplices<4> tets;
  };
  struct Edges {
    Positions positions;
    Simplices<2> edges;
    Rows<double> lengths;
    std::size_t vertices = 0;
  };

  static void each(auto& archive, auto& data);

  DomainKind kind_;
  KeptIn start_;
  std::variant<std::monostate, Triangles, Tets, Edges> lent_;  // of a cloud nothing: it is copied
  mutable std::once_flag once_;
  mutable AnyShape::Data data_;
};

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

}  // namespace plexway::detail
