#include <plexway/shape/shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/shape/support.hpp>

#include "complexes/common/geometry.hpp"
#include "io/names.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/modules/module.hpp"
#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway {
using namespace detail;

namespace {

constexpr DomainKind kind_of(const AnyShape::Data& data) {
  return static_cast<DomainKind>(data.index());
}

[[noreturn]] void out_of_range(std::string_view simplices, std::size_t simplex, Index vertex,
                               std::size_t vertices) {
  throw InputError(singular(simplices) + " " + std::to_string(simplex) + " has vertex " +
                   std::to_string(vertex) + ", but there are " + counted(vertices, "vertices"));
}

constexpr std::array<std::string_view, 5> names_by_corners = {"", "", "edges", "triangles",
                                                              "tetrahedra"};

// Vertices of the cells must be those from `first` to `end`.
void check_corners(const io::Cells& cells, std::string_view name, std::size_t first,
                   std::size_t end, std::size_t vertices) {
  for (std::size_t i = 0; i < cells.connectivity.size(); ++i)
    if (const Index v = cells.connectivity[i]; v < first || v >= end)
      out_of_range(name, i / cells.corners, v, vertices);
}

void check_count(std::size_t rows, std::size_t simplices, std::string_view what) {
  if (rows != simplices)
    throw InputError(std::to_string(rows) + " rows of lengths for " + counted(simplices, what));
}

SimplexPoint closest_of(const AnyShape& shape, const std::array<double, 3>& point) {
  SimplexPoint best;
  std::size_t first = 0;
  for (const io::Cells& cells : shape.state().cells) {
    const auto look = [&](const auto& rows) {
      const SimplexPoint found = closest_point(shape.positions(), rows, point);
      if (!(found.squared_distance < best.squared_distance)) return;
      best = found;
      best.simplex += first;
    };
    if (cells.corners == 2) look(rows_of<2>(cells));
    if (cells.corners == 3) look(rows_of<3>(cells));
    if (cells.corners == 4) look(rows_of<4>(cells));
    first += cells.count();
  }
  return best;
}

PointSource nearest_of_points(std::span<const std::array<double, 3>> points,
                              const std::array<double, 3>& point) {
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    const double away = std::hypot(p[0] - point[0], p[1] - point[1], p[2] - point[2]);
    if (!(away < least)) continue;
    least = away;
    best = static_cast<Index>(i);
  }
  return PointSource::at(best);
}

// Where the vertices of simplices are that have up to three coordinates.
AnyShape::Points places_of(const SimplexShape& shape) {
  AnyShape::Points places;
  if (shape.axes == 0 || shape.axes > 3) return places;
  places.assign(shape.vertices, {0, 0, 0});
  for (std::size_t v = 0; v < shape.vertices; ++v)
    for (std::size_t k = 0; k < shape.axes; ++k) places[v][k] = shape.positions[v * shape.axes + k];
  return places;
}

// What is given as arrays may name any vertex.
AnyShape checked(AnyShape::State state, std::optional<std::size_t> lengths = std::nullopt) {
  if (state.lengths) state.lengths->violations = violations_in(*state.lengths);
  AnyShape shape = AnyShape::of(std::move(state));
  const bool simplices = shape.kind() == DomainKind::simplices;
  for (const io::Cells& cells : shape.state().cells)
    check_corners(cells, simplices ? "simplices" : names_by_corners[cells.corners], 0,
                  shape.vertices(), shape.vertices());
  if (lengths) check_count(*lengths, shape.simplices(), shape.simplex_name());
  return shape;
}

AnyShape::State state_of(AnyShape::Data data, std::size_t vertices = 0) {
  AnyShape::State state;
  state.data = std::move(data);
  state.vertices = vertices;
  return state;
}

}  // namespace

AnyShape AnyShape::of(State state) {
  const auto made = std::make_shared<State>(std::move(state));
  made->cells.clear();
  made->collapsed.clear();
  if (made->kept) {
    made->cells = made->kept->shape->cells();
    made->positions = made->kept->shape->positions();
    return AnyShape(made);
  }
  each_list(made->data, [&](const auto& list) { made->cells.push_back(io::cells_of(list)); });
  if (const auto* simplices = std::get_if<SimplexShape>(&made->data)) {
    made->places = places_of(*simplices);
    made->positions = made->places;
    made->vertices = simplices->vertices;
    made->cells = {{static_cast<std::size_t>(simplices->dimension) + 1, simplices->corners}};
  } else if (const auto* cloud = std::get_if<CloudShape>(&made->data)) {
    made->positions = cloud->points.positions;
  } else {
    std::visit(
        [&](const auto& data) {
          if constexpr (requires { data.positions.front()[0]; }) made->positions = data.positions;
          if constexpr (requires { data.lengths; }) made->vertices = data.vertices;
        },
        made->data);
  }
  if (made->vertices == 0) made->vertices = made->positions.size();
  find_collapsed(*made);
  return AnyShape(made);
}

