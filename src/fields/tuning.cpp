#include <plexway/fields/tuning.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <plexway/common/blocks.hpp>
#include <plexway/error.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

namespace plexway {
namespace {

// Calls work(i) for each i below `count`, several at once.
template <class Work>
void at_once(std::size_t count, std::size_t threads, const Work& work) {
  for_blocks(count, 1, static_cast<int>(std::min(threads, count)), {},
             [&](std::size_t first, std::size_t) { work(first); });
}

// Fowler, Noll and Vo's hash, by whole numbers.
class Digest {
 public:
  void add(std::uint64_t bits) { value_ = (value_ ^ bits) * 1099511628211ULL; }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

// What a surface is solved on.
struct Prepared {
  std::optional<IntrinsicDelaunay> delaunay;  // where other triangles pay
  std::optional<TriangleMesh<float>> mesh;
};

Prepared prepare(const TuningSurface& surface, bool automatic) {
  Prepared made;
  if (!automatic) return made;
  SurfaceHints hints;
  hints.threads = 1;  // others are built at the same time
  const TriangleMesh<double> input(surface.positions, surface.faces, hints);
  const Retriangulation pays = what_pays(measure_triangulation(input));
  if (pays == Retriangulation::keep) return made;
  made.delaunay.emplace(input, refinement_for(pays), hints.threads);
  if (made.delaunay->summary().flips + made.delaunay->summary().inserted_vertices == 0)
    made.delaunay.reset();
  return made;
}

void build(const TuningSurface& surface, const SaddleThresholds& saddles, Prepared& prepared) {
  if (prepared.delaunay) {
    prepared.mesh.emplace(prepared.delaunay->mesh<float>(saddles));
    return;
  }
  SurfaceHints hints;
  hints.saddles = saddles;
  hints.threads = 1;  // others are built at the same time
  prepared.mesh.emplace(surface.positions, surface.faces, hints);
}

double field_error(const std::vector<double>& truth, const std::vector<float>& found) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (std::isnan(truth[v]) || truth[v] == 0) continue;
    const double d = static_cast<double>(found[v]);
    ++count;
    if (std::isfinite(truth[v]) && std::isfinite(d))
      sum += std::abs(d - truth[v]) / truth[v];
    else
      sum += std::isfinite(truth[v]) != std::isfinite(d);
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

void check_surface(const TuningSurface& surface) {
  const std::string prefix = surface.name + ": ";
  if (surface.truths.empty()) throw UsageError(prefix + "no exact distances to compare with");
  for (const TuningSurface::Truth& truth : surface.truths) {
    if (truth.source >= surface.positions.size())
      throw UsageError(prefix + "source " + std::to_string(truth.source) + " is out of range");
    if (truth.distance.size() != surface.positions.size())
      throw UsageError(prefix + std::to_string(truth.distance.size()) + " exact distances for " +
                       std::to_string(surface.positions.size()) + " vertices");
  }
}

}  // namespace

struct TuningSet::State {
  std::vector<TuningSurface> surfaces;
  bool automatic = false;
  std::size_t threads = 0;  // 0: all cores
  std::vector<Prepared> prepared;
  std::vector<std::pair<std::size_t, std::size_t>> fields;  // surface, truth
};

TuningSet::TuningSet(std::vector<TuningSurface> surfaces, bool automatic, std::size_t threads)
    : state_(std::make_unique<State>()) {
  if (surfaces.empty()) throw UsageError("there is no surface to tune on");
  State& s = *state_;
  s.surfaces = std::move(surfaces);
  s.automatic = automatic;
  s.threads = threads;
  for (std::size_t i = 0; i < s.surfaces.size(); ++i) {
    check_surface(s.surfaces[i]);
    for (std::size_t t = 0; t < s.surfaces[i].truths.size(); ++t) s.fields.emplace_back(i, t);
  }
  s.prepared.resize(s.surfaces.size());
  at_once(s.surfaces.size(), s.threads, [&](std::size_t i) {
    try {
      s.prepared[i] = prepare(s.surfaces[i], automatic);
      build(s.surfaces[i], SaddleThresholds::standard(), s.prepared[i]);
    } catch (const InputError& error) {
      throw InputError(s.surfaces[i].name + ": " + error.what());
    }
  });
}

TuningSet::TuningSet(TuningSet&&) noexcept = default;
TuningSet& TuningSet::operator=(TuningSet&&) noexcept = default;
TuningSet::~TuningSet() = default;

std::size_t TuningSet::fields() const { return state_->fields.size(); }

std::uint64_t TuningSet::digest() const {
  Digest digest;
  digest.add(std::uint64_t{state_->automatic});
  for (const TuningSurface& surface : state_->surfaces) {
    digest.add(std::uint64_t{surface.positions.size()});
    for (const auto& p : surface.positions)
      for (const double x : p) digest.add(x);
    for (const auto& f : surface.faces)
      for (const Index v : f) digest.add(std::uint64_t{v});
    for (const TuningSurface::Truth& truth : surface.truths) {
      digest.add(std::uint64_t{truth.source});
      for (const double d : truth.distance) digest.add(d);
    }
  }
  return digest.value();
}

void TuningSet::rebuild(const SaddleThresholds& saddles) {
  State& s = *state_;
  at_once(s.surfaces.size(), s.threads,
          [&](std::size_t i) { build(s.surfaces[i], saddles, s.prepared[i]); });
}

std::vector<double> TuningSet::errors(const PropagateOptions& options) const {
  const State& s = *state_;
  PropagateOptions by_labels = options;  // what is tuned are their rules
  by_labels.accuracy = Accuracy::fast();
  std::vector<double> errors(s.fields.size());
  at_once(s.fields.size(), s.threads, [&](std::size_t i) {
    const auto& [number, t] = s.fields[i];
    const TuningSurface::Truth& truth = s.surfaces[number].truths[t];
    // A source at a vertex needs no translation: vertices keep their numbers.
    const auto field =
        solve(Serial{}, *s.prepared[number].mesh, PointSource::at(truth.source), by_labels);
    errors[i] = field_error(truth.distance, field.distance);
  });
  return errors;
}

double TuningSet::mean_error(const PropagateOptions& options) const {
  double sum = 0;
  for (const double error : errors(options)) sum += error;
  return sum / static_cast<double>(fields());
}

std::vector<EvolvedParameter> probe_parameters() {
  return {{"slender", 1.5, 20, true}, {"uneven", 1.2, 20, true}, {"low", 0.05, 1.5, true},
          {"share[0]", 0, 1.2},       {"share[1]", 0, 1.2},      {"share[2]", 0, 1.2},
          {"share[3]", 0, 1.2},       {"share[4]", 0, 1.2},      {"share[5]", 0, 1.2}};
}

std::vector<double> values_of(const ProbeTable& t) {
  std::vector<double> values = {t.slender, t.uneven, t.low};
  values.insert(values.end(), t.share.begin(), t.share.end());
  return values;
}

ProbeTable probe_table_of(std::span<const double> values) {
  if (values.size() != 9) throw UsageError("a table of probes has nine numbers");
  ProbeTable table = {values[0], values[1], values[2], {}};
  std::copy(values.begin() + 3, values.end(), table.share.begin());
  return table;
}

std::vector<EvolvedParameter> saddle_parameters() {
  return {{"interior", 1e-6, 1e-2, true},
          {"boundary", 1e-7, 1e-2, true},
          {"noise_share", 0, 2},
          {"most_noise", 1e-4, 0.2, true},
          {"agreement", 0, 1}};
}

std::vector<double> values_of(const SaddleThresholds& t) {
  return {t.interior, t.boundary, t.noise_share, t.most_noise, t.agreement};
}

SaddleThresholds saddle_thresholds_of(std::span<const double> values) {
  if (values.size() != 5) throw UsageError("the thresholds of saddles are five numbers");
  return {values[0], values[1], values[2], values[3], values[4]};
}

}  // namespace plexway
