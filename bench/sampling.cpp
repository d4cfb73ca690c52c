#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <plexway/apps/poisson_disk.hpp>

#include "harness.hpp"
#include "../data/shapes.hpp"

using namespace plexway;
using samples::operator+, samples::operator-, samples::operator*;

int main(int argc, char** argv) {
  bench::Surface s;
  if (std::string_view(argv[1]) == "sphere") {
    auto shape = samples::geodesic_sphere(100);
    s = {"sphere", shape.points, shape.faces};
  } else if (std::string_view(argv[1]) == "bumpy") {
    auto shape = samples::bumpy(100);
    s = {"bumpy", shape.points, shape.faces};
  } else {
    s = bench::read_surface(argv[1]);
  }
  const std::size_t count = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000;
  TriangleMesh<float> mesh(s.positions, s.faces);
  Workspace<float> w;
  DistanceField<float> f;
  double best = 1e9;
  for (int i = 0; i < 7; ++i)
    best = std::min(best, bench::seconds([&] { const PointSource src = PointSource::at(static_cast<Index>(i * 997)); propagate(Serial{}, mesh, {&src, 1}, {}, w, f); }));
  PoissonOptions o;
  o.count = count;
  auto first = poisson_disks(Serial{}, mesh, o);
  std::printf("%zu faces, solve %.2f ms, expansions %.2f a face\n", mesh.face_count(), best * 1e3, double(f.statistics.expansions) / double(mesh.face_count()));
  o.count = 0;
  o.radius = first.radius;
  double t = 1e9;
  PoissonDisks d;
  for (int i = 0; i < 5; ++i) t = std::min(t, bench::seconds([&] { d = poisson_disks(Serial{}, mesh, o, w); }));
  std::printf("poisson %zu darts r %g (%.2f edges) %.2f ms ratio %.2f; thrown %zu back %zu expansions %.2f updates %.2f a face\n", d.darts.size(), d.radius, d.radius / mesh.unit(), t * 1e3, t / best, d.thrown, d.taken_back, double(d.statistics.expansions) / double(mesh.face_count()), double(d.statistics.updates) / double(mesh.face_count()));
  if (std::string_view(argv[1]) == "sphere") {
    std::vector<samples::Point> at;
    for (auto& p : d.darts) {
      samples::Point x = {0, 0, 0};
      for (std::size_t i = 0; i < 3u; ++i) x = x + p.barycentric[i] * s.positions[s.faces[p.simplex][i]];
      at.push_back(samples::unit(x));
    }
    double least = 9;
    for (size_t i = 0; i < at.size(); ++i)
      for (size_t j = 0; j < i; ++j) least = std::min(least, 2 * std::asin(std::sqrt(samples::dot(at[i] - at[j], at[i] - at[j])) / 2));
    samples::Noise noise(5);
    double most = 0;
    for (int k = 0; k < 100000; ++k) {
      samples::Point x = samples::unit({noise(), noise(), noise()});
      double near = 9;
      for (auto& a : at) near = std::min(near, samples::dot(a - x, a - x));
      most = std::max(most, 2 * std::asin(std::sqrt(near) / 2));
    }
    std::printf("least %.5f r  most %.5f r\n", least / d.radius, most / d.radius);
  }
}
