// Sources that are not points, against closed forms: a segment, a circle and a triangle, by windows
// and by labels, in turns. Errors are relative to the distance, but where that is less than an
// edge, to the edge.

#include <algorithm>
#include <cmath>

#include <plexway/paths/path_field.hpp>

#include "data/shapes.hpp"
#include "solver.hpp"

namespace bench::curves {

using plexway::PointSource;
using samples::Point;
using samples::operator*;
using samples::operator+;
using samples::operator-;

// A surface that unrolls onto the plane: where its vertices are there, and after what x it is
// around.
struct Unrolled {
  std::string name;
  samples::Shape shape;
  std::vector<Point> flat;
  double edge, around;

  [[nodiscard]] Index nearest(double x, double y) const {
    Index best = 0;
    for (Index v = 0; v < flat.size(); ++v)
      if (std::hypot(flat[v][0] - x, flat[v][1] - y) <
          std::hypot(flat[best][0] - x, flat[best][1] - y))
        best = v;
    return best;
  }
};

Unrolled square(Index n) {
  Unrolled s{"square",
             samples::jittered_square(n, 1, 0.25, 5, [](Index, Index) { return false; }),
             {},
             1. / n,
             1e9};
  samples::add_square_faces(s.shape, n, [](Index, Index) { return true; });
  s.flat = s.shape.points;
  return s;
}

// A prism with n sides, as high as it is around; its vertices are moved along its edges.
Unrolled prism(Index n) {
  Unrolled s{"prism", {}, {}, 1. / n, 1};
  samples::Noise noise(6);
  const double radius = 0.5 / n / std::sin(samples::pi / n);
  for (Index i = 0; i <= n; ++i)
    for (Index k = 0; k < n; ++k) {
      const double turn = 2 * samples::pi * k / n;
      const double y = (i + (i > 0 && i < n ? 0.3 * noise() : 0)) / n;
      s.shape.add({radius * std::cos(turn), radius * std::sin(turn), y});
      s.flat.push_back({static_cast<double>(k) / n, y, 0});
    }
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < n; ++k) {
      const Index a = i * n + k, b = i * n + (k + 1) % n;
      samples::add_quad(s.shape, a, b, b + n, a + n);
    }
  return s;
}

struct Case {
  std::string name;
  plexway::Source source;
  std::function<double(const Point&)> exact;
};

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double t = std::clamp(samples::dot(p - a, ab) / samples::dot(ab, ab), 0., 1.);
  const Point off = p - a - t * ab;
  return std::sqrt(samples::dot(off, off));
}

Case segment(const Unrolled& s, const plexway::TriangleMesh<double>& mesh) {
  const Index from = s.nearest(0.22, 0.31), to = s.nearest(0.57, 0.42);
  plexway::PathField field(mesh, s.shape.points);
  field.solve(plexway::Serial{}, PointSource::at(from));
  const plexway::Path path = field.trace(to);
  Case one{"segment", {}, [&s, a = s.flat[from], b = s.flat[to]](const Point& p) {
             double d = 1e300;
             for (const double turn : {-s.around, 0., s.around})
               d = std::min(d, to_segment({p[0] + turn, p[1], 0}, a, b));
             return d;
           }};
  plexway::CurveSource curve;
  for (const auto& p : path.points)
    curve.points.push_back(PointSource::in(p.simplex, p.barycentric));
  curve.points.front() = PointSource::at(to);
  curve.points.back() = PointSource::at(from);
  one.source = curve;
  return one;
}

Case circle(const Unrolled& s) {
  const Index centre = s.nearest(0.5, 0.5);
  const double radius = 0.3;
  return {"circle", plexway::BallSource{.centre = PointSource::at(centre), .radius = radius},
          [c = s.flat[centre], radius](const Point& p) {
            return std::abs(std::hypot(p[0] - c[0], p[1] - c[1]) - radius);
          }};
}

Case triangle(const Unrolled& s) {
  const Index f = static_cast<Index>(s.shape.faces.size() / 2 + 9);
  return {"triangle", plexway::SimplexSource{.simplex = f}, [&s, f](const Point& p) {
            double d = 1e300, least = 1e300;
            for (std::size_t i = 0; i < 3; ++i) {
              const Point &a = s.flat[s.shape.faces[f][i]],
                          &b = s.flat[s.shape.faces[f][(i + 1) % 3]];
              d = std::min(d, to_segment(p, a, b));
              least = std::min(least, samples::cross(b - a, p - a)[2]);
            }
            return least > 0 ? 0 : d;
          }};
}

Row measure(const Unrolled& s, const plexway::TriangleMesh<double>& mesh, const Case& one,
            plexway::Accuracy accuracy, std::size_t turns) {
  plexway::PropagateOptions options;
  options.accuracy = accuracy;
  Solver whole(mesh), by_labels(mesh);
  std::vector<double> first, to_labels;
  for (std::size_t i = 0; i <= turns; ++i) {
    const double a = seconds([&] { whole.solve(one.source, options); });
    const double b = seconds([&] { by_labels.solve(one.source, one_label()); });
    if (i == 0) continue;
    first.push_back(1e9 * a / static_cast<double>(s.flat.size()));
    to_labels.push_back(a / b);
  }
  Row row = {{"surface", s.name}, {"vertices", s.flat.size()}, {"source", one.name}};
  const auto add = [&](const std::string& named, const std::vector<double>& found) {
    double mean = 0, most = 0;
    for (std::size_t v = 0; v < s.flat.size(); ++v) {
      const double d = one.exact(s.flat[v]);
      const double off = std::abs(found[v] - d) / std::max(d, s.edge);
      mean += off / static_cast<double>(s.flat.size());
      most = std::max(most, off);
    }
    row.update({{named + "mean", mean}, {named + "max", most}});
  };
  add("", whole.distance());
  add("labels_", by_labels.distance());
  return row.update({{"ns", median(first)}, {"to_labels", median(to_labels)}});
}

void run(Arguments& arguments) {
  std::vector<Index> cells = {60, 200, 600};
  std::size_t turns = 15;
  double accuracy = plexway::Accuracy::accurate().error();
  arguments.option("--cells", &cells, "Cells a side");
  arguments.option("--turns", &turns, "Solves of each");
  arguments.option("--accuracy", &accuracy, "Mean relative error to ask windows for; 0: exact");
  Table& table = arguments.table(
      "surface; vertices; source; mean: error mean %.1e; max %.1e; labels_mean: labels: mean %.1e;"
      "labels_max: max %.1e; ns: ns/V %.0f; to_labels: time / labels %.2f");
  for (const Index n : cells)
    for (const Unrolled& s : {square(n), prism(n)}) {
      const plexway::TriangleMesh<double> mesh(s.shape.points, s.shape.faces);
      const auto add = [&](const Case& one) {
        table.add(measure(s, mesh, one, plexway::Accuracy(accuracy), turns));
      };
      add(segment(s, mesh));
      if (s.name != "square") continue;
      add(circle(s));
      add(triangle(s));
    }
}
const Command command("curves", "curves, balls and triangles as sources, against closed forms",
                      run);

}  // namespace bench::curves
