// Mixed domains whose pieces have speeds of their own, against closed forms, at any fineness: a
// skin on a block and on a ball, a sheet that stands on a block, solids in layers. The ball is a
// polyhedron; its facets alone make distances shorter than on a round one.

#include <algorithm>
#include <cmath>

#include "data/mixed_pieces.hpp"
#include "solver.hpp"

namespace bench::mixed {

using samples::Position;

struct Domain {
  plexway::MixedComplex<double> complex;
  std::vector<Position> positions;
  using Piece = plexway::MixedComplex<double>::Piece;

  template <class Shape>
  Piece add(const Shape& shape, double speed) {
    positions.insert(positions.end(), shape.positions.begin(), shape.positions.end());
    auto timed = shape.positions;
    for (Position& p : timed)
      for (double& x : p) x /= speed;
    if constexpr (requires { shape.tets; })
      return complex.add(plexway::TetMesh<double>(timed, shape.tets), shape.positions);
    else
      return complex.add(plexway::TriangleMesh<double>(timed, shape.faces), shape.positions);
  }
  void weld(const Piece& a, const Piece& b) { complex.weld(a, b, {.tolerance = 1e-9}); }
};

/// Rows of the table: what fields are off, as a share of the distance.
class Fields {
 public:
  /// `repeats`: of solves by 1, 2 and 3 threads in turn, whose bits must be Serial's.
  Fields(Table& table, std::size_t repeats) : table_(table), repeats_(repeats) {}

  /// From the vertex next to `from`; exact(vertex, source).
  void measure(const std::string& name, const Domain& domain, const Position& from,
               const std::function<double(const Position&, const Position&, Index)>& exact) {
    Index source = 0;
    for (Index v = 0; v < domain.positions.size(); ++v)
      if (samples::distance(domain.positions[v], from) <
          samples::distance(domain.positions[source], from))
        source = v;
    plexway::DistanceField<double> field;
    const double spent = seconds([&] {
      field = plexway::solve(plexway::Serial{}, domain.complex, plexway::PointSource::at(source));
    });
    std::size_t others = 0;
    for (std::size_t i = 0; i < repeats_; ++i) {
      const plexway::OpenMP team{.threads = 1 + static_cast<int>(i % 3)};
      others += plexway::solve(team, domain.complex, plexway::PointSource::at(source)).distance !=
                field.distance;
    }
    double mean = 0, worst = 0, low = 0;
    for (Index v = 0; v < domain.positions.size(); ++v) {
      const double truth = exact(domain.positions[source], domain.positions[v], v);
      if (!(truth > 1e-12)) continue;
      const double off = field.distance[v] / truth - 1;
      mean += std::abs(off) / static_cast<double>(domain.positions.size());
      worst = std::max(worst, std::abs(off));
      low = std::min(low, off);
    }
    table_.add({{"domain", name},
                {"vertices", domain.positions.size()},
                {"mean", mean},
                {"worst", worst},
                {"low", low},
                {"seconds", spent},
                {"others", others}});
  }