namespace detail {

metric::Violations violations_in(const MeasuredLengths& lengths) {
  if (lengths.tets.empty())
    return metric::find_violations(std::span<const std::array<double, 3>>(lengths.triangles));
  return metric::find_violations(std::span<const std::array<double, 6>>(lengths.tets));
}

}  // namespace detail

AnyShape AnyShape::surface(Points positions, std::vector<std::array<Index, 3>> triangles) {
  return checked(state_of(io::Triangles{std::move(positions), std::move(triangles)}));
}

AnyShape AnyShape::solid(Points positions, std::vector<std::array<Index, 4>> tets) {
  return checked(state_of(io::Tets{std::move(positions), std::move(tets)}));
}

AnyShape AnyShape::wireframe(Points positions, std::vector<std::array<Index, 2>> edges) {
  const std::size_t n = positions.size();
  return checked(state_of(io::Edges{std::move(positions), std::move(edges), {}, n}));
}

AnyShape AnyShape::surface(std::size_t vertices, std::vector<std::array<Index, 3>> triangles,
                           std::vector<std::array<double, 3>> lengths) {
  State state = state_of(io::Triangles{{}, std::move(triangles)}, vertices);
  const std::size_t rows = lengths.size();
  state.lengths.emplace().triangles = std::move(lengths);
  return checked(std::move(state), rows);
}

AnyShape AnyShape::solid(std::size_t vertices, std::vector<std::array<Index, 4>> tets,
                         std::vector<std::array<double, 6>> lengths) {
  State state = state_of(io::Tets{{}, std::move(tets)}, vertices);
  const std::size_t rows = lengths.size();
  state.lengths.emplace().tets = std::move(lengths);
  return checked(std::move(state), rows);
}

AnyShape AnyShape::wireframe(std::size_t vertices, std::vector<std::array<Index, 2>> edges,
                             std::vector<double> lengths) {
  const std::size_t rows = lengths.size();
  return checked(state_of(io::Edges{{}, std::move(edges), std::move(lengths), vertices}), rows);
}

AnyShape AnyShape::cloud(io::Points points, const ReadOptions& options) {
  check(options);
  const Stopwatch looking;
  CloudShape cloud = make_cloud("a cloud", {std::move(points), 0}, options);
  State state = state_of(std::move(cloud));
  state.neighbour_seconds = looking.seconds();
  return of(std::move(state));
}

AnyShape AnyShape::simplices(SimplexShape shape) {
  if (shape.dimension < 1 || shape.dimension > 4)
    throw InputError("simplices of dimension " + std::to_string(shape.dimension) +
                     ": 1 to 4 are taken");
  const auto corners = static_cast<std::size_t>(shape.dimension) + 1;
  if (shape.corners.size() % corners != 0)
    throw InputError("corners of simplices of dimension " + std::to_string(shape.dimension) +
                     " come in rows of " + std::to_string(corners) + ", not " +
                     std::to_string(shape.corners.size()) + " in all");
  const std::size_t count = shape.corners.size() / corners;
  check_corners({corners, shape.corners}, "simplices", 0, shape.vertices, shape.vertices);
  if (shape.axes > 0 && shape.positions.size() != shape.vertices * shape.axes)
    throw InputError(counted(shape.positions.size(), "coordinates") + " for " +
                     counted(shape.vertices, "vertices") + " of " + std::to_string(shape.axes));
  if (shape.axes > 0 && shape.axes < corners - 1)
    throw InputError("simplices of dimension " + std::to_string(shape.dimension) +
                     " need at least " + std::to_string(corners - 1) +
                     " coordinates a vertex, not " + std::to_string(shape.axes));
  if (shape.axes == 0)
    check_count(shape.lengths.size(), count * corners * (corners - 1) / 2, "edges");
  return of(state_of(std::move(shape)));
}

AnyShape AnyShape::mixed(MixedShape shape) {
  if (!(shape.tolerance >= 0)) throw UsageError("tolerance must be >= 0");
  std::size_t first = 0;
  for (const MixedShape::Part& part : shape.parts) {
    if (part.first_vertex != first)
      throw InputError("the parts of a mixed domain do not number their vertices through");
    first += part.vertices;
    const auto check = [&](const auto& list) {
      const io::Cells cells = io::cells_of(list);
      check_corners(cells, names_by_corners[cells.corners], part.first_vertex, first,
                    shape.positions.size());
    };
    check(part.edges), check(part.triangles), check(part.tets);
  }
  if (first != shape.positions.size())
    throw InputError(counted(shape.positions.size(), "positions") + " for parts of " +
                     counted(first, "vertices"));
  return of(state_of(std::move(shape)));
}

const std::filesystem::path& AnyShape::file() const { return state_->file; }
const AnyShape::Data& AnyShape::data() const {
  return state_->kept ? state_->kept->shape->data() : state_->data;
}
DomainKind AnyShape::kind() const { return kind_of(state_->data); }
std::size_t AnyShape::vertices() const { return state_->vertices; }
const MeasuredLengths* AnyShape::lengths() const {
  return state_->lengths ? &*state_->lengths : nullptr;
}
const io::FileReport& AnyShape::report() const { return state_->report; }
std::span<const Index> AnyShape::collapsed() const { return state_->collapsed; }
const std::string& AnyShape::level_set_note() const { return state_->level_set_note; }
double AnyShape::load_seconds() const { return state_->load_seconds; }
std::optional<double> AnyShape::mesh_seconds() const { return state_->mesh_seconds; }
std::optional<double> AnyShape::neighbour_seconds() const { return state_->neighbour_seconds; }

