#include <plexway/shape/shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/shape/support.hpp>

#include "complexes/common/closest_point.hpp"
#include "io/extension.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/fill.hpp"
#include "shape/kept_build.hpp"
#include "shape/merge.hpp"
#include "shape/modules/module.hpp"
#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway {
namespace {

constexpr DomainKind kind_of(const AnyShape::Data& data) {
  return static_cast<DomainKind>(data.index());
}

[[noreturn]] void out_of_range(std::string_view simplices, std::size_t simplex, Index vertex,
                               std::size_t vertices) {
  throw InputError(singular(simplices) + " " + std::to_string(simplex) + " has vertex " +
                   std::to_string(vertex) + ", but there are " + counted(vertices, "vertices"));
}

template <std::size_t N>
void check_corners(std::span<const std::array<Index, N>> simplices, std::size_t vertices,
                   std::string_view name) {
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (const Index v : simplices[s])
      if (v >= vertices) out_of_range(name, s, v, vertices);
}

void check_count(std::size_t rows, std::size_t simplices, std::string_view what) {
  if (rows != simplices)
    throw InputError(std::to_string(rows) + " rows of lengths for " + counted(simplices, what));
}

template <std::size_t N>
std::vector<std::array<Index, N>> rows_of(const SimplexShape& shape) {
  std::vector<std::array<Index, N>> rows(shape.corners.size() / N);
  for (std::size_t s = 0; s < rows.size(); ++s)
    std::copy_n(shape.corners.begin() + static_cast<std::ptrdiff_t>(N * s), N, rows[s].begin());
  return rows;
}

// The better of the best so far and another of `first` on.
void take(SimplexPoint& best, SimplexPoint other, std::size_t first) {
  if (!(other.squared_distance < best.squared_distance)) return;
  best = other;
  best.simplex += first;
}

SimplexPoint closest_of(const AnyShape& shape, const std::array<double, 3>& point) {
  const auto at = shape.positions();
  return std::visit(
      [&](const auto& data) {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          return closest_point(at, std::span(data.triangles), point);
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          return closest_point(at, std::span(data.tets), point);
        } else if constexpr (std::is_same_v<Kind, io::Edges>) {
          return closest_point(at, std::span(data.edges), point);
        } else if constexpr (std::is_same_v<Kind, MixedShape>) {
          SimplexPoint best;
          std::size_t first = 0;
          for (const MixedShape::Part& part : data.parts) {
            take(best, closest_point(at, std::span(part.edges), point), first);
            first += part.edges.size();
            take(best, closest_point(at, std::span(part.triangles), point), first);
            first += part.triangles.size();
            take(best, closest_point(at, std::span(part.tets), point), first);
            first += part.tets.size();
          }
          return best;
        } else if constexpr (std::is_same_v<Kind, SimplexShape>) {
          const auto in = [&](const auto& rows) {
            return closest_point(at, std::span(rows), point);
          };
          return data.dimension == 1   ? in(rows_of<2>(data))
                 : data.dimension == 2 ? in(rows_of<3>(data))
                                       : in(rows_of<4>(data));
        } else {
          return SimplexPoint{};
        }
      },
      shape.data());
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

// Parts of a mixed domain as the writer wants them, in numbers of their own.
void write_mixed(const std::filesystem::path& out, const MixedShape& shape,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  std::vector<MixedShape::Part> own = shape.parts;
  std::vector<io::MixedPart> parts;
  for (MixedShape::Part& part : own) {
    const auto move = [&](auto& rows) {
      for (auto& row : rows)
        for (Index& v : row) v -= static_cast<Index>(part.first_vertex);
    };
    move(part.edges), move(part.triangles), move(part.tets);
    parts.push_back(
        {.positions = std::span(shape.positions).subspan(part.first_vertex, part.vertices),
         .edges = part.edges,
         .triangles = part.triangles,
         .tets = part.tets});
  }
  io::write_field(out, parts, distance, label);
}

}  // namespace

namespace {

AnyShape::State of_data(AnyShape::Data data, std::size_t vertices) {
  AnyShape::State state;
  state.data = std::move(data);
  state.vertices = vertices;
  find_collapsed(state);
  return state;
}

}  // namespace

AnyShape::Points places_of(const SimplexShape& shape) {
  AnyShape::Points places;
  if (shape.axes == 0 || shape.axes > 3) return places;
  places.assign(shape.vertices, {0, 0, 0});
  for (std::size_t v = 0; v < shape.vertices; ++v)
    for (std::size_t k = 0; k < shape.axes; ++k) places[v][k] = shape.positions[v * shape.axes + k];
  return places;
}

