// What building makes and what solving finds, as an oracle for changes to them: a line with a
// checksum for every array of surfaces, their Delaunay triangulations and solids, and for fields on
// them, on wireframes, complexes of simplices and mixed domains, of shapes made on the spot and of
// files, in both precisions.
//
//   bench_digest [FILE...] > NEW    (the same built before the change: > OLD)
//   diff OLD NEW
//
// Beside the checksum stand how many numbers there are, and their mean, which tells whether another
// checksum means another rounding.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "data/random_stacks.hpp"

namespace {

using namespace plexway;
using testing::Solid;
using testing::Surface;

/// Prints lines, each under the name of what was entered last.
class Writer {
 public:
  void enter(std::string name) { prefix_ = std::move(name); }
  template <class T>
  void array(const char* name, const std::vector<T>& values) {
    unsigned long long bits = 14695981039346656037u;  // Fowler, Noll and Vo's, by words, each mixed
    double sum = 0, finite = 0;
    for (const T value : values) {
      std::uint64_t word = 0;
      std::memcpy(&word, &value, sizeof value);
      bits = (bits ^ word) * 1099511628211u;
      bits ^= bits >> 29;
      const auto number = static_cast<double>(value);
      if (std::isfinite(number)) sum += number, ++finite;
    }
    std::printf("%s %s: %zu %016llx %.12g\n", prefix_.c_str(), name, values.size(), bits,
                finite > 0 ? sum / finite : 0);
  }

 private:
  std::string prefix_;
};

template <class T, class Range>
void append(std::vector<T>& to, const Range& more) {
  for (const auto& one : more) to.push_back(static_cast<T>(one));
}

template <class Real>
void add(Writer& out, const TriangleMesh<Real>& mesh) {
  std::vector<Index> glued, corners, at, names;
  std::vector<Real> shape;
  for (const auto& t : mesh.triangles())
    for (std::size_t i = 0; i < 3; ++i) {
      append(glued, std::array{t.across[i], t.corner[i], Index{t.saddle(i)}});
      append(shape, std::array<Real, 3>{t.length[i], t.cosine[i], t.sine(i)});
    }
  append(names, mesh.vertices_inside());
  for (Index v = 0; v < names.size(); ++v) {
    mesh.corners_at(v, at);
    corners.push_back(static_cast<Index>(at.size()));
    append(corners, at);
  }
  append(corners, mesh.pinched());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [inside, turned] = mesh.inside_face(f);
    append(names, std::array<std::size_t, 2>{inside, turned});
  }
  const SurfaceSummary& s = mesh.summary();
  out.array("gluing", glued);
  out.array("shape", shape);
  out.array("corners", corners);
  out.array("names", names);
  out.array("summary", std::vector<std::size_t>{
                           s.vertices, s.faces, s.edges, s.boundary_edges, s.non_manifold_edges,
                           s.pinched_vertices, s.unreferenced_vertices, s.degenerate_faces,
                           s.violated_faces, s.refracting_edges, s.components, s.orientable});
}

template <class Real>
void add(Writer& out, const TetMesh<Real>& mesh) {
  std::vector<Index> glued, corners, names;
  std::vector<double> shape;
  for (const auto& t : mesh.tets()) {
    append(glued, t.across);
    append(glued, t.corner);
  }
  for (const auto& p : mesh.points()) append(shape, std::array<double, 3>{p.x, p.y, p.z});
  for (const auto& lengths : mesh.squared_lengths()) append(shape, lengths);
  append(names, mesh.vertices_inside());
  for (Index v = 0; v < names.size(); ++v) {
    const auto at = mesh.corners_at(v);
    corners.push_back(static_cast<Index>(at.size()));
    append(corners, at);
  }
  append(corners, mesh.pinched());
  for (const auto& e : mesh.pinched_edges())
    append(corners, std::array{e.vertex[0], e.vertex[1], e.begin, e.end});
  append(corners, mesh.pinched_edge_tets());
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    const auto [inside, turned] = mesh.inside_tet(t);
    append(names, std::array<std::size_t, 2>{inside, turned});
  }
  const SolidSummary& s = mesh.summary();
  out.array("gluing", glued);
  out.array("shape", shape);
  out.array("corners", corners);
  out.array("names", names);
  out.array("summary", std::vector<std::size_t>{
                           s.vertices, s.tets, s.edges, s.faces, s.boundary_faces, s.reflex_edges,
                           s.reflex_vertices, s.pinched_vertices, s.pinched_edges,
                           s.unreferenced_vertices, s.degenerate_tets, s.inverted_tets,
                           s.first_degenerate, s.first_inverted, s.components, s.embedded});
}

