#include "cli/report/source_marks.hpp"

#include <utility>
#include <variant>

namespace plexway::cli {
namespace {

constexpr std::size_t most_dots = 200;

class Marker {
 public:
  Marker(const Domain& domain, PictureContent& content) : domain_(domain), content_(content) {}

  void operator()(const PointSource& point) { content_.sources.push_back(domain_.position(point)); }
  void operator()(const VertexSource& set) {
    if (set.vertices.size() > most_dots) return;
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
  const Domain& domain_;
  PictureContent& content_;
};

}  // namespace

void add_source_mark(const Domain& domain, const Source& source, PictureContent& content) {
  if (domain.positions().empty()) return;
  std::visit(Marker(domain, content), source);
}

}  // namespace plexway::cli
