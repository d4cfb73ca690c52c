#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/surface/normals.hpp>

#include "complexes/common/box_tree.hpp"
#include "complexes/common/geometry.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/boundary.hpp"
#include "shape/scene.hpp"
#include "shape/shape_state.hpp"
#include "shape/warnings/survey.hpp"

namespace plexway {
using namespace detail;

namespace {

constexpr std::size_t most_dots = 200;

class Marker {
 public:
  Marker(const AnyShape& domain, SceneContent& content) : domain_(domain), content_(content) {}

  void operator()(const PointSource& point) { content_.sources.push_back(domain_.position(point)); }
  void operator()(const VertexSource& set) {
    if (set.vertices.size() > most_dots || set.vertices.size() == domain_.vertices()) return;
    for (const Index v : set.vertices) content_.dots.push_back(domain_.positions()[v]);
  }
  void operator()(const BallSource&) {}
  void operator()(const CurveSource& curve) {
    std::vector<std::array<double, 3>> line;
    const auto finish = [&] {
      if (line.size() > 1) content_.paths.push_back(std::move(line));
      line.clear();
    };
    for (const PointSource& point : curve.points) {
      if (names_nothing(point))
        finish();
      else
        line.push_back(domain_.position(point));
    }
    finish();
  }
  void operator()(const SimplexSource& whole) {
    std::vector<std::array<double, 3>> rim;
    const auto corners = domain_.corners(whole.simplex);
    for (const Index v : corners) rim.push_back(domain_.positions()[v]);
    if (corners.size() > 2) rim.push_back(rim.front());
    content_.paths.push_back(std::move(rim));
  }

