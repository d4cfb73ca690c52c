// What metrics cost in accuracy, against closed forms: two speeds and Snell's law, by edges that
// refract and by one length an edge; a speed that rises evenly; a constant tensor.

#include <cmath>

#include <plexway/metric/edge_lengths.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "data/two_speeds.hpp"
#include "solver.hpp"

namespace bench::metrics {

namespace metric = plexway::metric;
using metric::Point;
using metric::Tensor;

struct Case {
  std::string law, sides;
  metric::Metric metric;
  bool refracts = false, delaunay = false;
  std::function<double(const Point&, const Point&)> exact;
};

template <class Real>
Row measure(const samples::HalvedSquare& square, const Case& one, double y) {
  const auto lengths = metric::triangle_lengths(square.points, square.faces, one.metric);
  plexway::SurfaceHints hints;
  hints.refracts = one.refracts;
  plexway::TriangleMesh<Real> mesh(square.points.size(), square.faces, lengths, hints);
  if (one.delaunay) {
    const plexway::TriangleMesh<double> input(square.points.size(), square.faces, lengths, hints);
    mesh = plexway::IntrinsicDelaunay(input).mesh<Real>();
  }
  const Index source = square.nearest(0.3, y);
  Solver solver(mesh, one_label());
  std::vector<double> ns, exact;
  for (int repeat = 0; repeat < 5; ++repeat)
    ns.push_back(1e9 * seconds([&] { solver(source); }) /
                 static_cast<double>(square.points.size()));
  for (const Point& p : square.points) exact.push_back(one.exact(square.points[source], p));
  Errors errors;
  errors.add({source, exact}, solver.distance());
  const std::span<const std::array<double, 3>> sides = lengths;
  Row row = {{"law", one.law},
             {"sides", one.sides},
             {"vertices", square.points.size()},
             {"y", y},
             {"violated", metric::find_violations(sides).count}};
  add_errors(row, errors);
  row["ns"] = median(ns);
  return row;
}

std::vector<Case> cases(const samples::HalvedSquare& square) {
  std::vector<Case> all;
  const auto named = [](metric::Sides sides) {
    return sides == metric::Sides::own ? "own" : sides == metric::Sides::mean ? "mean" : "least";
  };
  for (const double ratio : {1.2, 2.0, 5.0})
    for (const auto sides : {metric::Sides::own, metric::Sides::mean, metric::Sides::least}) {
      const samples::TwoSpeeds law{1, ratio};
      metric::SimplexSpeeds speeds;
      speeds.agreement.sides = sides;
      for (std::size_t f = 0; f < square.faces.size(); ++f)
        speeds.speed.push_back(square.is_above(f) ? law.above : law.below);
      all.push_back({"1 and " + std::to_string(ratio).substr(0, 3), named(sides), speeds,
                     sides == metric::Sides::own, false,
                     [law](const Point& a, const Point& b) { return law.time(a, b); }});
    }
  // v = 1 + y is a hyperbolic plane.
  const auto rising = [](const Point& a, const Point& b) {
    const double squared = std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2);
    return std::acosh(1 + squared / (2 * (1 + a[1]) * (1 + b[1])));
  };
  for (const auto sides : {metric::Sides::own, metric::Sides::mean, metric::Sides::least}) {
    metric::SimplexSpeeds speeds;
    speeds.agreement = {sides, 1e-6};
    for (const auto& f : square.faces)
      speeds.speed.push_back(
          1 + (square.points[f[0]][1] + square.points[f[1]][1] + square.points[f[2]][1]) / 3);
    all.push_back({"rising", named(sides), speeds, sides == metric::Sides::own, false, rising});
  }
  metric::VertexTensors at_vertices;
  for (const Point& p : square.points) at_vertices.tensor.push_back(Tensor::of_speed(1 + p[1]));
  all.push_back({"rising", "vertices", at_vertices, false, false, rising});
  for (const double ratio : {2.0, 5.0, 10.0}) {
    const double c = std::cos(0.5), s = std::sin(0.5), across = ratio * ratio;
    const Tensor tensor =
        Tensor::planar(c * c + across * s * s, (1 - across) * c * s, s * s + across * c * c);
    for (const bool delaunay : {false, true})
      all.push_back({"tensor 1 to " + std::to_string(static_cast<int>(ratio)),
                     delaunay ? "delaunay" : "input",
                     metric::SimplexTensors{std::vector<Tensor>(square.faces.size(), tensor)},
                     false, delaunay, [tensor](const Point& a, const Point& b) {
                       return std::sqrt(tensor.squared({b[0] - a[0], b[1] - a[1], 0}));
                     }});
  }
  return all;
}

void run(Arguments& arguments) {
  std::vector<Index> cells = {20, 50, 100, 200};
  double shake = 0.35;
  bool twice = false;
  arguments.option("--cells", &cells, "Cells a side, even numbers");
  arguments.option("--shake", &shake, "Vertices are moved by so many cells");
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "law: metric; sides: shared edges; vertices; y: source at y; violated;"
      "mean: error mean %.1e; max %.1e; below: most below %.1e; ns: ns/V %.0f");
  for (const Index n : cells) {
    const samples::HalvedSquare square(n, shake);
    for (const Case& one : cases(square))
      for (const double y : {0.25, -0.25})
        table.add(twice ? measure<double>(square, one, y) : measure<float>(square, one, y));
  }
}
const Command command("metrics", "metrics on a square, against closed forms", run);

}  // namespace bench::metrics
