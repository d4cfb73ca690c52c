#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include <plexway/error.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/mixed/joined_pieces.hpp"
#include "strings/mixed_strings.hpp"
#include "strings/to_field.hpp"

namespace plexway::detail {

// Whether a domain's pieces lie in one space, each simplex at a speed of its own, and the parts
// that they are there.
template <class Real>
class MixedSpace::Builder {
 public:
  explicit Builder(const MixedComplex<Real>& domain) : domain_(domain) {}

  bool takes_strings() {
    if (!has_solid() || !place()) return false;
    for (const auto& piece : domain_.pieces())
      if (!std::visit([&](const auto& complex) { return add(piece, complex); },
                      domain_.complex(piece)))
        return false;
    merge_speeds();
    return !is_one_solid() && facets() <= most_facets;
  }
  [[nodiscard]] const strings::Parts& parts() const { return parts_; }
  std::vector<Index> points() { return std::move(point_); }
  std::vector<Range> ranges() const {
    std::vector<Range> ranges;
    const auto tets = static_cast<Index>(parts_.tets.size()),
               faces = static_cast<Index>(parts_.faces.size());
    for (const auto& [first, begin, corners] : begin_)
      ranges.push_back({first, begin + (corners == 4 ? 0 : corners == 3 ? tets : tets + faces)});
    return ranges;
  }

 private:
  using Piece = typename MixedComplex<Real>::Piece;
  using Point = strings::Point;
  static constexpr double near = sizeof(Real) == 4 ? 2e-5 : 1e-7;
  static constexpr std::size_t most_facets = 24;

  [[nodiscard]] bool has_solid() const {
    return std::any_of(domain_.pieces().begin(), domain_.pieces().end(), [&](const Piece& p) {
      return std::holds_alternative<TetMesh<Real>>(domain_.complex(p));
    });
  }

  // Vertices that are one are one point; they must lie together.
  bool place() {
    DisjointSets sets(domain_.vertex_count());
    for (const auto& [v, w] : domain_.outer_welds()) sets.unite(v, w);
    double size = 0;
    for (const Piece& piece : domain_.pieces()) {
      const auto own = domain_.positions(piece);
      if (own.size() != piece.vertices) return false;
      for (const auto& p : own) {
        at_.push_back({p[0], p[1], p[2]});
        size = std::max(size, norm(at_.back() - at_.front()));
      }
    }
    point_.assign(domain_.vertex_count(), none);
    for (Index v = 0; v < point_.size(); ++v) {
      const Index r = sets.find(v);
      if (norm(at_[v] - at_[r]) > 1e-7 * size) return false;
      if (r == v) {
        point_[v] = static_cast<Index>(parts_.points.size());
        parts_.points.push_back(at_[v]);
      }
      point_[v] = point_[r];
    }
    return true;
  }

  // The time that a unit of length takes, if it is the same along all edges; else 0.
  template <std::size_t N>
  [[nodiscard]] double slowness(const std::array<Index, N>& vertex,
                                const std::array<double, N*(N - 1) / 2>& length) const {
    std::array<double, N*(N - 1) / 2> there;
    double sum = 0, sum_there = 0;
    std::size_t n = 0;
    for (std::size_t j = 1; j < N; ++j)
      for (std::size_t i = 0; i < j; ++i, ++n) {
        there[n] = norm(at_[vertex[i]] - at_[vertex[j]]);
        sum += length[n];
        sum_there += there[n];
      }
    if (!(sum > 0) || !(sum_there > 0)) return 0;
    for (n = 0; n < there.size(); ++n)
      if (!(std::abs(length[n] / sum - there[n] / sum_there) < near)) return 0;
    return sum / sum_there;
  }
  template <std::size_t N>
  bool add(std::array<Index, N> vertex, const std::array<double, N*(N - 1) / 2>& length,
           std::vector<std::array<Index, N>>& simplices, std::vector<double>& slow) {
    const double s = slowness(vertex, length);
    if (!(s > 0)) return false;
    for (Index& v : vertex) v = point_[v];
    simplices.push_back(vertex);
    slow.push_back(s);
    return true;
  }

