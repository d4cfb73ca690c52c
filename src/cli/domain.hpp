#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway::cli {

/// What a user may hand to the tool, as it stands in the file.
///
/// The commands know domains only through this class, so that solids, clouds and wireframes become
/// further alternatives here and in solver.cpp, not in every command.
class Domain {
 public:
  /// Reads `file`. The extension tells the kind, unless `as` (a kind's name) does.
  /// Throws InputError as the readers do, UsageError for a kind that does not exist, NotBuiltError
  /// for one that this build lacks.
  static Domain load(const std::filesystem::path& file, const std::string& as);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::string_view kind() const { return "surface"; }
  /// What its simplices are called, in the plural.
  [[nodiscard]] std::string_view simplex_name() const { return "triangles"; }
  [[nodiscard]] std::size_t vertices() const { return surface_.positions.size(); }
  [[nodiscard]] std::size_t simplices() const { return surface_.triangles.size(); }
  [[nodiscard]] const io::Triangles& surface() const { return surface_; }

  /// The point of the domain closest to `point`; a vertex where it is that vertex. Among several,
  /// the one in the simplex with the lowest number. Cost: linear.
  [[nodiscard]] PointSource closest(const std::array<double, 3>& point) const;
  /// Where a source is.
  [[nodiscard]] std::array<double, 3> position(const PointSource& source) const;

  /// Writes one distance a vertex; the extension of `out` picks the format. Throws as
  /// io::write_field.
  void write_field(const std::filesystem::path& out, std::span<const double> distance,
                   std::span<const std::int32_t> label) const;

 private:
  Domain() = default;

  std::filesystem::path file_;
  io::Triangles surface_;
};

/// What `build` makes of `domain`, with the file's name put in front of what is wrong with it: a
/// complex knows vertices and faces, but not where they came from.
template <class Build>
auto with_file_name(const Domain& domain, Build build) {
  try {
    return build();
  } catch (const InputError& error) {
    throw InputError(domain.file().string() + ": " + error.what());
  }
}

}  // namespace plexway::cli
