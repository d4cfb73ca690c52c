#include <catch2/catch.hpp>

#include <filesystem>

#include <plexway/io/triangles.hpp>

#include "exact_data.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_truth_test {

namespace fs = std::filesystem;

// Real meshes with exact distances.
namespace {

Surface read(const fs::path& file) {
  io::Triangles t = io::read_triangles(file);
  return {std::move(t.positions), std::move(t.triangles)};
}

}  // namespace

TEST_CASE("windows on real surfaces: exact is exact, accurate is accurate") {
  std::vector<double> means;
  for (const char* const what : {"spot", "fandisk", "rocker-arm", "camelhead", "beetle_car",
                                 "bunny", "armadillo", "wavy_grid200", "t79741", "t908460"}) {
#ifdef PLEXWAY_SANITIZED
    if (means.size() == 2) break;
#endif
    const fs::path file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    const Surface s = read(file);
    const auto single = s.mesh<float>();
    const auto mesh = s.mesh<double>();
    // Not for merging: needles.
    const bool needles = what[0] == 't';
    double mean = 0;
    const std::vector<ExactAnswer> truths = exact_answers(file);
    REQUIRE_FALSE(truths.empty());
    for (const ExactAnswer& truth : truths) {
      const auto source = PointSource::at(static_cast<Index>(truth.source));
      CAPTURE(what, truth.source);
      const Errors exact =
          compare(solve_windows(mesh, {source}, Accuracy::exact()), truth.distance);
      CAPTURE(exact.mean, exact.max);
      CHECK(exact.fits);
      CHECK(exact.max <= 1e-8);
      const Errors near =
          compare(solve_windows(single, {source}, Accuracy::accurate()), truth.distance);
      CAPTURE(near.mean, near.max);
      CHECK(near.fits);
      CHECK(near.max <= (needles ? 2e-2 : 5e-3));
      mean += near.mean / static_cast<double>(truths.size());
    }
    CAPTURE(what, mean);
    CHECK(mean <= 2e-4);
    means.push_back(mean);
  }
#ifndef PLEXWAY_SANITIZED
  if (means.size() < 10) return;
  std::sort(means.begin(), means.end());
  CHECK((means[4] + means[5]) / 2 <= 7e-5);
#endif
}

}  // namespace plexway::testing::windows_truth_test
