#include <catch2/catch.hpp>

#include <filesystem>

#include <plexway/io/triangles.hpp>

#include "exact_data.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::truth_test {

namespace fs = std::filesystem;

// Real meshes with exact distances.
namespace {

PointSource from(const ExactAnswer& answer) {
  return PointSource::at(static_cast<Index>(answer.source));
}

Surface read(const fs::path& file) {
  io::Triangles t = io::read_triangles(file);
  return {std::move(t.positions), std::move(t.triangles)};
}

double without_nan(double x) { return std::isnan(x) ? 0 : x; }

}  // namespace

TEST_CASE("real surfaces: the default is more accurate than published, upper_bound is one") {
  struct Published {
    const char* name;
    double mean;
  };
  const Published published[] = {
      {"spot", 3.3e-3},       {"fandisk", 1.8e-3}, {"rocker-arm", 1.8e-3}, {"camelhead", 3.2e-3},
      {"beetle_car", 2.5e-3}, {"bunny", 1.9e-3},   {"armadillo", 1.0e-3},  {"wavy_grid200", 6.9e-3},
      {"t79741", 4.4e-2},     {"t908460", 9.0e-3}};
  std::vector<double> ratios;
  for (const auto& [what, bound] : published) {
#ifdef PLEXWAY_SANITIZED
    if (ratios.size() == 3) break;
#endif
    const fs::path file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    const auto mesh = read(file).mesh<float>();
    double mean = 0;
    const std::vector<ExactAnswer> truths = exact_answers(file);
    REQUIRE_FALSE(truths.empty());
    for (const ExactAnswer& truth : truths) {
      const Errors e = compare(solve(mesh, from(truth)), truth.distance);
      CAPTURE(what, truth.source, e.mean, e.max);
      CHECK(e.fits);
      mean += e.mean / static_cast<double>(truths.size());
      PropagateOptions upper;
      upper.visibility = Visibility::upper_bound;
      const Errors u = compare(solve(mesh, from(truth), upper), truth.distance);
      CHECK(u.fits);
      CHECK(u.below >= -1e-4);
    }
    CAPTURE(what, mean, bound);
    CHECK(mean <= bound);
    ratios.push_back(mean / bound);
  }
  REQUIRE_FALSE(ratios.empty());
#ifndef PLEXWAY_SANITIZED
  if (ratios.size() < std::size(published)) {
    WARN("measured on " << ratios.size() << " of " << std::size(published) << " meshes");
    return;
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = (ratios[4] + ratios[5]) / 2;
  CAPTURE(ratios);
  CHECK(median <= .75);
#endif
}

TEMPLATE_TEST_CASE("awkward surfaces: finite where a path leads, close where it is known", "",
                   float, double) {
  const std::vector<fs::path> files = exact_files("awkward", ".obj");
  if (files.empty()) WARN("skipped: no folder of awkward meshes with exact distances");
  for (const fs::path& file : files) {
    const std::string what = file.stem().string();
#ifdef PLEXWAY_SANITIZED
    if (fs::file_size(file) > 500000) continue;
#endif
    const Surface s = read(file);
    const auto mesh = s.mesh<TestType>();
    std::vector<ExactAnswer> truths = exact_answers(file);
    if (truths.empty()) truths.push_back({s.faces[0][0], {}});
    for (const ExactAnswer& truth : truths) {
      CAPTURE(what, truth.source);
      for (const Visibility visibility : visibilities) {
        PropagateOptions options;
        options.visibility = visibility;
        const auto d = solve(mesh, from(truth), options);
        bool valid = d[truth.source] == 0;
        for (const double x : d) valid &= x >= 0;
        CHECK(valid);
        if (truth.distance.empty()) continue;
        std::vector<double> exact = truth.distance;
        std::transform(exact.begin(), exact.end(), exact.begin(), without_nan);
        const Errors e = compare(d, exact);
        CAPTURE(name(options), e.mean, e.max, e.below);
        CHECK(e.fits);
        if (visibility == Visibility::saddles) CHECK(e.mean <= 1.5e-2);
        if (visibility == Visibility::upper_bound) CHECK(e.below >= -1e-4);
      }
    }
  }
}

}  // namespace plexway::testing::truth_test
