#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

/// Surfaces made on the spot, for tests of the core.
namespace plexway::testing {

using Position = std::array<double, 3>;
using Face = std::array<Index, 3>;

struct Surface {
  std::vector<Position> positions;
  std::vector<Face> faces;

  Index add(double x, double y, double z = 0) {
    positions.push_back({x, y, z});
    return static_cast<Index>(positions.size() - 1);
  }
  void triangle(Index a, Index b, Index c) { faces.push_back({a, b, c}); }
  void quad(Index a, Index b, Index c, Index d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  template <class Real>
  [[nodiscard]] TriangleMesh<Real> mesh() const {
    return TriangleMesh<Real>(positions, faces);
  }
  [[nodiscard]] Index nearest(double x, double y, double z = 0) const {
    Index best = 0;
    double least = 1e300;
    for (Index v = 0; v < positions.size(); ++v) {
      const double d = std::hypot(positions[v][0] - x, positions[v][1] - y, positions[v][2] - z);
      if (d < least) least = d, best = v;
    }
    return best;
  }
};

/// In [0, 1), the same on every platform.
inline double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }
inline Index below(std::mt19937& random, std::size_t limit) {
  return static_cast<Index>(uniform(random) * static_cast<double>(limit));
}

/// A rectangle of nx by ny cells, cut along one diagonal.
inline Surface grid(Index nx, Index ny, double width = 1, double height = 1) {
  Surface s;
  for (Index j = 0; j <= ny; ++j)
    for (Index i = 0; i <= nx; ++i) s.add(width * i / nx, height * j / ny);
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + nx + 1;
      s.quad(a, a + 1, b + 1, b);
    }
  return s;
}

/// The faces whose centroid passes; vertices stay, so that some may be left unreferenced.
template <class Keep>
Surface cut(Surface s, Keep keep) {
  std::erase_if(s.faces, [&](const Face& f) {
    double x = 0, y = 0;
    for (const Index v : f) x += s.positions[v][0] / 3, y += s.positions[v][1] / 3;
    return !keep(x, y);
  });
  return s;
}

/// The unit square, open along x = 1/2 from y = 0 to y = 1/2 (n even). Vertices on the right lip
/// are behind the grid's own.
inline Surface slit_square(Index n) {
  Surface s = grid(n, n);
  std::map<Index, Index> right;
  for (Index j = 0; j < n / 2; ++j) {
    const Index v = j * (n + 1) + n / 2;
    right[v] = s.add(s.positions[v][0], s.positions[v][1]);
  }
  for (Face& f : s.faces) {
    double x = 0;
    for (const Index v : f) x += s.positions[v][0] / 3;
    if (x > 0.5)
      for (Index& v : f)
        if (const auto found = right.find(v); found != right.end()) v = found->second;
  }
  return s;
}

/// Twice the signed area of a flat triangle.
inline double area2(const Surface& s, Index a, Index b, Index c) {
  const Position &p = s.positions[a], &q = s.positions[b], &r = s.positions[c];
  return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
}

/// A regular polygon with random points in it: each point splits the triangle it falls in, which
/// makes thin triangles, and random flips mix them. Far from Delaunay.
inline Surface random_polygon(Index corners, Index points, Index flips, unsigned seed) {
  std::mt19937 random(seed);
  Surface s;
  for (Index i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners + 0.3;
    s.add(std::cos(a), std::sin(a));
  }
  for (Index i = 1; i + 1 < corners; ++i) s.triangle(0, i, i + 1);
  while (s.positions.size() < corners + points) {
    const Index v = s.add(2 * uniform(random) - 1, 2 * uniform(random) - 1);
    const auto inside = std::find_if(s.faces.begin(), s.faces.end(), [&](const Face& f) {
      for (std::size_t i = 0; i < 3; ++i)
        if (!(area2(s, f[i], f[(i + 1) % 3], v) > 1e-7)) return false;
      return true;
    });
    if (inside == s.faces.end()) {
      s.positions.pop_back();
      continue;
    }
    const Face f = *inside;
    *inside = {f[0], f[1], v};
    s.triangle(f[1], f[2], v);
    s.triangle(f[2], f[0], v);
  }
  for (Index n = 0; n < flips; ++n) {
    Face& f = s.faces[below(random, s.faces.size())];
    const std::size_t i = below(random, 3);
    const Index a = f[i], b = f[(i + 1) % 3], c = f[(i + 2) % 3];
    for (Face& g : s.faces)
      for (std::size_t j = 0; j < 3; ++j) {
        if (g[j] != b || g[(j + 1) % 3] != a) continue;
        const Index d = g[(j + 2) % 3];
        if (area2(s, a, d, c) > 1e-7 && area2(s, d, b, c) > 1e-7) {
          f = {a, d, c};
          g = {d, b, c};
        }
        goto next;
      }
  next:;
  }
  return s;
}

