#include <plexway/fields/evolution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <plexway/error.hpp>

#include "sampling/random.hpp"

namespace plexway {
using namespace detail;
namespace {

constexpr double worst = -std::numeric_limits<double>::infinity();
constexpr double least_step = 1e-4, largest_step = 0.5;

// Box and Muller's; the second number of each pair is thrown away, so that there is no other state
// than the generator's.
double gaussian(Random& random) {
  const double u = 1 - random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

double reflected(double share) {
  share = std::fmod(std::abs(share), 2.0);
  return share > 1 ? 2 - share : share;
}

double to_value(const EvolvedParameter& p, double share) {
  if (share <= 0) return p.low;
  if (share >= 1) return p.high;
  return p.logarithmic ? p.low * std::pow(p.high / p.low, share) : p.low + share * (p.high - p.low);
}

double to_share(const EvolvedParameter& p, double value) {
  value = std::clamp(value, p.low, p.high);
  return p.logarithmic ? std::log(value / p.low) / std::log(p.high / p.low)
                       : (value - p.low) / (p.high - p.low);
}

}  // namespace

Evolution::Evolution(std::vector<EvolvedParameter> parameters, EvolutionOptions options)
    : parameters_(std::move(parameters)), options_(std::move(options)) {
  if (parameters_.empty()) throw UsageError("an evolution needs a parameter");
  for (const EvolvedParameter& p : parameters_)
    if (!(p.low < p.high) || !std::isfinite(p.high - p.low) || (p.logarithmic && !(p.low > 0)))
      throw UsageError("parameter " + p.name + ": its range is empty");
  if (options_.evaluations == 0 || options_.restarts == 0)
    throw UsageError("an evolution needs at least one evaluation of one start");
  if (!(options_.step > 0) || !std::isfinite(options_.step))
    throw UsageError("the step of an evolution must be a number > 0");
  if (!options_.start.empty() && options_.start.size() != parameters_.size())
    throw UsageError("the start of an evolution must have one value a parameter");
  for (const double x : options_.start)
    if (!std::isfinite(x)) throw UsageError("the start of an evolution must be finite");
  state_.random = options_.seed;
  state_.step = options_.step;
  state_.parent_fitness = state_.best_fitness = worst;
}

Evolution::Evolution(std::vector<EvolvedParameter> parameters, EvolutionOptions options,
                     EvolutionState state)
    : Evolution(std::move(parameters), std::move(options)) {
  const auto fits = [&](const std::vector<double>& shares, bool may_be_empty) {
    return (may_be_empty && shares.empty()) ||
           (shares.size() == parameters_.size() &&
            std::all_of(shares.begin(), shares.end(), [](double s) { return s >= 0 && s <= 1; }));
  };
  const bool any = state.restart > 0 || state.trials > 0;
  if (!fits(state.parent, state.trials == 0) || !fits(state.best, !any) || !(state.step > 0) ||
      state.restart > options_.restarts || state.trials >= options_.evaluations)
    throw UsageError("the state of an evolution does not fit its parameters and options");
  state_ = std::move(state);
}

std::vector<double> Evolution::values(std::span<const double> shares) const {
  std::vector<double> values(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) values[i] = to_value(parameters_[i], shares[i]);
  return values;
}

std::vector<double> Evolution::propose() {
  Random random(state_.random);
  child_.resize(parameters_.size());
  const bool given = state_.restart == 0 && !options_.start.empty();
  for (std::size_t i = 0; i < child_.size(); ++i) {
    if (state_.trials > 0)
      child_[i] = reflected(state_.parent[i] + state_.step * gaussian(random));
    else
      child_[i] = given ? to_share(parameters_[i], options_.start[i]) : random.uniform();
  }
  state_.random = random.state();
  return values(child_);
}

bool Evolution::tell(double fitness) {
  if (std::isnan(fitness)) fitness = worst;
  const bool first = state_.trials == 0, success = first || fitness > state_.parent_fitness;
  const bool record = state_.best.empty() || fitness > state_.best_fitness;
  if (success) {
    state_.parent = child_;
    state_.parent_fitness = fitness;
  }
  if (record) {
    state_.best = child_;
    state_.best_fitness = fitness;
  }
  if (options_.adapt && !first) {
    const double grow = std::exp(1 / std::sqrt(static_cast<double>(parameters_.size()) + 1));
    state_.step = std::clamp(state_.step * (success ? grow : std::pow(grow, -0.25)), least_step,
                             largest_step);
  }
  if (++state_.trials == options_.evaluations) {
    ++state_.restart;
    state_.trials = 0;
    state_.step = options_.step;
    state_.parent.clear();
    state_.parent_fitness = worst;
  }
  return record;
}

}  // namespace plexway
