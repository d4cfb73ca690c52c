#include <plexway/complex/intrinsic_delaunay.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <plexway/error.hpp>

#include "complex/delaunay_flips.hpp"
#include "complex/intrinsic_triangulation.hpp"
#include "complex/triangle_shape.hpp"

namespace plexway {
namespace {

// An edge is Delaunay up to this, as a sine.
template <class Real>
constexpr double tolerance_of = sizeof(Real) == 4 ? 1e-5 : 1e-11;

void check_face(Index face, std::size_t faces) {
  if (face >= faces)
    throw UsageError("face " + std::to_string(face) + " does not exist: there are " +
                     std::to_string(faces));
}

void check(const Refinement& wanted) {
  if (!(wanted.smallest_angle >= 0 && wanted.smallest_angle < 60))
    throw UsageError("smallest_angle of a refinement must be 0 degrees or more, and less than 60");
  if (!(wanted.most_vertices >= 0 && std::isfinite(wanted.most_vertices)))
    throw UsageError("most_vertices of a refinement must be 0 or more, and finite");
  if (!(wanted.shortest_edge >= 0))
    throw UsageError("shortest_edge of a refinement must be 0 or more");
}

// Edges of the input that are none any more: straight lines still. Slots that nothing happened to
// have theirs.
template <class Real>
std::vector<SurfaceChord> lost_edges(const TriangleMesh<Real>& input,
                                     const IntrinsicTriangulation& now) {
  std::vector<Index> outer(input.vertex_count());
  for (Index v = 0; v < outer.size(); ++v) outer[input.inside_vertex(v)] = v;
  std::vector<SurfaceChord> then, there;
  const auto add = [](std::vector<SurfaceChord>& to, Index v, Index w, double length) {
    if (v != w) to.push_back({std::min(v, w), std::max(v, w), length});
  };
  for (Index v = 0; input.has_chords() && v < outer.size(); ++v)
    for (const auto& chord : input.chords_at(v))
      if (v < chord.vertex)
        add(then, outer[v], outer[chord.vertex], static_cast<double>(chord.length));
  for (Index s = 0; s < now.triangles().size(); ++s) {
    const IntrinsicTriangle& t = now.triangles()[s];
    bool same = s < input.face_count();
    if (same) {
      const TriangleRecord<Real>& before = input.triangles()[s];
      for (std::size_t i = 0; i < 3; ++i)
        same &= outer[before.corner[i]] == t.corner[i] &&
                static_cast<double>(before.length[i]) == t.length[i];
      for (std::size_t i = 0; i < 3 && !same; ++i)
        add(then, outer[before.corner[i]], outer[before.corner[edge_after(i)]],
            static_cast<double>(before.length[i]));
    }
    for (std::size_t i = 0; i < 3 && !same; ++i)
      add(there, t.corner[i], t.corner[edge_after(i)], t.length[i]);
  }
  const auto less = [](const SurfaceChord& a, const SurfaceChord& b) {
    return std::tie(a.from, a.to, a.length) < std::tie(b.from, b.to, b.length);
  };
  // Of several between the same ends the shortest counts.
  const auto shortest = [&](std::vector<SurfaceChord>& all) {
    std::sort(all.begin(), all.end(), less);
    all.erase(std::unique(all.begin(), all.end(),
                          [](const SurfaceChord& a, const SurfaceChord& b) {
                            return a.from == b.from && a.to == b.to;
                          }),
              all.end());
  };
  shortest(then);
  shortest(there);
  auto known = there.begin();
  std::erase_if(then, [&](const SurfaceChord& chord) {
    while (known != there.end() &&
           std::tie(known->from, known->to) < std::tie(chord.from, chord.to))
      ++known;
    return known != there.end() && known->from == chord.from && known->to == chord.to &&
           known->length <= chord.length * (1 + 1e-12);
  });
  return then;
}

}  // namespace

struct IntrinsicDelaunay::State {
  IntrinsicTriangulation triangulation;
  std::vector<Index> face_of_slot;  // the caller's
  std::vector<Index> slot_of_face;
  std::size_t faces = 0;  // of the input
  bool refracts = false;
  double unit = 1;
  std::vector<std::array<double, 3>> positions;  // of the input's vertices, where known
  std::vector<SurfaceChord> chords;
  DelaunaySummary summary;

  template <class Real>
  explicit State(const TriangleMesh<Real>& input)
      : triangulation(input),
        face_of_slot(input.face_count()),
        slot_of_face(input.face_count()),
        faces(input.face_count()),
        refracts(input.summary().refracting_edges > 0),
        unit(input.unit()) {
    for (Index s = 0; s < face_of_slot.size(); ++s) {
      face_of_slot[s] = input.triangles()[s].face & ~reversed;
      slot_of_face[face_of_slot[s]] = s;
    }
    if (input.positions().empty()) return;
    positions.resize(input.vertex_count());
    for (Index v = 0; v < positions.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i)
        positions[v][i] = input.positions()[input.inside_vertex(v)][i] * unit;
  }

