// The texts that C++ and GLSL share give the same numbers in both.

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "executors/gl/buffer.hpp"
#include "executors/gl/front.hpp"
#include "executors/gl/uniforms.hpp"
#include "gl/device.hpp"
#include "kernel/hinge.hpp"
#include "labels/surface/saddle_step.hpp"

namespace text_test {

namespace {

using plexway::gl::Buffer;
using plexway::gl::Session;
using plexway::gl::Uniforms;

constexpr std::size_t count = 32768;

template <class Output, class Input>
std::vector<Output> run(const Session& session, const std::string& shader,
                        const std::string& defines, const std::vector<Input>& inputs) {
  Buffer in("inputs"), out("outputs");
  in.reserve(session, inputs.size() * sizeof(Input));
  out.reserve(session, inputs.size() * sizeof(Output));
  in.write(session, std::span<const Input>(inputs));
  in.bind(session, 0);
  out.bind(session, 1);
  const Uniforms program(session, session.program(shader, defines));
  session.gl.DispatchCompute(static_cast<GLuint>(count / 64), 1, 1);
  session.gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<Output> outputs(inputs.size());
  out.read(session, std::span<Output>(outputs));
  in.release(session);
  out.release(session);
  return outputs;
}

double apart(float a, float b) {
  if (a == b) return 0;
  return std::abs(double(a) - double(b)) /
         std::max({std::abs(double(a)), std::abs(double(b)), 1e-3});
}

// Random hinges by the coordinates of their points: I, S, q, v in K + 2 dimensions.
template <int K>
void check_hinges(const Session& session, double bound) {
  using Kernel = plexway::kernel::HingeKernel<float, K>;
  struct Input {
    float edge2[Kernel::KE], source2[K + 1], probe2[K + 1], vertex2[K + 1];
  };
  struct Output {
    float sigma, distance, visible, behind;
  };
  std::mt19937 engine(40 + K);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Input> inputs(count);
  for (Input& input : inputs) {
    double p[K + 4][K + 2] = {};
    for (auto& point : p)
      for (double& x : point) x = uniform(engine);
    const auto squared = [&](int a, int b) {
      double sum = 0;
      for (int i = 0; i < K + 2; ++i) sum += (p[a][i] - p[b][i]) * (p[a][i] - p[b][i]);
      return static_cast<float>(sum);
    };
    input.edge2[0] = 0;
    for (int b = 1; b <= K; ++b)
      for (int a = 0; a < b; ++a) input.edge2[b * (b - 1) / 2 + a] = squared(a, b);
    for (int i = 0; i <= K; ++i) {
      input.source2[i] = squared(i, K + 1);
      input.probe2[i] = squared(i, K + 2);
      input.vertex2[i] = squared(i, K + 3);
    }
  }
  const auto found = run<Output>(session, "kernel_check.comp",
                                 "#define PLEXWAY_K " + std::to_string(K) + "\n", inputs);
  std::size_t flips = 0, different = 0;
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto pose = Kernel::make_pose(inputs[i].edge2);
    const auto S = Kernel::locate(pose, inputs[i].source2);
    const auto q = Kernel::locate(pose, inputs[i].probe2);
    const auto v = Kernel::locate(pose, inputs[i].vertex2);
    const auto step = Kernel::carry(pose, S, 0, q, false, 0);
    const float d = plexway::kernel::sqrt(Kernel::distance_squared(pose, step.source, v));
    flips += (found[i].visible != 0) != step.visible;
    different += found[i].sigma != step.sigma || found[i].distance != d;
    worst = std::max({worst, apart(found[i].sigma, step.sigma), apart(found[i].distance, d)});
  }
  CAPTURE(K, different, worst);
  CHECK(flips <= (bound == 0 ? 0 : count / 10000));
  CHECK(worst <= bound);
  if (bound == 0) CHECK(different == 0);
}

}  // namespace

TEST_CASE("the hinge kernel gives in a shader what it gives in C++", "[gl]") {
  const auto device = plexway::testing::device();
  if (!device) return;
  const bool exact = plexway::testing::exact(*device);
  const Session session(*device);
  check_hinges<0>(session, exact ? 0 : 1e-4);
  check_hinges<1>(session, exact ? 0 : 1e-4);
  check_hinges<2>(session, exact ? 0 : 1e-3);
  check_hinges<3>(session, exact ? 0 : 1e-3);
}

