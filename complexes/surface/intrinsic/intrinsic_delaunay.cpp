#include <plexway/surface/intrinsic_delaunay.hpp>

#include <cmath>
#include <string>

#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/building_blocks.hpp"
#include "complexes/common/kept_archive.hpp"
#include "complexes/common/simplex_order.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/intrinsic/delaunay_flips.hpp"
#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"
#include "complexes/surface/shape_blocks.hpp"

namespace plexway {
using namespace detail;

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

// What a triangulation's triangles are to a mesh.
class ShapesOfSlots final : public TriangleShapes {
 public:
  ShapesOfSlots(std::span<const IntrinsicTriangle> triangles, std::span<const Index> slot_of_face,
                double unit)
      : triangles_(triangles), slot_of_face_(slot_of_face), unit_(unit) {}

  void look_up(std::span<const Index> faces, ShapeBlock& block) const override {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const IntrinsicTriangle& t = triangles_[slot_of_face_[faces[k]]];
      bool degenerate = false;
      for (std::size_t i = 0; i < 3; ++i) {
        block.length[i][k] = t.length[i] * unit_;
        block.cosine[i][k] = t.angle[i].c;
        block.sine[i][k] = t.angle[i].s;
        degenerate |= t.length[i] == 0 || t.angle[i].s < 1e-14;
      }
      block.degenerate[k] = degenerate;
      block.violated[k] = false;
    }
  }

 private:
  std::span<const IntrinsicTriangle> triangles_;
  std::span<const Index> slot_of_face_;
  double unit_;
};

}  // namespace

struct IntrinsicDelaunay::State {
  double unit = 1;
  IntrinsicTriangulation triangulation;
  Rows<Index> face_of_slot;  // the caller's
  Rows<Index> slot_of_face;
  std::size_t faces = 0;  // of the input
  bool refracts = false;
  bool released = false;                         // are the triangles gone?
  int threads = 0;                               // that make meshes
  std::vector<std::array<double, 3>> positions;  // of the vertices, where known
  // The caller's, while a mesh is made of them: where no vertex was put in they need no copy.
  std::span<const std::array<double, 3>> borrowed;
  std::vector<SurfaceChord> chords;
  DelaunaySummary summary;

  State() = default;
  template <class Real>
  State(const TriangleMesh<Real>& input, int by_threads)
      : unit(input.unit()),
        triangulation(input),
        faces(input.face_count()),
        refracts(input.summary().refracting_edges > 0),
        threads(by_threads) {
    std::vector<Index> face(faces), slot(faces);
    for (Index s = 0; s < faces; ++s) {
      face[s] = input.triangles()[s].face & ~reversed;
      slot[face[s]] = s;
    }
    face_of_slot = std::move(face);
    slot_of_face = std::move(slot);
    if (input.positions().empty()) return;
    positions.resize(input.vertex_count());
    for (Index v = 0; v < positions.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i)
        positions[v][i] = input.positions()[input.inside_vertex(v)][i] * unit;
  }

