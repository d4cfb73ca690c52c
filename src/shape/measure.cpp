#include <cmath>
#include <set>
#include <variant>

#include <plexway/shape/support.hpp>

#include "shape/shape_state.hpp"

namespace plexway {
using namespace detail;
namespace {

// Calls use(sides) where simplices may measure an edge that they share in two ways.
void with_sides(auto& metric, const auto& use) {
  std::visit(
      [&](auto& of) {
        if constexpr (requires { of.agreement; })
          if (of.agreement.sides == metric::Sides::own) use(of.agreement.sides);
      },
      metric);
}

bool keeps_sides(const metric::Metric& metric) {
  bool keeps = false;
  with_sides(metric, [&](metric::Sides) { keeps = true; });
  return keeps;
}

// With one length an edge, the mean of its simplices.
metric::Metric smoothed(metric::Metric metric) {
  with_sides(metric, [](metric::Sides& sides) { sides = metric::Sides::mean; });
  return metric;
}

// A wireframe that has lengths and no positions: what is left is to go through them slower.
std::vector<double> measure_lengths(const io::Edges& wireframe, const metric::Metric& metric) {
  if (std::holds_alternative<metric::GivenLengths>(metric)) {
    const std::vector<metric::Point> anywhere(wireframe.vertices);
    return metric::edge_lengths(anywhere, wireframe.edges, metric);
  }
  const auto& speed = std::get<metric::SimplexSpeeds>(metric).speed;
  std::vector<double> lengths = wireframe.lengths;
  if (speed.size() != lengths.size())
    throw InputError(std::to_string(speed.size()) + " speeds for " +
                     std::to_string(lengths.size()) + " edges");
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    if (!(speed[e] > 0))
      throw InputError("edge " + std::to_string(e) + ": a speed must be above 0");
    lengths[e] /= speed[e];
  }
  return lengths;
}

// A speed makes pieces of its own, and each costs memory of its own.
constexpr std::size_t most_speeds = 64;

// How many different ones, as far as most_speeds + 1.
std::size_t count_speeds(const metric::SimplexSpeeds& speeds, std::size_t simplices) {
  if (speeds.speed.size() != simplices)
    throw InputError(std::to_string(speeds.speed.size()) + " speeds for " +
                     std::to_string(simplices) + " simplices");
  std::set<double> different;
  for (std::size_t s = 0; s < simplices; ++s) {
    if (!(speeds.speed[s] > 0) || std::isinf(speeds.speed[s]))
      throw InputError("simplex " + std::to_string(s) + ": a speed must be above 0");
    if (different.size() <= most_speeds) different.insert(speeds.speed[s]);
  }
  return different.size();
}

std::vector<double> speeds_of(const AnyShape& shape, const metric::Metric& metric) {
  const auto& speeds = std::get<metric::SimplexSpeeds>(metric);
  if (count_speeds(speeds, shape.simplices()) > most_speeds)
    throw UsageError("a mixed domain takes at most " + std::to_string(most_speeds) +
                     " different speeds, a region each");
  return speeds.speed;
}

// Is a solid to be a mixed domain of regions of one speed each, at whose faces paths are refracted?
bool has_regions(const io::Tets& solid, const metric::Metric& metric) {
  const auto* speeds = std::get_if<metric::SimplexSpeeds>(&metric);
  return speeds != nullptr && keeps_sides(metric) &&
         count_speeds(*speeds, solid.tets.size()) <= most_speeds;
}

}  // namespace

MeasuredLengths AnyShape::measure(const metric::Metric& metric) const {
  const bool speeds = std::holds_alternative<metric::SimplexSpeeds>(metric);
  const bool given = std::holds_alternative<metric::GivenLengths>(metric);
  support(speeds  ? Purpose::metrics
          : given ? Purpose::given_lengths
                  : Purpose::tensors,
          *this)
      .require();
  MeasuredLengths lengths;
  if (const auto* surface = std::get_if<io::Triangles>(&data())) {
    lengths.refracts = keeps_sides(metric);
    lengths.triangles = metric::triangle_lengths(surface->positions, surface->triangles, metric);
  } else if (const auto* solid = std::get_if<io::Tets>(&data())) {
    lengths.refracts = has_regions(*solid, metric);
    if (lengths.refracts) {
      lengths.speeds = std::get<metric::SimplexSpeeds>(metric).speed;
    } else {
      lengths.smoothed = keeps_sides(metric);
      lengths.tets = metric::tet_lengths(solid->positions, solid->tets, smoothed(metric));
    }
  } else if (const auto* wireframe = std::get_if<io::Edges>(&data())) {
    lengths.edges = wireframe->lengths.empty()
                        ? metric::edge_lengths(wireframe->positions, wireframe->edges, metric)
                        : measure_lengths(*wireframe, metric);
  } else {
    lengths.speeds = speeds_of(*this, metric);
  }
  lengths.violations = violations_in(lengths);
  return lengths;
}

}  // namespace plexway
