#include <plexway/shape/scene.hpp>

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/surface/normals.hpp>

#include "shape/arguments/require.hpp"
#include "shape/simplex_edges.hpp"
#include "shape/warnings/cloud_slopes.hpp"
#include "shape/warnings/survey.hpp"

namespace plexway {
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
  std::visit(
      [&](const auto& data) {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          part.triangles = data.triangles;
          if (content.fine != nullptr && content.label.empty()) {
            part.positions = content.fine->positions;
            part.triangles = content.fine->faces;
            part.value = content.fine->distance;
          }
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          part.tets = data.tets;
          part.ghost = content.look_inside;
        } else if constexpr (std::is_same_v<Kind, io::Edges>) {
          part.edges = data.edges;
        } else if constexpr (std::is_same_v<Kind, CloudShape>) {
          normals_ = data.points.normals.empty()
                         ? estimate_normals(data.measured(), data.neighbours)
                         : data.points.normals;
          part.normals = normals_;
          if (!content.distance.empty() && content.label.empty()) {
            slopes_ = cloud_slopes(data.measured(), normals_, data.neighbours, content.distance);
            part.slope = slopes_;
          }
        } else if constexpr (std::is_same_v<Kind, MixedShape>) {
          for (const MixedShape::Part& of : data.parts) {
            part.edges = of.edges;
            part.triangles = of.triangles;
            part.tets = of.tets;
            part.ghost = content.look_inside;
            scene_.parts.push_back(part);
          }
        } else {
          support(Purpose::pictures, shape.kind()).require();
        }
      },
      shape.data());
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

}  // namespace plexway
