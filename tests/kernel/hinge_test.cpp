// The kernel against the oracle, on random hinges and on hinges made to break it.

#include "hinge_oracle.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "kernel/hinge.hpp"

namespace hinge_test {

namespace {

using oracle::Hinge;
using oracle::Random;
using oracle::Simplex;
using oracle::Vector;

template <class Real_, int K_>
struct Case {
  using Real = Real_;
  static constexpr int K = K_;
  using Kernel = plexway::detail::kernel::HingeKernel<Real, K>;
  /// With lengths about 1, heights from 0.05 and squares as input: what rounding can do at worst.
  static constexpr double close = std::is_same_v<Real, float> ? 1e-3 : 1e-11;
};

#define ALL_CASES                                                                            \
  (Case<float, 0>), (Case<float, 1>), (Case<float, 2>), (Case<float, 3>), (Case<double, 0>), \
      (Case<double, 1>), (Case<double, 2>), (Case<double, 3>)

/// The kernel's view of a hinge: squared lengths only.
template <class C>
struct Posed {
  using Real = typename C::Real;
  using Kernel = typename C::Kernel;
  typename Kernel::HingePose pose;
  typename Kernel::HingePoint S, q, v;

  explicit Posed(const Hinge& hinge, double scale = 1) {
    Real edge2[Kernel::KE] = {};
    size_t e = 0;
    for (size_t j = 0; j < hinge.I.size(); ++j)
      for (size_t i = 0; i < j; ++i)
        edge2[e++] = static_cast<Real>((scale * (hinge.I[i] - hinge.I[j])).squaredNorm());
    pose = Kernel::make_pose(edge2);
    S = located(hinge, hinge.S, scale);
    q = located(hinge, hinge.q, scale);
    v = located(hinge, hinge.v, scale);
  }
  auto located(const Hinge& hinge, const Vector& p, double scale = 1) const {
    Real d2[C::K + 1] = {};
    for (size_t i = 0; i < hinge.I.size(); ++i)
      d2[i] = static_cast<Real>((scale * (p - hinge.I[i])).squaredNorm());
    return Kernel::locate(pose, d2);
  }
  auto carried(bool is_behind = false) const {
    return Kernel::carry(pose, S, Real(0), q, is_behind, Real(0));
  }
  double distance(const typename Kernel::HingePoint& a,
                  const typename Kernel::HingePoint& b) const {
    return std::sqrt(static_cast<double>(Kernel::distance_squared(pose, a, b)));
  }
  /// Length of the whole path to q that a step stands for.
  double path(const typename Kernel::HingeStep& step) const {
    return static_cast<double>(step.sigma) + distance(step.source, q);
  }
};

/// Back into space, by barycentric coordinates.
template <class C>
Vector embedded(const Hinge& hinge, const Posed<C>& posed,
                const typename C::Kernel::HingePoint& p) {
  typename C::Kernel::HingeCrossing c;
  for (int j = 0; j < C::Kernel::KX; ++j) c.x[j] = p.x[j];
  c.w = 1;
  const auto weights = C::Kernel::weights(posed.pose, c);
  Vector sum = Vector::Zero(hinge.S.size());
  for (size_t i = 0; i < hinge.I.size(); ++i) sum += static_cast<double>(weights.b[i]) * hinge.I[i];
  return sum;
}

struct Worst {
  double error = 0;
  int index = -1;
  void see(double a, double b, int i) {
    const double e = std::abs(a - b);
    if (!(e <= error)) error = e, index = i;
  }
};

template <class C, int N>
bool finite(const typename C::Real (&values)[N]) {
  return std::all_of(values, values + N, [](auto x) { return std::isfinite(x); });
}

}  // namespace

TEMPLATE_TEST_CASE("a located point has its distances", "[kernel]", ALL_CASES) {
  Random random{std::mt19937_64{11}};
  Worst feet, heights;
  for (int i = 0; i < 3000; ++i) {
    const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const Posed<TestType> posed(hinge);
    const Vector foot = oracle::foot(hinge.I, hinge.S);
    feet.see((embedded(hinge, posed, posed.S) - foot).norm(), 0, i);
    heights.see(static_cast<double>(posed.S.h), (hinge.S - foot).norm(), i);
  }
  CAPTURE(feet.index, heights.index);
  CHECK(feet.error < TestType::close);
  CHECK(heights.error < TestType::close);
}

TEMPLATE_TEST_CASE("crossing, visibility and distance agree with the embedding", "[kernel]",
                   ALL_CASES) {
  using Kernel = typename TestType::Kernel;
  Random random{std::mt19937_64{12}};
  Worst crossings, distances;
  int clear = 0, flips = 0, seen = 0;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const Posed<TestType> posed(hinge);
    const auto c = Kernel::crossing(posed.S, posed.q);
    auto p = posed.S;
    for (int j = 0; j < Kernel::KX; ++j) p.x[j] = c.x[j] / c.w;
    const Vector expected = hinge.crossing();
    crossings.see((embedded(hinge, posed, p) - expected).norm(), 0, i);
    distances.see(posed.distance(posed.S, posed.v), hinge.straight(hinge.v), i);

    const double slack = oracle::barycentric(hinge.I, expected).minCoeff();
    if (std::abs(slack) < 3 * TestType::close) continue;
    ++clear;
    seen += slack > 0;
    flips += Kernel::inside(posed.pose, c, 0) != (slack > 0);
    const auto step = posed.carried();
    CHECK(step.visible == (slack > 0 && TestType::K > 0));
  }
  CAPTURE(crossings.index, distances.index);
  CHECK(crossings.error < TestType::close);
  CHECK(distances.error < TestType::close);
  CHECK(flips == 0);
  CHECK(clear > count * 9 / 10);
  CHECK(seen > count / 50);
}