  // From what was before the flips: corners(slot) are a slot's, by the caller's vertices, and
  // whether they ran the other way.
  template <class CornersOf>
  void take_from_input(bool in_space, std::vector<SurfaceChord> lost, CornersOf corners) {
    if (in_space)  // vertices that were put in lie in space as well
      for (const SlotPoint& point : triangulation.inserted()) {
        const auto [corner, turned] = corners(point.slot);
        // A slot that was turned over for good has its corners the other way round.
        const bool over = turned != triangulation.turned(point.slot);
        std::array<double, 3> at{};
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k)
            at[k] += point.at[over && i > 0 ? 3 - i : i] * positions[corner[i]][k];
        positions.push_back(at);
      }
    chords = LostEdges::sorted(std::move(lost));
    for (SurfaceChord& chord : chords) chord.length *= unit;
  }

  template <class Real>
  void take_from_input(const TriangleMesh<Real>& input) {
    const std::vector<Index> outer = vertices_outside(input);
    const auto corners = [&](Index slot) {
      const TriangleRecord<Real>& t = input.triangles()[slot];
      return std::pair(std::array{outer[t.corner[0]], outer[t.corner[1]], outer[t.corner[2]]},
                       (t.face & reversed) != 0);
    };
    const LostEdges edges(triangulation, faces, threads);
    std::vector<SurfaceChord> lost;
    for (Index v = 0; input.has_chords() && v < outer.size(); ++v)
      for (const auto& chord : input.chords_at(v))
        if (v < chord.vertex)
          edges.look_at(outer[v], outer[chord.vertex], static_cast<double>(chord.length), lost);
    for (Index s = 0; s < faces; ++s) {
      if (!triangulation.history().changed(s)) continue;
      const auto corner = corners(s).first;
      const TriangleRecord<Real>& t = input.triangles()[s];
      for (std::size_t i = 0; i < 3; ++i)
        if (!edges.told_by_other_side(s, t.across[i]))
          edges.look_at(corner[i], corner[edge_after(i)], static_cast<double>(t.length[i]), lost);
    }
    take_from_input(input.faces_are_in_space(), std::move(lost), corners);
  }

  /// `layout` without what the constructor took of it.
  void take_from_input(const FaceLayout& layout, const TriangleShapes& shapes) {
    const std::vector<Index> outer = layout.vertices_outside(threads);
    const auto corners = [&](Index slot) {
      const auto& c = layout.corner[slot];
      return std::pair(std::array{outer[c[0]], outer[c[1]], outer[c[2]]}, layout.is_turned(slot));
    };
    const LostEdges edges(triangulation, faces, threads);
    std::vector<SurfaceChord> lost;
    const auto look = [&](std::size_t first, std::size_t last, std::vector<SurfaceChord>& own) {
      std::array<Index, ShapeBlock::size> slots, listed;
      ShapeBlock block{};
      for (Index s = static_cast<Index>(first); s < last;) {
        std::size_t count = 0;
        for (; s < last && count < slots.size(); ++s)
          if (triangulation.history().changed(s)) {
            slots[count] = s;
            listed[count++] = face_of_slot[s];
          }
        if (count == 0) break;
        shapes.look_up(std::span(listed).first(count), block);
        for (std::size_t k = 0; k < count; ++k) {
          const auto [corner, turned] = corners(slots[k]);
          for (std::size_t i = 0; i < 3; ++i)
            if (!edges.told_by_other_side(slots[k], layout.across[slots[k]][i]))
              edges.look_at(corner[i], corner[edge_after(i)],
                            block.length[turned ? 2 - i : i][k] / unit, own);
        }
      }
    };
    gather_blocks<std::vector<SurfaceChord>>(faces, threads, look,
                                             [&](const std::vector<SurfaceChord>& own) {
                                               lost.insert(lost.end(), own.begin(), own.end());
                                             });
    if (triangulation.inserted().empty())
      borrowed = shapes.positions();
    else
      positions.assign(shapes.positions().begin(), shapes.positions().end());
    take_from_input(!positions.empty(), std::move(lost), corners);
  }

  State(FaceLayout&& layout, const TriangleShapes& shapes, int by_threads)
      : triangulation(layout, shapes, unit, by_threads),
        face_of_slot(std::move(layout.face)),
        slot_of_face(std::move(layout.face_to_inside)),
        faces(face_of_slot.size()),
        threads(by_threads) {}

  template <class Real>
  void flip(const Refinement& refinement) {
    DelaunayFlips flips(triangulation, tolerance_of<Real>);
    flips.all(threads);
    if (refinement.smallest_angle > 0) refine(triangulation, flips, refinement);
    summary = {flips.count(), flips.stuck(), triangulation.inserted().size()};
    triangulation.settle();
    for (Index s = static_cast<Index>(faces); s < triangulation.triangles().size(); ++s) {
      face_of_slot.own().push_back(s);
      slot_of_face.own().push_back(s);
    }
  }

  /// Of a mesh whose triangles lie as the slots do: its numbers are these, and kept once.
  template <class Real>
  void share_numbers(TriangleMesh<Real>& mesh) {
    auto numbers = std::make_shared<const std::vector<Index>>(std::move(slot_of_face.own()));
    slot_of_face = {*numbers, numbers};
    mesh.face_to_inside_ = {*numbers, numbers};
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
IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<Real>& input, const Refinement& refinement,
                                     int threads)
    : state_((check(refinement), std::make_unique<State>(input, threads))) {
  state_->flip<Real>(refinement);
  state_->take_from_input(input);
}
template IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<float>&, const Refinement&, int);
template IntrinsicDelaunay::IntrinsicDelaunay(const TriangleMesh<double>&, const Refinement&, int);

