// Random plans as the fuzzers make them (tests/fuzz/fuzz_plan.hpp), with errors in a table where
// those only hold bounds: rectangles cut out of a square, as a surface, as a complex of triangles
// and as the prism over it, against the visibility graph of the corners; prisms over plans with a
// crack, and paths in these; plans of eight by eight cells of which a share is left out, from one
// source and several, and cubes of cells, against the same cut finer. Several sources at once: in a
// cube against straight lines, in prisms over plans against the least of a field from each. And
// solids of several speeds: stacks of slabs, against Snell's law and head waves; two with
// rectangles or slits cut out of both, against a refined graph. Solids welded to their own
// surfaces, against the solid alone and the straight line.

#include <map>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>

#include "data/cell_lattice.hpp"
#include "data/cell_plans.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"
#include "fuzz/fuzz_plan.hpp"
#include "random_cracks.hpp"

namespace bench::random_plans {

using plexway::PointSource;

/// So many draws of bytes that `use(choices)` can make something of.
template <class Use>
void each_choices(Random& random, std::size_t draws, const Use& use) {
  while (draws > 0) {
    std::array<std::uint8_t, 16> bytes;
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    fuzz::Choices choices(bytes.data(), bytes.size());
    draws -= use(choices);
  }
}

// Plans with enough room for the source, by `solve(cut, choices, errors)`.
template <class Solve>
void solve_plans(Random& random, std::size_t plans, PlanErrors& errors, const Solve& solve) {
  each_choices(random, plans, [&](fuzz::Choices& choices) {
    const auto cut = fuzz::cut_of(choices);
    if (cut) solve(*cut, choices, errors);
    return cut.has_value();
  });
}

void solve_surface(const fuzz::Cut& cut, const std::string& accuracy, PlanErrors& errors) {
  const plexway::TriangleMesh<double> mesh(cut.places, cut.shape.faces);
  errors.add(distances(mesh, PointSource::at(0), by_accuracy(accuracy)), cut.truth);
}

void solve_plane(const fuzz::Cut& cut, PlanErrors& errors) {
  const plexway::SimplicialComplex<double, 2> complex(fuzz::flattened(cut.places), 2,
                                                      cut.shape.faces);
  errors.add(distances(complex, PointSource::at(0)), cut.truth);
}

void solve_prism(const fuzz::Cut& cut, fuzz::Choices& choices, PlanErrors& errors) {
  const fuzz::Prism prism = fuzz::prism_of(cut.shape, fuzz::height_of(choices));
  const plexway::TetMesh<double> solid(prism.places, prism.tets);
  errors.add(distances(solid, PointSource::at(0)), fuzz::over(prism, cut.truth));
}

// ---- Several sources at once in solids ----

/// Where sources are, and their offsets.
struct PlacedSources {
  std::vector<PointSource> sources;
  std::vector<fuzz::Place> at;

  void add(const PointSource& source, const fuzz::Place& place) {
    sources.push_back(source);
    at.push_back(place);
  }
  /// By straight lines.
  [[nodiscard]] Distances straight(const std::vector<fuzz::Place>& places) const {
    Distances truth;
    for (const fuzz::Place& p : places) {
      truth.push_back(std::numeric_limits<double>::infinity());
      for (std::size_t n = 0; n < at.size(); ++n)
        truth.back() = std::min(truth.back(), sources[n].offset + fuzz::Graph::straight(p, at[n]));
    }
    return truth;
  }
};

/// A cube of 6 to 20 cells a side; vertices inside moved by up to `jitter` of a cell.
struct RandomCube {
  std::size_t cells;
  std::vector<fuzz::Place> places;
  std::vector<std::array<Index, 4>> tets;