TEMPLATE_TEST_CASE("a bend is the shortest way over the boundary", "[kernel]", ALL_CASES) {
  Random random{std::mt19937_64{13}};
  Worst lengths, totals, walked;
  int longer_than_straight = 0, bends = 0;
  const int count = TestType::K == 3 ? 600 : 3000;
  for (int i = 0; i < count; ++i) {
    const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const Posed<TestType> posed(hinge);
    const auto step = posed.carried(i % 2 == 0);  // a source behind bends even where it would see
    if (step.visible) continue;
    ++bends;
    const Vector b = embedded(hinge, posed, step.source);
    lengths.see(posed.path(step), oracle::shortest_bend(hinge), i);
    totals.see(hinge.bent_at(b), oracle::shortest_bend(hinge), i);
    walked.see(static_cast<double>(step.sigma), (hinge.S - b).norm(), i);
    longer_than_straight += posed.path(step) > hinge.straight(hinge.q) - TestType::close;
    CHECK(oracle::barycentric(hinge.I, b).minCoeff() > -1e-5);
    CHECK(step.source.h == 0);
  }
  CAPTURE(lengths.index, totals.index, walked.index);
  CHECK(lengths.error < TestType::close);
  CHECK(totals.error < TestType::close);
  CHECK(walked.error < TestType::close);
  CHECK(longer_than_straight == bends);
  CHECK(bends > count / 4);
}

TEMPLATE_TEST_CASE("a source is behind exactly when it is on the far side", "[kernel]", ALL_CASES) {
  using Real = typename TestType::Real;
  Random random{std::mt19937_64{15}};
  for (int i = 0; i < 2000; ++i) {
    const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const Posed<TestType> posed(hinge);
    const Vector up = (hinge.S - oracle::foot(hinge.I, hinge.S)).normalized();
    const double height = random.uniform(0.05, 2);
    for (const double side : {1.0, -1.0}) {
      const Vector u = hinge.I[0] + side * height * up;
      const auto d2 = static_cast<Real>((hinge.S - u).squaredNorm());
      const Real behind =
          TestType::Kernel::behind(posed.pose, posed.S, posed.located(hinge, u), d2);
      CHECK((behind > 0) == (side < 0));
    }
  }
  // On the span: no side.
  Hinge flat = oracle::random_hinge(random, TestType::K, 0.2);
  flat.S = oracle::foot(flat.I, flat.S);
  const Posed<TestType> posed(flat);
  const auto d2 = static_cast<Real>((flat.S - flat.v).squaredNorm());
  CHECK_FALSE(TestType::Kernel::behind(posed.pose, posed.S, posed.v, d2) > Real(1e-3));
}

TEMPLATE_TEST_CASE("the order of I's vertices does not matter", "[kernel]", ALL_CASES) {
  Random random{std::mt19937_64{16}};
  Worst paths, distances;
  for (int i = 0; i < 3000; ++i) {
    const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    Hinge shuffled = hinge;
    std::shuffle(shuffled.I.begin(), shuffled.I.end(), random.engine);
    const Posed<TestType> a(hinge), b(shuffled);
    paths.see(a.path(a.carried()), b.path(b.carried()), i);
    distances.see(a.distance(a.S, a.v), b.distance(b.S, b.v), i);
  }
  CAPTURE(paths.index, distances.index);
  CHECK(paths.error < TestType::close);
  CHECK(distances.error < TestType::close);
}

