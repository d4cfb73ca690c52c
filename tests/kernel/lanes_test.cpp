// Real may be a SIMD type down to `distance_squared`: four hinges at once give the same bits as one
// after another. This pins what such a type has to bring.

#include <catch2/catch.hpp>

#include <random>

#include "kernel/hinge.hpp"

namespace lanes {

struct Float4 {
  float at[4];
  Float4() = default;
  Float4(float a) : at{a, a, a, a} {}
};
struct Mask4 {
  bool at[4];
};

template <class Result = Float4, class F>
Result each(F f) {
  Result r{};
  for (int i = 0; i < 4; ++i) r.at[i] = f(i);
  return r;
}
Float4 operator+(Float4 a, Float4 b) {
  return each([&](int i) { return a.at[i] + b.at[i]; });
}
Float4 operator-(Float4 a, Float4 b) {
  return each([&](int i) { return a.at[i] - b.at[i]; });
}
Float4 operator*(Float4 a, Float4 b) {
  return each([&](int i) { return a.at[i] * b.at[i]; });
}
Float4 operator/(Float4 a, Float4 b) {
  return each([&](int i) { return a.at[i] / b.at[i]; });
}
Float4 operator-(Float4 a) {
  return each([&](int i) { return -a.at[i]; });
}
Float4& operator+=(Float4& a, Float4 b) { return a = a + b; }
Float4& operator-=(Float4& a, Float4 b) { return a = a - b; }
Mask4 operator>(Float4 a, Float4 b) {
  return each<Mask4>([&](int i) { return a.at[i] > b.at[i]; });
}
Mask4 operator<=(Float4 a, Float4 b) {
  return each<Mask4>([&](int i) { return a.at[i] <= b.at[i]; });
}
Float4 max(Float4 a, Float4 b) {
  return each([&](int i) { return plexway::kernel::max(a.at[i], b.at[i]); });
}
Float4 min(Float4 a, Float4 b) {
  return each([&](int i) { return plexway::kernel::min(a.at[i], b.at[i]); });
}
Float4 select(Mask4 c, Float4 a, Float4 b) {
  return each([&](int i) { return c.at[i] ? a.at[i] : b.at[i]; });
}
Float4 sqrt(Float4 a) {
  return each([&](int i) { return plexway::kernel::sqrt(a.at[i]); });
}

}  // namespace lanes

template <>
struct std::numeric_limits<lanes::Float4> : std::numeric_limits<float> {};

namespace lanes_test {

namespace {

template <int K>
void check_lanes() {
  using One = plexway::kernel::HingeKernel<float, K>;
  using Four = plexway::kernel::HingeKernel<lanes::Float4, K>;
  std::mt19937 engine{31};
  std::uniform_real_distribution<float> uniform(0.5f, 1.5f);
  for (int n = 0; n < 1000; ++n) {
    lanes::Float4 edge2[Four::KE], s2[K + 1], q2[K + 1];
    for (auto* values : {&edge2[0], &s2[0], &q2[0]})
      for (int i = 0; i < (values == edge2 ? Four::KE : K + 1); ++i)
        for (float& x : values[i].at) x = uniform(engine);
    const lanes::Float4 qv2 = s2[0];
    const auto pose = Four::make_pose(edge2);
    const auto S = Four::locate(pose, s2), q = Four::locate(pose, q2);
    const auto distance2 = Four::distance_squared(pose, S, q);
    const auto slack = Four::slack(pose, Four::crossing(S, q), 0.01f);
    const auto behind = Four::behind(pose, S, q, qv2);
    const auto o = Four::offset(pose, q, S, qv2);
    for (int l = 0; l < 4; ++l) {
      float edge2_1[One::KE], s2_1[K + 1], q2_1[K + 1];
      for (int i = 0; i < One::KE; ++i) edge2_1[i] = edge2[i].at[l];
      for (int i = 0; i <= K; ++i) s2_1[i] = s2[i].at[l], q2_1[i] = q2[i].at[l];
      const auto pose1 = One::make_pose(edge2_1);
      const auto S1 = One::locate(pose1, s2_1), q1 = One::locate(pose1, q2_1);
      REQUIRE(distance2.at[l] == One::distance_squared(pose1, S1, q1));
      REQUIRE(slack.at[l] == One::slack(pose1, One::crossing(S1, q1), 0.01f));
      REQUIRE(behind.at[l] == One::behind(pose1, S1, q1, qv2.at[l]));
      REQUIRE(o.r2.at[l] == One::offset(pose1, q1, S1, qv2.at[l]).r2);
    }
  }
}

}  // namespace

TEST_CASE("lanes of a SIMD number agree with scalars to the bit", "[kernel]") {
  check_lanes<0>();
  check_lanes<1>();
  check_lanes<2>();
  check_lanes<3>();
}

}  // namespace lanes_test