  /// Vertices that were put in lie in space as well, where the input's triangles do.
  template <class Real>
  void place_inserted(const TriangleMesh<Real>& input) {
    if (!input.faces_are_in_space()) return;
    for (const SlotPoint& point : triangulation.inserted()) {
      const TriangleRecord<Real>& t = input.triangles()[point.slot];
      // A slot that was turned over for good has its corners the other way round.
      const bool over = ((t.face & reversed) != 0) != triangulation.turned(point.slot);
      std::array<double, 3>& at = positions.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          at[k] += point.at[over && i > 0 ? 3 - i : i] * input.positions()[t.corner[i]][k] * unit;
    }
  }

  [[nodiscard]] SlotPoint slot_point(Index face, const std::array<double, 4>& b) const {
    SlotPoint point{slot_of_face[face], {b[0], b[1], b[2]}};
    if (triangulation.turned(point.slot)) std::swap(point.at[1], point.at[2]);
    return point;
  }
  [[nodiscard]] std::array<double, 3> in_face(Index slot, std::array<double, 3> at) const {
    if (triangulation.turned(slot)) std::swap(at[1], at[2]);
    return at;
  }
};

template <class Real>
IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<Real>& input, const Refinement& refinement)
    : state_((check(refinement), std::make_unique<State>(input))) {
  IntrinsicTriangulation& triangulation = state_->triangulation;
  DelaunayFlips flips(triangulation, tolerance_of<Real>);
  flips.all();
  if (refinement.smallest_angle > 0) refine(triangulation, flips, refinement);
  state_->summary = {flips.count(), flips.stuck(), triangulation.inserted().size()};
  triangulation.release_counts();
  state_->place_inserted(input);
  state_->chords = lost_edges(input, triangulation);
  for (SurfaceChord& chord : state_->chords) chord.length *= state_->unit;
  for (Index s = static_cast<Index>(input.face_count()); s < triangulation.triangles().size();
       ++s) {
    state_->face_of_slot.push_back(s);
    state_->slot_of_face.push_back(s);
  }
}
template IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<float>&, const Refinement&);
template IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<double>&, const Refinement&);

IntrinsicDelaunay::IntrinsicDelaunay(IntrinsicDelaunay&&) noexcept = default;
IntrinsicDelaunay& IntrinsicDelaunay::operator=(IntrinsicDelaunay&&) noexcept = default;
IntrinsicDelaunay::~IntrinsicDelaunay() = default;

const DelaunaySummary& IntrinsicDelaunay::summary() const { return state_->summary; }

std::size_t IntrinsicDelaunay::bytes() const {
  return sizeof(State) + state_->triangulation.bytes() +
         (state_->face_of_slot.capacity() + state_->slot_of_face.capacity()) * sizeof(Index) +
         state_->positions.capacity() * sizeof(state_->positions[0]) +
         state_->chords.capacity() * sizeof(SurfaceChord);
}

template <class Real>
TriangleMesh<Real> IntrinsicDelaunay::mesh(const SaddleThresholds& saddles) const {
  const auto triangles = state_->triangulation.triangles();
  const std::size_t m = triangles.size();
  std::vector<std::array<Index, 3>> faces(m), across(m);
  std::vector<TriangleShape> shapes(m);
  const auto face_of = [&](Index slot) { return state_->face_of_slot[slot]; };
  for (Index s = 0; s < m; ++s) {
    const IntrinsicTriangle& t = triangles[s];
    const Index f = face_of(s);
    faces[f] = t.corner;
    TriangleShape& shape = shapes[f];
    shape.violated = false;
    for (std::size_t i = 0; i < 3; ++i) {
      shape.length[i] = t.length[i] * state_->unit;
      shape.cosine[i] = t.angle[i].c;
      shape.sine[i] = t.angle[i].s;
      shape.degenerate |= t.length[i] == 0 || t.angle[i].s < 1e-14;
      const Index o = t.across[i];
      across[f][i] =
          o == none ? none : 3 * face_of(o >> Across::face_shift) + (o & Across::edge_mask);
    }
  }
  SurfaceHints hints;
  hints.refracts = state_->refracts;
  hints.positions = state_->positions;
  hints.chords = state_->chords;
  hints.saddles = saddles;
  // New triangles lie behind all others: they need a new order.
  if (state_->summary.inserted_vertices == 0) hints.order = state_->face_of_slot;
  return TriangleMesh<Real>(state_->triangulation.vertices(), faces, shapes, std::move(across),
                            hints);
}
template TriangleMesh<float> IntrinsicDelaunay::mesh(const SaddleThresholds&) const;
template TriangleMesh<double> IntrinsicDelaunay::mesh(const SaddleThresholds&) const;