TEMPLATE_TEST_CASE("a change of unit scales every length", "[kernel]", ALL_CASES) {
  Random random{std::mt19937_64{17}};
  for (const double scale : {1e-6, 1e6}) {
    Worst paths, distances;
    for (int i = 0; i < 2000; ++i) {
      const Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
      const Posed<TestType> unit(hinge), scaled(hinge, scale);
      paths.see(unit.path(unit.carried()), scaled.path(scaled.carried()) / scale, i);
      distances.see(unit.distance(unit.S, unit.v), scaled.distance(scaled.S, scaled.v) / scale, i);
    }
    CAPTURE(scale, paths.index, distances.index);
    CHECK(paths.error < TestType::close);
    CHECK(distances.error < TestType::close);
  }
}

TEMPLATE_TEST_CASE("points on the span of I are ordinary", "[kernel]", ALL_CASES) {
  Random random{std::mt19937_64{18}};
  // Distances give a height of 0 only to the square root of their rounding.
  const double close = std::sqrt(TestType::close) * 0.1;
  for (int i = 0; i < 300; ++i) {
    Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    if (i % 3 != 0) hinge.S = oracle::foot(hinge.I, hinge.S);
    if (i % 3 != 1) hinge.q = oracle::foot(hinge.I, hinge.q);
    const Posed<TestType> posed(hinge);
    const auto step = posed.carried();
    const double shortest = oracle::shortest_over(
        hinge, TestType::K < 3 ? hinge.I : Simplex(hinge.I.begin(), hinge.I.begin() + 1));
    if (TestType::K < 3)
      CHECK(posed.path(step) == Approx(shortest).margin(close));
    else
      CHECK(posed.path(step) < shortest + close);
    CHECK(posed.path(step) > (hinge.S - hinge.q).norm() - close);
  }
  // Both exactly in the span: S's own foot decides, so no path is too short.
  using Kernel = typename TestType::Kernel;
  const Posed<TestType> posed(oracle::random_hinge(random, TestType::K, 0.2));
  auto in = Kernel::vertex_point(posed.pose, 0);
  auto out = in;
  out.x[0] = -1;
  CHECK(Kernel::inside(posed.pose, Kernel::crossing(in, out), typename TestType::Real(1e-6)));
  if (TestType::K > 0) CHECK_FALSE(Kernel::inside(posed.pose, Kernel::crossing(out, in), 0));
}

TEMPLATE_TEST_CASE("thin hinges stay accurate in proportion", "[kernel]", (Case<float, 1>),
                   (Case<double, 1>), (Case<double, 2>), (Case<double, 3>)) {
  // As in a needle triangle, an edge 1e3 times longer than the distance from one of its ends: the
  // error must stay a fraction of that distance, and not of the edge.
  Random random{std::mt19937_64{19}};
  Worst worst;
  for (int i = 0; i < 1000; ++i) {
    Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const bool first = TestType::K == 1 && i % 2 == 0;  // beyond K = 1 the caller picks vertex 0
    hinge.I.back() = hinge.I[0] + 1e3 * (hinge.I.back() - hinge.I[0]);
    if (first) std::swap(hinge.I.front(), hinge.I.back());
    const Posed<TestType> posed(hinge);
    const double height = (hinge.v - oracle::foot(hinge.I, hinge.v)).norm();
    const double nearest = (hinge.v - (first ? hinge.I.back() : hinge.I.front())).norm();
    const auto h = static_cast<double>(posed.v.h);
    worst.see((h * h - height * height) / nearest, 0, i);
  }
  CAPTURE(worst.index);
  CHECK(worst.error < (std::is_same_v<typename TestType::Real, float> ? 2e-3 : 1e-9));
}

TEMPLATE_TEST_CASE("degenerate hinges give the path over what is left of them", "[kernel]",
                   (Case<float, 1>), (Case<float, 2>), (Case<double, 1>), (Case<double, 2>)) {
  Random random{std::mt19937_64{20}};
  const double close = std::sqrt(TestType::close);
  for (int i = 0; i < 400; ++i) {
    Hinge hinge = oracle::random_hinge(random, TestType::K, 0.2);
    const Vector edge = hinge.I[1] - hinge.I[0];
    if (TestType::K == 2) hinge.I[2] = hinge.I[0] + random.uniform(-1, 2) * edge;  // collinear
    if (i % 4 == 0) hinge.I.back() = hinge.I[0];                                   // zero length
    if (i % 8 == 0) hinge.I.assign(hinge.I.size(), hinge.I[0]);                    // a point
    const Posed<TestType> posed(hinge);
    CHECK(posed.path(posed.carried()) ==
          Approx(oracle::shortest_over(hinge, hinge.I)).margin(close));
  }
}

