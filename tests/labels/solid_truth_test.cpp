#include <catch2/catch.hpp>

#include <string>

#include "labels/solid_solving.hpp"
#include "labels/solid_truth.hpp"

namespace plexway::testing::solid_truth_test {

namespace {

// The largest relative error beyond two mean edges from the source.
double worst_far(const std::vector<double>& found, const std::vector<double>& exact, double unit) {
  double worst = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] > 2 * unit) worst = std::max(worst, std::abs(found[v] / exact[v] - 1));
  return worst;
}

// Nothing where the solid is missing.
template <class Real>
std::optional<double> mean_error(const std::string& name, Index source,
                                 double worst_allowed = .04) {
  const auto truth = read_solid_truth(name, source);
  if (!truth) return {};
  const auto mesh = truth->solid.mesh<Real>();
  const auto found = solve(mesh, PointSource::at(source));
  const Errors e = compare(found, truth->exact);
  const double worst = worst_far(found, truth->exact, mesh.unit());
  CAPTURE(name, e.mean, e.max, e.below, worst);
  CHECK(e.fits);
  CHECK(worst <= worst_allowed);
  return e.mean;
}

}  // namespace

TEST_CASE("solids with exact answers, double") {
  CHECK(mean_error<double>("cube_10k", 8).value_or(0) <= 1e-12);
  CHECK(mean_error<double>("maze_10k", 32).value_or(0) <= 5e-12);
  CHECK(mean_error<double>("notch_10k", 14).value() <= 5e-12);
  CHECK(mean_error<double>("notch_100k", 14).value_or(0) <= 5e-12);
  const double cavity = mean_error<double>("cavity_10k", 170).value();
  const double finer_cavity = mean_error<double>("cavity_100k", 650).value_or(0);
  CHECK(cavity <= 1.3e-3);
  CHECK(finer_cavity <= 4e-4);
  CHECK(finer_cavity < cavity / 1.5);
}

TEST_CASE("solids with exact answers, float") {
  CHECK(mean_error<float>("cube_10k", 8).value_or(0) <= 1e-7);
  CHECK(mean_error<float>("maze_10k", 32).value_or(0) <= 1.5e-7);
  CHECK(mean_error<float>("notch_10k", 14).value() <= 1.5e-7);
  CHECK(mean_error<float>("cavity_10k", 170).value() <= 1.3e-3);
}

TEST_CASE("plain steps on solids with exact answers") {
  const SolidTruth truth = read_solid_truth("notch_10k", 14).value();
  PropagateOptions options;
  options.visibility = Visibility::centroid;
  CHECK(compare(solve(truth.solid.mesh<double>(), PointSource::at(14), options), truth.exact).mean <
        2e-3);
  options.visibility = Visibility::upper_bound;
  const Errors bound =
      compare(solve(truth.solid.mesh<double>(), PointSource::at(14), options), truth.exact);
  CHECK(bound.fits);
  CHECK(bound.below > -1e-9);
  CHECK(bound.mean < 7e-2);
}

}  // namespace plexway::testing::solid_truth_test