AnyShape AnyShape::surface(Points positions, std::vector<std::array<Index, 3>> triangles) {
  const std::size_t n = positions.size();
  check_corners<3>(triangles, n, "triangles");
  return AnyShape(std::make_shared<State>(
      of_data(io::Triangles{std::move(positions), std::move(triangles)}, n)));
}

AnyShape AnyShape::solid(Points positions, std::vector<std::array<Index, 4>> tets) {
  const std::size_t n = positions.size();
  check_corners<4>(tets, n, "tetrahedra");
  return AnyShape(
      std::make_shared<State>(of_data(io::Tets{std::move(positions), std::move(tets)}, n)));
}

AnyShape AnyShape::wireframe(Points positions, std::vector<std::array<Index, 2>> edges) {
  const std::size_t n = positions.size();
  check_corners<2>(edges, n, "edges");
  return AnyShape(std::make_shared<State>(
      of_data(io::Edges{std::move(positions), std::move(edges), {}, n}, n)));
}

AnyShape AnyShape::surface(std::size_t vertices, std::vector<std::array<Index, 3>> triangles,
                           std::vector<std::array<double, 3>> lengths) {
  check_corners<3>(triangles, vertices, "triangles");
  check_count(lengths.size(), triangles.size(), "triangles");
  State state = of_data(io::Triangles{{}, std::move(triangles)}, vertices);
  state.lengths.emplace();
  state.lengths->violations =
      metric::find_violations(std::span<const std::array<double, 3>>(lengths));
  state.lengths->triangles = std::move(lengths);
  return AnyShape(std::make_shared<State>(std::move(state)));
}

AnyShape AnyShape::solid(std::size_t vertices, std::vector<std::array<Index, 4>> tets,
                         std::vector<std::array<double, 6>> lengths) {
  check_corners<4>(tets, vertices, "tetrahedra");
  check_count(lengths.size(), tets.size(), "tetrahedra");
  State state = of_data(io::Tets{{}, std::move(tets)}, vertices);
  state.lengths.emplace();
  state.lengths->violations =
      metric::find_violations(std::span<const std::array<double, 6>>(lengths));
  state.lengths->tets = std::move(lengths);
  return AnyShape(std::make_shared<State>(std::move(state)));
}

AnyShape AnyShape::wireframe(std::size_t vertices, std::vector<std::array<Index, 2>> edges,
                             std::vector<double> lengths) {
  check_corners<2>(edges, vertices, "edges");
  check_count(lengths.size(), edges.size(), "edges");
  return AnyShape(std::make_shared<State>(
      of_data(io::Edges{{}, std::move(edges), std::move(lengths), vertices}, vertices)));
}

AnyShape AnyShape::cloud(io::Points points, const ReadOptions& options) {
  check(options);
  const Stopwatch looking;
  CloudShape cloud = make_cloud("a cloud", {std::move(points), 0}, options);
  const std::size_t n = cloud.points.positions.size();
  State state = of_data(std::move(cloud), n);
  state.neighbour_seconds = looking.seconds();
  return AnyShape(std::make_shared<State>(std::move(state)));
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
  for (std::size_t i = 0; i < shape.corners.size(); ++i)
    if (shape.corners[i] >= shape.vertices)
      out_of_range("simplices", i / corners, shape.corners[i], shape.vertices);
  if (shape.axes > 0 && shape.positions.size() != shape.vertices * shape.axes)
    throw InputError(counted(shape.positions.size(), "coordinates") + " for " +
                     counted(shape.vertices, "vertices") + " of " + std::to_string(shape.axes));
  if (shape.axes > 0 && shape.axes < corners - 1)
    throw InputError("simplices of dimension " + std::to_string(shape.dimension) +
                     " need at least " + std::to_string(corners - 1) +
                     " coordinates a vertex, not " + std::to_string(shape.axes));
  if (shape.axes == 0)
    check_count(shape.lengths.size(), count * corners * (corners - 1) / 2, "edges");
  State state;
  state.vertices = shape.vertices;
  state.places = places_of(shape);
  state.data = std::move(shape);
  find_collapsed(state);
  return AnyShape(std::make_shared<State>(std::move(state)));
}

