#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <plexway/fields/evolution.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// A surface with exact answers.
struct TuningSurface {
  /// For messages.
  std::string name;
  /// n, in any unit.
  std::vector<std::array<double, 3>> positions;
  /// Triangles of vertices < n.
  std::vector<std::array<Index, 3>> faces;
  /// The exact field of one source.
  struct Truth {
    Index source;                  ///< a vertex
    std::vector<double> distance;  ///< one a vertex; NaN where not known, +inf where no path leads
  };
  /// At least one.
  std::vector<Truth> truths;
};

/// Surfaces that a policy is judged by, each from each of its sources; single precision.
///
/// The same result with any number of threads: fields are computed at once, and summed in order.
class TuningSet {
 public:
  /// `automatic`: on the triangles that `what_pays` chooses, as the tool does; else on those given.
  /// `threads`: 0 for all cores. Throws UsageError for no surface, one without truth, or a truth
  /// that does not fit; InputError "NAME: cause" as TriangleMesh.
  TuningSet(std::vector<TuningSurface> surfaces, bool automatic, std::size_t threads = 0);
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  TuningSet(TuningSet&&) noexcept;
  /// Likewise.
  TuningSet& operator=(TuningSet&&) noexcept;
  ~TuningSet();

  /// Fields, that is pairs of a surface and a source.
  [[nodiscard]] std::size_t fields() const;
  /// Of everything that the errors depend on, but the policy.
  [[nodiscard]] std::uint64_t digest() const;

  /// Makes the surfaces anew, with other thresholds.
  /// Cost: that of building all surfaces, on all threads.
  void rebuild(const SaddleThresholds& saddles);
  /// The mean absolute relative error of each field. A vertex that is reached and should not be, or
  /// the other way round, counts as an error of 1; vertices with truth 0 do not count.
  /// Throws as `solve`. Cost: a solve by Serial each, on all threads.
  [[nodiscard]] std::vector<double> errors(const PropagateOptions& options) const;
  /// The mean over all fields, so that a small surface counts as much as a large one.
  /// Throws and costs as `errors`.
  [[nodiscard]] double mean_error(const PropagateOptions& options) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The numbers of a ProbeTable, as an evolution takes them: three thresholds, six shares.
[[nodiscard]] std::vector<EvolvedParameter> probe_parameters();
/// A table as those nine numbers.
[[nodiscard]] std::vector<double> values_of(const ProbeTable& table);
/// And back. Throws UsageError unless there are nine.
[[nodiscard]] ProbeTable probe_table_of(std::span<const double> values);

/// Those of the thresholds that say which vertices are saddles.
[[nodiscard]] std::vector<EvolvedParameter> saddle_parameters();
/// Thresholds as those five numbers.
[[nodiscard]] std::vector<double> values_of(const SaddleThresholds& thresholds);
/// And back. Throws UsageError unless there are five.
[[nodiscard]] SaddleThresholds saddle_thresholds_of(std::span<const double> values);

}  // namespace plexway
