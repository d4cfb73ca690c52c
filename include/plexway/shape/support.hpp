#pragma once

#include <plexway/any_domain.hpp>
#include <plexway/domain/support.hpp>
#include <plexway/support.hpp>

/// @file
/// The part of the table of what goes together (support.hpp) that is asked about files, shapes and
/// how they are built.
namespace plexway {

/// What is asked for while files are read. `X(name, what it is)`.
#define PLEXWAY_READINGS(X)                \
  X(kind, "another kind, ReadOptions::as") \
  X(connecting, "CloudPreparation")        \
  X(filling, "FillOptions")                \
  X(repair, "VolumeOptions::repair")       \
  X(voxel, "VolumeOptions::voxel")         \
  X(grid, "VolumeOptions::grid")           \
  X(joining, "parts of a mixed domain, AnyShape::read of several files")

#define PLEXWAY_NAME(name, what) name,
/// The rows of PLEXWAY_READINGS by name.
enum class Reading { PLEXWAY_READINGS(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// In what form a file has a domain.
enum class FileForm {
  plain,      ///< its simplices or points
  boundary,   ///< facets around a solid: .poly, .smesh
  level_set,  ///< a solid by a function on a grid: .vdb
  prepared,   ///< AnyDomain::keep
  parts,      ///< a surface of which each process reads its part: SurfaceRows
};

/// A file, as far as it matters here.
struct FileUse {
  DomainKind held;    ///< what it has; `solid` in a boundary and a level set
  DomainKind wanted;  ///< what it is to be: the same, or ReadOptions::as
  /// How it has it.
  FileForm form = FileForm::plain;
  bool repaired = false;       ///< VolumeOptions::repair
  bool writes_volume = false;  ///< VolumeOptions::writes_volume
  bool several = false;        ///< one of several files
  bool copied = false;         ///< points to be written as they are, by 'plexway convert'
  bool positions = true;       ///< not lengths alone
};

/// Does what is asked for while files are read go together with a file?
constexpr Support support(Reading reading, const FileUse& f) {
  using enum DomainKind;
  const bool level_set = f.form == FileForm::level_set, boundary = f.form == FileForm::boundary;
  const bool thinned = reading == Reading::voxel && f.writes_volume;  // that is for the result
  if (f.form == FileForm::parts)
    return reading == Reading::kind && f.wanted == f.held ? Refusal::nothing
                                                          : Refusal::in_parts_whole;
  if (f.several && reading != Reading::joining)
    return reading == Reading::kind && f.wanted == mixed ? Refusal::nothing
                                                         : Refusal::several_files;
  if (f.copied && reading != Reading::kind) return Refusal::copied_points;
  if (f.form == FileForm::prepared && !thinned && reading != Reading::grid)
    return Refusal::prepared;
  switch (reading) {
    case Reading::kind: {
      const bool of_surface =
          f.held == surface && (f.wanted == solid || f.wanted == wireframe || f.wanted == cloud);
      const bool of_solid =
          f.held == solid && (f.wanted == wireframe || (level_set && f.wanted == surface));
      return f.held == f.wanted || of_surface || of_solid ? Refusal::nothing : Refusal::taken_as;
    }
    case Reading::connecting:
      return f.wanted == cloud ? Refusal::nothing : Refusal::connecting_domain;
    case Reading::filling:
      return boundary || (f.held == surface && f.wanted == solid) ? Refusal::nothing
                                                                  : Refusal::filling_domain;
    case Reading::repair:
      return f.held == surface && f.wanted != cloud ? Refusal::nothing : Refusal::repair_domain;
    case Reading::voxel:
      return level_set || f.repaired || f.writes_volume || f.wanted == cloud
                 ? Refusal::nothing
                 : Refusal::voxel_domain;
    case Reading::joining:
      if (f.held == cloud || f.held == simplices || boundary || level_set)
        return Refusal::pieces_domain;
      return f.positions ? Refusal::nothing : Refusal::pieces_positions;
    case Reading::grid:
      return level_set ? Refusal::nothing : Refusal::grid_domain;
  }
  return Support();
}

/// Are these other triangles than the shape's? Triangulation::automatic gives way where they may
/// not be.
constexpr bool on_other_triangles(Triangulation triangulation) {
  return triangulation == Triangulation::delaunay || triangulation == Triangulation::refined;
}

/// May sources of a kind start on such triangles of a surface?
constexpr Support support(Triangulation triangulation, SourceKind source) {
  const bool shape = source == SourceKind::curve || source == SourceKind::simplex;
  return shape && on_other_triangles(triangulation) ? Refusal::shapes_triangulation
                                                    : Refusal::nothing;
}

/// Is a purpose served on such triangles of a surface?
constexpr Support support(Purpose purpose, Triangulation triangulation) {
  const bool search = purpose == Purpose::searches || purpose == Purpose::astar;
  return search && on_other_triangles(triangulation) ? Refusal::search_triangulation
                                                     : Refusal::nothing;
}

/// May a domain be kept that was measured by a metric (BuildOptions::lengths), or masked?
constexpr Support support_of_keeping(DomainKind domain, bool measured, bool masked) {
  if (measured) return Refusal::kept_metric;
  if (masked) return Refusal::kept_mask;
  return support(Purpose::kept_builds, domain);
}

/// Does a purpose go together with a shape, with everything that it tells?
[[nodiscard]] inline Support support(Purpose purpose, const AnyShape& shape) {
  const DomainKind kind = shape.kind();
  const bool embedded = kind == DomainKind::solid && shape.lengths() == nullptr;
  return support(purpose, {.executor = ExecutorKind::serial,
                           .domain = kind,
                           .dimension = shape.dimension(),
                           .single_precision = true,
                           .metric = embedded ? MetricKind::embedded : MetricKind::intrinsic,
                           .positions = !shape.positions().empty()});
}

}  // namespace plexway