IntrinsicDelaunay::IntrinsicDelaunay(IntrinsicDelaunay&&) noexcept = default;
IntrinsicDelaunay& IntrinsicDelaunay::operator=(IntrinsicDelaunay&&) noexcept = default;
IntrinsicDelaunay::~IntrinsicDelaunay() = default;

IntrinsicDelaunay::IntrinsicDelaunay() = default;

void IntrinsicDelaunay::release_triangles() {
  state_->triangulation.release_triangles();
  std::vector<std::array<double, 3>>().swap(state_->positions);
  state_->borrowed = {};
  std::vector<SurfaceChord>().swap(state_->chords);
  state_->released = true;
}

namespace detail {

template <>
struct KeptGap<SlotPoint> {
  static constexpr std::size_t begin = sizeof(Index), end = offsetof(SlotPoint, at);
};

template <class Archive, class Delaunay>
void KeptParts::each_of_delaunay(Archive& archive, Delaunay& delaunay) {
  auto& s = *delaunay.state_;
  archive(s.unit, s.face_of_slot, s.slot_of_face, s.faces, s.refracts, s.summary.flips,
          s.summary.stuck_edges, s.summary.inserted_vertices);
  auto& t = s.triangulation;
  archive(t.vertices_, t.turned_, t.inserted_, t.history_.patches_, t.history_.last_);
}

void KeptParts::keep(KeptOut& out, const IntrinsicDelaunay& delaunay) {
  each_of_delaunay(out, delaunay);
}

IntrinsicDelaunay KeptParts::open_delaunay(KeptIn& in, std::size_t triangles,
                                           std::size_t vertices) {
  IntrinsicDelaunay delaunay;
  delaunay.state_ = std::make_unique<IntrinsicDelaunay::State>();
  each_of_delaunay(in, delaunay);
  IntrinsicDelaunay::State& s = *delaunay.state_;
  s.released = true;
  const std::size_t slots = s.triangulation.history().slots();
  in.require(slots == triangles && s.triangulation.vertices() == vertices);
  in.require(s.faces > 0 && s.faces <= slots && s.face_of_slot.size() == slots &&
             s.slot_of_face.size() == slots);
  bool bad = s.triangulation.inserted().size() > s.triangulation.vertices();
  for (const Index slot : s.slot_of_face) bad |= slot >= slots;
  for (const Index face : s.face_of_slot) bad |= face >= slots;
  for (std::size_t f = 0; f < s.faces; ++f) bad |= s.slot_of_face[f] >= s.faces;
  for (const SlotPoint& point : s.triangulation.inserted()) bad |= point.slot >= s.faces;
  in.require(!bad && s.triangulation.history().sound(s.faces));
  return delaunay;
}

}  // namespace detail

const DelaunaySummary& IntrinsicDelaunay::summary() const { return state_->summary; }

std::size_t IntrinsicDelaunay::bytes() const {
  return sizeof(State) + state_->triangulation.bytes() +
         (state_->face_of_slot.capacity() + state_->slot_of_face.capacity()) * sizeof(Index) +
         state_->positions.capacity() * sizeof(state_->positions[0]) +
         state_->chords.capacity() * sizeof(SurfaceChord);
}

