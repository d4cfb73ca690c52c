#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

/// Hinges in explicit coordinates, solved by linear algebra and by searching. Shares nothing with
/// the kernel: no poses, no unfolding formula, no closed form for the bend.
namespace oracle {

using Vector = Eigen::VectorXd;
using Simplex = std::vector<Vector>;

/// Columns: edges from vertex 0.
inline Eigen::MatrixXd edges(const Simplex& simplex) {
  const auto k = static_cast<Eigen::Index>(simplex.size()) - 1;
  Eigen::MatrixXd e(simplex[0].size(), k);
  for (Eigen::Index i = 0; i < k; ++i) e.col(i) = simplex[static_cast<size_t>(i) + 1] - simplex[0];
  return e;
}

inline Vector foot(const Simplex& simplex, const Vector& p) {
  if (simplex.size() == 1) return simplex[0];
  const Eigen::MatrixXd e = edges(simplex);
  return simplex[0] + e * e.colPivHouseholderQr().solve(p - simplex[0]);
}

inline Vector barycentric(const Simplex& simplex, const Vector& p) {
  Eigen::MatrixXd a(p.size() + 1, static_cast<Eigen::Index>(simplex.size()));
  for (size_t i = 0; i < simplex.size(); ++i)
    a.col(static_cast<Eigen::Index>(i)) << simplex[i], 1.0;
  Vector b(p.size() + 1);
  b << p, 1.0;
  return a.colPivHouseholderQr().solve(b);
}

/// A hinge I with S on one side and q, v on the other, each in its own direction off the span: the
/// hinge really is folded, by any angle.
struct Hinge {
  Simplex I;
  Vector S, q, v;

  /// T rotated about the span of I until q is opposite S; `p` turns along with q.
  Vector unfolded(const Vector& p) const {
    const Vector up = (S - foot(I, S)).normalized();
    const Vector out = (q - foot(I, q)).normalized();
    const Vector base = foot(I, p);
    const Vector rest = p - base;
    const double along = rest.dot(out);
    // What is at right angles to q's direction stays at right angles to S's as well.
    const Vector side = any_normal(up) * (rest - along * out).norm();
    return base - along * up + side;
  }

  /// A unit vector at right angles to the span of I and to `up`.
  Vector any_normal(const Vector& up) const {
    Simplex with = I;
    with.push_back(I[0] + up);
    Vector best = Vector::Zero(S.size());
    for (Eigen::Index i = 0; i < S.size(); ++i) {
      const Vector p = I[0] + Vector::Unit(S.size(), i);
      const Vector off = p - foot(with, p);
      if (off.norm() > best.norm()) best = off;
    }
    return best.normalized();
  }

  /// The straight line from S to the unfolded q meets the span where S + s (q - S) = v0 + E y.
  Vector crossing() const {
    const Eigen::MatrixXd e = edges(I);
    const Vector target = unfolded(q);
    Eigen::MatrixXd a(S.size(), e.cols() + 1);
    a << e, S - target;
    const Vector solution = a.colPivHouseholderQr().solve(S - I[0]);
    return S + solution(e.cols()) * (target - S);
  }

  double straight(const Vector& p) const { return (unfolded(p) - S).norm(); }
  double bent_at(const Vector& b) const { return (S - b).norm() + (b - q).norm(); }
};

/// The least value of a convex function on [0, 1].
inline double least(const std::function<double(double)>& f) {
  const double golden = 0.6180339887498949;
  double a = 0, b = 1;
  double x = b - golden, y = a + golden, fx = f(x), fy = f(y);
  double best = std::min({f(0), f(1), fx, fy});
  for (int i = 0; i < 45; ++i) {
    if (fx < fy) {
      b = y, y = x, fy = fx, x = b - golden * (b - a), fx = f(x);
    } else {
      a = x, x = y, fx = fy, y = a + golden * (b - a), fy = f(y);
    }
    best = std::min({best, fx, fy});
  }
  return best;
}

/// The shortest path from S to q that touches this simplex: nested searches, one per dimension.
inline double shortest_over(const Hinge& hinge, const Simplex& face) {
  if (face.size() == 1) return hinge.bent_at(face[0]);
  return least([&](double t) {
    Simplex slice;
    for (size_t i = 1; i < face.size(); ++i) slice.push_back(face[0] + t * (face[i] - face[0]));
    return shortest_over(hinge, slice);
  });
}

/// ... that touches the boundary of I.
inline double shortest_bend(const Hinge& hinge) {
  if (hinge.I.size() == 1) return hinge.bent_at(hinge.I[0]);
  double best = std::numeric_limits<double>::infinity();
  for (size_t m = 0; m < hinge.I.size(); ++m) {
    Simplex face = hinge.I;
    face.erase(face.begin() + static_cast<std::ptrdiff_t>(m));
    best = std::min(best, shortest_over(hinge, face));
  }
  return best;
}

struct Random {
  std::mt19937_64 engine;
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(engine); }
  Vector gauss(Eigen::Index n) {
    Vector x(n);
    for (auto& c : x) c = std::normal_distribution<>()(engine);
    return x;
  }
  Eigen::MatrixXd rotation(Eigen::Index n) {
    Eigen::MatrixXd m(n, n);
    for (Eigen::Index i = 0; i < n; ++i) m.col(i) = gauss(n);
    return m.householderQr().householderQ();
  }
};

/// A hinge in R^(K+3), its lengths about 1. `shape`: the least height of I's vertices over the
/// opposite faces, relative to I's longest edge or 1. `codimension` of I in T: with 1, v is off the
/// span in q's direction.
inline Hinge random_hinge(Random& random, int K, double shape, int codimension = 1) {
  const Eigen::Index n = K + 3;
  const auto in_span = [&](double spread) {
    Vector p = Vector::Zero(n);
    p.head(K) = spread * random.gauss(K);
    return p;
  };
  const auto direction = [&] {
    Vector d = Vector::Zero(n);
    d.tail(3) = random.gauss(3).normalized();
    return d;
  };
  Hinge hinge;
  for (bool fair = false; !fair;) {
    hinge.I.assign(1, in_span(1));
    for (int i = 0; i < K; ++i) hinge.I.push_back(in_span(1));
    double longest = 1, lowest = 1e300;
    for (size_t i = 0; i < hinge.I.size(); ++i) {
      Simplex face = hinge.I;
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
      if (face.empty()) break;
      lowest = std::min(lowest, (hinge.I[i] - foot(face, hinge.I[i])).norm());
      for (const Vector& other : face) longest = std::max(longest, (hinge.I[i] - other).norm());
    }
    fair = lowest >= shape * longest;
  }
  // One draw a statement: the order of evaluation within an expression is the compiler's.
  const Vector back = direction();
  const Vector out = direction();
  const Vector other = direction();
  hinge.S = in_span(1);
  hinge.S += random.uniform(0.05, 2) * back;
  hinge.q = in_span(0.7);
  hinge.q += random.uniform(0.05, 1) * out;
  hinge.v = in_span(1);
  hinge.v += random.uniform(0.05, 1) * (codimension == 1 ? out : other);

  const Eigen::MatrixXd turn = random.rotation(n);
  const Vector shift = random.gauss(n);
  for (Vector* p : {&hinge.S, &hinge.q, &hinge.v}) *p = turn * *p + shift;
  for (Vector& p : hinge.I) p = turn * p + shift;
  return hinge;
}

}  // namespace oracle
