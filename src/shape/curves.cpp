#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include <plexway/paths/path_field.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solve.hpp>

#include "shape/boundary.hpp"
#include "shape/shape_state.hpp"

namespace plexway {
namespace {

template <class Complex, class Positions>
std::vector<PointSource> join(const Complex& complex, const Positions& positions,
                              std::span<const PointSource> points) {
  PathField field(complex, positions);
  std::vector<PointSource> curve = {points[0]};
  for (std::size_t n = 1; n < points.size(); ++n) {
    // Traced back to its source, so it starts with the point before.
    field.solve(Serial{}, points[n]);
    const Path path = field.trace(points[n - 1]);
    if (path.points.empty())
      throw InputError("there is no path from point " + std::to_string(n - 1) + " to the next");
    for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
      const PathPoint& at = path.points[i];
      curve.push_back({.simplex = at.simplex, .barycentric = at.barycentric});
    }
    curve.push_back(points[n]);
  }
  return curve;
}

// Boundary edges as lines, each as long as it goes on.
std::vector<PointSource> rim_lines(const io::Triangles& surface) {
  std::map<std::pair<Index, Index>, int> count;
  for (const auto& f : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++count[std::minmax(f[i], f[(i + 1) % 3])];
  std::multimap<Index, Index> next;
  for (const auto& f : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (count[std::minmax(f[i], f[(i + 1) % 3])] == 1) next.emplace(f[i], f[(i + 1) % 3]);
  std::vector<PointSource> lines;
  while (!next.empty()) {
    if (!lines.empty()) lines.emplace_back();
    lines.push_back(PointSource::at(next.begin()->first));
    for (auto at = next.begin(); at != next.end(); at = next.find(lines.back().vertex)) {
      lines.push_back(PointSource::at(at->second));
      next.erase(at);
    }
  }
  return lines;
}

}  // namespace

CurveSource AnyShape::joined(std::span<const PointSource> points) const {
  support(Purpose::lines, *this).require();
  if (points.empty()) throw UsageError("a line needs at least one point");
  return with_file_name(*this, [&]() -> CurveSource {
    if (const auto* surface = std::get_if<io::Triangles>(&data())) {
      const TriangleMesh<double> mesh(surface->positions, surface->triangles);
      return {.points = join(mesh, surface->positions, points)};
    }
    const auto& wires = std::get<io::Edges>(data());
    const Wireframe<double> wireframe(wires.positions, wires.edges);
    return {.points = join(wireframe, wires.positions, points)};
  });
}

Source AnyShape::boundary(double offset) const {
  support(Purpose::boundaries, kind()).require();
  const auto nothing = [&]() -> InputError {
    return InputError("source boundary: the " + std::string(kind_noun(kind())) + " has none");
  };
  if (const auto* surface = std::get_if<io::Triangles>(&data())) {
    CurveSource curve{.points = rim_lines(*surface), .offset = offset};
    if (curve.points.empty()) throw nothing();
    return curve;
  }
  VertexSource source;
  if (kind() == DomainKind::solid && lengths() == nullptr)
    source = walls_of(std::get<io::Tets>(data()));
  else
    source.vertices = rim_vertices(state_->cells.front());
  source.offset = offset;
  if (source.vertices.empty()) throw nothing();
  return source;
}

}  // namespace plexway
