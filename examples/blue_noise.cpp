// How even are Poisson disks? The spectrum and the pair correlation of darts on a square, beside
// those of points thrown without regard for each other (white noise). Writes a picture:
//   example_blue_noise blue_noise.svg
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <plexway/sampling/poisson_disk.hpp>

namespace {

using Point = std::array<double, 2>;
constexpr double pi = std::numbers::pi;

// Mean of |sum exp(2 pi i f.p)|^2 / n over rings of frequencies: 1 for white noise.
std::vector<double> spectrum(const std::vector<Point>& points, int rings) {
  std::vector<double> sum(static_cast<std::size_t>(rings)), count(sum.size());
  for (int u = 0; u < rings; ++u)
    for (int v = -rings + 1; v < rings; ++v) {
      const auto ring = static_cast<std::size_t>(std::hypot(u, v));
      if ((u == 0 && v <= 0) || ring >= sum.size()) continue;
      double re = 0, im = 0;
      for (const auto& [x, y] : points) {
        re += std::cos(2 * pi * (u * x + v * y));
        im += std::sin(2 * pi * (u * x + v * y));
      }
      sum[ring] += (re * re + im * im) / static_cast<double>(points.size());
      count[ring] += 1;
    }
  for (std::size_t r = 1; r < sum.size(); ++r) sum[r] /= count[r];
  return sum;
}

// Pairs at a distance, against as many as white noise has: from points at least `reach` inside.
std::vector<double> pair_correlation(const std::vector<Point>& points, double reach, int bins) {
  std::vector<double> pairs(static_cast<std::size_t>(bins));
  double inner = 0;
  for (const Point& p : points) {
    if (std::min({p[0], p[1], 1 - p[0], 1 - p[1]}) < reach) continue;
    ++inner;
    for (const Point& q : points) {
      const double d = std::hypot(p[0] - q[0], p[1] - q[1]);
      if (d > 0 && d < reach) ++pairs[static_cast<std::size_t>(d / reach * bins)];
    }
  }
  for (int b = 0; b < bins; ++b) {
    const double ring = pi * reach * reach * (2 * b + 1) / (bins * bins);
    pairs[static_cast<std::size_t>(b)] /= inner * ring * static_cast<double>(points.size());
  }
  return pairs;
}

std::string dots(const std::vector<Point>& points, double left, double top, double size) {
  std::string svg;
  for (const auto& [x, y] : points)
    svg += "<circle r='1.1' cx='" + std::to_string(left + size * x) + "' cy='" +
           std::to_string(top + size * y) + "'/>\n";
  return svg;
}

std::string curve(const std::vector<double>& values, double left, double top, double width,
                  double height, const char* colour) {
  std::string svg = std::string("<polyline fill='none' stroke='") + colour + "' points='";
  for (std::size_t i = 1; i < values.size(); ++i)
    svg +=
        std::to_string(left + width * static_cast<double>(i) / static_cast<double>(values.size())) +
        "," + std::to_string(top + height * (1 - std::min(values[i], 3.) / 3)) + " ";
  return svg + "'/>\n";
}

}  // namespace

int main(int argc, char** argv) {
  constexpr plexway::Index n = 160;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<plexway::Index, 3>> faces;
  for (plexway::Index i = 0; i <= n; ++i)
    for (plexway::Index j = 0; j <= n; ++j)
      positions.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
  for (plexway::Index i = 0; i < n; ++i)
    for (plexway::Index j = 0; j < n; ++j) {
      const plexway::Index a = i * (n + 1) + j, b = a + n + 1;
      faces.push_back({a, b, b + 1});
      faces.push_back({a, b + 1, a + 1});
    }
  const plexway::TriangleMesh<float> square(positions, faces);
  const auto disks = plexway::poisson_disks(plexway::Serial{}, square, {.count = 1500});
  std::vector<Point> blue, white;
  for (const auto& dart : disks.darts) {
    Point p = {0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k)
        p[k] += dart.barycentric[i] * positions[faces[dart.simplex][i]][k];
    blue.push_back(p);
  }
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.; };
  for (std::size_t i = 0; i < blue.size(); ++i) white.push_back({uniform(), uniform()});

  const auto blue_spectrum = spectrum(blue, 80), white_spectrum = spectrum(white, 80);
  const double reach = 4 * disks.radius;
  const auto blue_pairs = pair_correlation(blue, reach, 60);
  const auto white_pairs = pair_correlation(white, reach, 60);
  double low = 0, white_low = 0, near = 0;
  for (std::size_t f = 3; f < 20; ++f)
    low += blue_spectrum[f] / 17, white_low += white_spectrum[f] / 17;
  for (std::size_t b = 0; b < 15; ++b) near = std::max(near, blue_pairs[b]);
  std::printf("%zu darts, radius %.4f\n", blue.size(), disks.radius);
  std::printf("power at low frequencies: %.3f, white noise %.3f\n", low, white_low);
  std::printf("pairs nearer than the radius: %.3f, white noise 1; just beyond it: %.2f\n", near,
              blue_pairs[15]);
  if (argc > 1) {
    std::ofstream svg(argv[1]);
    svg << "<svg xmlns='http://www.w3.org/2000/svg' width='900' height='620' "
           "font-family='sans-serif'"
           " font-size='13'>\n<rect width='900' height='620' fill='white'/>\n"
        << dots(blue, 20, 30, 270) << dots(white, 20, 330, 270)
        << "<text x='20' y='20'>Poisson disks</text><text x='20' y='320'>white noise</text>\n"
        << "<text x='330' y='20'>power by frequency, 1 to 80 (top: 3)</text>\n"
        << "<text x='330' y='320'>pairs by distance, 0 to 4 radii (top: 3)</text>\n";
    for (const double top : {30., 330.})
      svg << "<rect x='330' y='" << top
          << "' width='540' height='270' fill='none' stroke='gray'/>\n"
          << "<line x1='330' x2='870' y1='" << top + 180 << "' y2='" << top + 180
          << "' stroke='lightgray'/>\n";
    svg << curve(white_spectrum, 330, 30, 540, 270, "silver")
        << curve(blue_spectrum, 330, 30, 540, 270, "royalblue")
        << curve(white_pairs, 330, 330, 540, 270, "silver")
        << curve(blue_pairs, 330, 330, 540, 270, "royalblue") << "</svg>\n";
  }
  return low < 0.3 && white_low > 0.7 && near < 0.05 && blue_pairs[15] > 1.5 ? 0 : 1;
}
