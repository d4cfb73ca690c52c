// Surfaces by every way to solve them: time beside Boost's Dijkstra or another way, in turns,
// errors against exact answers, memory. Surfaces are read or made (bumpy:N, wavy:N and torus:N of
// about so many vertices, corners:N and strip:N so many cells long), exact answers those of files,
// of closed forms, or of exact windows on the same triangles.

#include <cmath>
#include <numbers>
#include <random>

#include <plexway/surface/intrinsic_delaunay.hpp>

#include "data/corner_domains.hpp"
#include "data/long_strips.hpp"
#include "peers.hpp"
#include "scenes.hpp"
#include "solver.hpp"

namespace bench::surfaces {

using plexway::PropagateOptions, plexway::Retriangulation, plexway::Visibility;

struct Settings {
  Effort effort{8, 2, 20};
  std::size_t compared = 0;
  bool random = false, shuffled = false;
  double limit = 600;
  std::string against = "dijkstra";
};

struct Case {
  Surface surface;
  std::vector<Truth> truths;
};

// ---- Surfaces ----

Surface wavy(std::size_t vertices) {
  Surface s = height_field(
      static_cast<Index>(std::sqrt(static_cast<double>(vertices))) - 1,
      [](double x, double y) { return 0.05 * std::sin(12 * x) * std::cos(9 * y + 3 * x); });
  s.name = "wavy_" + std::to_string(s.positions.size());
  return s;
}

/// Twice as many vertices around as across, each moved along the surface by up to a fifth of an
/// edge.
Surface torus(std::size_t vertices) {
  const auto across = static_cast<Index>(std::sqrt(static_cast<double>(vertices) / 2));
  const Index around = 2 * across;
  std::mt19937 random(1);
  const auto jitter = [&] { return .4 * (static_cast<double>(random()) / 4294967296. - .5); };
  Surface s{"torus_" + std::to_string(around * across), {}, {}};
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * (i + jitter()) / around;
      const double b = 2 * std::numbers::pi * (j + jitter()) / across;
      const double r = 1 + .4 * std::cos(b);
      s.positions.push_back({r * std::cos(a), r * std::sin(a), .4 * std::sin(b)});
      const Index right = (i + 1) % around, up = (j + 1) % across;
      const Index at[4] = {i * across + j, right * across + j, right * across + up,
                           i * across + up};
      s.faces.push_back({at[0], at[1], at[2]});
      s.faces.push_back({at[0], at[2], at[3]});
    }
  return s;
}

/// Flat, in a straight frame, and wound up on a cylinder: straight lines through space say nothing.
Case strip(Index edges) {
  const samples::LongStrip strip(edges, 2, 1);
  Truth truth{0, {}};
  for (Index v = 0; v < strip.vertices(); ++v) truth.distance.push_back(strip.between(0, v));
  return {{"strip_" + std::to_string(edges), strip.wound(), strip.faces}, {std::move(truth)}};
}

std::vector<Case> made(const std::string& what) {
  const auto colon = what.find(':');
  const std::string kind = what.substr(0, colon);
  if (colon == what.npos) throw Exit(2, "--make " + what + ": KIND:SIZE");
  const auto size = static_cast<std::size_t>(std::stoul(what.substr(colon + 1)));
  if (kind == "bumpy") return {{bumpy_surface(size), {}}};
  if (kind == "wavy") return {{wavy(size), {}}};
  if (kind == "torus") return {{torus(size), {}}};
  if (kind == "strip") return {strip(static_cast<Index>(size))};
  if (kind != "corners") throw Exit(2, "--make " + what + ": bumpy, wavy, torus, corners or strip");
  std::vector<Case> all;
  for (const samples::CornerDomain& domain : samples::corner_domains()) {
    samples::Shape grid = domain.grid(static_cast<Index>(size), 0.25, 1);
    Truth truth{0, domain.distances(grid.points)};
    all.push_back(
        {{domain.name + '_' + std::to_string(size), std::move(grid.points), std::move(grid.faces)},
         {std::move(truth)}});
  }
  return all;
}

