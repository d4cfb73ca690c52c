#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/common/mask.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/shape/cloud_shape.hpp>
#include <plexway/shape/read_options.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// Simplices of one dimension, 1 to 4.
using SimplexShape = io::Simplices;

/// Edges, triangles and tetrahedra over shared vertices. Vertices are numbered through, part after
/// part; simplices likewise, and in each part edges come first, then triangles, then tetrahedra.
struct MixedShape {
  /// One of the parts: vertices that follow each other, and simplices of them.
  struct Part {
    ///@{
    /// Its first vertex, and how many it has.
    std::size_t first_vertex = 0, vertices = 0;
    ///@}
    // By numbers of the whole.
    /// Edges, by numbers of the whole, as all simplices.
    std::vector<std::array<Index, 2>> edges = {};
    /// Triangles.
    std::vector<std::array<Index, 3>> triangles = {};
    /// Tetrahedra.
    std::vector<std::array<Index, 4>> tets = {};
  };
  /// Of all parts, part after part, in one unit.
  std::vector<std::array<double, 3>> positions;
  /// At least one.
  std::vector<Part> parts;
  double tolerance = 0;  ///< vertices of two parts are one if they are this close
};

/// Lengths of edges by a metric, those of the kind of domain that was measured.
struct MeasuredLengths {
  /// Of a surface, as TriangleMesh takes them; else empty.
  std::vector<std::array<double, 3>> triangles;
  /// Of a solid, as TetMesh takes them; else empty, as where paths are refracted.
  std::vector<std::array<double, 6>> tets;
  /// Of a wireframe, one an edge; else empty.
  std::vector<double> edges;
  /// Of a mixed domain's simplices, all kinds in order, and of a solid's with regions to each
  /// speed.
  std::vector<double> speeds;
  /// Simplices may measure an edge they share in two ways.
  bool refracts = false;
  /// They were to, but a solid of so many speeds, or of tensors, takes their mean.
  bool smoothed = false;
  /// Simplices whose lengths no flat simplex has.
  metric::Violations violations;
};

/// A domain as a file or a caller has it, in double precision and of any kind: what AnyDomain is
/// made from. Immutable; copies share what they hold.
class AnyShape {
 public:
  /// In the order of DomainKind.
  using Data =
      std::variant<io::Triangles, io::Tets, io::Edges, SimplexShape, CloudShape, MixedShape>;
  /// Three coordinates a point.
  using Points = std::vector<std::array<double, 3>>;

  /// Reads `file`, and fills or unravels it where `options.as` asks for that; else the extension
  /// tells the kind, an .obj without faces but with lines is a wireframe, and a .ply without faces
  /// a cloud. Throws InputError as the readers do, UsageError for options that mean nothing here,
  /// and NotBuiltError for what this build lacks.
  [[nodiscard]] static AnyShape read(const std::filesystem::path& file,
                                     const ReadOptions& options = {});

  /// Reads several files, each a surface, a solid or a wireframe with positions, or a .msh, .vtu or
  /// .vtk with cells of several dimensions: parts of one mixed domain, whose vertices are one where
  /// they are closer than `tolerance` in file units, >= 0. Throws as above; UsageError for options
  /// that say how to fill, repair or connect points.
  [[nodiscard]] static AnyShape read(std::span<const std::filesystem::path> files, double tolerance,
                                     const ReadOptions& options = {});

  // From arrays: positions in any unit, simplices by vertices counted from 0. All throw InputError
  // that names the simplex for a vertex out of range.
  /// Triangles.
  [[nodiscard]] static AnyShape surface(Points positions,
                                        std::vector<std::array<Index, 3>> triangles);
  /// Tetrahedra.
  [[nodiscard]] static AnyShape solid(Points positions, std::vector<std::array<Index, 4>> tets);
  /// Edges.
  [[nodiscard]] static AnyShape wireframe(Points positions,
                                          std::vector<std::array<Index, 2>> edges);
  /// By lengths alone, one row a simplex, in the order of TriangleMesh, TetMesh and Wireframe.
  [[nodiscard]] static AnyShape surface(std::size_t vertices,
                                        std::vector<std::array<Index, 3>> triangles,
                                        std::vector<std::array<double, 3>> lengths);
  /// Likewise.
  [[nodiscard]] static AnyShape solid(std::size_t vertices, std::vector<std::array<Index, 4>> tets,
                                      std::vector<std::array<double, 6>> lengths);
  /// Likewise.
  [[nodiscard]] static AnyShape wireframe(std::size_t vertices,
                                          std::vector<std::array<Index, 2>> edges,
                                          std::vector<double> lengths);
  /// Points, thinned, denoised and connected as options.cloud and options.volume.voxel say; with
  /// normals where points.normals has them. Throws NotBuiltError without FLANN.
  [[nodiscard]] static AnyShape cloud(io::Points points, const ReadOptions& options = {});
  /// Of dimension 1 to 4. Throws InputError for counts that do not fit.
  [[nodiscard]] static AnyShape simplices(SimplexShape shape);
  /// Of parts that are there already. Throws InputError for numbers that do not fit, UsageError for
  /// a tolerance that is not >= 0.
  [[nodiscard]] static AnyShape mixed(MixedShape shape);

