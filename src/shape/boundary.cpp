#include "shape/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/box_tree.hpp"
#include "complexes/common/geometry.hpp"
#include "complexes/solid/shared_faces.hpp"
#include "shape/shape_state.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

using Point = Point3;
using Row = std::array<std::uint32_t, 3>;

bool inside_out(std::span<const Point> positions, const std::array<std::uint32_t, 4>& tet) {
  const auto edge = [&](std::size_t i) { return minus(positions[tet[i]], positions[tet[0]]); };
  return dot(edge(1), cross(edge(2), edge(3))) < 0;
}

}  // namespace

std::vector<Row> boundary_faces(std::span<const Point> positions,
                                std::span<const std::array<std::uint32_t, 4>> tets) {
  return outer_faces(
      tets.size(), [&](std::size_t t, std::size_t i) { return tets[t][i]; },
      [&](std::size_t t) { return inside_out(positions, tets[t]); });
}

io::Triangles boundary_of(const io::Tets& solid) {
  io::Triangles surface;
  surface.triangles = boundary_faces(solid.positions, solid.tets);
  std::vector<char> used(solid.positions.size(), 0);
  for (const Row& face : surface.triangles)
    for (const std::uint32_t v : face) used[v] = 1;
  std::vector<std::uint32_t> number(solid.positions.size());
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.push_back(solid.positions[v]);
  }
  for (Row& t : surface.triangles)
    for (std::uint32_t& v : t) v = number[v];
  return surface;
}

namespace {

// Squared, 0 inside.
double squared_distance(const Box<3>& box, const Point& point) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::max({box.low[k] - point[k], point[k] - box.high[k], 0.});
    sum += off * off;
  }
  return sum;
}

// The boundary's triangles in a unit in which squares neither overflow nor underflow.
class Walls {
 public:
  explicit Walls(const io::Tets& solid) : boundary_(boundary_of(solid)) {
    Box<3> all = Box<3>::empty();
    for (const Point& p : boundary_.positions) all.add(p);
    for (std::size_t k = 0; k < 3; ++k) {
      centre_[k] = all.low[k] / 2 + all.high[k] / 2;
      unit_ = std::max(unit_, all.high[k] / 2 - all.low[k] / 2);
    }
    if (unit_ == 0) unit_ = 1;
    for (Point& p : boundary_.positions) p = placed(p);
    std::vector<Box<3>> boxes;
    boxes.reserve(boundary_.triangles.size());
    for (const auto& triangle : boundary_.triangles) {
      boxes.push_back(Box<3>::empty());
      for (const Index v : triangle) boxes.back().add(boundary_.positions[v]);
    }
    tree_ = BoxTree<3>(boxes);
  }

  [[nodiscard]] bool empty() const { return boundary_.triangles.empty(); }

  // Neighbours in the list mostly have the same nearest triangle: it is looked at first.
  [[nodiscard]] double distance(const Point& from) {
    const Point point = placed(from);
    double best = squared_to(nearest_, point);
    tree_.search([&](const Box<3>& box) { return squared_distance(box, point) < best; },
                 [&](Index triangle) {
                   const double found = squared_to(triangle, point);
                   if (!(found < best)) return;
                   best = found;
                   nearest_ = triangle;
                 });
    return std::sqrt(best) * unit_;
  }

 private:
  [[nodiscard]] Point placed(const Point& p) const {
    Point at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = (p[k] - centre_[k]) / unit_;
    return at;
  }
  [[nodiscard]] double squared_to(Index triangle, const Point& point) const {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = minus(boundary_.positions[boundary_.triangles[triangle][i]], point);
    return detail::squared_distance(corners);
  }

  io::Triangles boundary_;
  Point centre_{};
  double unit_ = 0;
  BoxTree<3> tree_;
  Index nearest_ = 0;
};

// Which vertices the boundary has, and which the solid.
std::vector<char> kinds_of(const io::Tets& solid) {
  std::vector<char> used(solid.positions.size(), 0);
  for (const auto& tet : solid.tets)
    for (const Index v : tet) used[v] = 1;
  for (const Index v : rim_vertices(io::cells_of(solid.tets))) used[v] = 2;
  return used;
}

}  // namespace