PointSource IntrinsicDelaunay::to_intrinsic(const PointSource& point) const {
  if (point.vertex != none) return point;
  check_face(point.simplex, state_->faces);
  const SlotPoint there =
      state_->triangulation.history().forward(state_->slot_point(point.simplex, point.barycentric));
  // A slot that nothing happened to has its corners as they were.
  PointSource result = PointSource::in(state_->face_of_slot[there.slot], there.at);
  result.offset = point.offset;
  return result;
}

PointSource IntrinsicDelaunay::to_input(const PointSource& point) const {
  SlotPoint there;
  if (point.vertex != none) {
    const auto inserted = state_->triangulation.inserted();
    const std::size_t own = state_->triangulation.vertices() - inserted.size();
    if (point.vertex < own || point.vertex - own >= inserted.size()) return point;
    there = inserted[point.vertex - own];
  } else {
    check_face(point.simplex, state_->slot_of_face.size());
    there = state_->triangulation.history().back(
        {state_->slot_of_face[point.simplex],
         {point.barycentric[0], point.barycentric[1], point.barycentric[2]}});
  }
  PointSource result =
      PointSource::in(state_->face_of_slot[there.slot], state_->in_face(there.slot, there.at));
  result.offset = point.offset;
  return result;
}

std::vector<IntrinsicDelaunay::Piece> IntrinsicDelaunay::line_to_input(
    Index face, const std::array<double, 3>& from, const std::array<double, 3>& to) const {
  check_face(face, state_->slot_of_face.size());
  std::vector<PatchHistory::Piece> pieces;
  state_->triangulation.history().back({state_->slot_of_face[face], from, to}, pieces);
  std::vector<Piece> result;
  for (const auto& p : pieces)
    result.push_back({state_->face_of_slot[p.slot], state_->in_face(p.slot, p.from),
                      state_->in_face(p.slot, p.to)});
  return result;
}

template <class Real>
TriangulationShape measure_triangulation(const TriangleMesh<Real>& mesh) {
  TriangulationShape shape;
  const auto triangles = mesh.triangles();
  const Index sentinel = static_cast<Index>(triangles.size() - 1);
  constexpr double degree = std::numbers::pi / 180;
  const Real blunt = static_cast<Real>(std::cos(150 * degree));
  const Real sharp = static_cast<Real>(std::cos(5 * degree));
  Real least = 1, most = -1;
  std::size_t blunt_ones = 0, needles = 0;
  for (Index f = 0; f < sentinel; ++f) {
    const TriangleRecord<Real>& t = triangles[f];
    const Real low = std::min({t.cosine[0], t.cosine[1], t.cosine[2]});
    const Real high = std::max({t.cosine[0], t.cosine[1], t.cosine[2]});
    least = std::min(least, low);
    most = std::max(most, high);
    blunt_ones += low < blunt;
    needles += high > sharp;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index o = t.across[i], g = o >> Across::face_shift;
      if (g == sentinel || (o & Across::fan) != 0 || g < f) continue;
      const std::size_t j = o & Across::edge_mask;
      if (g == f && j < i) continue;
      ++shape.inner_edges;
      const Real ca = t.cosine[edge_before(i)], cb = triangles[g].cosine[edge_before(j)];
      const Real sine = t.sine(edge_before(i)) * cb + ca * triangles[g].sine(edge_before(j));
      constexpr Real blur = sizeof(Real) == 4 ? Real(1e-4) : Real(1e-9);
      if (g != f && (sine < -blur || (ca < -blur && cb < -blur))) ++shape.non_delaunay_edges;
    }
  }
  const auto degrees = [](Real cosine) {
    return std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0)) / degree;
  };
  shape.largest_angle = degrees(least);
  shape.smallest_angle = degrees(most);
  shape.blunt_share = static_cast<double>(blunt_ones) / static_cast<double>(sentinel);
  shape.needle_share = static_cast<double>(needles) / static_cast<double>(sentinel);
  return shape;
}
template TriangulationShape measure_triangulation(const TriangleMesh<float>&);
template TriangulationShape measure_triangulation(const TriangleMesh<double>&);

Retriangulation what_pays(const TriangulationShape& shape) {
  if (shape.needle_share > 0.1) return Retriangulation::refined;
  return shape.non_delaunay_share() > 0.04 ? Retriangulation::flips : Retriangulation::keep;
}

Refinement refinement_for(Retriangulation wanted) {
  return wanted == Retriangulation::refined ? Refinement::moderate() : Refinement();
}

}  // namespace plexway