int AnyShape::dimension() const {
  std::size_t corners = kind() == DomainKind::cloud ? 3 : 1;
  for (const io::Cells& cells : state_->cells)
    if (kind() != DomainKind::mixed || cells.count() > 0)
      corners = std::max(corners, cells.corners);
  return static_cast<int>(corners) - 1;
}

std::string_view AnyShape::simplex_name() const {
  constexpr std::array<std::string_view, 6> names = {"triangles", "tetrahedra", "edges",
                                                     "simplices", "triangles",  "simplices"};
  return names[static_cast<std::size_t>(kind())];
}

std::size_t AnyShape::simplices() const {
  std::size_t count = 0;
  for (const io::Cells& cells : state_->cells) count += cells.count();
  return count;
}

std::span<const Index> AnyShape::corners(std::size_t simplex) const {
  for (const io::Cells& cells : state_->cells) {
    if (const std::size_t at = simplex * cells.corners; at < cells.connectivity.size())
      return cells.connectivity.subspan(at, cells.corners);
    simplex -= cells.count();
  }
  return {};
}

std::span<const std::array<double, 3>> AnyShape::positions() const { return state_->positions; }

PointSource AnyShape::closest(const std::array<double, 3>& point) const {
  support(Purpose::places, *this).require();
  if (cloud() != nullptr) return nearest_of_points(positions(), point);
  if (simplices() == 0) throw UsageError("there is no simplex to be close to");
  const SimplexPoint found = closest_of(*this, point);
  return source_at(found, corners(found.simplex));
}

std::array<double, 3> AnyShape::position(const PointSource& source) const {
  support(Purpose::places, *this).require();
  const auto place = positions();
  if (source.vertex != none) {
    if (source.vertex >= place.size()) throw UsageError("there is no such vertex");
    return place[source.vertex];
  }
  if (source.simplex >= simplices()) throw UsageError("there is no such simplex");
  std::array<double, 3> at = {0, 0, 0};
  const auto ends = corners(source.simplex);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) at[k] += source.barycentric[i] * place[ends[i]][k];
  }
  return at;
}

void AnyShape::write_field(const std::filesystem::path& out, std::span<const double> distance,
                           std::span<const std::int32_t> label,
                           std::span<const double> error) const {
  if (is_vdb(out.string())) {
    require(out.string(), support(Purpose::volumes, *this));
    if (openvdb_functions(out.string())
            .write_field(out, std::get<io::Tets>(data()), distance, label, state_->voxel) == 0)
      throw UsageError(out.string() +
                       ": no voxel has its centre in the solid: choose a smaller voxel");
    return;
  }
  const CloudShape* const points = cloud();
  if (points != nullptr && io::lower_extension(out) == ".pcd")
    return pcl_functions(out.string())
        .write_field(out, positions(), distance, points->points.original);
  const FieldCells cells(*this);
  const bool estimates = points != nullptr || kind() == DomainKind::surface;
  io::write_field_of(out, {vertices(), positions(), cells.all, distance, label, cells.original,
                           estimates && !positions().empty() ? error : std::span<const double>()});
}

namespace detail {

FieldCells::FieldCells(const AnyShape& shape) {
  if (const CloudShape* const cloud = shape.cloud()) {
    lists_[0].resize(shape.vertices());
    std::iota(lists_[0].begin(), lists_[0].end(), Index{0});
    all = {{1, lists_[0]}};
    original = cloud->points.original;
    return;
  }
  // The vertices alone: as a wireframe without edges.
  all = {{2, {}}};
  if (shape.positions().empty() || shape.kind() == DomainKind::simplices) return;
  all = shape.state().cells;
  if (shape.kind() != DomainKind::mixed) return;
  // The lists of all parts, kind after kind.
  all.clear();
  for (std::size_t corners = 2; corners <= 4; ++corners) {
    std::vector<Index>& list = lists_[corners - 2];
    for (const io::Cells& cells : shape.state().cells)
      if (cells.corners == corners)
        list.insert(list.end(), cells.connectivity.begin(), cells.connectivity.end());
    if (!list.empty()) all.push_back({corners, list});
  }
}

}  // namespace detail

std::span<const std::string_view> AnyShape::field_extensions(DomainKind kind) {
  static const auto with = [](std::string_view more) {
    const auto known = io::field_extensions();
    std::vector<std::string_view> all(known.begin(), known.end());
    all.push_back(more);
    return all;
  };
  static const std::vector<std::string_view> of_clouds = with(".pcd"), of_solids = with(".vdb");
  if (kind == DomainKind::cloud) return of_clouds;
  return support(Purpose::volumes, kind) ? of_solids : io::field_extensions();
}

}  // namespace plexway