 private:
  const AnyShape& domain_;
  SceneContent& content_;
};

}  // namespace

void SceneContent::mark(const AnyShape& shape, const Source& source) {
  if (!shape.positions().empty()) std::visit(Marker(shape, *this), source);
}

ShapeScene::ShapeScene(const AnyShape& shape, const SceneContent& content) {
  render::Part part;
  part.positions = shape.positions();
  require(shape.file().empty() ? "the domain" : shape.file().string(),
          support(Purpose::pictures, shape));
  part.value = content.distance;
  part.label = content.label;
  if (const CloudShape* const cloud = shape.cloud()) {
    normals_ = cloud->points.normals.empty()
                   ? estimate_normals(cloud->measured(), cloud->neighbours)
                   : cloud->points.normals;
    part.normals = normals_;
    if (!content.distance.empty() && content.label.empty()) {
      slopes_ = cloud_slopes(cloud->measured(), normals_, cloud->neighbours, content.distance);
      part.slope = slopes_;
    }
  }
  // A part of a mixed domain has three lists.
  for (std::size_t i = 0; i < shape.state().cells.size(); ++i) {
    const io::Cells& cells = shape.state().cells[i];
    if (cells.corners == 2) part.edges = rows_of<2>(cells);
    if (cells.corners == 3) part.triangles = rows_of<3>(cells);
    if (cells.corners == 4) part.tets = rows_of<4>(cells), part.ghost = content.look_inside;
    if (shape.kind() == DomainKind::mixed && i % 3 == 2) scene_.parts.push_back(part);
  }
  if (shape.kind() == DomainKind::surface && content.fine != nullptr && content.label.empty()) {
    part.positions = content.fine->positions;
    part.triangles = content.fine->faces;
    part.value = content.fine->distance;
  }
  // What has no area shows nothing; its edges do.
  const bool filled = shape.kind() == DomainKind::surface || shape.kind() == DomainKind::solid;
  if (filled && lie_in_line(shape.positions())) {
    lines_ = edges_of(shape);
    part = {};
    part.positions = lines_.positions, part.edges = lines_.edges;
    part.value = content.distance, part.label = content.label;
    is_line_ = true;
  }
  if (scene_.parts.empty()) scene_.parts = {part};
  scene_.sources = content.sources;
  scene_.targets = content.targets;
  scene_.paths = content.paths;
  if (content.dots.empty()) return;
  render::Dots dots;
  dots.positions = content.dots;
  if (!content.label.empty()) dots.colour = {35, 40, 50};
  scene_.dots = {std::move(dots)};
}

namespace detail {

void fill_page(io::Page& page, const AnyShape& shape, const SceneContent& content) {
  page.positions = shape.positions();
  require(shape.file().empty() ? "the domain" : shape.file().string(),
          support(Purpose::pictures, shape));
  page.value = content.distance;
  page.label = content.label;
  for (const io::Cells& cells : shape.state().cells) {
    if (cells.corners == 2)
      for (const auto& edge : rows_of<2>(cells)) page.edges.push_back(edge);
    if (cells.corners == 3)
      for (const auto& triangle : rows_of<3>(cells)) page.triangles.push_back(triangle);
    if (cells.corners == 4)
      for (const auto& face : boundary_faces(shape.positions(), rows_of<4>(cells)))
        page.triangles.push_back(face);
  }
  // Inside a solid there is something to see: of its skin the edges are left.
  if (content.look_inside && shape.kind() == DomainKind::solid) {
    for (const auto& [a, b, c] : page.triangles)
      page.edges.insert(page.edges.end(), {{a, b}, {b, c}, {c, a}});
    page.triangles.clear();
  }
  page.sources = content.sources;
  page.targets = content.targets;
  page.dots = content.dots;
  page.paths = content.paths;
}

namespace {

// How widely a part is spread across axis k, as a share of the whole.
double spread(const Box<3>& part, const std::array<double, 3>& whole, std::size_t k) {
  const auto size = minus(part.high, part.low);
  const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
  return size[a] / whole[a] * (size[b] / whole[b]);
}

}  // namespace

char probable_up(const AnyShape& shape) {
  const auto positions = shape.positions();
  if (positions.empty()) return 'z';
  auto whole = Box<3>::empty();
  for (const auto& p : positions) whole.add(p);
  const std::array<double, 3> size = minus(whole.high, whole.low);
  const auto least =
      static_cast<std::size_t>(std::min_element(size.begin(), size.end()) - size.begin());
  const double next = std::min(size[(least + 1) % 3], size[(least + 2) % 3]);
  if (!(size[least] > 1e-3 * next)) return 'z';  // a sheet or a line is seen from where it shows
  constexpr double flat = 0.3, clear = 0.15, clearer = 0.1;
  if (size[least] < flat * next) return least == 1 ? 'y' : 'z';

  constexpr double slab = 0.02;  // of the extent
  std::array<Box<3>, 3> lower, upper;
  lower.fill(Box<3>::empty());
  upper.fill(Box<3>::empty());
  for (const auto& p : positions)
    for (std::size_t k = 0; k < 3; ++k) {
      if (p[k] <= whole.low[k] + slab * size[k]) lower[k].add(p);
      if (p[k] >= whole.high[k] - slab * size[k]) upper[k].add(p);
    }
  std::array<double, 3> foot{};
  for (std::size_t k = 0; k < 3; ++k)
    foot[k] = spread(lower[k], size, k) - spread(upper[k], size, k);
  const double others = std::max(std::abs(foot[0]), std::abs(foot[2]));
  return foot[1] > clear && foot[1] > others + clearer ? 'y' : 'z';
}

namespace {

// Least squares in the plane across the normal; at most twice as steep as the steepest way to a
// neighbour, for neighbours that all but lie in a line tell nothing about the way across it.
Point3 slope(Index i, std::span<const Point3> points, const Point3& normal,
             std::span<const Index> around, std::span<const double> value) {
  const Point3 x = some_perpendicular(normal), y = cross(normal, x);
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0, steepest = 0;
  for (const Index n : around) {
    const double rise = value[n] - value[i];
    if (!std::isfinite(rise)) continue;
    const Point3 to = minus(points[n], points[i]);
    const double a = dot(to, x), b = dot(to, y);
    xx += a * a, xy += a * b, yy += b * b;
    xv += a * rise, yv += b * rise;
    if (const double length = std::sqrt(dot(to, to)); length > 0)
      steepest = std::max(steepest, std::abs(rise) / length);
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * (xx + yy) * (xx + yy))) return {};
  double p = (yy * xv - xy * yv) / determinant, q = (xx * yv - xy * xv) / determinant;
  if (const double length = std::hypot(p, q); length > 2 * steepest)
    p *= 2 * steepest / length, q *= 2 * steepest / length;
  Point3 found;
  for (std::size_t k = 0; k < 3; ++k) found[k] = p * x[k] + q * y[k];
  return found;
}

}  // namespace

std::vector<std::array<double, 3>> cloud_slopes(std::span<const std::array<double, 3>> points,
                                                std::span<const std::array<double, 3>> normals,
                                                const Neighbours& neighbours,
                                                std::span<const double> value) {
  std::vector<std::array<double, 3>> found(points.size(), Point3{});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double length = std::sqrt(dot(normals[i], normals[i]));
    if (!(length > 0) || !std::isfinite(value[i])) continue;
    const auto point = static_cast<Index>(i);
    found[i] = slope(point, points, unit(normals[i]), neighbours.around(point), value);
  }
  return found;
}

}  // namespace detail

}  // namespace plexway