  /// The file, or empty.
  [[nodiscard]] const std::filesystem::path& file() const;
  /// What it holds.
  [[nodiscard]] const Data& data() const;
  /// Its kind.
  [[nodiscard]] DomainKind kind() const;
  /// The name of its kind: see plexway::kind_name.
  [[nodiscard]] std::string_view kind_name() const { return plexway::kind_name(kind()); }
  /// The cloud if it is one, else null.
  [[nodiscard]] const CloudShape* cloud() const {
    return kind() == DomainKind::cloud ? std::get_if<CloudShape>(&data()) : nullptr;
  }
  /// Of its simplices; of a mixed domain the greatest.
  [[nodiscard]] int dimension() const;
  /// What its simplices are called, in the plural.
  [[nodiscard]] std::string_view simplex_name() const;
  /// Points, of a cloud.
  [[nodiscard]] std::size_t vertices() const;
  /// As given: a cloud has none.
  [[nodiscard]] std::size_t simplices() const;
  /// Corners of a simplex.
  [[nodiscard]] std::span<const Index> corners(std::size_t simplex) const;
  /// One a vertex; none at all where there are only lengths, or more than three coordinates.
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const;
  /// Lengths that it was made from, or null.
  [[nodiscard]] const MeasuredLengths* lengths() const;

  /// The region of each simplex, as the .msh, .vtu or .vtk that it was read from has them; see
  /// io::read_regions. Reads the file again. Throws InputError as that, and UsageError for a shape
  /// of no such file, or whose simplices are not the file's.
  [[nodiscard]] std::vector<std::int64_t> regions() const;

  /// What was done with a file besides taking what it has.
  [[nodiscard]] const io::FileReport& report() const;
  /// Simplices with a vertex twice, by their numbers: no domain is built of them.
  [[nodiscard]] std::span<const Index> collapsed() const;

  /// How a level set came in: the grid and its voxels, or what was repaired; else empty.
  [[nodiscard]] const std::string& level_set_note() const;
  /// Seconds that reading took, and those that filling a surface and finding the neighbours of a
  /// cloud took, if that was done.
  [[nodiscard]] double load_seconds() const;
  /// For filling, if that was done.
  [[nodiscard]] std::optional<double> mesh_seconds() const;
  /// For neighbours, if that was done.
  [[nodiscard]] std::optional<double> neighbour_seconds() const;

  /// The point of the domain closest to `point`; a vertex where it is that vertex. Among several,
  /// the one in the simplex with the lowest number. Of a cloud, the nearest point. Needs positions
  /// (UsageError). Cost: linear.
  [[nodiscard]] PointSource closest(const std::array<double, 3>& point) const;
  /// Where a source is. Needs positions (UsageError).
  [[nodiscard]] std::array<double, 3> position(const PointSource& source) const;
  /// Points joined by shortest paths, as a curve through the simplices between. Throws UsageError
  /// where the domain is neither a surface nor a wireframe with positions, InputError where no path
  /// leads.
  [[nodiscard]] CurveSource joined(std::span<const PointSource> points) const;
  /// The whole boundary: of a surface as a curve, of a solid its faces (every vertex with its exact
  /// distance; by lengths alone the boundary's vertices), of a wireframe the ends of single edges.
  /// Throws InputError where there is none, UsageError for other kinds.
  [[nodiscard]] Source boundary(double offset = 0) const;

  /// Lengths by a metric. Triangles may measure an edge they share in two ways where the metric
  /// says Sides::own. Mixed domains take a speed a simplex, of at most 64 different ones: paths are
  /// refracted where it changes. So are those in solids by SimplexSpeeds with Sides::own; of more
  /// than 64 speeds, and of tensors, an edge of a solid takes the mean of its simplices. Throws
  /// InputError as metric::triangle_lengths, and UsageError for what cannot be measured.
  [[nodiscard]] MeasuredLengths measure(const metric::Metric& metric) const;

  /// What a mask leaves of it: its vertices, with their numbers, and the simplices that are open.
  /// Throws UsageError for other kinds than surfaces, solids, wireframes and simplices, and for a
  /// mask of another size. Cost: linear.
  [[nodiscard]] AnyShape open_part(const Mask& mask) const;

  /// Writes one distance a vertex, and of surfaces and clouds its `error` where there is one; the
  /// extension of `out` picks the format. Throws as
  /// io::write_field; a cloud fits a .pcd as well, a solid a .vdb.
  void write_field(const std::filesystem::path& out, std::span<const double> distance,
                   std::span<const std::int32_t> label = {},
                   std::span<const double> error = {}) const;
  /// The extensions that fields of a kind may have, with the dot, in lower case.
  [[nodiscard]] static std::span<const std::string_view> field_extensions(DomainKind kind);

  /// For the library's own use.
  struct State;
  /// Likewise.
  [[nodiscard]] const State& state() const { return *state_; }
  /// Likewise.
  [[nodiscard]] static AnyShape of(State state);

 private:
  explicit AnyShape(std::shared_ptr<const State> state) : state_(std::move(state)) {}

  std::shared_ptr<const State> state_;
};

}  // namespace plexway
