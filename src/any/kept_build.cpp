#include "any/kept_build.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/any/support.hpp>
#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "any/shape_state.hpp"
#include "io/extension.hpp"

namespace plexway {
namespace {

// Bytes, whatever an enumeration is made of.
template <class Archive, class Enum>
void each_choice(Archive& archive, Enum& choice) {
  auto number = static_cast<std::uint32_t>(choice);
  archive(number);
  choice = static_cast<Enum>(number);
}

template <class Archive, class Value>
void each_if_any(Archive& archive, Value& value) {
  bool any = value.has_value();
  archive(any);
  if constexpr (Archive::reads)
    if (any) value.emplace();
  if (any) archive(*value);
}

template <class Archive, class Lengths>
void each_of_lengths(Archive& archive, Lengths& lengths) {
  archive(lengths.triangles, lengths.tets, lengths.edges, lengths.speeds, lengths.refracts,
          lengths.violations.count, lengths.violations.first);
}

template <class Archive, class Data>
void each_of_data(Archive& archive, Data& data) {
  using Kind = std::remove_const_t<Data>;
  if constexpr (std::is_same_v<Kind, io::Triangles>) {
    archive(data.positions, data.triangles);
  } else if constexpr (std::is_same_v<Kind, io::Tets>) {
    archive(data.positions, data.tets);
  } else if constexpr (std::is_same_v<Kind, io::Edges>) {
    archive(data.positions, data.edges, data.lengths, data.vertices);
  } else {
    static_assert(std::is_same_v<Kind, CloudShape>);
    archive(data.points.positions, data.points.normals, data.points.original, data.smoothed,
            data.neighbours.begin, data.neighbours.of, data.k);
    each_if_any(archive, data.max_normal_angle);
    archive(data.points_in_file, data.not_finite, data.outliers, data.thinned, data.normals_agree);
  }
}

// Calls use(data) for those kinds that can be kept.
template <class Data, class Use>
void with_kept_kind(Data& data, DomainKind kind, const Use& use) {
  std::visit(
      [&](auto& of_kind) {
        using Kind = std::remove_const_t<std::remove_reference_t<decltype(of_kind)>>;
        if constexpr (std::is_same_v<Kind, SimplexShape> || std::is_same_v<Kind, MixedShape>)
          support(Purpose::kept_builds, kind).require();
        else
          use(of_kind);
      },
      data);
}

AnyShape::Data empty_of(DomainKind kind, const KeptIn& in) {
  switch (kind) {
    case DomainKind::surface:
      return io::Triangles{};
    case DomainKind::solid:
      return io::Tets{};
    case DomainKind::wireframe:
      return io::Edges{};
    case DomainKind::cloud:
      return CloudShape{};
    default:
      in.refuse("is damaged");
  }
}

// Rows of finite numbers, one a vertex or none at all.
bool are_points(std::span<const std::array<double, 3>> rows, std::size_t vertices) {
  if (!rows.empty() && rows.size() != vertices) return false;
  bool finite = true;
  for (const auto& [x, y, z] : rows)
    finite &= std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  return finite;
}

template <std::size_t N>
bool are_simplices(std::span<const std::array<Index, N>> rows, std::size_t vertices) {
  Index largest = 0;
  for (const auto& row : rows)
    for (const Index v : row) largest = std::max(largest, v);
  return !rows.empty() && largest < vertices;
}

template <class Rows>
bool are_lengths(const Rows& rows, std::size_t simplices) {
  bool sound = true;
  for (const auto& row : rows)
    for (const double length : row) sound &= length >= 0 && std::isfinite(length);
  return sound && rows.size() == simplices;
}

// What the readers of other files see to.
bool is_sound(const AnyShape::State& state) {
  const std::size_t n = state.vertices;
  const MeasuredLengths* lengths = state.lengths ? &*state.lengths : nullptr;
  if (const auto* surface = std::get_if<io::Triangles>(&state.data))
    return are_simplices<3>(surface->triangles, n) && are_points(surface->positions, n) &&
           (lengths == nullptr ? !surface->positions.empty()
                               : are_lengths(lengths->triangles, surface->triangles.size()));
  if (const auto* solid = std::get_if<io::Tets>(&state.data))
    return are_simplices<4>(solid->tets, n) && are_points(solid->positions, n) &&
           (lengths == nullptr ? !solid->positions.empty()
                               : are_lengths(lengths->tets, solid->tets.size()));
  if (const auto* wires = std::get_if<io::Edges>(&state.data)) {
    bool sound = lengths == nullptr && wires->vertices == n;
    for (const double length : wires->lengths) sound &= length >= 0 && std::isfinite(length);
    return sound && are_simplices<2>(wires->edges, n) && are_points(wires->positions, n) &&
           (wires->lengths.empty() ? !wires->positions.empty()
                                   : wires->lengths.size() == wires->edges.size());
  }
  const auto& cloud = std::get<CloudShape>(state.data);
  const Neighbours& near = cloud.neighbours;
  if (n == 0 || near.begin.size() != n + 1 || cloud.points.positions.size() != n ||
      (!cloud.points.original.empty() && cloud.points.original.size() != n) || lengths != nullptr)
    return false;
  try {
    check(near);
  } catch (const InputError&) {
    return false;
  }
  return are_points(cloud.points.positions, n) && are_points(cloud.points.normals, n) &&
         are_points(cloud.smoothed, n) && cloud.max_normal_angle.value_or(1) > 0 &&
         cloud.max_normal_angle.value_or(1) <= 180;
}

}  // namespace

bool KeptBuild::answers(const BuildOptions& options) const {
  return options.lengths == nullptr && options.mask == nullptr && options.precision == precision &&
         (!is_surface || options.triangulation == triangulation);
}

bool is_kept_build(const std::filesystem::path& file) {
  return io::lower_extension(file.string()) == ".plexway";
}

void write_kept_shape(KeptOut& out, const AnyShape& shape, const BuildOptions& options) {
  support_of_keeping(shape.kind(), options.lengths != nullptr, options.mask != nullptr).require();
  const AnyShape::State& state = shape.state();
  DomainKind kind = shape.kind();
  Precision precision = options.precision;
  Triangulation triangulation = options.triangulation;
  each_choice(out, kind);
  each_choice(out, precision);
  each_choice(out, triangulation);
  out(state.vertices, state.level_set_note, state.voxel);
  with_kept_kind(state.data, kind, [&](const auto& data) { each_of_data(out, data); });
  bool measured = state.lengths.has_value();
  out(measured);
  if (measured) each_of_lengths(out, *state.lengths);
}

AnyShape::State read_kept_build(KeptIn in) {
  AnyShape::State state;
  DomainKind kind{};
  Precision precision{};
  Triangulation triangulation{};
  each_choice(in, kind);
  each_choice(in, precision);
  each_choice(in, triangulation);
  in.require(precision == Precision::single || precision == Precision::twice);
  in.require(triangulation == Triangulation::input || triangulation == Triangulation::delaunay ||
             triangulation == Triangulation::refined || triangulation == Triangulation::automatic);
  in(state.vertices, state.level_set_note, state.voxel);
  in.require(state.vertices < none && state.voxel >= 0 && std::isfinite(state.voxel));
  state.data = empty_of(kind, in);
  with_kept_kind(state.data, kind, [&](auto& data) { each_of_data(in, data); });
  bool measured = false;
  in(measured);
  if (measured) each_of_lengths(in, state.lengths.emplace());
  in.require(is_sound(state));
  state.kept = std::make_shared<const KeptBuild>(
      KeptBuild{precision, triangulation, kind == DomainKind::surface, std::move(in)});
  return state;
}

AnyShape::State read_kept_build(const std::filesystem::path& file) {
  const Stopwatch loading;
  AnyShape::State state = read_kept_build(KeptIn(file));
  state.file = file;
  state.load_seconds = loading.seconds();
  return state;
}

AnyShape read_kept_for(const std::filesystem::path& file, const std::filesystem::path& name) {
  AnyShape::State state = read_kept_build(file);
  state.file = name;
  return AnyShape::of(std::move(state));
}

}  // namespace plexway
