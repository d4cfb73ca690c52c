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

#include <plexway/any/cloud_shape.hpp>
#include <plexway/any/read_options.hpp>
#include <plexway/apps/path.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// Simplices of one dimension, 1 to 4, with any number of coordinates or with lengths alone.
struct SimplexShape {
  int dimension = 4;
  std::size_t vertices = 0;
  std::size_t axes = 0;                ///< coordinates a vertex; 0: none
  std::vector<double> positions = {};  ///< vertices x axes
  std::vector<Index> corners = {};     ///< dimension + 1 a simplex
  /// If there are no positions: dimension (dimension + 1) / 2 a simplex, ordered as
  /// SimplicialComplex has them.
  std::vector<double> lengths = {};
};

/// Edges, triangles and tetrahedra over shared vertices. Vertices are numbered through, part after
/// part; simplices likewise, and in each part edges come first, then triangles, then tetrahedra.
struct MixedShape {
  struct Part {
    std::size_t first_vertex = 0, vertices = 0;
    // By numbers of the whole.
    std::vector<std::array<Index, 2>> edges = {};
    std::vector<std::array<Index, 3>> triangles = {};
    std::vector<std::array<Index, 4>> tets = {};
  };
  std::vector<std::array<double, 3>> positions;
  std::vector<Part> parts;
  double tolerance = 0;  ///< vertices of two parts are one if they are this close
};

/// Lengths of edges by a metric, those of the kind of domain that was measured.
struct MeasuredLengths {
  std::vector<std::array<double, 3>> triangles;
  std::vector<std::array<double, 6>> tets;
  std::vector<double> edges;
  bool refracts = false;  ///< triangles may measure an edge they share in two ways
  metric::Violations violations;
};

/// A domain as a file or a caller has it, in double precision and of any kind: what AnyDomain is
/// made from. Immutable; copies share what they hold.
class AnyShape {
 public:
  /// In the order of DomainKind.
  using Data =
      std::variant<io::Triangles, io::Tets, io::Edges, SimplexShape, CloudShape, MixedShape>;
  using Points = std::vector<std::array<double, 3>>;

  /// Reads `file`, and fills or unravels it where `options.as` asks for that; else the extension
  /// tells the kind, an .obj without faces but with lines is a wireframe, and a .ply without faces
  /// a cloud. Throws InputError as the readers do, UsageError for options that mean nothing here,
  /// and NotBuiltError for what this build lacks.
  [[nodiscard]] static AnyShape read(const std::filesystem::path& file,
                                     const ReadOptions& options = {});

  // From arrays: positions in any unit, simplices by vertices counted from 0. All throw InputError
  // that names the simplex for a vertex out of range.
  [[nodiscard]] static AnyShape surface(Points positions,
                                        std::vector<std::array<Index, 3>> triangles);
  [[nodiscard]] static AnyShape solid(Points positions, std::vector<std::array<Index, 4>> tets);
  [[nodiscard]] static AnyShape wireframe(Points positions,
                                          std::vector<std::array<Index, 2>> edges);
  /// By lengths alone, one row a simplex, in the order of TriangleMesh, TetMesh and Wireframe.
  [[nodiscard]] static AnyShape surface(std::size_t vertices,
                                        std::vector<std::array<Index, 3>> triangles,
                                        std::vector<std::array<double, 3>> lengths);
  [[nodiscard]] static AnyShape solid(std::size_t vertices, std::vector<std::array<Index, 4>> tets,
                                      std::vector<std::array<double, 6>> lengths);
  [[nodiscard]] static AnyShape wireframe(std::size_t vertices,
                                          std::vector<std::array<Index, 2>> edges,
                                          std::vector<double> lengths);
  /// Points, thinned, denoised and connected as options.cloud and options.volume.voxel say; with
  /// normals where points.normals has them. Throws NotBuiltError without FLANN.
  [[nodiscard]] static AnyShape cloud(io::Points points, const ReadOptions& options = {});
  /// Of dimension 1 to 4. Throws InputError for counts that do not fit.
  [[nodiscard]] static AnyShape simplices(SimplexShape shape);
  [[nodiscard]] static AnyShape mixed(MixedShape shape);

  /// The file, or empty.
  [[nodiscard]] const std::filesystem::path& file() const;
  [[nodiscard]] const Data& data() const;
  [[nodiscard]] DomainKind kind() const;
  [[nodiscard]] std::string_view kind_name() const { return plexway::kind_name(kind()); }
  /// The cloud if it is one, else null.
  [[nodiscard]] const CloudShape* cloud() const { return std::get_if<CloudShape>(&data()); }
  /// Of its simplices; of a mixed domain the greatest.
  [[nodiscard]] int dimension() const;
  /// What its simplices are called, in the plural.
  [[nodiscard]] std::string_view simplex_name() const;
  [[nodiscard]] std::size_t vertices() const;
  /// As given: a cloud has none.
  [[nodiscard]] std::size_t simplices() const;
  /// Corners of a simplex.
  [[nodiscard]] std::span<const Index> corners(std::size_t simplex) const;
  /// One a vertex; none at all where there are only lengths, or more than three coordinates.
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const;
  /// Lengths that it was made from, or null.
  [[nodiscard]] const MeasuredLengths* lengths() const;

  /// How a level set came in: the grid and its voxels, or what was repaired; else empty.
  [[nodiscard]] const std::string& level_set_note() const;
  /// Seconds that reading took, and those that filling a surface and finding the neighbours of a
  /// cloud took, if that was done.
  [[nodiscard]] double load_seconds() const;
  [[nodiscard]] std::optional<double> mesh_seconds() const;
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
  /// The whole boundary: of a surface as a curve, of a solid the vertices of its boundary, of a
  /// wireframe the ends of single edges. Throws InputError where there is none, UsageError for
  /// other kinds.
  [[nodiscard]] Source boundary(double offset = 0) const;

  /// Lengths by a metric; `refract`: triangles may measure an edge they share in two ways. Throws
  /// InputError as metric::triangle_lengths, and UsageError for kinds that cannot be measured.
  [[nodiscard]] MeasuredLengths measure(const metric::Metric& metric) const;

  /// Lines on a surface where a field has the values. UsageError for other kinds; see isolines.hpp.
  [[nodiscard]] std::vector<Path> isolines(std::span<const double> distance,
                                           std::span<const double> values) const;

  /// Writes one distance a vertex; the extension of `out` picks the format. Throws as
  /// io::write_field; a cloud fits a .pcd as well, a solid a .vdb.
  void write_field(const std::filesystem::path& out, std::span<const double> distance,
                   std::span<const std::int32_t> label = {}) const;
  /// The extensions that fields of a kind may have, with the dot, in lower case.
  [[nodiscard]] static std::span<const std::string_view> field_extensions(DomainKind kind);

  struct State;

 private:
  explicit AnyShape(std::shared_ptr<const State> state) : state_(std::move(state)) {}

  std::shared_ptr<const State> state_;
};

}  // namespace plexway