/// Vertices and faces in an order that says nothing about where they are.
void shuffle(Surface& surface) {
  samples::Noise noise(1);
  const auto place = shuffled(surface.positions.size(), noise);
  const auto old_positions = surface.positions;
  for (std::size_t v = 0; v < place.size(); ++v) surface.positions[place[v]] = old_positions[v];
  const auto face_place = shuffled(surface.faces.size(), noise);
  const auto old_faces = surface.faces;
  for (std::size_t f = 0; f < face_place.size(); ++f) {
    auto face = old_faces[f];
    for (Index& v : face) v = place[v];
    surface.faces[face_place[f]] = face;
  }
  surface.name += ", shuffled";
}

// ---- Ways to solve ----

PropagateOptions options_of(const std::string& way) {
  PropagateOptions options = one_label();
  if (way == "accurate" || way == "exact") return by_accuracy(way);
  if (way == "plain") options.vectorised = false;
  if (way == "centroid") options.visibility = Visibility::centroid;
  if (way == "tuned" || way == "published") options.visibility = Visibility::tuned;
  if (way == "published") options.probe = plexway::ProbeTable::published();
  if (way == "upper_bound") options.visibility = Visibility::upper_bound;
  if (way == "fifo") options.schedule = plexway::Schedule::fifo;
  if (way == "priority") options.schedule = plexway::Schedule::priority;
  if (way[0] >= '0' && way[0] <= '9') options.accuracy = plexway::Accuracy(std::stod(way));
  return options;
}

// ---- Measured ----

/// Errors, with what lies below the straight line in space, how far the two distances of a pair of
/// sources differ, and of how many vertices the estimate of the error is not too small.
template <class Real>
void judge(Solver<plexway::TriangleMesh<Real>>& solver, const Case& one, Row& row) {
  Errors errors;
  std::size_t compared = 0, beyond = 0, held = 0, estimated = 0;
  double line = 0, asymmetry = 0;
  std::vector<std::vector<double>> between;
  const auto& places = one.surface.positions;
  for (const Truth& truth : one.truths) {
    solver(truth.source);
    const auto& distance = solver.distance();
    const auto& estimate = solver.field().error;
    errors.add(truth, distance);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double exact = truth.distance[v], found = static_cast<double>(distance[v]);
      if (!(exact > 0) || !std::isfinite(exact) || !std::isfinite(found)) continue;
      ++compared;
      beyond += std::abs(found / exact - 1) > 5e-3;
      if (v < estimate.size()) {  // single precision alone is off by 1e-6
        ++estimated;
        held += std::abs(found - exact) <= static_cast<double>(estimate[v]) + 1e-6 * exact;
      }
      const auto &p = places[v], &q = places[truth.source];
      const double straight = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (straight > 0) line = std::min(line, found / straight - 1);
    }
    between.emplace_back();
    for (const Truth& other : one.truths)
      between.back().push_back(static_cast<double>(distance[other.source]));
  }
  if (compared == 0) return;
  for (std::size_t i = 0; i < between.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto [least, most] = std::minmax(between[i][j], between[j][i]);
      if (least > 0 && std::isfinite(most)) asymmetry = std::max(asymmetry, (most - least) / least);
    }
  add_errors(row, errors);
  row["beyond"] = static_cast<double>(beyond) / static_cast<double>(compared);
  row["line"] = line;
  if (between.size() > 1) row["asymmetry"] = asymmetry;
  if (estimated > 0) row["held"] = static_cast<double>(held) / static_cast<double>(estimated);
}

template <class Real>
Row measure(const Case& one, Retriangulation kind, const std::string& way,
            const Settings& settings) {
  using Mesh = plexway::TriangleMesh<Real>;
  const Surface& surface = one.surface;
  const double vertices = static_cast<double>(surface.positions.size());
  Row row;
  // Memory first, while nothing but the surface is there.
  return_free_memory();
  const double before = status_bytes("VmRSS").value_or(0);
  std::unique_ptr<Mesh> mesh;
  row["build"] = 1e9 / vertices * seconds([&] {
                   if (kind == Retriangulation::keep) {
                     mesh = std::make_unique<Mesh>(surface.positions, surface.faces);
                     return;
                   }
                   const plexway::TriangleMesh<double> input(surface.positions, surface.faces);
                   const plexway::IntrinsicDelaunay other(input, plexway::refinement_for(kind));
                   mesh = std::make_unique<Mesh>(other.template mesh<Real>());
                   row["flips"] = other.summary().flips;
                   row["inserted"] = other.summary().inserted_vertices;
                 });
  const auto sources = rotating_sources(surface, settings.effort.sources);
  Solver solver(*mesh, options_of(way));
  solver(sources[0]);
  if (const auto peak = status_bytes("VmHWM")) row["peak"] = (*peak - before) / vertices;
  row["bytes"] = static_cast<double>(mesh->bytes() + solver.bytes()) / vertices;

  const Mesh input(surface.positions, surface.faces);
  Solver other(input, options_of(settings.against));
  const auto dijkstra = settings.against == "dijkstra"
                            ? reference_peer(surface, sizeof(Real) == sizeof(float))
                            : nullptr;
  const Times times = take_turns(
      sources, settings.effort, [&](Index v) { dijkstra ? dijkstra->solve(v) : other(v); },
      [&](Index v) { solver(v); });
  row["ns"] = 1e9 * times.second / vertices;
  row["other_ns"] = 1e9 * times.first / vertices;
  row["ratio"] = times.ratio;
  row["turns"] = static_cast<double>(solver.statistics().expansions) / vertices;
  judge(solver, one, row);
  return row;
}

