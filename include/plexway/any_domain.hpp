#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/fields/read_out.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/open_simplices.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/support.hpp>

/// @file
/// The component `any`: link plexway::any. A domain of any kind, its kind and its precision hidden:
/// what programs use that take what users give them.
///
///   const AnyDomain domain = AnyDomain::read("knot.ply");
///   const AnyField field = domain.solve(Serial{}, PointSource::at(7));
///   domain.shape().write_field("distances.vtu", field.doubles());
namespace plexway {

struct CloudSummary;

/// The executors: they run a solve.
using AnyExecutor = std::variant<Serial, OpenMP, GL>;

/// How a shape becomes a domain.
struct BuildOptions {
  /// The precision of its fields.
  Precision precision = Precision::float32;
  /// Of surfaces.
  Triangulation triangulation = Triangulation::automatic;
  /// What its edges cost, by AnyShape::measure; null: their lengths in space, or those given.
  std::shared_ptr<const MeasuredLengths> lengths = nullptr;
  /// Where no path may go, of surfaces, solids, wireframes and simplices; null: everywhere. Fields,
  /// sources and paths keep the numbers of the shape.
  std::shared_ptr<const Mask> mask = nullptr;
  /// That build surfaces, solids and clouds; 0: as many as the machine has. The result does not
  /// depend on it.
  int threads = 0;
  /// Of clouds: called with the share that is done; returning false stops with Cancelled.
  std::function<bool(double)> progress = {};
};

/// A distance field that traces paths and evaluates any point, kind and precision hidden;
/// see PathField. Keeps what it refers to. Any number of threads may ask at once.
class AnyPathField {
 public:
  /// The distances that it was made from.
  [[nodiscard]] const AnyField& field() const;
  /// The path from a point back to its nearest source; points of a path lie in simplices of the
  /// shape, but of a cloud in triangles of its sheet. `positions` are empty where the shape has
  /// none, or lengths by a metric. Throws and costs as PathField::trace.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options = {}) const;
  /// The distance of any point, and of many; throws and costs as PathField::at. UsageError for
  /// clouds.
  [[nodiscard]] double at(const PointSource& point, ReadOut level = ReadOut::neighbours) const;
  /// Of many points.
  [[nodiscard]] std::vector<double> at(std::span<const PointSource> points,
                                       ReadOut level = ReadOut::neighbours) const;
  /// The direction away from the source at the centre of each triangle or tetrahedron; throws as
  /// PathField::gradient. UsageError for clouds.
  [[nodiscard]] std::vector<std::array<double, 3>> gradient() const;
  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const;

  /// For the library's own use.
  struct State;

 private:
  friend class AnyDomain;
  explicit AnyPathField(std::shared_ptr<const State> state) : state_(std::move(state)) {}

  std::shared_ptr<const State> state_;
};

/// A domain of any kind, ready for distances.
///
/// Immutable: any number of threads may solve on one domain at once, each with a workspace of its
/// own, which is kept for the next solve. Copies share what they hold.
class AnyDomain {
 public:
  /// Throws InputError, after "FILE: " where the shape has a file, as the domains' constructors do,
  /// and where a mask leaves nothing; UsageError for a triangulation of what is no surface, a mask
  /// of another size, and fewer than 0 threads.
  explicit AnyDomain(AnyShape shape, const BuildOptions& options = {});
  /// From a file; throws as AnyShape::read, too.
  [[nodiscard]] static AnyDomain read(const std::filesystem::path& file,
                                      const ReadOptions& reading = {},
                                      const BuildOptions& building = {});

  /// The same shape, which is shared, with other walls; null: with none. The complex is built anew,
  /// as walls decide where paths bend and which triangles are Delaunay. Throws as the constructor.
  [[nodiscard]] AnyDomain masked(std::shared_ptr<const Mask> mask) const;

  /// Writes the shape and what was built of it to a file, mostly called NAME.plexway, which is read
  /// as any other (AnyShape::read) and then maps into memory instead of being built: fields have
  /// the same bits. Any number of processes may share its memory. The file is for this version of
  /// the library and for machines with this byte order; it has a checksum, and one that is foreign
  /// or damaged is refused (InputError). With other BuildOptions the shape is built
  /// anew. Surfaces, solids, wireframes and clouds, without a metric or a mask (UsageError); throws
  /// Error "cannot write FILE: reason". Size in single precision: 110 bytes a triangle, 150 on
  /// Delaunay triangles.
  void keep(const std::filesystem::path& file) const;

