#include <plexway/complex/point_cloud.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <plexway/complex/distinct_points.hpp>
#include <plexway/error.hpp>

#include "complex/cloud_bridges.hpp"
#include "complex/gluing.hpp"
#include "complex/umbrella.hpp"
#include "complex/umbrella_sheet.hpp"

namespace plexway {
namespace {

using Points = std::span<const Point3>;
using Triangle = std::array<Index, 3>;

void check_input(Points points, const Neighbours& neighbours, const CloudOptions& options) {
  if (points.empty()) throw InputError("the cloud has no points");
  if (neighbours.point_count() != points.size())
    throw InputError(std::to_string(points.size()) + " points with neighbours of " +
                     std::to_string(neighbours.point_count()));
  if (!options.normals.empty() && options.normals.size() != points.size())
    throw InputError(std::to_string(points.size()) + " points with " +
                     std::to_string(options.normals.size()) + " normals");
  check(neighbours);
  if (!(options.max_normal_angle > 0 && options.max_normal_angle <= 180))
    throw UsageError("the largest angle between normals must be > 0 and <= 180 degrees");
  if (!(options.widest_circle > 0) || !(options.widest_boundary_circle > 0))
    throw UsageError("the widest circle must be > 0 spacings");
}

// Neighbours between places: points that are not the first at theirs are left out.
Places places_of(Points points, const Neighbours& neighbours, const DistinctPoints& distinct) {
  const std::size_t n = distinct.order.size();
  std::vector<Index> place(points.size());
  for (std::size_t p = 0; p < n; ++p) place[distinct.order[p]] = static_cast<Index>(p);
  const auto of = [&](Index point) { return place[distinct.first[point]]; };
  // What the twins of a place have as neighbours counts, too.
  std::vector<std::array<Index, 2>> more;  // place, neighbour
  for (Index i = 0; i < points.size(); ++i)
    if (distinct.first[i] != i)
      for (const Index j : neighbours.around(i))
        if (of(i) != of(j)) more.push_back({of(i), of(j)});
  std::sort(more.begin(), more.end());

  Places places;
  places.at.reserve(n);
  places.near.begin.reserve(n + 1);
  places.near.begin.push_back(0);
  places.near.of.reserve(neighbours.of.size());
  std::size_t next = 0;
  for (Index p = 0; p < n; ++p) {
    places.at.push_back(points[distinct.order[p]]);
    const std::size_t start = places.near.of.size();
    const auto row = [&] { return std::span<const Index>(places.near.of).subspan(start); };
    const auto add = [&](Index q, bool twins) {
      if (q == p) return;
      if (twins && std::find(row().begin(), row().end(), q) != row().end()) return;
      places.near.of.push_back(q);
    };
    for (const Index j : neighbours.around(distinct.order[p])) add(of(j), points.size() > n);
    for (; next < more.size() && more[next][0] == p; ++next) add(more[next][1], true);
    places.near.begin.push_back(static_cast<Index>(places.near.of.size()));
  }
  return places;
}

std::vector<Point3> normals_of(Points normals, const DistinctPoints& distinct) {
  std::vector<Point3> result;
  if (normals.empty()) return result;
  result.reserve(distinct.order.size());
  for (const Index i : distinct.order) result.push_back(normals[i]);
  return result;
}

// A cloud of one place, or of places that are all alone: the mesh still needs a triangle.
void add_stub(Places& places, SheetWedges& sheet) {
  const Index n = static_cast<Index>(places.at.size());
  for (int i = 0; i < 2; ++i) {
    places.at.push_back(Point3(places.at[0]));
    sheet.add_place();
  }
  sheet.add({0, n, n + 1});
}

struct Sheet {
  std::vector<Point3> more;  // places that are no points
  std::vector<Triangle> faces;
  std::vector<std::array<double, 3>> lengths;  // empty: as in space
};

double tangent_length(const Places& places, std::span<const TangentFrame> frames, Index a,
                      Index b) {
  const Point3 q = minus(places.at[b], places.at[a]);
  const double square = dot(q, q);
  if (a >= frames.size() || b >= frames.size()) return std::sqrt(square);
  const auto &m = frames[a].normal, &n = frames[b].normal;
  // On a smooth surface an edge leaves both tangent planes to the same side: nothing along the mean
  // normal. What there is, is noise; unless the normals differ much, as across an edge of a solid.
  const double cosine = dot(m, n);
  constexpr double most = 0.9;  // 25 degrees
  if (std::abs(cosine) < most) return std::sqrt(square);
  Point3 mean;
  for (std::size_t d = 0; d < 3; ++d)
    mean[d] = static_cast<double>(m[d]) +
              std::copysign(static_cast<double>(n[d]), cosine * static_cast<double>(n[d]));
  const double along = dot(mean, q);
  return std::sqrt(std::max(square - along * along / dot(mean, mean), 0.0));
}

std::size_t boundary_places(const SheetWedges& sheet, std::size_t places) {
  std::size_t count = 0;
  for (Index p = 0; p < places; ++p) {
    bool open = false;
    sheet.around(p, [&](const SheetWedges::Wedge& w) {
      open = open || sheet.only_triangle(p, w.a) != none || sheet.only_triangle(p, w.b) != none;
    });
    count += open;
  }
  return count;
}

void count_parts(const CloudParts& parts, const DistinctPoints& distinct, CloudSummary& summary) {
  std::vector<std::size_t> points(parts.part.size(), 0), places(parts.part.size(), 0);
  std::vector<Index> place(distinct.first.size());
  for (Index p = 0; p < distinct.order.size(); ++p) place[distinct.order[p]] = p;
  for (const Index first : distinct.first) ++points[parts.part[place[first]]];
  for (const Index part : parts.part) ++places[part];
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p] > 0) summary.component_sizes.push_back(points[p]);
    summary.isolated_points += places[p] == 1;
  }
  std::sort(summary.component_sizes.rbegin(), summary.component_sizes.rend());
  summary.components = summary.component_sizes.size();
  summary.largest_component = summary.component_sizes[0];
  summary.bridges = parts.bridges;
}