template <class Real>
TriangleMesh<Real> IntrinsicDelaunay::mesh(const SaddleThresholds& saddles) const {
  if (state_->released)
    throw UsageError("the triangles of this Delaunay triangulation were released");
  const auto triangles = state_->triangulation.triangles();
  const std::size_t m = triangles.size(), vertices = state_->triangulation.vertices();
  SurfaceHints hints;
  hints.refracts = state_->refracts;
  hints.positions = state_->borrowed.empty() ? state_->positions : state_->borrowed;
  hints.chords = state_->chords;
  hints.saddles = saddles;
  hints.threads = state_->threads;
  const ShapesOfSlots shapes(triangles, state_->slot_of_face, state_->unit);
  FaceLayout::Triples faces(m), across(m);
  if (state_->summary.inserted_vertices == 0) {
    over_blocks(m, hints.threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t s = first; s < last; ++s) {
        faces[s] = triangles[s].corner;
        for (std::size_t i = 0; i < 3; ++i) {
          const Index o = triangles[s].across[i];
          across[s][i] = o == none ? none : o & ~Across::special;
        }
      }
    });
    std::vector<Index> order(state_->face_of_slot.begin(), state_->face_of_slot.end());
    return {
        FaceLayout(vertices, std::move(order), std::move(faces), std::move(across), hints.threads),
        shapes, hints};
  }
  // New triangles lie behind all others: they need a new order.
  const auto face_of = [&](Index slot) { return state_->face_of_slot[slot]; };
  for (Index s = 0; s < m; ++s) {
    const IntrinsicTriangle& t = triangles[s];
    const Index f = face_of(s);
    faces[f] = t.corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index o = t.across[i];
      across[f][i] =
          o == none ? none : 3 * face_of(o >> Across::face_shift) + (o & Across::edge_mask);
    }
  }
  return {FaceLayout(vertices, faces, breadth_first<3>(across), across, hints.threads), shapes,
          hints};
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

Refinement refinement_for(Retriangulation wanted) {
  return wanted == Retriangulation::refined ? Refinement::moderate() : Refinement();
}

template <class Real>
TriangulatedSurface<Real> triangulate(const GivenPoints& positions, const GivenSimplices<3>& faces,
                                      std::optional<Retriangulation> wanted, int threads) {
  SurfaceHints hints;
  hints.threads = threads;
  FaceLayout layout = lay_out(positions, faces, {}, threads);
  const ShapesInSpace shapes(positions, faces);
  const Retriangulation done =
      wanted ? *wanted : what_pays(measure_triangulation<Real>(layout, shapes, threads));
  if (done == Retriangulation::keep)
    return {TriangleMesh<Real>(std::move(layout), shapes, hints), std::nullopt, done};
  IntrinsicDelaunay delaunay;
  delaunay.state_ = std::make_unique<IntrinsicDelaunay::State>(std::move(layout), shapes, threads);
  delaunay.state_->template flip<double>(refinement_for(done));
  delaunay.state_->take_from_input(layout, shapes);
  layout = {};
  const DelaunaySummary& summary = delaunay.summary();
  const bool same = summary.flips + summary.inserted_vertices == 0;
  if (same) delaunay.release_triangles();
  TriangleMesh<Real> mesh =
      same ? TriangleMesh<Real>(positions, faces, hints) : delaunay.mesh<Real>();
  if (!same) delaunay.release_triangles();
  if (!same && summary.inserted_vertices == 0) delaunay.state_->share_numbers(mesh);
  return {std::move(mesh), std::move(delaunay), done};
}
template TriangulatedSurface<float> triangulate(const GivenPoints&, const GivenSimplices<3>&,
                                                std::optional<Retriangulation>, int);
template TriangulatedSurface<double> triangulate(const GivenPoints&, const GivenSimplices<3>&,
                                                 std::optional<Retriangulation>, int);

}  // namespace plexway
