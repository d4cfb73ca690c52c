#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace plexway {

/// Reads the right answers: one number a line in vertex order, NaN where there is none ("nan"
/// lines), +inf where no path leads ("inf"). Empty lines at the end do not count.
/// Throws InputError "FILE:LINE: cause", also when there are not `vertices` of them.
std::vector<double> read_truth(const std::string& file, std::size_t vertices);

/// Relative errors of distances, gathered over several fields.
class ErrorGauge {
 public:
  /// Vertices whose truth is 0 (the source) or NaN do not count.
  void add(std::span<const double> distance, std::span<const double> truth);

  [[nodiscard]] std::size_t compared() const { return relative_.size(); }
  /// Vertices that only one of the two reaches.
  [[nodiscard]] std::size_t mismatched_unreached() const { return mismatched_; }

  // Of |distance - truth| / truth; NaN where nothing was compared.
  [[nodiscard]] double mean() const;
  /// Linear between the two nearest ranks.
  [[nodiscard]] double percentile(double percent) const;
  [[nodiscard]] double max() const;
  /// The most negative signed error; 0 where no distance is too short.
  [[nodiscard]] double most_below() const;

 private:
  std::vector<double> relative_;  // signed
  std::size_t mismatched_ = 0;
};

}  // namespace plexway
