#include "shape/shape_page.hpp"

#include <variant>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "shape/arguments/require.hpp"
#include "shape/solid_boundary.hpp"

namespace plexway {

void fill_page(io::Page& page, const AnyShape& shape, const SceneContent& content) {
  page.positions = shape.positions();
  require(shape.file().empty() ? "the domain" : shape.file().string(),
          support(Purpose::pictures, shape));
  page.value = content.distance;
  page.label = content.label;
  if (const auto* surface = std::get_if<io::Triangles>(&shape.data())) {
    page.triangles = surface->triangles;
  } else if (const auto* solid = std::get_if<io::Tets>(&shape.data())) {
    page.triangles = boundary_faces(solid->positions, solid->tets);
  } else if (const auto* wires = std::get_if<io::Edges>(&shape.data())) {
    page.edges = wires->edges;
  } else if (const auto* mixed = std::get_if<MixedShape>(&shape.data())) {
    for (const MixedShape::Part& part : mixed->parts) {
      page.edges.insert(page.edges.end(), part.edges.begin(), part.edges.end());
      page.triangles.insert(page.triangles.end(), part.triangles.begin(), part.triangles.end());
      const auto skin = boundary_faces(mixed->positions, part.tets);
      page.triangles.insert(page.triangles.end(), skin.begin(), skin.end());
    }
  }
  // Inside a solid there is something to see: of its skin the edges are left.
  if (content.look_inside && std::holds_alternative<io::Tets>(shape.data())) {
    for (const auto& [a, b, c] : page.triangles)
      page.edges.insert(page.edges.end(), {{a, b}, {b, c}, {c, a}});
    page.triangles.clear();
  }
  page.sources = content.sources;
  page.targets = content.targets;
  page.dots = content.dots;
  page.paths = content.paths;
}

}  // namespace plexway