void count_pairs(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
                 CloudSummary& summary) {
  double spacing = 0;
  for (Index i = 0; i < places.near.point_count(); ++i) {
    spacing += static_cast<double>(frames[i].spacing);
    for (const Index j : places.near.around(i)) {
      const auto back = places.near.around(j);
      if (j < i && std::find(back.begin(), back.end(), i) != back.end()) continue;
      ++summary.neighbour_pairs;
      summary.refused_pairs += !same_sheet(places, frames, rule, i, j);
    }
  }
  summary.mean_spacing = spacing / static_cast<double>(places.near.point_count());
}

Sheet make_sheet(Points points, const Neighbours& neighbours, const CloudOptions& options,
                 CloudSummary& summary, std::vector<std::array<Index, 2>>& twins) {
  const double angle = options.max_normal_angle * std::numbers::pi / 180;
  const SheetRule rule = {std::sin(angle / 2), std::cos(angle), !options.normals.empty()};
  double done = 0;
  const auto share = [&](double part) {
    return [&options, from = done, part](double s) {
      return !options.progress || options.progress(from + part * s);
    };
  };
  const DistinctPoints distinct = distinct_points(points);
  Places places = places_of(points, neighbours, distinct);
  const std::size_t n = places.at.size();
  std::vector<TangentFrame> frames = tangent_frames(places, normals_of(options.normals, distinct),
                                                    rule, options.threads, share(0.1));
  done = 0.1;
  SheetWedges sheet(places, frames);
  add_umbrellas(
      local_umbrellas(places, frames, rule, options.widest_circle, options.threads, share(0.5)),
      options.threads, sheet);
  done = 0.6;
  fill_holes(options.widest_circle, sheet);
  trim_boundary(options.widest_boundary_circle, sheet);
  const CloudParts parts = bridge_parts(rule, frames, places, sheet);
  if (sheet.triangles().empty()) add_stub(places, sheet);
  if (options.progress && !options.progress(0.7))
    throw Cancelled("stopped by the progress callback");

  summary.points = points.size();
  summary.distinct = n;
  summary.duplicates = points.size() - n;
  count_pairs(places, frames, rule, summary);
  count_parts(parts, distinct, summary);
  summary.boundary_points = boundary_places(sheet, n);

  Sheet result;
  result.more.assign(places.at.begin() + static_cast<std::ptrdiff_t>(n), places.at.end());
  for (const Triangle& t : sheet.triangles())
    if (t[0] != none) result.faces.push_back(t);
  summary.triangles = result.faces.size();
  // Along the curve that the places lie along.
  const auto before = [](const Triangle& a, const Triangle& b) {
    return std::min({a[0], a[1], a[2]}) < std::min({b[0], b[1], b[2]});
  };
  std::stable_sort(result.faces.begin(), result.faces.end(), before);
  if (options.tangent_lengths)
    for (const Triangle& t : result.faces)
      result.lengths.push_back({tangent_length(places, frames, t[0], t[1]),
                                tangent_length(places, frames, t[1], t[2]),
                                tangent_length(places, frames, t[2], t[0])});
  for (Triangle& t : result.faces)
    for (Index& v : t) v = v < n ? distinct.order[v] : static_cast<Index>(points.size() + (v - n));
  for (Index i = 0; i < points.size(); ++i)
    if (distinct.first[i] != i) twins.push_back({i, distinct.first[i]});
  return result;
}

template <class Real>
TriangleMesh<Real> mesh_of(Points points, Sheet&& sheet) {
  std::vector<Index> order(sheet.faces.size());
  std::iota(order.begin(), order.end(), Index{0});
  const SurfaceHints hints = {.order = order, .samples = true};
  if (!sheet.lengths.empty()) {
    const std::size_t vertices = points.size() + sheet.more.size();
    return TriangleMesh<Real>(vertices, sheet.faces, sheet.lengths,
                              glue_by_vertices(vertices, sheet.faces), hints);
  }
  if (sheet.more.empty()) return TriangleMesh<Real>(points, sheet.faces, hints);
  std::vector<Point3> all(points.begin(), points.end());
  all.insert(all.end(), sheet.more.begin(), sheet.more.end());
  return TriangleMesh<Real>(all, sheet.faces, hints);
}

}  // namespace

template <class Real>
PointCloud<Real>::PointCloud(Points points, const Neighbours& neighbours,
                             const CloudOptions& options)
    : surface_((check_input(points, neighbours, options),
                mesh_of<Real>(points, make_sheet(points, neighbours, options, summary_, twins_)))) {
  if (options.progress) options.progress(1);
}

template <class Real>
std::size_t PointCloud<Real>::bytes() const {
  return sizeof(*this) - sizeof(surface_) + surface_.bytes() +
         twins_.capacity() * sizeof(twins_[0]) +
         summary_.component_sizes.capacity() * sizeof(std::size_t);
}

template <class Real>
Index PointCloud<Real>::of_point(Index point) const {
  const auto at = std::lower_bound(twins_.begin(), twins_.end(), std::array<Index, 2>{point, 0});
  return at != twins_.end() && (*at)[0] == point ? (*at)[1] : point;
}

template class PointCloud<float>;
template class PointCloud<double>;

}  // namespace plexway