/// The unit cube's surface, n by n cells a side.
inline Surface cube(Index n) {
  Surface s;
  std::map<std::array<Index, 3>, Index> named;
  const auto at = [&](Index x, Index y, Index z) {
    const auto [place, fresh] = named.try_emplace({x, y, z}, 0);
    if (fresh) place->second = s.add(double(x) / n, double(y) / n, double(z) / n);
    return place->second;
  };
  for (Index side : {Index(0), n})
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const bool out = side != 0;  // outward faces all around
        const auto put = [&](auto corner) {
          const Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                      d = corner(i, j + 1);
          if (out)
            s.quad(a, b, c, d);
          else
            s.quad(a, d, c, b);
        };
        put([&](Index u, Index w) { return at(side, u, w); });
        put([&](Index u, Index w) { return at(w, side, u); });
        put([&](Index u, Index w) { return at(u, w, side); });
      }
  return s;
}

inline Surface tetrahedron() {
  Surface s;
  const double h = std::sqrt(0.75), z = std::sqrt(2. / 3);
  s.add(0, 0), s.add(1, 0), s.add(0.5, h), s.add(0.5, h / 3, z);
  s.triangle(0, 2, 1), s.triangle(0, 1, 3), s.triangle(1, 2, 3), s.triangle(2, 0, 3);
  return s;
}

/// Every triangle into four.
inline Surface subdivide(const Surface& coarse) {
  Surface s;
  s.positions = coarse.positions;
  std::map<std::pair<Index, Index>, Index> middle;
  const auto between = [&](Index a, Index b) {
    const auto [place, fresh] = middle.try_emplace(std::minmax(a, b), 0);
    if (fresh) {
      const Position &p = s.positions[a], &q = s.positions[b];
      place->second = s.add((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    }
    return place->second;
  };
  for (const Face& f : coarse.faces) {
    const Index a = between(f[0], f[1]), b = between(f[1], f[2]), c = between(f[2], f[0]);
    s.triangle(f[0], a, c), s.triangle(a, f[1], b), s.triangle(c, b, f[2]), s.triangle(a, b, c);
  }
  return s;
}

inline Surface sphere(int levels) {
  Surface s;
  for (int d = 0; d < 3; ++d)
    for (const double sign : {1., -1.}) {
      Position p{};
      p[static_cast<std::size_t>(d)] = sign;
      s.positions.push_back(p);
    }
  for (Index x : {0u, 1u})
    for (Index y : {2u, 3u})
      for (Index z : {4u, 5u}) {
        if ((x + y + z) % 2 == 0)
          s.triangle(x, y, z);
        else
          s.triangle(x, z, y);
      }
  for (int level = 0; level < levels; ++level) {
    s = subdivide(s);
    for (Position& p : s.positions) {
      const double r = std::hypot(p[0], p[1], p[2]);
      for (double& c : p) c /= r;
    }
  }
  return s;
}

/// A prism of n sides, open above and below: side 1 long, unrolls to a rectangle n wide.
inline Surface prism(Index n, Index rows, double height) {
  Surface s;
  const double r = 0.5 / std::sin(std::numbers::pi / n);
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i < n; ++i)
      s.add(r * std::cos(2 * std::numbers::pi * i / n), r * std::sin(2 * std::numbers::pi * i / n),
            height * j / rows);
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * n + i, b = j * n + (i + 1) % n;
      s.quad(a, b, b + n, a + n);
    }
  return s;
}

