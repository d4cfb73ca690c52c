#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "io/names.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/shape_state.hpp"

namespace plexway::detail {
namespace {

template <class Archive, class Value>
void each_if_any(Archive& archive, Value& value) {
  bool any = value.has_value();
  archive(any);
  if constexpr (Archive::reads)
    if (any) value.emplace();
  if (any) archive(*value);
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

// Rows of finite numbers, one a vertex or none at all.
bool is_cloud_block(std::span<const std::array<double, 3>> rows, std::size_t vertices) {
  if (!rows.empty() && rows.size() != vertices) return false;
  bool finite = true;
  for (const auto& [x, y, z] : rows)
    finite &= std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  return finite;
}

bool are_simplices(const io::Cells& cells, std::size_t vertices) {
  Index largest = 0;
  for (const Index v : cells.connectivity) largest = std::max(largest, v);
  return cells.count() > 0 && largest < vertices;
}

template <class Rows>
bool are_lengths(const Rows& rows, std::size_t simplices) {
  bool sound = true;
  for (const auto& row : rows)
    for (const double length : row) sound &= length >= 0 && std::isfinite(length);
  return sound && rows.size() == simplices;
}

bool is_sound_cloud(const CloudShape& cloud, std::size_t n) {
  const Neighbours& near = cloud.neighbours;
  if (n == 0 || near.begin.size() != n + 1 || cloud.points.positions.size() != n ||
      (!cloud.points.original.empty() && cloud.points.original.size() != n))
    return false;
  try {
    check(near);
  } catch (const InputError&) {
    return false;
  }
  return is_cloud_block(cloud.points.positions, n) && is_cloud_block(cloud.points.normals, n) &&
         is_cloud_block(cloud.smoothed, n) && cloud.max_normal_angle.value_or(1) > 0 &&
         cloud.max_normal_angle.value_or(1) <= 180;
}

}  // namespace

void KeptShape::each(auto& archive, auto& data) {
  if constexpr (requires { data.triangles; }) {
    archive(data.positions, data.triangles);
  } else if constexpr (requires { data.tets; }) {
    archive(data.positions, data.tets);
  } else if constexpr (requires { data.edges; }) {
    archive(data.positions, data.edges, data.lengths, data.vertices);
  } else {
    archive(data.points.positions, data.points.normals, data.points.original, data.smoothed,
            data.neighbours.begin, data.neighbours.of, data.k);
    each_if_any(archive, data.max_normal_angle);
    archive(data.points_in_file, data.not_finite, data.outliers, data.thinned, data.normals_agree);
  }
}

AnyShape::Data KeptShape::empty(DomainKind kind, const KeptIn& in) {
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

KeptShape::KeptShape(KeptIn& in, DomainKind kind)
    : kind_(kind), start_(in), data_(empty(kind, in)) {
  const auto lend = [&](auto&& lent) {
    each(in, lent);
    lent_ = std::move(lent);
  };
  if (kind == DomainKind::surface)
    lend(Triangles{});
  else if (kind == DomainKind::solid)
    lend(Tets{});
  else if (kind == DomainKind::wireframe)
    lend(Edges{});
  else
    each(in, std::get<CloudShape>(data_));
}

bool KeptShape::is_sound(std::size_t n, const MeasuredLengths* lengths) const {
  if (kind_ == DomainKind::cloud)
    return lengths == nullptr && is_sound_cloud(std::get<CloudShape>(data_), n);
  const io::Cells all = cells().front();
  if (!are_simplices(all, n) || !is_cloud_block(positions(), n)) return false;
  if (const auto* wires = std::get_if<Edges>(&lent_)) {
    bool sound = lengths == nullptr && wires->vertices == n;
    for (const double length : wires->lengths) sound &= length >= 0 && std::isfinite(length);
    return sound &&
           (wires->lengths.empty() ? !positions().empty() : wires->lengths.size() == all.count());
  }
  if (lengths == nullptr) return !positions().empty();
  return kind_ == DomainKind::surface ? are_lengths(lengths->triangles, all.count())
                                      : are_lengths(lengths->tets, all.count());
}

std::span<const std::array<double, 3>> KeptShape::positions() const {
  return std::visit(
      [&](const auto& lent) -> std::span<const std::array<double, 3>> {
        if constexpr (requires { lent.positions; })
          return lent.positions;
        else
          return std::get<CloudShape>(data_).points.positions;
      },
      lent_);
}

std::vector<io::Cells> KeptShape::cells() const {
  std::vector<io::Cells> found;
  each_list(lent_, [&](const auto& list) { found.push_back(io::cells_of(list)); });
  return found;
}

const AnyShape::Data& KeptShape::data() const {
  if (kind_ != DomainKind::cloud)
    std::call_once(once_, [&] {
      KeptIn in = start_;
      with_kept_kind(data_, kind_, [&](auto& data) { each(in, data); });
    });
  return data_;
}

void KeptShape::write(KeptOut& out, const AnyShape& shape) {
  with_kept_kind(shape.data(), shape.kind(), [&](const auto& data) { each(out, data); });
}

namespace {

// Bytes, whatever an enumeration is made of.
template <class Archive, class Enum>
void each_choice(Archive& archive, Enum& choice) {
  auto number = static_cast<std::uint32_t>(choice);
  archive(number);
  choice = static_cast<Enum>(number);
}

template <class Archive, class Lengths>
void each_of_lengths(Archive& archive, Lengths& lengths) {
  archive(lengths.triangles, lengths.tets, lengths.edges, lengths.speeds, lengths.refracts,
          lengths.violations.count, lengths.violations.first);
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
  KeptShape::write(out, shape);
  bool measured = state.lengths.has_value();
  out(measured);
  if (measured) each_of_lengths(out, *state.lengths);
  out(state.merged, state.merge_tolerance);
}

AnyShape::State read_kept_build(KeptIn in) {
  AnyShape::State state;
  DomainKind kind{};
  Precision precision{};
  Triangulation triangulation{};
  each_choice(in, kind);
  each_choice(in, precision);
  each_choice(in, triangulation);
  in.require(precision == Precision::float32 || precision == Precision::float64);
  in.require(triangulation == Triangulation::input || triangulation == Triangulation::delaunay ||
             triangulation == Triangulation::refined || triangulation == Triangulation::automatic);
  in(state.vertices, state.level_set_note, state.voxel);
  in.require(state.vertices < none && state.voxel >= 0 && std::isfinite(state.voxel));
  state.data = KeptShape::empty(kind, in);
  auto shape = std::make_unique<const KeptShape>(in, kind);
  bool measured = false;
  in(measured);
  if (measured) each_of_lengths(in, state.lengths.emplace());
  in(state.merged, state.merge_tolerance);
  in.require(state.merged.empty() || state.merged.size() == state.vertices);
  for (Index v = 0; v < state.merged.size(); ++v)
    in.require(state.merged[v] <= v && state.merged[state.merged[v]] == state.merged[v]);
  in.require(state.merge_tolerance >= 0 && std::isfinite(state.merge_tolerance));
  in.require(shape->is_sound(state.vertices, state.lengths ? &*state.lengths : nullptr));
  state.kept = std::make_shared<const KeptBuild>(KeptBuild{
      precision, triangulation, kind == DomainKind::surface, std::move(shape), std::move(in)});
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

}  // namespace plexway::detail