TEST_CASE("the saddle step gives in a shader what it gives in C++", "[gl]") {
  const auto device = plexway::testing::device();
  if (!device) return;
  const Session session(*device);
  using Kernel = plexway::kernel::SaddleKernel<float>;
  struct Input {
    float x[3], h[3], sigma, width, hinge, cosine, sine, apex_x, apex_h;
    std::uint32_t flags;
  };
  struct Output {
    float x[3], h[3], sigma, distance, corner, limit_x[2], limit_h[2];
    std::uint32_t narrower;
  };
  std::mt19937 engine(51);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Input> inputs(count);
  for (Input& input : inputs) {
    const auto between = [&](float a, float b) { return a + (b - a) * uniform(engine); };
    input.width = between(0.3f, 2);
    input.hinge = between(0.3f, 2);
    input.x[0] = between(-3, 4);
    input.h[0] = between(-0.2f, 4);
    // No limit, one that is an end of the edge, or any on its side.
    for (int side = 0; side < 2; ++side) {
      const float pick = uniform(engine), end = side == 0 ? 0 : input.width;
      input.x[1 + side] = pick < 0.3f   ? input.x[0]
                          : pick < 0.6f ? end
                                        : input.x[0] + (end - input.x[0]) * uniform(engine);
      input.h[1 + side] = pick < 0.3f ? input.h[0] : pick < 0.6f ? 0 : input.h[0] * uniform(engine);
    }
    input.sigma = between(0, 5);
    const float angle = between(0.05f, 3);
    input.cosine = std::cos(angle);
    input.sine = std::sin(angle);
    input.apex_x = between(-0.5f, 1.5f) * input.hinge;
    input.apex_h = between(0.02f, 2);
    input.flags = static_cast<std::uint32_t>(engine() & 15u) | (engine() % 8 == 0 ? 16u : 0u);
  }
  const auto found = run<Output>(session, "saddle_check.comp", "", inputs);
  std::size_t different = 0, far = 0, dropped = 0, bent = 0, narrower = 0, otherwise = 0;
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Input& in = inputs[i];
    Kernel::PosedSaddles label;
    label.source = Kernel::saddle_point(in.x[0], in.h[0]);
    for (int side = 0; side < 2; ++side)
      label.limit[side] = Kernel::saddle_point(in.x[1 + side], in.h[1 + side]);
    label.sigma = in.sigma;
    const auto arriving = label;
    const bool left = (in.flags & 1) != 0;
    label = Kernel::turn_label(label, left, in.width, in.hinge, in.cosine, in.sine);
    // What a neighbour there would have posed, if it knew the same source.
    Kernel::PosedSaddles other;
    other.sigma = label.sigma;
    other.source = Kernel::saddle_point(in.hinge - label.source.x[0], -label.source.h);
    for (int n = 0; n < 2; ++n)
      other.limit[n] = Kernel::saddle_point(
          0.5F * (other.source.x[0] + (n == 0 ? 0.25F : 0.75F) * in.hinge), 0.5F * other.source.h);
    const auto heard = Kernel::narrow_limits(
        arriving, other, left, in.width, in.hinge, in.cosine, in.sine,
        Kernel::saddle_point(left ? in.hinge * in.cosine : in.width - in.hinge * in.cosine,
                             in.hinge * in.sine),
        0.01F * in.width);
    const std::uint32_t says = (heard.narrower[0] ? 1u : 0u) | (heard.narrower[1] ? 2u : 0u);
    narrower += says != 0;
    bool same = says == found[i].narrower;
    for (int n = 0; n < 2; ++n)
      same &= apart(found[i].limit_x[n], heard.limit[n].x[0]) <= 1e-4 &&
              apart(found[i].limit_h[n], heard.limit[n].h) <= 1e-4;
    otherwise += !same;
    Kernel::SaddleHinge hinge;
    hinge.extent = in.hinge;
    hinge.apex = Kernel::saddle_point(in.apex_x, in.apex_h);
    hinge.saddle[0] = (in.flags & 4) != 0;
    hinge.saddle[1] = (in.flags & 8) != 0;
    hinge.pivot = left ? 0 : 1;
    if ((in.flags & 2) != 0) {
      label = Kernel::mirror_label(label, in.hinge);
      hinge.pivot = 1 - hinge.pivot;
    }
    const auto crossed = Kernel::cross_hinge(label, hinge, (in.flags & 16) != 0);
    const float corner = Kernel::path_length(crossed.label, in.hinge, hinge.apex);
    dropped += std::isinf(crossed.distance);
    bent += crossed.label.sigma != in.sigma;
    if (std::isinf(crossed.distance) != std::isinf(found[i].distance)) {
      ++far;
      continue;
    }
    const double error =
        std::max({std::isinf(crossed.distance) ? 0 : apart(found[i].distance, crossed.distance),
                  apart(found[i].corner, corner), apart(found[i].sigma, crossed.label.sigma),
                  apart(found[i].x[0], crossed.label.source.x[0]),
                  apart(found[i].h[0], crossed.label.source.h),
                  apart(found[i].x[1], crossed.label.limit[0].x[0]),
                  apart(found[i].h[1], crossed.label.limit[0].h),
                  apart(found[i].x[2], crossed.label.limit[1].x[0]),
                  apart(found[i].h[2], crossed.label.limit[1].h)});
    different += error > 0;
    far += error > 1e-4;  // took another branch
    if (error <= 1e-4) worst = std::max(worst, error);
  }
  CAPTURE(different, far, worst, dropped, bent, narrower, otherwise);
  CHECK(narrower > count / 100);
  CHECK(otherwise <= (plexway::testing::exact(*device) ? 0 : count / 1000));
  CHECK(dropped > count / 1000);
  CHECK(bent > count / 20);
  CHECK(far <= (plexway::testing::exact(*device) ? 0 : count / 1000));
  if (plexway::testing::exact(*device)) CHECK(different == 0);
}

}  // namespace text_test