inline Surface moebius(Index n, Index rows = 2) {
  Surface s;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j <= rows; ++j) {
      const double a = 2 * std::numbers::pi * i / n, w = double(j) / rows - 0.5;
      s.add((2 + w * std::cos(a / 2)) * std::cos(a), (2 + w * std::cos(a / 2)) * std::sin(a),
            w * std::sin(a / 2));
    }
  const auto at = [&](Index i, Index j) {
    return i < n ? i * (rows + 1) + j : rows - j;  // the seam turns it over
  };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < rows; ++j) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

/// Rectangles 1 by 1 that share the edge x = 0; sheet k stands at its own angle.
inline Surface sheets(Index count, Index n) {
  Surface s;
  for (Index j = 0; j <= n; ++j) s.add(0, 0, double(j) / n);
  for (Index k = 0; k < count; ++k) {
    const double a = 2 * std::numbers::pi * k / count + 0.1;
    const Index first = static_cast<Index>(s.positions.size());
    for (Index i = 1; i <= n; ++i)
      for (Index j = 0; j <= n; ++j) s.add(std::cos(a) * i / n, std::sin(a) * i / n, double(j) / n);
    const auto at = [&](Index i, Index j) { return i == 0 ? j : first + (i - 1) * (n + 1) + j; };
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        if (k % 2)
          s.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        else
          s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return s;
}

/// Two squares [0, 1]^2 and [1, 2]^2 that touch in (1, 1) only.
inline Surface bow_tie(Index n) {
  Surface s = grid(n, n);
  const Index joint = static_cast<Index>(s.positions.size() - 1);
  const Surface other = grid(n, n);
  const Index shift = joint;  // the other's vertex 0 is the joint
  for (std::size_t v = 1; v < other.positions.size(); ++v)
    s.add(other.positions[v][0] + 1, other.positions[v][1] + 1);
  for (const Face& f : other.faces) s.triangle(f[0] + shift, f[1] + shift, f[2] + shift);
  return s;
}

/// Random points, random triangles between them: every awkwardness at once.
inline Surface soup(Index points, Index triangles, unsigned seed) {
  std::mt19937 random(seed);
  Surface s;
  for (Index v = 0; v < points; ++v) s.add(uniform(random), uniform(random), uniform(random));
  while (s.faces.size() < triangles) {
    const Index a = below(random, points), b = below(random, points), c = below(random, points);
    if (a != b && b != c && c != a) s.triangle(a, b, c);
  }
  return s;
}

/// The same surface with other numbers: vertex v becomes vertex[v].
struct Renamed {
  Surface surface;
  std::vector<Index> vertex;
};
inline Renamed renamed(const Surface& s, unsigned seed, bool vertices, bool turn_over = false) {
  std::mt19937 random(seed);
  Renamed r;
  r.vertex.resize(s.positions.size());
  for (Index v = 0; v < r.vertex.size(); ++v) r.vertex[v] = v;
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(random, i)]);
  };
  if (vertices) shuffle(r.vertex);
  r.surface.positions.resize(s.positions.size());
  for (std::size_t v = 0; v < r.vertex.size(); ++v)
    r.surface.positions[r.vertex[v]] = s.positions[v];
  r.surface.faces = s.faces;
  shuffle(r.surface.faces);
  for (Face& f : r.surface.faces) {
    for (Index& v : f) v = r.vertex[v];
    std::rotate(f.begin(), f.begin() + below(random, 3), f.end());
    if (turn_over && random() % 2) std::swap(f[1], f[2]);
  }
  return r;
}

/// lengths[f][i] from corner i to the next.
inline std::vector<std::array<double, 3>> lengths_of(const Surface& s) {
  std::vector<std::array<double, 3>> lengths;
  for (const Face& f : s.faces) {
    std::array<double, 3> row{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Position &p = s.positions[f[i]], &q = s.positions[f[(i + 1) % 3]];
      row[i] = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }
    lengths.push_back(row);
  }
  return lengths;
}

}  // namespace plexway::testing