  RandomCube(Random& random, double jitter) : cells(6 + random() % 15) {
    const double cell = 1. / static_cast<double>(cells);
    const plexway::KuhnGrid<3> grid({cells, cells, cells}, {cell, cell, cell});
    for (Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      if (jitter > 0)
        for (double& x : places.back())
          if (x > cell / 2 && x < 1 - cell / 2) x += (2 * share(random) - 1) * jitter * cell;
    }
    tets = grid.simplices();
  }
  void solve(const PlacedSources& from, PlanErrors& errors) const {
    const plexway::TetMesh<double> cube(places, tets);
    errors.add(distances(cube, from.sources), from.straight(places));
  }
};

/// So many vertices of the grid as it is.
void solve_cube(Random& random, std::size_t count, PlanErrors& errors) {
  const RandomCube cube(random, 0);
  PlacedSources from;
  for (std::size_t n = 0; n < count; ++n) {
    const auto v = static_cast<Index>(random() % cube.places.size());
    from.add(PointSource::at(v), cube.places[v]);
  }
  cube.solve(from, errors);
}

/// Vertices and points of tetrahedra, in every other draw with offsets, on a grid whose vertices
/// are moved.
void solve_moved_cube(Random& random, std::size_t count, PlanErrors& errors) {
  const RandomCube cube(random, .15);
  const double most = random() % 2 == 0 ? 0 : share(random) / 4;
  PlacedSources from;
  for (std::size_t n = 0; n < count; ++n) {
    const auto t = static_cast<Index>(random() % cube.tets.size());
    std::array<double, 4> b = {1, 0, 0, 0};
    if (random() % 2 == 0) {
      for (double& x : b) x = .05 + share(random);
      const double sum = b[0] + b[1] + b[2] + b[3];
      for (double& x : b) x /= sum;
    }
    fuzz::Place at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += b[i] * cube.places[cube.tets[t][i]][k];
    PointSource source = PointSource::in(t, b);
    source.offset = most * share(random);
    from.add(source, at);
  }
  cube.solve(from, errors);
}

/// All vertices of the boundary.
void solve_from_boundary(Random& random, PlanErrors& errors) {
  const RandomCube cube(random, .15);
  PlacedSources from;
  for (Index v = 0; v < cube.places.size(); ++v)
    if (std::any_of(cube.places[v].begin(), cube.places[v].end(),
                    [](double x) { return x < 1e-9 || x > 1 - 1e-9; }))
      from.add(PointSource::at(v), cube.places[v]);
  cube.solve(from, errors);
}

/// In the prism over a plan, against the least of a field from each.
void solve_least(const fuzz::Cut& cut, Random& random, std::size_t count, double height,
                 PlanErrors& errors) {
  const fuzz::Prism prism = fuzz::prism_of(cut.shape, height);
  const plexway::TetMesh<double> solid(prism.places, prism.tets);
  std::vector<PointSource> sources;
  while (sources.size() < count) {
    const auto v = static_cast<Index>(random() % prism.places.size());
    sources.push_back(PointSource::at(v));
    sources.back().offset = random() % 2 == 0 ? 0 : share(random) / 4;
  }
  Distances least(prism.places.size(), std::numeric_limits<double>::infinity());
  for (const PointSource& source : sources) {
    const auto one = distances(solid, source);
    for (std::size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], one[v]);
  }
  errors.add(distances(solid, sources), least);
}

/// Two layers of cells, of which this share is left out, against the visibility graph.
void solve_cells(Random& random, double left_out, std::size_t count, PlanErrors& errors) {
  const samples::CellPlan plan(random, left_out);
  std::vector<PointSource> sources;
  Distances truth(plan.places.size(), std::numeric_limits<double>::infinity());
  while (sources.size() < count) {
    sources.push_back(PointSource::at(static_cast<Index>(random() % plan.places.size())));
    sources.back().offset = count == 1 || random() % 2 == 0 ? 0 : 2 * share(random);
    const auto one = plan.truth(sources.back().vertex);
    for (std::size_t v = 0; v < truth.size(); ++v)
      truth[v] = std::min(truth[v], sources.back().offset + one[v]);
  }
  errors.add(distances(plexway::TetMesh<double>(plan.places, plan.tets), sources), truth);
}

/// Cells of a cube, against the same cells cut in eight.
void solve_lattice(Random& random, int side, double left_out, PlanErrors& errors) {
  const auto out = samples::CellLattice::left_out(side, left_out, random);
  const samples::CellLattice whole(side, out, 1), cut(side, out, 2);
  const auto from = whole.any_vertex(random);
  const auto field = [&](const samples::CellLattice& of) {
    return distances(plexway::TetMesh<double>(of.places, of.tets),
                     PointSource::at(of.vertex(from)));
  };
  const Distances found = field(whole), fine = field(cut);
  Distances truth(found.size());
  whole.each_vertex([&](const auto& at) { truth[whole.vertex(at)] = fine[cut.vertex(at)]; });
  errors.add(found, truth);
}

// ---- Solids of several speeds ----

