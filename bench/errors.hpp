#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include <plexway/common/ids.hpp>

namespace bench {

using plexway::Index;

struct Truth {
  Index source = 0;
  std::vector<double> distance;  ///< one a vertex; NaN where not known
};

/// Relative errors, pooled over sources. `wrong` counts what has no error in per cent: NaN, a
/// finite distance where no path leads, +inf where one does, a source that is not at 0.
class Errors {
 public:
  /// `found` may go on after the vertices.
  template <class Found>
  void add(const Truth& truth, const Found& found) {
    for (std::size_t v = 0; v < truth.distance.size(); ++v) {
      const double exact = truth.distance[v], d = static_cast<double>(found[v]);
      if (std::isnan(exact)) continue;
      if (std::isfinite(exact) && std::isfinite(d) && exact > 0)
        signed_.push_back(d / exact - 1);
      else if (d != exact)  // both +inf, or both 0, are right
        ++wrong_;
    }
  }

  struct Summary {
    double mean, p99, max;
    double most_below;  ///< most negative signed error; 0 if there is none
    std::size_t wrong;
  };

  [[nodiscard]] std::optional<Summary> summary() const {
    if (signed_.empty()) return std::nullopt;
    std::vector<double> size(signed_.size());
    std::transform(signed_.begin(), signed_.end(), size.begin(),
                   [](double e) { return std::abs(e); });
    std::sort(size.begin(), size.end());
    const double count = static_cast<double>(size.size());
    const auto rank = static_cast<std::size_t>(std::ceil(0.99 * count)) - 1;
    return Summary{std::accumulate(size.begin(), size.end(), 0.0) / count, size[rank], size.back(),
                   std::min(0.0, *std::min_element(signed_.begin(), signed_.end())), wrong_};
  }

 private:
  std::vector<double> signed_;
  std::size_t wrong_ = 0;
};

}  // namespace bench
