#include <cmath>
#include <set>
#include <utility>
#include <variant>

#include "any/shape_state.hpp"

namespace plexway {
namespace {

// May triangles measure an edge that they share in two ways?
bool keeps_sides(const metric::Metric& metric) {
  if (const auto* tensors = std::get_if<metric::SimplexTensors>(&metric))
    return tensors->agreement.sides == metric::Sides::own;
  if (const auto* speeds = std::get_if<metric::SimplexSpeeds>(&metric))
    return speeds->agreement.sides == metric::Sides::own;
  return false;
}

// A wireframe that has lengths and no positions: what is left is to go through them slower.
std::vector<double> measure_lengths(const io::Edges& wireframe, const metric::Metric& metric) {
  if (std::holds_alternative<metric::GivenLengths>(metric)) {
    const std::vector<metric::Point> anywhere(wireframe.vertices);
    return metric::edge_lengths(anywhere, wireframe.edges, metric);
  }
  const auto* speeds = std::get_if<metric::SimplexSpeeds>(&metric);
  if (speeds == nullptr)
    throw UsageError("tensors measure directions, and this wireframe has no positions");
  std::vector<double> lengths = wireframe.lengths;
  if (speeds->speed.size() != lengths.size())
    throw InputError(std::to_string(speeds->speed.size()) + " speeds for " +
                     std::to_string(lengths.size()) + " edges");
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    if (!(speeds->speed[e] > 0))
      throw InputError("edge " + std::to_string(e) + ": a speed must be above 0");
    lengths[e] /= speeds->speed[e];
  }
  return lengths;
}

// Each speed makes pieces of its own.
std::vector<double> speeds_of(const AnyShape& shape, const metric::Metric& metric) {
  constexpr std::size_t most = 64;
  const auto* speeds = std::get_if<metric::SimplexSpeeds>(&metric);
  if (speeds == nullptr) throw UsageError("a mixed domain is measured by speeds only");
  if (speeds->speed.size() != shape.simplices())
    throw InputError(std::to_string(speeds->speed.size()) + " speeds for " +
                     std::to_string(shape.simplices()) + " simplices");
  std::set<double> different;
  for (std::size_t s = 0; s < speeds->speed.size(); ++s) {
    if (!(speeds->speed[s] > 0) || std::isinf(speeds->speed[s]))
      throw InputError("simplex " + std::to_string(s) + ": a speed must be above 0");
    different.insert(speeds->speed[s]);
    if (different.size() > most)
      throw UsageError("a mixed domain takes at most " + std::to_string(most) +
                       " different speeds, a region each");
  }
  return speeds->speed;
}

}  // namespace

MeasuredLengths AnyShape::measure(const metric::Metric& metric) const {
  MeasuredLengths lengths;
  if ((kind() == DomainKind::surface || kind() == DomainKind::solid) && positions().empty())
    throw UsageError(
        "a metric is measured between positions, and there are lengths alone: measure "
        "them by it before");
  if (const auto* surface = std::get_if<io::Triangles>(&data())) {
    lengths.refracts = keeps_sides(metric);
    lengths.triangles = metric::triangle_lengths(surface->positions, surface->triangles, metric);
    lengths.violations =
        metric::find_violations(std::span<const std::array<double, 3>>(lengths.triangles));
  } else if (const auto* solid = std::get_if<io::Tets>(&data())) {
    lengths.tets = metric::tet_lengths(solid->positions, solid->tets, metric);
    lengths.violations =
        metric::find_violations(std::span<const std::array<double, 6>>(lengths.tets));
  } else if (const auto* wireframe = std::get_if<io::Edges>(&data())) {
    lengths.edges = wireframe->lengths.empty()
                        ? metric::edge_lengths(wireframe->positions, wireframe->edges, metric)
                        : measure_lengths(*wireframe, metric);
  } else if (kind() == DomainKind::mixed) {
    lengths.speeds = speeds_of(*this, metric);
  } else {
    throw UsageError("surfaces, solids, wireframes and mixed domains are measured, not a " +
                     std::string(kind_noun(kind())));
  }
  return lengths;
}

}  // namespace plexway
