#include "shape/kept_build.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "io/extension.hpp"
#include "shape/shape_state.hpp"

namespace plexway {
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

}  // namespace plexway