  bool add(const Piece& piece, const TetMesh<Real>& solid) {
    begin_.push_back({piece.first_simplex, static_cast<Index>(parts_.tets.size()), 4});
    for (auto tet : tets_of(solid)) {
      std::array<double, 6> length;
      std::size_t n = 0;
      for (std::size_t j = 1; j < 4; ++j)
        for (std::size_t i = 0; i < j; ++i) {
          length[n++] = solid.unit() * norm(solid.points()[solid.inside_vertex(tet[i])] -
                                            solid.points()[solid.inside_vertex(tet[j])]);
        }
      for (Index& v : tet) v += piece.first_vertex;
      if (!add<4>(tet, length, parts_.tets, parts_.slow_tets)) return false;
    }
    return true;
  }
  bool add(const Piece& piece, const TriangleMesh<Real>& surface) {
    begin_.push_back({piece.first_simplex, static_cast<Index>(parts_.faces.size()), 3});
    const std::vector<Index> outer = outer_of(piece, surface);
    for (Index f = 0; f < piece.simplices; ++f) {
      const auto [inside, turned] = surface.inside_face(f);
      const auto& t = surface.triangles()[inside];
      std::array<Index, 3> face = {outer[t.corner[0]], outer[t.corner[1]], outer[t.corner[2]]};
      std::array<double, 3> length = {double(t.length[0]), double(t.length[2]),
                                      double(t.length[1])};
      for (double& l : length) l *= surface.unit();
      if (turned) {
        std::swap(face[1], face[2]);
        std::swap(length[0], length[1]);
      }
      if (!add<3>(face, length, parts_.faces, parts_.slow_faces)) return false;
    }
    return true;
  }
  bool add(const Piece& piece, const Wireframe<Real>& wires) {
    begin_.push_back({piece.first_simplex, static_cast<Index>(parts_.edges.size()), 2});
    const std::vector<Index> outer = outer_of(piece, wires);
    for (Index e = 0; e < piece.simplices; ++e) {
      const auto ends = wires.inside_edge(e);
      if (!add<2>({outer[ends.from], outer[ends.to]}, {double(ends.length) * wires.unit()},
                  parts_.edges, parts_.slow_edges))
        return false;
    }
    return true;
  }
  template <class Complex>
  static std::vector<Index> outer_of(const Piece& piece, const Complex& complex) {
    std::vector<Index> outer(piece.vertices);
    for (Index v = 0; v < piece.vertices; ++v)
      outer[complex.inside_vertex(v)] = piece.first_vertex + v;
    return outer;
  }

  // Speeds that differ by rounding are one.
  void merge_speeds() {
    std::vector<double*> all;
    for (auto* list : {&parts_.slow_tets, &parts_.slow_faces, &parts_.slow_edges})
      for (double& s : *list) all.push_back(&s);
    std::sort(all.begin(), all.end(), [](const double* a, const double* b) { return *a < *b; });
    for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
      double sum = 0;
      for (double last = *all[i]; j < all.size() && *all[j] <= last * (1 + near); ++j) {
        last = *all[j];
        sum += last;
      }
      const double mean = sum / static_cast<double>(j - i);
      for (std::size_t k = i; k < j; ++k) *all[k] = mean;
    }
  }

  // Solids of one speed that are joined to one are solved as that.
  [[nodiscard]] bool is_one_solid() const {
    if (!parts_.faces.empty() || !parts_.edges.empty()) return false;
    const auto& slow = parts_.slow_tets;
    if (std::adjacent_find(slow.begin(), slow.end(), std::not_equal_to<>()) != slow.end())
      return false;
    const auto joined = domain_.joined();
    return (joined ? joined->domain : domain_).pieces().size() == 1;
  }

  // Flat parts of sheets that are folded: of one speed, with no more than two triangles at an edge.
  [[nodiscard]] std::size_t facets() const {
    struct Side {
      std::array<Index, 2> edge;
      Index face, corner;  // the corner opposite
    };
    std::vector<Side> sides;
    DisjointSets facet(parts_.faces.size());
    const std::vector<Index> covered = strings::covered_by(parts_);
    for (Index f = 0; f < parts_.faces.size(); ++f)
      for (std::size_t k = 0; k < 3 && covered[f] == none; ++k) {
        const Index a = parts_.faces[f][k], b = parts_.faces[f][(k + 1) % 3];
        sides.push_back({{std::min(a, b), std::max(a, b)}, f, parts_.faces[f][(k + 2) % 3]});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.face < b.face;
    });
    const auto off = [&](const Side& side) {
      const Point &a = parts_.points[side.edge[0]],
                  along = strings::unit(parts_.points[side.edge[1]] - a),
                  d = parts_.points[side.corner] - a;
      return strings::unit(d - dot(d, along) * along);
    };
    std::vector<Index> folded;
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      while (j < sides.size() && sides[j].edge == sides[i].edge) ++j;
      if (j - i != 2) continue;
      if (norm(off(sides[i]) + off(sides[i + 1])) > 1e-7)
        folded.insert(folded.end(), {sides[i].face, sides[i + 1].face});
      else
        facet.unite(sides[i].face, sides[i + 1].face);
    }
    for (Index& f : folded) f = facet.find(f);
    std::sort(folded.begin(), folded.end());
    return static_cast<std::size_t>(std::unique(folded.begin(), folded.end()) - folded.begin());
  }

  const MixedComplex<Real>& domain_;
  strings::Parts parts_;
  std::vector<Point> at_;     // of vertices
  std::vector<Index> point_;  // likewise
  struct Begin {
    Index first, begin, corners;
  };
  std::vector<Begin> begin_;  // of pieces
};

