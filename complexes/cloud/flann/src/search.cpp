#include "search.hpp"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
#include <flann/util/result_set.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plexway::flann {
namespace {

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