  /// The shape that it was made from.
  [[nodiscard]] const AnyShape& shape() const;
  /// The kind of the shape.
  [[nodiscard]] DomainKind kind() const { return shape().kind(); }
  /// The precision of its fields.
  [[nodiscard]] Precision precision() const;
  /// Of the shape: fields have one distance each.
  [[nodiscard]] std::size_t vertices() const { return shape().vertices(); }
  /// Of the domain: a cloud has triangles only here. Without those of a refinement, and with those
  /// that a mask closes.
  [[nodiscard]] std::size_t simplices() const;
  /// Parts that no path connects; of a mixed domain counted by its welds.
  [[nodiscard]] std::size_t components() const;
  /// Mean length of the edges of a surface; else 0.
  [[nodiscard]] double mean_edge() const;
  /// Edges of a surface where paths are refracted.
  [[nodiscard]] std::size_t refracting_edges() const;
  /// The lengths that a metric gave it (BuildOptions::lengths); null without one.
  [[nodiscard]] const MeasuredLengths* lengths() const;
  /// Which of its simplices are open; null where all are.
  [[nodiscard]] const OpenSimplices* open_simplices() const;
  /// The triangles that a cloud was made into, or null.
  [[nodiscard]] const CloudSummary* cloud() const;
  /// Which triangles a surface is solved on, at first: see AnyField::triangulation.
  [[nodiscard]] const TriangulationReport& triangulation() const;
  /// Seconds that building took.
  [[nodiscard]] double build_seconds() const;
  /// Bytes held, workspaces included, but not the shape.
  [[nodiscard]] std::size_t bytes() const;

  /// Is it supported? By the table of support.hpp, with all that values decide.
  [[nodiscard]] Support support(const AnyExecutor& executor, const SourceList& sources,
                                const PropagateOptions& options = {}) const;

  /// ONE field: the distance of every vertex from the nearest of `sources`. Throws and costs as
  /// plexway::solve, NotBuiltError for GL in a build without it, and InputError after "FILE: ".
  ///
  /// Where the triangulation was left open and the solve left more than a vertex in fifty to
  /// repair, the triangles of the input are tried as well. Points are those of the shape; curves
  /// and triangles lie in its triangles, so where those were to be others, UsageError, or if that
  /// was left open, those of the shape. UsageError for a point in a simplex that is masked; a
  /// vertex behind the mask reaches itself.
  [[nodiscard]] AnyField solve(const AnyExecutor& executor, const SourceList& sources,
                               const PropagateOptions& options = {}) const;
  /// The same into a field whose memory is used again.
  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const;

  /// Takes the field of source k alone. Called by one thread at a time, in any order.
  using TakeField = std::function<void(std::size_t k, const AnyField& field)>;
  /// K fields, one *to each* of the K sources, as `solve` has them by Serial; by OpenMP a thread a
  /// source, by GL one after the other. Memory: a workspace and a field a thread.
  void solve_each(const AnyExecutor& executor, const SourceList& sources,
                  const PropagateOptions& options, const TakeField& take) const;
  /// The same into rows: K times vertices() numbers, row k the distances from source k. False if
  /// max_expansions ended one early. Throws UsageError for another count.
  bool solve_each(const AnyExecutor& executor, const SourceList& sources,
                  const PropagateOptions& options, std::span<double> rows) const;
  /// Likewise; rounded where the domain is of double.
  bool solve_each(const AnyExecutor& executor, const SourceList& sources,
                  const PropagateOptions& options, std::span<float> rows) const;

  /// A field that traces paths; on complexes of simplices it does not, and there `at` takes
  /// ReadOut::linear alone (UsageError); on mixed domains other levels are lengths of paths.
  /// Distances are those of `solve`; paths lie in the shape's triangles. Cost: a solve, and once
  /// building those where others were taken.
  [[nodiscard]] AnyPathField path_field(const AnyExecutor& executor,
                                        std::span<const PointSource> sources,
                                        const PropagateOptions& options = {}) const;

  /// For the library's own use.
  struct State;
  /// For <plexway/shape/complex.hpp>.
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace plexway
