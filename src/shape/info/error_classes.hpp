#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <plexway/shape/shape.hpp>

#include "shape/info/report.hpp"

namespace plexway::detail {

/// Where errors come from: relative errors at the vertices, split in several ways, each of them
/// into a few classes. For surfaces and solids.
class ErrorClasses {
 public:
  /// Cost: one pass over the domain. Throws UsageError for other kinds of domain.
  explicit ErrorClasses(const AnyShape& domain);

  /// One field and its truth, a number a vertex; what is not finite or 0 in truth does not count.
  /// `source` is where distances are from: in solids, errors are also split by how much longer than
  /// a straight line the exact path is.
  void add(std::span<const double> distance, std::span<const double> truth,
           const std::array<double, 3>& source);

  /// An array of {split, class, vertices, mean, above, below, share}: errors as shares of the exact
  /// distance, `above` and `below` their parts of either sign, `share` that of the class in the
  /// sum.
  [[nodiscard]] Json json() const;
  /// The same for people.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr std::size_t splits = 6, most_classes = 6;
  struct Sum {
    std::size_t vertices = 0;
    double above = 0, below = 0;
  };

  void count(std::size_t split, std::size_t part, double error);
  [[nodiscard]] double slope(std::size_t simplex, std::span<const double> truth) const;
  [[nodiscard]] std::string class_name(std::size_t split, std::size_t part) const;

  const AnyShape& domain_;
  bool solid_;
  std::vector<unsigned char> shape_, curvature_;  // classes of vertices
  std::vector<unsigned char> ridge_;              // reused: is the vertex at the cut locus?
  double mean_edge_ = 0;
  std::array<std::array<Sum, most_classes>, splits> sum_{};
};

}  // namespace plexway::detail