TEMPLATE_TEST_CASE("a flat tetrahedron gives a path over it, if not the best", "[kernel]",
                   (Case<float, 3>), (Case<double, 3>)) {
  Random random{std::mt19937_64{22}};
  for (int i = 0; i < 20; ++i) {
    Hinge hinge = oracle::random_hinge(random, 3, 0.2);
    hinge.I[3] = oracle::foot(Simplex(hinge.I.begin(), hinge.I.begin() + 3), hinge.I[3]);
    const Posed<TestType> posed(hinge);
    const double path = posed.path(posed.carried());
    const double close = std::sqrt(TestType::close);
    double vertices = std::numeric_limits<double>::infinity();
    for (const Vector& b : hinge.I) vertices = std::min(vertices, hinge.bent_at(b));
    CHECK(path > oracle::shortest_over(hinge, hinge.I) - close);
    CHECK(path < vertices + close);
  }
}

TEMPLATE_TEST_CASE("no input gives NaN", "[kernel]", ALL_CASES) {
  using Real = typename TestType::Real;
  using Kernel = typename TestType::Kernel;
  constexpr int K = TestType::K;
  Random random{std::mt19937_64{21}};
  // Squared lengths of no metric at all, zero among them.
  const auto any = [&] {
    const double pick = random.uniform(0, 1);
    if (pick < 0.15) return Real(0);
    return static_cast<Real>(pick < 0.5 ? random.uniform(0, 2)
                                        : std::pow(10.0, random.uniform(-12, 12)));
  };
  int bad = 0;
  for (int i = 0; i < 100000; ++i) {
    Real edge2[Kernel::KE], s2[K + 1], q2[K + 1];
    for (Real& x : edge2) x = any();
    for (Real& x : s2) x = any();
    for (Real& x : q2) x = any();
    const auto pose = Kernel::make_pose(edge2);
    const auto S = Kernel::locate(pose, s2), q = Kernel::locate(pose, q2);
    const auto step = Kernel::carry(pose, S, Real(0), q, i % 5 == 0, Real(1e-6));
    bool good = finite<TestType>(S.x) && S.h >= 0 && finite<TestType>(step.source.x);
    for (const Real x :
         {S.h, q.h, step.sigma, step.source.h, Kernel::distance_squared(pose, step.source, q),
          Kernel::behind(pose, S, q, s2[0])})
      good = good && std::isfinite(x);
    bad += !good || step.sigma < 0;
  }
  CHECK(bad == 0);
}

TEST_CASE("K = 2 bends where no projection would", "[kernel]") {
  // A long thin triangle; the way round its lower edge meets it far from the crossing's foot.
  using Kernel = plexway::detail::kernel::HingeKernel<double, 2>;
  Hinge hinge;
  const auto at = [](double x, double y, double z) { return Vector(Eigen::Vector3d(x, y, z)); };
  hinge.I = {at(0, 0, 0), at(10, 0, 0), at(5, 3, 0)};
  hinge.S = at(1, -3, 0.1);
  hinge.q = at(9, -1, -4);
  const double edge2[] = {100, 34, 34};
  const auto pose = Kernel::make_pose(edge2);
  const auto located = [&](const Vector& p) {
    double d2[3];
    for (size_t i = 0; i < 3; ++i) d2[i] = (p - hinge.I[i]).squaredNorm();
    return Kernel::locate(pose, d2);
  };
  const auto S = located(hinge.S), q = located(hinge.q);
  const auto step = Kernel::carry(pose, S, 0.0, q, false, 0.0);
  REQUIRE_FALSE(step.visible);
  const double path = step.sigma + std::sqrt(Kernel::distance_squared(pose, step.source, q));
  CHECK(path == Approx(oracle::shortest_bend(hinge)).epsilon(1e-9));
  const Vector crossing = at(1 + 8 * 0.1 / 4.1, 0, 0);  // projected onto the lower edge
  CHECK(path < hinge.bent_at(crossing) - 0.1);
}

}  // namespace hinge_test
