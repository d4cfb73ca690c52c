#include <plexway/surface/smoothing.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <plexway/common/blocks.hpp>
#include <plexway/error.hpp>

#include "complexes/cloud/neighbourhood.hpp"
#include "complexes/common/arrays.hpp"
#include "complexes/common/geometry.hpp"

namespace plexway {
using namespace detail;
namespace {

constexpr int terms = 6;
constexpr std::size_t fewest = terms + 2;  // points around: with fewer, a quadric meets them all
constexpr std::size_t smoothing_block = 1024;

using Terms = Eigen::Matrix<double, terms, 1>;

/// A surface over the tangent plane, of second order, that fits a neighbourhood best.
class Quadric {
 public:
  explicit Quadric(const Neighbourhood& around)
      : around_(around), frame_(fit_frame(around.offset, around.weight)) {
    Eigen::Matrix<double, terms, terms> products = Eigen::Matrix<double, terms, terms>::Zero();
    Terms heights = Terms::Zero();
    double sum = 1;
    products(0, 0) = 1;  // the point itself, at height 0
    for (std::size_t i = 0; i < around.offset.size(); ++i) {
      const Terms t = terms_at(around.offset[i]);
      const Terms weighted = around.weight[i] * t;
      products.noalias() += weighted * t.transpose();
      heights.noalias() += dot(around.offset[i], frame_.normal) * weighted;
      sum += around.weight[i];
    }
    // What the points do not determine, as along a line, is 0.
    for (int k = 1; k < terms; ++k) products(k, k) += 1e-9 * sum;
    factors_ = products.ldlt().solve(heights);
    if (!factors_.allFinite()) factors_.setZero();
  }

  /// The surface above the point, as an offset from it.
  [[nodiscard]] std::array<double, 3> foot() const {
    std::array<double, 3> to = frame_.normal;
    for (double& x : to) x *= factors_[0];
    return to;
  }

  /// How far points are off it, by their number corrected for the freedom the fit had.
  [[nodiscard]] double deviation() const {
    double squares = factors_[0] * factors_[0], sum = 1;
    for (std::size_t i = 0; i < around_.offset.size(); ++i) {
      const double off =
          dot(around_.offset[i], frame_.normal) - factors_.dot(terms_at(around_.offset[i]));
      squares += around_.weight[i] * off * off;
      sum += around_.weight[i];
    }
    const double count = static_cast<double>(around_.offset.size() + 1);
    return std::sqrt(squares / sum * count / (count - terms));
  }

 private:
  Terms terms_at(const std::array<double, 3>& offset) const {
    const double x = dot(offset, frame_.u) / around_.radius;
    const double y = dot(offset, frame_.v) / around_.radius;
    Terms t;
    t << 1, x, y, x * x, x * y, y * y;
    return t;
  }

  const Neighbourhood& around_;
  LocalFrame frame_;
  Terms factors_;
};

/// From how many points lie how near: the side of the square that each point has.
double spacing(const Neighbourhood& around) {
  const double count = static_cast<double>(around.offset.size());
  return std::sqrt(2 * std::numbers::pi * around.mean_square / count);
}

/// Squared, in a scale where its median is the square of the noise: the median of the chi-squared
/// distribution by Wilson and Hilferty.
double deviation2(const Neighbourhood& around) {
  const double freedom = static_cast<double>(around.offset.size() + 1 - terms);
  const double off = Quadric(around).deviation();
  return off * off / std::pow(1 - 2 / (9 * freedom), 3);
}

/// Of those that are not negative; 0 without any.
double known_median(std::vector<double>& values) {
  std::erase_if(values, [](double v) { return v < 0; });
  return values.empty() ? 0 : median(values);
}

}  // namespace

double noise_level(const GivenPoints& points, const Neighbours& neighbours, int threads) {
  check(points, neighbours);
  // Squares: of the deviation among the nearer half and among all, and of their radii in
  // proportion.
  std::vector<double> near(points.size(), -1), all = near, wider = near;
  for_blocks(points.size(), smoothing_block, threads, {}, [&](std::size_t first, std::size_t last) {
    Neighbourhood around;
    for (std::size_t i = first; i < last; ++i) {
      around.set_neighbours(points, neighbours, static_cast<Index>(i));
      if (around.offset.size() < fewest + 4 || !(around.radius > 0)) continue;
      const double unit = spacing(around);
      const double radius = around.mean_square;
      all[i] = deviation2(around) / (unit * unit);
      around.keep_nearest(std::max(fewest, around.offset.size() * 3 / 5));
      if (!(around.radius > 0)) continue;
      near[i] = deviation2(around) / (unit * unit);
      wider[i] = radius / around.mean_square;
    }
  });
  const double variance = known_median(near), spread = known_median(all),
               ratio = known_median(wider);
  if (!(variance > 0)) return 0;
  // Noise is the same at both scales. What a smooth surface has beyond second order grows with the
  // third power of the radius.
  const double growth = std::max(ratio * ratio * ratio, 2.0);
  return std::sqrt(std::max((growth * variance - spread) / (growth - 1), 0.0));
}

std::vector<std::array<double, 3>> smooth(const GivenPoints& points, const Neighbours& neighbours,
                                          const SmoothOptions& options) {
  check(points, neighbours);
  if (options.rounds < 0)
    throw UsageError(std::to_string(options.rounds) +
                     " rounds of smoothing: there are none below 0");
  std::vector<std::array<double, 3>> now(points.begin(), points.end());
  if (options.least_noise > 0 &&
      noise_level(points, neighbours, options.threads) < options.least_noise)
    return now;
  std::vector<std::array<double, 3>> next(now.size());
  for (int round = 0; round < options.rounds; ++round) {
    std::function<bool(double)> progress;
    if (options.progress)
      progress = [&](double share) { return options.progress((round + share) / options.rounds); };
    for_blocks(now.size(), smoothing_block, options.threads, progress,
               [&](std::size_t first, std::size_t last) {
                 Neighbourhood around;
                 for (std::size_t i = first; i < last; ++i) {
                   next[i] = now[i];
                   around.set_two_rings(now, neighbours, static_cast<Index>(i));
                   if (around.offset.size() < fewest || !(around.radius > 0)) continue;
                   const std::array<double, 3> foot = Quadric(around).foot();
                   for (std::size_t d = 0; d < 3; ++d) next[i][d] += foot[d];
                 }
               });
    now.swap(next);
  }
  return now;
}

}  // namespace plexway