 private:
  Table& table_;
  std::size_t repeats_;
};

void run(Arguments& arguments) {
  using namespace samples;
  std::size_t n = 40, slabs = 20, up = 0, repeats = 0;
  double thick = .25;
  std::vector<double> speeds = {.3, 1.1, 3};
  std::vector<std::string> only;
  arguments.positive("--cells", &n, "Cells a side");
  arguments.option("--speeds", &speeds, "Of skins and sheets; blocks have 1");
  arguments.names("--only", &only, "block, ball, standing, layers, slabs, one");
  arguments.option("--slabs", &slabs,
                   "How many there are in slabs and one, which run only if --only names them");
  arguments.option("--thick", &thick, "Of slabs, if they are 1 wide");
  arguments.option("--up", &up, "Cells over the thickness of a slab; 0: as many as along a side");
  arguments.option("--repeats", &repeats,
                   "Solves by 1, 2 and 3 threads in turn, to be Serial's to the last bit");
  Table& table = arguments.table(
      "domain; vertices; mean; worst; low: lowest; seconds: s %.3f; others: other bits");
  if (up == 0) up = n;
  const auto asked = [&](const char* name) {
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
  };
  const double cell = 1. / static_cast<double>(n);
  Fields fields(table, repeats);
  for (const double c : speeds) {
    const std::string at = ", c = " + std::to_string(c).substr(0, 3);
    if (asked("block")) {
      Domain domain;
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n), 1);
      domain.weld(solid, domain.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, n, n), c));
      for (const double depth : {0., 2 * cell, .5})
        fields.measure("skin on a block" + at, domain, {.25, .4, 1 - depth},
                       [&](const Position& p, const Position& q, Index) {
                         return along_fast(1 - p[2], 1 - q[2], std::hypot(p[0] - q[0], p[1] - q[1]),
                                           c, distance(p, q));
                       });
    }
    if (asked("ball")) {
      Domain domain;
      const Block round = ball(n);
      const auto solid = domain.add(round, 1);
      domain.weld(solid, domain.add(skin_of(round), c));
      for (const double r : {1., .5})
        fields.measure(
            "skin on a ball" + at, domain, {.3 * r, .5 * r, .81 * r},
            [&](const Position& p, const Position& q, Index) { return by_the_skin(p, q, c); });
    }
    if (asked("standing")) {
      Domain domain;
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n), 1);
      const auto plate = domain.add(sheet({.5, 0, 1}, {0, 1, 0}, {0, 0, 1}, n, n), c);
      domain.weld(solid, plate);
      fields.measure("sheet stands on a block" + at, domain, {.25, 0, .5},
                     [&](const Position& p, const Position& q, Index v) {
                       const double r = std::hypot(p[0] - .5, 1 - p[2]), x = std::abs(p[1] - q[1]);
                       if (v >= plate.first_vertex) return refracted(r, q[2] - 1, x, 1, c);
                       return along_fast(r, std::hypot(q[0] - .5, 1 - q[2]), x, c, distance(p, q));
                     });
    }
  }
  // Many layers, and as many slabs of one speed, which are joined to one solid.
  for (const bool one : {false, true}) {
    if (only.empty() || !asked(one ? "one" : "slabs")) continue;
    Domain domain;
    std::vector<Domain::Piece> pieces;
    Layers layers;
    for (std::size_t k = 0; k < slabs; ++k) {
      constexpr double of_five[] = {1, 2.5, 1.7, .8, 2};
      layers.v.push_back(one ? 1 : of_five[k % 5]);
      if (k > 0) layers.z.push_back(thick * static_cast<double>(k));
      const double z = thick * static_cast<double>(k);
      pieces.push_back(domain.add(block({0, 0, z}, {1, 1, z + thick}, {n, n, up}), layers.v[k]));
      if (k > 0) domain.weld(pieces[k - 1], pieces[k]);
    }
    const double height = thick * static_cast<double>(slabs);
    for (const double z : {0., height / 3})
      fields.measure(
          one ? "slabs of one speed" : "slabs of five speeds", domain, {.4, .3, z},
          [&](const Position& p, const Position& q, Index) { return layers.time(p, q); });
  }
  const Layers stacks[] = {
      {{.4}, {1, 2}}, {{.45}, {2, 1}}, {{.3, .65}, {1, 2, 1}}, {{.3, .65}, {2, 1, 1.5}}};
  for (const Layers& layers : stacks) {
    if (!asked("layers")) break;
    Domain domain;
    std::vector<Domain::Piece> pieces;
    const auto blocks = blocks_of(layers, n, .15, 1);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      pieces.push_back(domain.add(blocks[k], layers.v[k]));
      if (k > 0) domain.weld(pieces[k - 1], pieces[k]);
    }
    std::string name = "layers";
    for (const double v : layers.v) name += " " + std::to_string(v).substr(0, 3);
    for (const double z : {.2, layers.z[0] - cell, layers.z[0] + cell})
      fields.measure(name, domain, {.4, .3, z}, [&](const Position& p, const Position& q, Index) {
        return layers.time(p, q);
      });
  }
}
const Command command("mixed", "mixed domains of several speeds, against closed forms", run);

}  // namespace bench::mixed