/// From a vertex on a plane between two slabs, or from any.
void solve_stack(Random& random, double thinnest, double thickest, bool on_plane,
                 PlanErrors& errors) {
  const samples::Stack stack = samples::random_stack(random, 20, thinnest, thickest);
  const samples::StackDomain whole(stack);
  const auto& places = whole.places;
  const auto& planes = stack.layers.z;
  Index source;
  do {
    source = static_cast<Index>(random() % places.size());
  } while (on_plane && std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
  Distances truth;
  for (const auto& p : places) truth.push_back(stack.layers.time(places[source], p));
  errors.add(distances(whole.domain, PointSource::at(source)), truth);
}

/// Two solids of two speeds with rectangles or slits cut out of both.
void solve_pierced(Random& random, bool slits, std::size_t plans, PlanErrors& errors) {
  each_choices(random, plans, [&](fuzz::Choices& choices) {
    auto plan = fuzz::plan_of(choices);
    if (!plan) return false;
    if (slits) plan->blocks = fuzz::slits_of(plan->blocks);
    if (std::any_of(plan->blocks.begin(), plan->blocks.end(), [&](const auto& b) {
          return b.left == b.right && std::abs(plan->source[0] - b.left) < 1e-9;
        }))
      return false;  // from a slit, or in its line
    const auto solved = fuzz::solve_pierced(*plan, choices);
    if (solved) errors.add(solved->found, solved->truth);
    return solved.has_value();
  });
}

/// A grid with cells left out, vertices moved in every other one, welded to all or some of its own
/// boundary as a surface of the same speed: what the solid alone says, and the straight line.
struct Skinned {
  std::vector<fuzz::Place> places, skin;
  std::vector<std::array<Index, 4>> tets;
  std::vector<std::array<Index, 3>> triangles;
  bool all = false;  // is all of the boundary covered?

  explicit Skinned(Random& random) {
    const std::size_t n = 3 + random() % 4;
    const double empty = .35 * share(random), cell = 1. / static_cast<double>(n);
    std::vector<char> gone(n * n * n);
    for (char& one : gone) one = share(random) < empty;
    const plexway::KuhnGrid<3> grid({n, n, n}, {cell, cell, cell});
    tets = grid.simplices([&](const auto& c) { return gone[c[0] + n * (c[1] + n * c[2])] != 0; });
    const double moved = random() % 2 == 0 ? 0 : .15 * cell;
    for (Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      for (double& x : places.back())
        if (x > cell / 2 && x < 1 - cell / 2) x += moved * (2 * share(random) - 1);
    }
    all = random() % 2 == 0;
    cover(random, all ? 1 : .2 + .8 * share(random));
  }

 private:
  void cover(Random& random, double covered) {
    std::map<std::array<Index, 3>, int> faces;
    for (std::array<Index, 4> t : tets) {
      std::sort(t.begin(), t.end());
      for (std::size_t i = 0; i < 4; ++i) {
        std::array<Index, 3> face{};
        for (std::size_t j = 0, k = 0; j < 4; ++j)
          if (j != i) face[k++] = t[j];
        ++faces[face];
      }
    }
    std::map<Index, Index> own;
    for (const auto& [face, count] : faces) {
      if (count != 1 || share(random) > covered) continue;
      triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [at, is_new] = own.try_emplace(face[i], static_cast<Index>(skin.size()));
        if (is_new) skin.push_back(places[face[i]]);
        triangles.back()[i] = at->second;
      }
    }
  }
};

void solve_skinned(Random& random, bool straight, PlanErrors& errors) {
  const Skinned made(random);
  const auto from = static_cast<std::size_t>(random());
  if (made.tets.empty() || made.triangles.empty()) return;
  plexway::MixedComplex<double> domain;
  const plexway::TetMesh<double> alone(made.places, made.tets);
  const auto solid = domain.add(alone, made.places);
  const auto skin = domain.add(plexway::TriangleMesh<double>(made.skin, made.triangles), made.skin);
  domain.weld(solid, skin, {.tolerance = 1e-9});
  const Index v = made.tets[from % made.tets.size()][0];
  const Distances all = distances(domain, PointSource::at(solid.vertex(v)));
  Distances found, truth = straight ? Distances() : distances(alone, PointSource::at(v));
  for (Index w = 0; w < made.places.size(); ++w) {
    found.push_back(all[solid.vertex(w)]);
    if (straight) truth.push_back(fuzz::Graph::straight(made.places[w], made.places[v]));
  }
  for (Index w = 0; straight && w < made.skin.size(); ++w) {
    found.push_back(all[skin.vertex(w)]);
    truth.push_back(fuzz::Graph::straight(made.skin[w], made.places[v]));
  }
  for (std::size_t w = 0; w < truth.size(); ++w)
    if (!(found[w] < std::numeric_limits<double>::infinity())) truth[w] = 0;  // not reached
  errors.add(found, truth);
}

