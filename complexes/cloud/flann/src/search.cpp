#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
#include <flann/util/result_set.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "complexes/common/geometry.hpp"
#include "search.hpp"

namespace plexway::flann {

using namespace detail;
namespace {

using Offset = std::array<double, 3>;

// The direction in which offsets spread most, by powers of their second moments.
Offset widest_direction(std::span<const Offset> offsets) {
  std::array<Offset, 3> m{};
  for (const Offset& q : offsets)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += q[i] * q[j];
  for (int round = 0; round < 6; ++round) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (!(trace > 0)) return {1, 0, 0};
    std::array<Offset, 3> square{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) square[i][j] += m[i][k] / trace * (m[k][j] / trace);
    m = square;
  }
  std::size_t row = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (m[i][i] > m[row][row]) row = i;
  return unit(m[row]);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

using Distance = ::flann::L2_3D<double>;

// The nearest so far, sorted. FLANN's own sets copy more than that.
class Nearest final : public ::flann::ResultSet<double> {
 public:
  Nearest(std::vector<Found>& found, const std::vector<Index>& points, std::size_t self,
          std::size_t k, double squared_radius)
      : found_(found), points_(points), self_(self), k_(k), worst_(squared_radius) {
    found_.clear();
  }
  bool full() const override { return true; }
  // FLANN offers what is nearer than worstDist(), in any order: so of equals at the end of the row
  // the lower number stays only if worstDist() is a little more than theirs.
  void addPoint(double squared, std::size_t index) override {
    if (index == self_) return;
    const Found next{squared, points_[index], static_cast<Index>(index)};
    if (k_ == 0) {
      found_.push_back(next);
      return;
    }
    if (found_.size() == k_) {
      if (!(next < found_.back())) return;
      found_.pop_back();
    }
    found_.push_back(next);
    std::size_t i = found_.size() - 1;
    for (; i > 0 && next < found_[i - 1]; --i) found_[i] = found_[i - 1];
    found_[i] = next;
    if (found_.size() == k_) worst_ = std::nextafter(found_.back().squared, infinity);
  }
  double worstDist() const override { return worst_; }

 private:
  std::vector<Found>& found_;
  const std::vector<Index>& points_;
  std::size_t self_, k_;
  double worst_;
};

}  // namespace

RowOfPoints::RowOfPoints(std::span<const Offset> offsets) {
  constexpr std::size_t least = 6;  // fewer tell nothing
  if (offsets.size() < least) return;
  along_ = widest_direction(offsets);
  reach_ = std::sqrt(dot(offsets.back(), offsets.back()));
  // A row is narrow, and the next one just within reach, if at all. On a rim neither is so.
  constexpr double nearest = 0.8, narrow = 0.15;
  Offset first{}, across;
  std::size_t beside = 0;
  double width = 0, length = 0;  // squares
  for (const Offset& q : offsets) {
    if (!is_beside(q, across)) {
      width += dot(across, across);
      length += dot(q, q);
      continue;
    }
    if (dot(q, q) < nearest * nearest * reach_ * reach_) return;
    if (beside++ == 0) first = across;
    if (dot(first, across) < 0) return;  // on both sides
  }
  found_ = beside <= offsets.size() / 5 && width < narrow * narrow * length;
}

// Farther across the row than along it, and not by noise alone.
bool RowOfPoints::is_beside(const Offset& offset, Offset& across) const {
  const double along = dot(along_, offset);
  for (std::size_t d = 0; d < 3; ++d) across[d] = offset[d] - along * along_[d];
  const double off = std::sqrt(dot(across, across));
  return off > std::abs(along) && off > reach_ / 3;
}

std::size_t RowOfPoints::needed(std::span<const Offset> offsets, bool any) const {
  constexpr double more = 1.25;  // of the distance of the first: a few of each row
  Offset first{}, across;
  bool one = false;
  for (const Offset& q : offsets) {
    if (!is_beside(q, across)) continue;
    if (one && !any && dot(first, across) >= 0) continue;
    if (!one) first = across;
    if (!one && !any) {
      one = true;
      continue;
    }
    const double square = more * more * dot(q, q);
    std::size_t count = 0;
    while (count < offsets.size() && dot(offsets[count], offsets[count]) <= square) ++count;
    return count;
  }
  return 0;
}

struct Search::Tree {
  explicit Tree(std::vector<std::array<double, 3>>& points)
      : index(::flann::Matrix<double>(points.data()->data(), points.size(), 3),
              ::flann::KDTreeSingleIndexParams(12, true)) {
    index.buildIndex();
  }
  ::flann::KDTreeSingleIndex<Distance> index;
};

Search::Search(std::span<const std::array<double, 3>> points, DistinctPoints places)
    : places_(std::move(places)) {
  // By a power of two to about 1, so that no square leaves the range of a double.
  double largest = 0;
  for (const auto& p : points)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  scale_ = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
  scaled_.reserve(places_.order.size());
  for (const Index i : places_.order)
    scaled_.push_back({points[i][0] * scale_, points[i][1] * scale_, points[i][2] * scale_});
  if (!scaled_.empty()) tree_ = std::make_unique<Tree>(scaled_);
}

Search::~Search() = default;

void Search::around(std::size_t i, std::size_t k, double radius, std::vector<Found>& found) const {
  // Up to and with the radius: FLANN asks for less than.
  const double reach =
      std::nextafter(radius * scale_ * (radius * scale_), std::numeric_limits<double>::infinity());
  Nearest nearest(found, places_.order, i, k, reach);
  tree_->index.findNeighbors(nearest, scaled_[i].data(), ::flann::SearchParams(-1, 0.0f, true));
  if (k == 0) std::sort(found.begin(), found.end());
}

}  // namespace plexway::flann