std::vector<Index> rim_vertices(const io::Cells& cells) {
  std::vector<std::array<Index, 3>> faces;  // of fewer corners: filled up
  faces.reserve(cells.connectivity.size());
  for (std::size_t first = 0; first < cells.connectivity.size(); first += cells.corners)
    for (std::size_t skip = 0; skip < cells.corners; ++skip) {
      std::array<Index, 3> face = {none, none, none};
      for (std::size_t i = 0, k = 0; i < cells.corners; ++i)
        if (i != skip) face[k++] = cells.connectivity[first + i];
      std::sort(face.begin(), face.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  std::vector<Index> rim;
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end] == faces[f]) ++end;
    if (end == f + 1)
      std::copy_if(faces[f].begin(), faces[f].end(), std::back_inserter(rim),
                   [](Index v) { return v != none; });
    f = end;
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

VertexSource walls_of(const io::Tets& solid) {
  VertexSource source;
  Walls walls(solid);
  if (walls.empty()) return source;
  const std::vector<char> kind = kinds_of(solid);
  for (Index v = 0; v < kind.size(); ++v) {
    if (kind[v] == 0) continue;
    source.vertices.push_back(v);
    source.offsets.push_back(kind[v] == 2 ? 0 : walls.distance(solid.positions[v]));
  }
  return source;
}

VertexSource rim_of(const VertexSource& walls) {
  VertexSource rim{.vertices = {}, .offset = walls.offset};
  for (std::size_t i = 0; i < walls.vertices.size(); ++i)
    if (walls.offsets.empty() || walls.offsets[i] == 0) rim.vertices.push_back(walls.vertices[i]);
  return rim;
}

}  // namespace detail

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

namespace detail {

namespace {

void add_edges(std::span<const std::uint32_t> corners,
               std::vector<std::array<std::uint32_t, 2>>& edges) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if (corners[i] != corners[j])
        edges.push_back({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])});
}

void sort_out(std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

// With any number of coordinates, or lengths of their own; where two simplices differ, the lesser.
io::Edges edges_of_simplices(const SimplexShape& shape) {
  const auto corners = static_cast<std::size_t>(shape.dimension) + 1;
  std::map<std::array<std::uint32_t, 2>, double> length;
  for (std::size_t s = 0, next = 0; s < shape.corners.size() / corners; ++s)
    for (std::size_t j = 1; j < corners; ++j)
      for (std::size_t i = 0; i < j; ++i, ++next) {
        const std::uint32_t a = shape.corners[s * corners + i], b = shape.corners[s * corners + j];
        double squared = 0;
        for (std::size_t k = 0; k < shape.axes; ++k) {
          const double d =
              shape.positions[a * shape.axes + k] - shape.positions[b * shape.axes + k];
          squared += d * d;
        }
        const double given = shape.axes > 0 ? std::sqrt(squared) : shape.lengths[next];
        const auto [known, is_new] = length.try_emplace({std::min(a, b), std::max(a, b)}, given);
        if (!is_new) known->second = std::min(known->second, given);
      }
  io::Edges made;
  made.vertices = shape.vertices;
  for (const auto& [ends, of] : length) {
    made.edges.push_back(ends);
    made.lengths.push_back(of);
  }
  return made;
}

io::Edges edges_of_cloud(const CloudShape& cloud) {
  io::Edges made;
  made.positions = cloud.measured();
  made.vertices = made.positions.size();
  for (Index i = 0; i < cloud.neighbours.point_count(); ++i)
    for (const Index j : cloud.neighbours.around(i))
      made.edges.push_back({std::min(i, j), std::max(i, j)});
  sort_out(made.edges);
  return made;
}

}  // namespace

io::Edges edges_of(const AnyShape& shape) {
  if (shape.cloud() != nullptr) return edges_of_cloud(*shape.cloud());
  if (const auto* wireframe = std::get_if<io::Edges>(&shape.data())) return *wireframe;
  if (const auto* simplices = std::get_if<SimplexShape>(&shape.data()))
    return edges_of_simplices(*simplices);
  io::Edges made;
  made.positions.assign(shape.positions().begin(), shape.positions().end());
  made.vertices = shape.vertices();
  for (std::size_t s = 0; s < shape.simplices(); ++s) add_edges(shape.corners(s), made.edges);
  sort_out(made.edges);
  return made;
}

std::vector<double> lengths_of(const io::Edges& wireframe) {
  if (!wireframe.lengths.empty()) return wireframe.lengths;
  if (wireframe.positions.size() != wireframe.vertices)
    throw UsageError("the edges have neither lengths nor positions");
  std::vector<double> lengths;
  lengths.reserve(wireframe.edges.size());
  for (const auto& [from, to] : wireframe.edges) {
    const auto& a = wireframe.positions[from];
    const auto& b = wireframe.positions[to];
    lengths.push_back(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  return lengths;
}

}  // namespace detail

}  // namespace plexway
