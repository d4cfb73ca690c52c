#include <plexway/cloud/point_cloud.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <plexway/common/distinct_points.hpp>
#include <plexway/error.hpp>

#include "complexes/cloud/sheet.hpp"
#include "complexes/cloud/umbrella.hpp"
#include "complexes/common/arrays.hpp"
#include "complexes/common/nearby.hpp"
#include "complexes/surface/gluing.hpp"

namespace plexway {
using namespace detail;
namespace {

using Points = std::span<const Point3>;
using Corners3 = std::array<Index, 3>;

constexpr double deepest_notch = 0.35;  // spacings

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

// A power of two that brings coordinates to about 1: then no square leaves the range of a number.
double scale_of(Points points) {
  double largest = 0;
  for (const Point3& p : points)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

Point3 times(double scale, const Point3& p) { return {scale * p[0], scale * p[1], scale * p[2]}; }

// Points may be in any order: what is read of them soon, in three steps of which each needs what
// the one before it brought.
void fetch_ahead(Points points, const Neighbours& neighbours, std::span<const Index> order,
                 std::span<const Index> place, std::size_t p) {
  constexpr std::size_t first = 24, second = 16, third = 8;
  if (p + first >= order.size()) return;
  __builtin_prefetch(&neighbours.begin[order[p + first]]);
  __builtin_prefetch(&points[order[p + first]]);
  const auto row = neighbours.around(order[p + second]);
  for (std::size_t k = 0; k < row.size(); k += 16) __builtin_prefetch(&row[k]);
  for (const Index j : neighbours.around(order[p + third])) __builtin_prefetch(&place[j]);
}

// Neighbours between places: points that are not the first at theirs are left out.
Places places_of(Points points, double scale, const Neighbours& neighbours,
                 const DistinctPoints& distinct) {
  const std::size_t n = distinct.order.size();
  std::vector<Index> place(points.size());
  for (std::size_t p = 0; p < n; ++p) place[distinct.order[p]] = static_cast<Index>(p);
  for (Index i = 0; i < points.size() && points.size() > n; ++i)
    if (distinct.first[i] != i) place[i] = place[distinct.first[i]];
  const auto of = [&](Index point) { return place[point]; };
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
  places.near.of.resize(neighbours.of.size() + more.size());
  Index* const all = places.near.of.data();
  std::size_t end = 0, next = 0;
  const bool twins = points.size() > n;
  for (Index p = 0; p < n; ++p) {
    fetch_ahead(points, neighbours, distinct.order, place, p);
    places.at.push_back(times(scale, points[distinct.order[p]]));
    const std::size_t start = end;
    const auto add_once = [&](Index q) {
      if (q != p && std::find(all + start, all + end, q) == all + end) all[end++] = q;
    };
    for (const Index j : neighbours.around(distinct.order[p]))
      if (twins)
        add_once(of(j));
      else
        all[end++] = of(j);
    for (; next < more.size() && more[next][0] == p; ++next) add_once(more[next][1]);
    places.near.begin.push_back(static_cast<Index>(end));
  }
  places.near.of.resize(end);
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
void add_placeholder(Places& places, SheetWedges& sheet) {
  const Index n = static_cast<Index>(places.at.size());
  for (int i = 0; i < 2; ++i) {
    places.at.push_back(Point3(places.at[0]));
    sheet.add_place();
  }
  sheet.add({0, n, n + 1});
}

struct Sheet {
  std::vector<Point3> more;  // places that are no points
  std::vector<Corners3> faces;
  std::vector<std::array<double, 3>> lengths;  // empty: as in space
};

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
  summary.joints = parts.joints;
}

void count_pairs(const Places& places, std::span<const TangentFrame> frames,
                 CloudSummary& summary) {
  double spacing = 0;
  for (Index i = 0; i < places.near.point_count(); ++i) {
    spacing += static_cast<double>(frames[i].spacing);
    for (const Index j : places.near.around(i)) summary.neighbour_pairs += j > i;
  }
  summary.mean_spacing = spacing / static_cast<double>(places.near.point_count());
}

// Along the curve that the places lie along: by the first of each triangle's places.
std::vector<Corners3> along_places(std::span<const Corners3> faces, std::size_t places) {
  const auto first_of = [](const Corners3& t) { return std::min({t[0], t[1], t[2]}); };
  std::vector<Index> begin;
  std::vector<Corners3> sorted;
  fill_rows(places, begin, sorted, [&](const auto& add) {
    for (const Corners3& t : faces) add(first_of(t), t);
  });
  return sorted;
}

Sheet make_sheet(Points points, const Neighbours& neighbours, const CloudOptions& options,
                 CloudSummary& summary, std::vector<std::array<Index, 2>>& twins,
                 std::vector<Point3>& more) {
  const double angle = options.max_normal_angle * std::numbers::pi / 180;
  // A chord of a circle makes half the angle with the tangents at its ends that these make with
  // each other. It is measured at the rms distance of 16 neighbours: farther ones may be no higher.
  constexpr double rms_of_spacing = 1.6;
  const SheetRule rule = {rms_of_spacing * std::sin(angle / 2), std::cos(angle),
                          !options.normals.empty()};
  double done = 0;
  const auto share = [&](double part) {
    return [&options, from = done, part](double s) {
      return !options.progress || options.progress(from + part * s);
    };
  };
  const DistinctPoints equal = distinct_points(points);
  const double scale = scale_of(points);
  Places places = places_of(points, scale, neighbours, equal);
  DistinctPoints distinct = equal;
  // Asked of places, which lie beside their neighbours; points lie anywhere.
  if (equal.order.size() < points.size() || may_have_near_twins(places.at, places.near)) {
    distinct = without_near_twins(points, neighbours, equal);
    if (distinct.order.size() < equal.order.size())
      places = places_of(points, scale, neighbours, distinct);
  }
  const std::size_t n = places.at.size();
  std::vector<TangentFrame> frames = tangent_frames(places, normals_of(options.normals, distinct),
                                                    rule, options.threads, share(0.1));
  done = 0.1;
  SheetWedges sheet(places, frames, rule);
  {
    const Umbrellas umbrellas =
        local_umbrellas(places, frames, rule, options.widest_circle, options.threads, share(0.5));
    summary.refused_pairs = umbrellas.refused;
    set_reach(places, umbrellas, options.threads, frames);
    add_umbrellas(umbrellas, options.threads, sheet);
  }
  done = 0.6;
  fill_holes(options.widest_circle, sheet);
  close_tears(options.widest_boundary_circle, sheet);
  const std::vector<Index> torn = torn_places(options.widest_boundary_circle, sheet);
  trim_boundary(options.widest_boundary_circle, sheet);
  fill_notches(deepest_notch, sheet);
  widen_boundary_saddles(places, frames, rule, sheet);
  const CloudParts parts = bridge_parts(rule, frames, places, sheet);
  if (sheet.triangles().empty()) add_placeholder(places, sheet);
  if (options.progress && !options.progress(0.7))
    throw Cancelled("stopped by the progress callback");

  summary.points = points.size();
  summary.distinct = n;
  summary.duplicates = points.size() - n;
  summary.near_duplicates = equal.order.size() - n;
  count_pairs(places, frames, summary);
  count_parts(parts, distinct, summary);
  summary.mean_spacing /= scale;
  for (Index p = 0; p < n; ++p) summary.boundary_points += sheet.open(p);
  summary.torn_points = torn.size();
  for (const Index p : torn) summary.first_torn = std::min(summary.first_torn, distinct.order[p]);

  Sheet result;
  for (std::size_t p = n; p < places.at.size(); ++p)
    result.more.push_back(times(1 / scale, places.at[p]));
  for (const Corners3& t : sheet.triangles())
    if (t[0] != none) result.faces.push_back(t);
  summary.triangles = result.faces.size();
  result.faces = along_places(result.faces, places.at.size());
  const HeightNoise noise = height_noise(places, frames);
  summary.noise = noise.height / scale;
  const double flat = options.lengths == EdgeLengths::in_space     ? 0
                      : options.lengths == EdgeLengths::tangential ? 1
                                                                   : noise.share;
  // Noise everywhere, and enough of it to hide how sharp a ridge is.
  constexpr double least_noise = 0.02;
  const double height = summary.noise / summary.mean_spacing;
  const bool noisy = options.lengths == EdgeLengths::automatic && noise.share >= 1;
  const double hidden = noisy && height > least_noise ? height : 0;
  result.lengths = sheet_lengths(places, frames, rule, result.faces, flat, hidden);
  const std::vector<Index> chords =
      chord_places(places, frames, rule, result.faces, result.lengths, height, hidden);
  summary.chord_points = chords.size();
  for (const Index p : chords)
    summary.first_chord = std::min(summary.first_chord, distinct.order[p]);
  for (auto& lengths : result.lengths)
    for (double& l : lengths) l /= scale;
  for (Corners3& t : result.faces)
    for (Index& v : t) v = v < n ? distinct.order[v] : static_cast<Index>(points.size() + (v - n));
  for (Index i = 0; i < points.size(); ++i)
    if (distinct.first[i] != i) twins.push_back({i, distinct.first[i]});
  more = result.more;
  return result;
}

template <class Real>
TriangleMesh<Real> mesh_of(Points points, int threads, Sheet&& sheet) {
  std::vector<Index> order(sheet.faces.size());
  std::iota(order.begin(), order.end(), Index{0});
  const SurfaceHints hints = {.order = order, .samples = true, .threads = threads};
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
PointCloud<Real>::PointCloud(const GivenPoints& points, const Neighbours& neighbours,
                             const CloudOptions& options)
    : surface_((check_input(points, neighbours, options),
                mesh_of<Real>(points, options.threads,
                              make_sheet(points, neighbours, options, summary_, twins_, more_)))) {
  if (options.progress) options.progress(1);
}

template <class Real>
std::size_t PointCloud<Real>::bytes() const {
  return sizeof(*this) - sizeof(surface_) + surface_.bytes() +
         twins_.capacity() * sizeof(twins_[0]) + more_.capacity() * sizeof(more_[0]) +
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
