#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plexway {

/// A number to be found, from `low` to `high`.
struct EvolvedParameter {
  /// For people.
  std::string name;
  ///@{
  /// Ends of its range, low < high.
  double low, high;
  ///@}
  bool logarithmic = false;  ///< steps are factors; needs low > 0
};

/// How an evolution goes.
struct EvolutionOptions {
  /// Of the random numbers.
  std::uint64_t seed = 1;
  std::size_t evaluations = 300;  ///< of each start, the start itself included; at least 1
  std::size_t restarts = 1;       ///< so many starts, one after the other; at least 1
  double step = 0.2;              ///< first standard deviation, as a share of each range; > 0
  /// The one-fifth rule: the step grows with each success and shrinks with each failure, so that it
  /// stays where one trial in five succeeds. false: the step is always the same.
  bool adapt = true;
  /// Where the first start begins, clamped to the ranges; empty: anywhere. Later starts always
  /// begin anywhere.
  std::vector<double> start = {};
};

/// Where an evolution is: all that it takes to go on as if nothing had happened.
struct EvolutionState {
  std::uint64_t random = 0;  ///< of the generator
  std::size_t restart = 0;   ///< the present start, from 0
  std::size_t trials = 0;    ///< evaluations of it
  /// The present standard deviation, as a share of each range.
  double step = 0;
  /// Of `parent`.
  double parent_fitness = 0;
  /// Of `best`.
  double best_fitness = 0;
  std::vector<double> parent;  ///< as shares of the ranges, 0 to 1; empty before the first trial
  std::vector<double> best;    ///< of all starts
};

/// The (1+1) evolution strategy: one parent, one child, all parameters mutated by a Gaussian at
/// once; the child takes the parent's place if it is better (as GSP 2021 found its table; the
/// one-fifth rule is Rechenberg's, 1973). Beyond an end of its range a parameter is reflected.
///
/// @code
///   Evolution evolution(parameters, options);
///   while (!evolution.done()) evolution.tell(fitness_of(evolution.propose()));
///
/// @endcode
/// The same seed and the same fitness give the same trials.
class Evolution {
 public:
  /// Throws UsageError for no parameter, an empty range or options out of range.
  Evolution(std::vector<EvolvedParameter> parameters, EvolutionOptions options);
  /// Goes on from a state that one with the same parameters and options had; throws UsageError
  /// where it does not fit.
  Evolution(std::vector<EvolvedParameter> parameters, EvolutionOptions options,
            EvolutionState state);

  /// Have all starts had their evaluations?
  [[nodiscard]] bool done() const { return state_.restart >= options_.restarts; }
  /// The next trial, one value a parameter. To be followed by `tell`.
  [[nodiscard]] std::vector<double> propose();
  /// How good the trial was; more is better. NaN counts as worst. True if it is the best so far.
  /// Needs a trial that was proposed and not told yet (not checked).
  bool tell(double fitness);

  /// Between `tell` and `propose`.
  [[nodiscard]] const EvolutionState& state() const { return state_; }
  /// The best of all trials so far. Needs one.
  [[nodiscard]] std::vector<double> best() const { return values(state_.best); }
  /// Its fitness.
  [[nodiscard]] double best_fitness() const { return state_.best_fitness; }
  /// Evaluations of all starts.
  [[nodiscard]] std::size_t evaluations() const {
    return state_.restart * options_.evaluations + state_.trials;
  }

 private:
  [[nodiscard]] std::vector<double> values(std::span<const double> shares) const;

  std::vector<EvolvedParameter> parameters_;
  EvolutionOptions options_;
  EvolutionState state_;
  std::vector<double> child_;
};

}  // namespace plexway