template <class Real>
std::shared_ptr<const MixedSpace> MixedSpace::of(const MixedComplex<Real>& domain) {
  return domain.space().template get<MixedSpace>([&] {
    auto space = std::make_shared<MixedSpace>();
    Builder<Real> builder(domain);
    if (builder.takes_strings()) {
      space->point = builder.points();
      space->pieces_ = builder.ranges();
      try {
        space->media = std::make_unique<const strings::MediaSpace>(builder.parts());
      } catch (const InputError&) {  // solids that overlap are no space
      }
    }
    return std::shared_ptr<const MixedSpace>(std::move(space));
  });
}

template std::shared_ptr<const MixedSpace> MixedSpace::of(const MixedComplex<float>&);
template std::shared_ptr<const MixedSpace> MixedSpace::of(const MixedComplex<double>&);

namespace {

// Where a point of a simplex is a vertex of it.
Index corner_of(const strings::MediaSpace& media, Index simplex, const PointSource& point) {
  for (std::size_t i = 0; i < 4; ++i)
    if (point.barycentric[i] == 1) return media.simplices()[simplex].corner[i];
  return none;
}

// A point of these simplices, as one of each.
std::vector<strings::Inside> inside_of(const strings::MediaSpace& media, const strings::Point& at,
                                       std::span<const Index> simplices) {
  std::vector<strings::Inside> inside;
  for (const Index s : simplices) {
    const auto& simplex = media.simplices()[s];
    inside.push_back({s, simplex.medium, simplex.corner, media.beside(s, at)});
  }
  return inside;
}

strings::Source source_of(const MixedSpace& space, const PointSource& given,
                          std::vector<strings::Inside>& inside) {
  const strings::MediaSpace& media = *space.media;
  strings::Source source;
  source.offset = given.offset / media.unit();
  if (given.vertex != none) {
    source.point = space.point[given.vertex];
  } else {
    const Index simplex = space.simplex(given.simplex);
    source.point = corner_of(media, simplex, given);
    source.at = media.at(simplex, given.barycentric);
    if (source.point == none)
      source.inside = inside =
          inside_of(media, source.at, media.simplices_around(simplex, given.barycentric));
  }
  if (source.point != none) source.at = media.point(source.point);
  return source;
}

}  // namespace

template <class Real>
void MixedStrings::solve(const MixedComplex<Real>& domain, std::shared_ptr<const MixedSpace> space,
                         std::span<const PointSource> sources, const PropagateOptions& options,
                         const strings::Threads& threads, DistanceField<Real>& field) {
  const strings::MediaSpace& media = *space->media;
  if (!solver_ || space_ != space) {
    solver_ = std::make_unique<strings::Solver>(media);
    space_ = std::move(space);
  }
  sources_.clear();
  inside_.assign(sources.size(), {});
  for (const PointSource& s : sources)
    sources_.push_back(source_of(*space_, s, inside_[sources_.size()]));
  const double unit = media.unit();
  field.complete =
      solver_->solve(sources_, strings::limits_of(options, unit, domain.simplex_count(), threads));
  const auto number = [&](Index vertex) { return space_->point[vertex]; };
  strings::to_field(*solver_, domain.vertex_count(), number, unit, sources, options.radius, field);
  field.accuracy = Accuracy::accurate();
}

MixedStrings::Found MixedStrings::at(const PointSource& point) const {
  const std::lock_guard lock(asked_);
  const strings::MediaSpace& media = *space_->media;
  Index number;
  if (point.vertex != none) {
    number = space_->point[point.vertex];
  } else {
    const Index simplex = space_->simplex(point.simplex);
    number = corner_of(media, simplex, point);
    if (number == none) {
      number = static_cast<Index>(media.points());
      const strings::Point at = media.at(simplex, point.barycentric);
      const auto inside = inside_of(media, at, media.simplices_around(simplex, point.barycentric));
      std::vector<Index> own;  // sources that share one of these
      for (Index n = 0; n < inside_.size(); ++n)
        if (!inside_[n].empty()) own.push_back(n);
      solver_->attach(at, inside, own);
    }
  }
  const Index source = solver_->source(number);
  if (source == none) return {std::numeric_limits<double>::infinity(), none, {}, {}};
  auto [points, through] = solver_->path(number);
  return {solver_->distance(number) * media.unit(), source, std::move(points), std::move(through)};
}

std::size_t MixedStrings::bytes() const {
  return sizeof(*this) + (solver_ ? solver_->bytes() : 0) +
         sources_.capacity() * sizeof(strings::Source);
}

template void MixedStrings::solve(const MixedComplex<float>&, std::shared_ptr<const MixedSpace>,
                                  std::span<const PointSource>, const PropagateOptions&,
                                  const strings::Threads&, DistanceField<float>&);
template void MixedStrings::solve(const MixedComplex<double>&, std::shared_ptr<const MixedSpace>,
                                  std::span<const PointSource>, const PropagateOptions&,
                                  const strings::Threads&, DistanceField<double>&);

}  // namespace plexway::detail