AnyShape AnyShape::mixed(MixedShape shape) {
  if (!(shape.tolerance >= 0)) throw UsageError("tolerance must be >= 0");
  std::size_t first = 0;
  for (const MixedShape::Part& part : shape.parts) {
    if (part.first_vertex != first)
      throw InputError("the parts of a mixed domain do not number their vertices through");
    first += part.vertices;
    const auto check_rows = [&](const auto& rows, std::string_view name) {
      for (std::size_t s = 0; s < rows.size(); ++s)
        for (const Index v : rows[s])
          if (v < part.first_vertex || v >= first) out_of_range(name, s, v, shape.positions.size());
    };
    check_rows(part.edges, "edges");
    check_rows(part.triangles, "triangles");
    check_rows(part.tets, "tetrahedra");
  }
  if (first != shape.positions.size())
    throw InputError(counted(shape.positions.size(), "positions") + " for parts of " +
                     counted(first, "vertices"));
  return AnyShape(std::make_shared<State>(of_data(std::move(shape), first)));
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
  switch (kind()) {
    case DomainKind::surface:
    case DomainKind::cloud:
      return 2;
    case DomainKind::solid:
      return 3;
    case DomainKind::wireframe:
      return 1;
    case DomainKind::simplices:
      return std::get<SimplexShape>(data()).dimension;
    case DomainKind::mixed:
      break;
  }
  int dimension = 0;
  for (const MixedShape::Part& part : std::get<MixedShape>(data()).parts)
    dimension = std::max(dimension, !part.tets.empty()        ? 3
                                    : !part.triangles.empty() ? 2
                                    : !part.edges.empty()     ? 1
                                                              : 0);
  return dimension;
}

std::string_view AnyShape::simplex_name() const {
  constexpr std::array<std::string_view, 6> names = {"triangles", "tetrahedra", "edges",
                                                     "simplices", "triangles",  "simplices"};
  return names[static_cast<std::size_t>(kind())];
}

std::size_t AnyShape::simplices() const {
  if (state_->kept) return state_->kept->shape->simplices();
  return std::visit(
      [](const auto& data) -> std::size_t {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          return data.triangles.size();
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          return data.tets.size();
        } else if constexpr (std::is_same_v<Kind, io::Edges>) {
          return data.edges.size();
        } else if constexpr (std::is_same_v<Kind, SimplexShape>) {
          return data.corners.size() / (static_cast<std::size_t>(data.dimension) + 1);
        } else if constexpr (std::is_same_v<Kind, MixedShape>) {
          std::size_t count = 0;
          for (const MixedShape::Part& part : data.parts)
            count += part.edges.size() + part.triangles.size() + part.tets.size();
          return count;
        } else {
          return 0;
        }
      },
      data());
}

std::span<const Index> AnyShape::corners(std::size_t simplex) const {
  return std::visit(
      [&](const auto& data) -> std::span<const Index> {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          return data.triangles[simplex];
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          return data.tets[simplex];
        } else if constexpr (std::is_same_v<Kind, io::Edges>) {
          return data.edges[simplex];
        } else if constexpr (std::is_same_v<Kind, SimplexShape>) {
          const auto n = static_cast<std::size_t>(data.dimension) + 1;
          return std::span(data.corners).subspan(n * simplex, n);
        } else if constexpr (std::is_same_v<Kind, MixedShape>) {
          for (const MixedShape::Part& part : data.parts) {
            if (simplex < part.edges.size()) return part.edges[simplex];
            simplex -= part.edges.size();
            if (simplex < part.triangles.size()) return part.triangles[simplex];
            simplex -= part.triangles.size();
            if (simplex < part.tets.size()) return part.tets[simplex];
            simplex -= part.tets.size();
          }
          return {};
        } else {
          return {};
        }
      },
      data());
}

std::span<const std::array<double, 3>> AnyShape::positions() const {
  if (state_->kept) return state_->kept->shape->positions();
  return std::visit(
      [&](const auto& data) -> std::span<const std::array<double, 3>> {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, CloudShape>)
          return data.points.positions;
        else if constexpr (std::is_same_v<Kind, SimplexShape>)
          return state_->places;
        else
          return data.positions;
      },
      data());
}

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
  if (positions().empty() || kind() == DomainKind::simplices) {
    // The vertices alone: as a wireframe without edges.
    io::Edges vertices;
    vertices.positions.assign(positions().begin(), positions().end());
    vertices.vertices = this->vertices();
    return io::write_field(out, vertices, distance, label);
  }
  std::visit(
      [&](const auto& data) {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, CloudShape>) {
          if (io::lower_extension(out) == ".pcd")
            pcl_functions(out.string())
                .write_field(out, data.points.positions, distance, data.points.original);
          else
            io::write_field(out, data.points, distance, label, error);
        } else if constexpr (std::is_same_v<Kind, MixedShape>) {
          write_mixed(out, data, distance, label);
        } else if constexpr (!std::is_same_v<Kind, SimplexShape>) {
          if constexpr (std::is_same_v<Kind, io::Triangles>)
            io::write_field(out, data, distance, label, error);
          else
            io::write_field(out, data, distance, label);
        }
      },
      data());
}

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