// What is refused is refused with the same words.
template <class Work>
void attempt(Writer& out, const std::string& name, Work work) {
  out.enter(name);
  try {
    work();
  } catch (const std::exception& error) {
    std::printf("%s: %s\n", name.c_str(), error.what());
  }
}

/// Fields from one vertex.
template <class Domain>
void fields(Writer& out, const Domain& domain, Index source,
            const std::vector<std::pair<const char*, Accuracy>>& accuracies = {
                {"field", Accuracy::usual()}}) {
  for (const auto& [name, accuracy] : accuracies) {
    PropagateOptions options;
    options.accuracy = accuracy;
    out.array(name, solve(Serial{}, domain, PointSource::at(source), options).distance);
  }
}

std::vector<double> flat(const std::vector<std::array<double, 3>>& positions) {
  std::vector<double> numbers;
  for (const auto& p : positions) numbers.insert(numbers.end(), p.begin(), p.end());
  return numbers;
}

/// One that something is at.
template <class Simplices>
Index first_of(const Simplices& simplices) {
  return simplices.empty() ? 0 : simplices[0][0];
}

template <class Real>
void surfaces(Writer& out, const std::string& name, const Surface& s) {
  const std::string real = sizeof(Real) == 4 ? " float" : " double";
  attempt(out, name + real, [&] {
    const TriangleMesh<Real> mesh(s.positions, s.faces);
    add(out, mesh);
    fields(out, mesh, first_of(s.faces),
           {{"fast", Accuracy::fast()}, {"accurate", Accuracy::usual()}});
    if (sizeof(Real) == 8) fields(out, mesh, first_of(s.faces), {{"exact", Accuracy::exact()}});
  });
  attempt(out, name + " complex" + real, [&] {
    const SimplicialComplex<Real, 2> complex(flat(s.positions), 3, s.faces);
    fields(out, complex, first_of(s.faces));
  });
  attempt(out, name + " samples" + real, [&] {
    SurfaceHints hints;
    hints.samples = true;
    add(out, TriangleMesh<Real>(s.positions, s.faces, hints));
  });
  std::vector<std::array<double, 3>> lengths;
  bool sound = true;
  for (const auto& f : s.faces)
    for (const Index v : f) sound = sound && v < s.positions.size();
  if (!sound) return;
  lengths = testing::lengths_of(s);
  attempt(out, name + " lengths" + real,
          [&] { add(out, TriangleMesh<Real>(s.positions.size(), s.faces, lengths)); });
  std::mt19937 random(3);
  auto uneven = lengths;  // which breaks the triangle inequality here and there
  for (auto& row : uneven)
    for (double& l : row) l *= 1 + 1.2 * testing::uniform(random);
  attempt(out, name + " uneven" + real,
          [&] { add(out, TriangleMesh<Real>(s.positions.size(), s.faces, uneven)); });
  attempt(out, name + " refracting" + real, [&] {
    SurfaceHints hints;
    hints.refracts = true;
    add(out, TriangleMesh<Real>(s.positions.size(), s.faces, uneven, hints));
  });
  attempt(out, name + " delaunay" + real, [&] {
    const TriangleMesh<double> input(s.positions, s.faces);
    const IntrinsicDelaunay delaunay(input);
    add(out, delaunay.mesh<Real>());
    out.array("flips",
              std::vector<std::size_t>{delaunay.summary().flips, delaunay.summary().stuck_edges});
    std::vector<double> mapped;
    for (Index f = 0; f < s.faces.size(); f += 1 + static_cast<Index>(s.faces.size() / 999)) {
      const PointSource p = delaunay.to_intrinsic(PointSource::in(f, {0.2, 0.5, 0.3}));
      mapped.insert(mapped.end(), {double(p.simplex), p.barycentric[0], p.barycentric[1]});
      const PointSource q = delaunay.to_input(PointSource::in(f, {0.2, 0.5, 0.3}));
      mapped.insert(mapped.end(), {double(q.simplex), q.barycentric[0], q.barycentric[1]});
    }
    out.array("mapped", mapped);
  });
  attempt(out, name + " refined" + real, [&] {
    const TriangleMesh<Real> input(s.positions, s.faces);
    add(out, IntrinsicDelaunay(input, Refinement::moderate()).template mesh<Real>());
  });
}

