#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include <plexway/io/triangles.hpp>

#include "propagate/solving.hpp"

using namespace plexway;
using namespace plexway::testing;
namespace fs = std::filesystem;

// Real meshes with exact distances: NAME.obj, and NAME.vID.txt with one value a line.
namespace {

struct Truth {
  Index source;
  std::vector<double> distance;
};

std::vector<Truth> truths_of(const fs::path& mesh) {
  std::vector<Truth> list;
  const std::string stem = mesh.stem().string() + ".v";
  for (const auto& entry : fs::directory_iterator(mesh.parent_path())) {
    const std::string file = entry.path().filename().string();
    if (file.rfind(stem, 0) != 0) continue;
    Truth t;
    t.source = static_cast<Index>(std::stoul(file.substr(stem.size())));
    std::ifstream in(entry.path());
    for (std::string value; in >> value;) t.distance.push_back(std::stod(value));
    list.push_back(std::move(t));
  }
  std::sort(list.begin(), list.end(),
            [](const Truth& a, const Truth& b) { return a.source < b.source; });
  return list;
}

Surface read(const fs::path& file) {
  io::Triangles t = io::read_triangles(file);
  return {std::move(t.positions), std::move(t.triangles)};
}

bool have_truth(const char* folder) {
  const fs::path root = PLEXWAY_TRUTH_DIR;
  return !root.empty() && fs::exists(root / folder);
}

double without_nan(double x) { return std::isnan(x) ? 0 : x; }

}  // namespace

TEST_CASE("real surfaces: the default is more accurate than published, upper_bound is one") {
  if (!have_truth("surfaces")) {
    WARN("skipped: no folder of meshes with exact distances");
    return;
  }
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
    const fs::path file = fs::path(PLEXWAY_TRUTH_DIR) / "surfaces" / (std::string(what) + ".obj");
    if (!fs::exists(file)) continue;
    const auto mesh = read(file).mesh<float>();
    double mean = 0;
    const std::vector<Truth> truths = truths_of(file);
    REQUIRE_FALSE(truths.empty());
    for (const Truth& truth : truths) {
      const Errors e = compare(solve(mesh, PointSource::at(truth.source)), truth.distance);
      CAPTURE(what, truth.source, e.mean, e.max);
      CHECK(e.fits);
      mean += e.mean / static_cast<double>(truths.size());
      PropagateOptions upper;
      upper.visibility = Visibility::upper_bound;
      const Errors u = compare(solve(mesh, PointSource::at(truth.source), upper), truth.distance);
      CHECK(u.fits);
      CHECK(u.below >= -1e-4);
    }
    CAPTURE(what, mean, bound);
    CHECK(mean <= bound);
    ratios.push_back(mean / bound);
  }
#ifndef PLEXWAY_SANITIZED
  REQUIRE(ratios.size() == std::size(published));
  std::sort(ratios.begin(), ratios.end());
  const double median = (ratios[4] + ratios[5]) / 2;
  CAPTURE(ratios);
  CHECK(median <= .75);
#endif
}

TEMPLATE_TEST_CASE("awkward surfaces: finite where a path leads, close where it is known", "",
                   float, double) {
  if (!have_truth("awkward")) {
    WARN("skipped: no folder of meshes with exact distances");
    return;
  }
  for (const auto& entry : fs::directory_iterator(fs::path(PLEXWAY_TRUTH_DIR) / "awkward")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".obj") continue;
    const std::string what = file.stem().string();
#ifdef PLEXWAY_SANITIZED
    if (fs::file_size(file) > 500000) continue;
#endif
    const Surface s = read(file);
    const auto mesh = s.mesh<TestType>();
    std::vector<Truth> truths = truths_of(file);
    if (truths.empty()) truths.push_back({s.faces[0][0], {}});
    for (const Truth& truth : truths) {
      CAPTURE(what, truth.source);
      for (const Visibility visibility : visibilities) {
        PropagateOptions options;
        options.visibility = visibility;
        const auto d = solve(mesh, PointSource::at(truth.source), options);
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