void run(Arguments& arguments) {
  std::size_t plans = 200;
  unsigned seed = 1;
  std::vector<std::string> only;
  arguments.option("--plans", &plans, "How many of each kind");
  arguments.option("--seed", &seed, "Other plans by another number");
  arguments.names("--only", &only,
                  "accurate, exact, plane, prism, cells, lattice, sources, moved, boundary, least, "
                  "stack, holes, slits, crack, path, skin");
  Table& table = arguments.table(
      "domain; plans; vertices; mean; long: most too long; short: most too short;"
      "off: vertices off by .1 %; far: above 1 %; above1: plans above 1 %; above3: above 3 %;"
      "above5: above 5 %");
  const auto measure = [&](const std::string& name,
                           const std::function<void(Random&, PlanErrors&)>& solve) {
    const std::string kind = name.substr(0, name.find(' '));
    if (!only.empty() && std::find(only.begin(), only.end(), kind) == only.end()) return;
    Random random(seed);
    PlanErrors errors;
    solve(random, errors);
    errors.print(name, table);
  };
  const auto of_plans = [&](const std::string& name, const auto& solve) {
    measure(name,
            [&](Random& random, PlanErrors& errors) { solve_plans(random, plans, errors, solve); });
  };
  of_plans("accurate", [](const auto& cut, auto&, PlanErrors& errors) {
    solve_surface(cut, "accurate", errors);
  });
  of_plans("exact",
           [](const auto& cut, auto&, PlanErrors& errors) { solve_surface(cut, "exact", errors); });
  of_plans("plane", [](const auto& cut, auto&, PlanErrors& errors) { solve_plane(cut, errors); });
  of_plans("prism", [](const auto& cut, auto& choices, PlanErrors& errors) {
    solve_prism(cut, choices, errors);
  });
  const auto of_counts = [&](const std::string& name, const std::vector<std::size_t>& counts,
                             const auto& solve) {
    for (const std::size_t count : counts)
      measure(name + ' ' + std::to_string(count), [&](Random& random, PlanErrors& errors) {
        for (std::size_t i = 0; i < plans; ++i) solve(random, count, errors);
      });
  };
  of_counts("sources", {1, 2, 5, 20, 200, 2000}, solve_cube);
  of_counts("moved", {2, 5, 20, 200, 2000}, solve_moved_cube);
  for (const double left_out : {.2, .28, .35})
    of_counts("cells without " + std::to_string(static_cast<int>(100 * left_out)) + " %, from",
              {1, 2, 5, 20}, [&](Random& random, std::size_t count, PlanErrors& errors) {
                solve_cells(random, left_out, count, errors);
              });
  const auto lattices = [&](const std::string& name, int side, double left_out) {
    measure("lattice " + name, [&](Random& random, PlanErrors& errors) {
      for (std::size_t i = 0; i < plans; ++i) solve_lattice(random, side, left_out, errors);
    });
  };
  lattices("of 6, 15 % left out", 6, .15);
  lattices("of 10, 20 % left out", 10, .2);
  measure("boundary", [&](Random& random, PlanErrors& errors) {
    for (std::size_t i = 0; i < plans; ++i) solve_from_boundary(random, errors);
  });
  for (const std::size_t count : {2, 5, 20, 200})
    measure("least " + std::to_string(count), [&](Random& random, PlanErrors& errors) {
      solve_plans(random, plans, errors, [&](const auto& cut, auto& choices, PlanErrors& into) {
        solve_least(cut, random, count, fuzz::height_of(choices), into);
      });
    });
  const auto stacks = [&](const std::string& name, double thinnest, double thickest,
                          bool on_plane) {
    measure("stack " + name, [&](Random& random, PlanErrors& errors) {
      for (std::size_t i = 0; i < plans; ++i)
        solve_stack(random, thinnest, thickest, on_plane, errors);
    });
  };
  stacks("thin, from a plane", .02, 1.5, true);
  stacks("of cells, from a plane", .7, 1.5, true);
  stacks("thin, from anywhere", .02, 1.5, false);
  for (const bool slits : {false, true})
    measure(
        slits ? "slits in two speeds" : "holes in two speeds",
        [&](Random& random, PlanErrors& errors) { solve_pierced(random, slits, plans, errors); });
  for (const std::string kind : {"slit", "L", "T", "U", "any", "hole"})
    measure("crack " + kind, [&](Random& random, PlanErrors& errors) {
      solve_cracked(random, plans, kind, errors);
    });
  for (const bool straight : {false, true})
    measure(straight ? "skin over straight lines" : "skin over the solid alone",
            [&](Random& random, PlanErrors& errors) {
              for (std::size_t i = 0; i < plans; ++i) solve_skinned(random, straight, errors);
            });
  measure("path slit", [&](Random& random, PlanErrors& errors) {
    trace_cracked(random, plans, "slit", errors);
  });
}
const Command command("random_plans", "random plans, cracks, sources, layers: worst errors", run);

}  // namespace bench::random_plans