template <class Real>
void solids(Writer& out, const std::string& name, const Solid& s) {
  const std::string real = sizeof(Real) == 4 ? " float" : " double";
  attempt(out, name + real, [&] {
    const TetMesh<Real> mesh(s.positions, s.tets);
    add(out, mesh);
    fields(out, mesh, first_of(s.tets));
  });
  attempt(out, name + " complex" + real, [&] {
    const SimplicialComplex<Real, 3> complex(flat(s.positions), 3, s.tets);
    fields(out, complex, first_of(s.tets));
  });
  for (const auto& t : s.tets)
    for (const Index v : t)
      if (v >= s.positions.size()) return;
  const auto lengths = s.lengths();
  attempt(out, name + " lengths" + real,
          [&] { add(out, TetMesh<Real>(s.positions.size(), s.tets, lengths)); });
  std::mt19937 random(5);
  auto uneven = lengths;
  for (auto& row : uneven)
    for (double& l : row) l *= 1 + 0.2 * testing::uniform(random);
  attempt(out, name + " uneven" + real,
          [&] { add(out, TetMesh<Real>(s.positions.size(), s.tets, uneven)); });
}

void surface(Writer& out, const std::string& name, const Surface& s) {
  surfaces<float>(out, name, s);
  surfaces<double>(out, name, s);
}
void solid(Writer& out, const std::string& name, const Solid& s) {
  solids<float>(out, name, s);
  solids<double>(out, name, s);
}

std::string exponent(double x) { return std::to_string(std::lround(std::log10(x))); }

template <class Shape>
Shape scaled(Shape s, double by) {
  for (auto& p : s.positions)
    for (double& x : p) x *= by;
  return s;
}

void made_surfaces(Writer& out) {
  namespace t = testing;
  surface(out, "grid", t::grid(13, 9));
  surface(out, "slit", t::slit_square(8));
  surface(out, "polygon", t::random_polygon(7, 200, 500, 1));
  surface(out, "cube", t::cube(5));
  surface(out, "tetrahedron", t::tetrahedron());
  surface(out, "sphere", t::sphere(4));
  surface(out, "prism", t::prism(7, 5, 2));
  surface(out, "moebius", t::moebius(31, 3));
  for (Index n : {1u, 2u, 3u, 5u}) surface(out, "sheets" + std::to_string(n), t::sheets(n, 4));
  surface(out, "bow_tie", t::bow_tie(4));
  for (unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u})
    surface(out, "soup" + std::to_string(seed),
            t::soup(8 + 12 * seed, seed % 2 ? 15 * seed : 60 * seed, seed));
  surface(out, "renamed", t::renamed(t::sphere(3), 4, true, true).surface);
  surface(out, "renamed moebius", t::renamed(t::moebius(20, 2), 5, true, true).surface);
  surface(out, "renamed sheets", t::renamed(t::sheets(4, 5), 6, true, true).surface);
  surface(out, "renamed tie", t::renamed(t::bow_tie(5), 7, true, true).surface);
  for (double by : {1e-300, 1e-160, 1e-30, 1e30, 1e150, 1e300, 1e308})
    surface(out, "scaled " + exponent(by), scaled(t::sphere(2), by));
  // No area, no length, next to none.
  Surface thin = t::grid(6, 6);
  for (auto& p : thin.positions) p[1] *= 1e-9;
  surface(out, "thin", thin);
  for (auto& p : thin.positions) p[1] = 0;
  surface(out, "flat", thin);
  for (auto& p : thin.positions) p = {1, 2, 3};
  surface(out, "point", thin);
  Surface uneven = t::grid(9, 9);
  std::mt19937 random(9);
  for (auto& p : uneven.positions)
    for (double& x : p) x += std::pow(10, -12 * t::uniform(random)) * (t::uniform(random) - 0.5);
  for (std::size_t v = 0; v + 7 < uneven.positions.size(); v += 7)
    uneven.positions[v] = uneven.positions[v + 1];
  surface(out, "uneven", uneven);
  Surface spare = t::grid(3, 3);
  spare.positions.insert(spare.positions.begin(), {5, 5, 5});
  for (auto& f : spare.faces)
    for (Index& v : f) ++v;
  spare.add(7, 7);
  spare.faces.push_back(spare.faces[3]);  // twice the same
  spare.faces.push_back({spare.faces[4][0], spare.faces[4][2], spare.faces[4][1]});
  surface(out, "spare", spare);
  Surface dense = t::sphere(3);  // many faces in one cell of the curve
  for (std::size_t f = 0; f < dense.positions.size(); f += 2)
    for (double& x : dense.positions[f]) x *= 1e-6;
  surface(out, "dense", dense);
  Surface bad = t::grid(2, 2);
  bad.faces[3][1] = 99;
  surface(out, "out of range", bad);
  bad = t::grid(2, 2);
  bad.faces[3][1] = bad.faces[3][2];
  surface(out, "twice", bad);
  bad = t::grid(2, 2);
  bad.positions[4][2] = std::numeric_limits<double>::quiet_NaN();
  surface(out, "nan", bad);
  bad.faces.clear();
  surface(out, "none", bad);
}