/// From so many vertices, spread or random, by exact windows.
std::vector<Truth> by_windows(const Surface& surface, const Settings& settings) {
  const plexway::TriangleMesh<double> mesh(surface.positions, surface.faces);
  Solver exact(mesh, by_accuracy("exact"));
  auto sources = rotating_sources(surface, settings.compared);
  std::mt19937 random(1);
  if (settings.random)
    for (Index& source : sources)
      source = surface.faces[random() % surface.faces.size()][random() % 3];
  std::vector<Truth> truths;
  for (const Index source : sources) {
    exact(source);
    truths.push_back({source, exact.distance()});
  }
  return truths;
}

void run(Arguments& arguments) {
  Meshes meshes;
  Settings settings;
  std::vector<std::string> generated, ways = {"fast", "accurate", "exact"}, triangles = {"input"};
  bool twice = false;
  meshes.add_options(arguments);
  arguments.names("--make", &generated, "Also bumpy:N, wavy:N, torus:N, corners:N, strip:N");
  arguments.names("--by", &ways,
                  "fast, accurate, exact, an error to ask for, and by one label a triangle: plain, "
                  "centroid, tuned, published, upper_bound, fifo, priority");
  arguments.option("--against", &settings.against, "dijkstra, or one of --by on the input");
  arguments.names("--triangles", &triangles, "input, delaunay, refined");
  arguments.option("--compared", &settings.compared,
                   "The exact answers of so many sources by windows, not those of files");
  arguments.option("--random", &settings.random, "With --compared: random sources");
  arguments.option("--shuffle", &settings.shuffled, "Vertices and faces in random order");
  settings.effort.add_options(arguments);
  arguments.add_limit();
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "mesh; vertices; triangles; by; build: build ns/V %.0f; flips; inserted; ns: ns/V %.0f;"
      "other_ns: the other's ns/V %.0f; ratio %.2f; turns: turns/V %.1f; mean: error mean %.1e;"
      "p99 %.1e; max %.1e; below: most below %.1e; wrong; beyond: share beyond 5e-3 %.1e;"
      "asymmetry: two ways differ by %.1e; line: below the line %.1e;"
      "held: estimate holds %.4f; bytes: bytes/V %.0f; peak: peak bytes/V %.0f; note");
  const auto on = [&](Case one) {
    if (settings.shuffled) shuffle(one.surface), one.truths.clear();
    if (settings.compared > 0) one.truths = by_windows(one.surface, settings);
    for (const std::string& name : triangles)
      for (const std::string& way : ways) {
        const Retriangulation kind = name == "delaunay"  ? Retriangulation::flips
                                     : name == "refined" ? Retriangulation::refined
                                                         : Retriangulation::keep;
        const bool exact = twice || way == "exact";
        table.measure({{"mesh", one.surface.name},
                       {"vertices", one.surface.positions.size()},
                       {"triangles", name},
                       {"by", way}},
                      arguments.limit, [&] {
                        return exact ? measure<double>(one, kind, way, settings)
                                     : measure<float>(one, kind, way, settings);
                      });
      }
  };
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    on({surface, truths});
  });
  for (const std::string& what : generated)
    for (Case& one : made(what)) on(std::move(one));
}
const Command command("surfaces", "every way to solve surfaces: time, errors, memory", run);

}  // namespace bench::surfaces
