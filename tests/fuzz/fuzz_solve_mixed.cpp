// Pieces welded to a whole whose distances are known: a square with rectangles cut out, dealt among
// sheets, and the prism over it among solids (the truth is the visibility graph of the corners);
// layers of two speeds, as sheets and as solids (Snell's law and head waves); a square with wires
// of a speed of their own from vertex to vertex (a graph of straight lines and wires).

#include "data/speed_times.hpp"
#include "fuzz_whole.hpp"

namespace fuzz_solve_mixed {

namespace {

using namespace fuzz;

/// Which piece each quarter of a tile belongs to.
struct Patchwork {
  static constexpr int across = plan_cells / 2;
  std::vector<std::size_t> piece;

  Patchwork(Choices& choices, std::size_t pieces) : piece(across * across) {
    for (std::size_t& p : piece) p = choices.byte() % pieces;
  }
  std::size_t operator()(const Place& at) const {
    const auto step = [](double x) {
      return std::clamp(static_cast<int>(std::floor(x * across)), 0, across - 1);
    };
    return piece[static_cast<std::size_t>(step(at[1]) * across + step(at[0]))];
  }
};

void solve_patches(Choices& choices, bool solid) {
  const auto cut = cut_of(choices);
  if (!cut) return;
  const std::size_t pieces = 2 + choices.byte() % 3;
  const Patchwork patches(choices, pieces);
  if (!solid) {
    Whole whole(cut->places);
    for (const auto& part : dealt(cut->shape.faces, cut->places, pieces, patches))
      whole.add(part, 1);
    whole.check(0, cut->truth, {1e-3, 5e-2});
    return;
  }
  const Prism prism = prism_of(cut->shape, height_of(choices));
  Whole whole(prism.places);
  for (const auto& part : dealt(prism.tets, prism.places, pieces, patches)) whole.add(part, 1);
  whole.check(0, over(prism, cut->truth), {1e-3, 1e-1});
}

void solve_layers(Choices& choices, bool solid) {
  samples::CornerDomain plan;  // nothing is cut out
  plan.source = source_of(choices);
  samples::Shape shape = meshed(plan, choices);
  const double middle = static_cast<double>(1 + choices.byte() % (plan_cells - 1)) / plan_cells;
  const std::array<double, 2> speed = {1, std::exp2((choices.byte() - 127.5) / 80)};
  // Vertices of the line between stay on it.
  for (auto& p : shape.points)
    if (std::abs(p[1] - middle) < 0.4 / plan_cells) p[1] = middle;
  const std::vector<Place> flat(shape.points.begin(), shape.points.end());
  const samples::Layers layers{{middle}, {speed[0], speed[1]}};
  const auto layer_of = [&](const Place& at) { return std::size_t{at[1] > middle}; };
  const auto solve = [&](const std::vector<Place>& places, const auto& simplices, Bounds bounds) {
    Whole whole(places);
    const auto parts = dealt(simplices, places, 2, layer_of);
    whole.add(parts[0], speed[0]);
    whole.add(parts[1], speed[1]);
    std::vector<double> truth;
    const Place& s = places[0];
    for (const Place& p : places)
      truth.push_back(layers.time({s[0], s[2], s[1]}, {p[0], p[2], p[1]}));
    whole.check(0, truth, bounds);
  };
  if (solid) {
    const Prism prism = prism_of(shape, height_of(choices));
    solve(prism.places, prism.tets, {1e-3, 2e-1});  // a vertex in a thousand plans is 15 % long
  } else {
    solve(flat, shape.faces, {1e-3, 8e-2});
  }
}

void solve_wires(Choices& choices) {
  samples::CornerDomain plan;
  plan.source = source_of(choices);
  const samples::Shape shape = meshed(plan, choices);
  const std::vector<Place> flat(shape.points.begin(), shape.points.end());
  const double speed = std::exp2((choices.byte() - 64) / 64.);
  std::vector<std::array<Index, 2>> wires;
  for (int left = choices.byte() % 8; left > 0; --left) {
    const Index a = choices.below(flat.size()), b = choices.below(flat.size());
    // Along an edge a wire could be taken and left anywhere.
    if (Graph::straight(flat[a], flat[b]) > 2.5 / plan_cells) wires.push_back({a, b});
  }
  std::vector<double> truth;
  for (const Place& p : flat) truth.push_back(Graph::straight(flat[0], p));
  for (bool better = true; better;) {
    better = false;
    for (const auto& wire : wires)
      for (const auto& [a, b] : {std::pair(wire[0], wire[1]), std::pair(wire[1], wire[0])}) {
        const double there = truth[a] + Graph::straight(flat[a], flat[b]) / speed;
        if (!(there < truth[b])) continue;
        better = true;
        for (std::size_t v = 0; v < flat.size(); ++v)
          truth[v] = std::min(truth[v], there + Graph::straight(flat[b], flat[v]));
      }
  }
  Whole whole(flat);
  whole.add(shape.faces, 1);
  whole.add(wires, speed);
  whole.check(0, truth, {1e-3, 5e-2});
}

}  // namespace

PLEXWAY_FUZZER(solve_mixed)(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const int kind = choices.byte() % 5;
  return check_input({}, [&] {
    if (kind < 2)
      solve_patches(choices, kind == 1);
    else if (kind < 4)
      solve_layers(choices, kind == 3);
    else
      solve_wires(choices);
  });
}

}  // namespace fuzz_solve_mixed