void made_solids(Writer& out) {
  namespace t = testing;
  solid(out, "cube", t::solid_cube(5));
  solid(out, "straight cube", t::solid_cube(4, 0));
  solid(out, "l", t::l_shape(3));
  solid(out, "straight l", t::l_shape(4, 0));
  solid(out, "walled", t::walled(4));
  solid(out, "straight walled", t::walled(4, 0));
  solid(out, "edge", t::edge_touch(3));
  solid(out, "vertex", t::vertex_touch(3));
  solid(out, "pipe", t::pipe(7, 2, 4));
  for (double by : {1e-300, 1e-30, 1e30, 1e300, 1e308})
    solid(out, "scaled " + exponent(by), scaled(t::l_shape(2), by));
  Solid turned = t::walled(3);
  std::mt19937 random(2);
  for (auto& tet : turned.tets) {
    std::shuffle(tet.begin(), tet.end(), random);
  }
  std::shuffle(turned.tets.begin(), turned.tets.end(), random);
  solid(out, "turned", turned);
  Solid flat = t::l_shape(3);
  for (auto& p : flat.positions) p[2] *= 1e-9;
  solid(out, "thin", flat);
  for (auto& p : flat.positions) p[2] = 0;
  solid(out, "flat", flat);
  Solid some = t::solid_cube(4, 0);
  for (std::size_t v = 0; v < some.positions.size(); v += 5)
    some.positions[v] = some.positions[(v + 1) % some.positions.size()];
  solid(out, "collapsed", some);
  // Tetrahedra taken out at random: edges and vertices where others only touch.
  for (unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    Solid holes = t::solid_cube(4);
    std::mt19937 chance(seed);
    std::erase_if(holes.tets, [&](const auto&) { return t::uniform(chance) < 0.15 * seed; });
    solid(out, "holes" + std::to_string(seed), holes);
  }
  Solid bad = t::solid_cube(2);
  bad.tets.push_back(bad.tets[3]);
  solid(out, "twice", bad);
  bad = t::solid_cube(2);
  bad.tets[3][1] = 999;
  solid(out, "out of range", bad);
  bad = t::solid_cube(2);
  bad.tets[3][1] = bad.tets[3][2];
  solid(out, "corner twice", bad);
  bad = t::solid_cube(2);
  bad.positions.push_back({0.5, 0.5, 9});
  bad.tets.push_back({bad.tets[0][0], bad.tets[0][1], bad.tets[0][2],
                      static_cast<Index>(bad.positions.size() - 1)});
  solid(out, "same side", bad);
}

void made_stacks(Writer& out) {
  std::mt19937 random(1);
  for (int n = 0; n < 8; ++n)
    attempt(out, "stack" + std::to_string(n), [&] {
      const samples::Stack stack = samples::random_stack(random, 20, .1, 1.5);
      const samples::StackDomain whole(stack);
      fields(out, whole.domain, 0);
    });
}

void file(Writer& out, const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".node" || extension == ".ele" || extension == ".mesh") {
    const auto read = io::read_tets(path);
    solid(out, name, {read.positions, read.tets});
  } else {
    const auto read = io::read_triangles(path);
    surface(out, name, {read.positions, read.triangles});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Writer out;
  made_surfaces(out);
  made_solids(out);
  made_stacks(out);
  for (int i = 1; i < argc; ++i) file(out, argv[i]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_digest: %s\n", error.what());
  return 1;
}
