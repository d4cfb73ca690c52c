#include <EGL/egl.h>
#include <catch2/catch.hpp>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "executors/gl/buffer.hpp"
#include "executors/gl/front.hpp"
#include "executors/gl/program.hpp"
#include "gl/device.hpp"
#include "message_of.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::context_test {
using namespace detail;

// Devices, contexts, shader messages and limits.

TEST_CASE("devices say what they are, or why they cannot be used", "[gl]") {
  if (!device()) return;
  const auto devices = gl_devices();
  REQUIRE_FALSE(devices.empty());
  std::size_t useful = 0;
  for (const GLDevice& d : devices) {
    CHECK(&d - devices.data() == d.number);
    if (!d.problem.empty()) continue;
    ++useful;
    CHECK_FALSE(d.vendor.empty());
    CHECK_FALSE(d.renderer.empty());
    CHECK(d.version.find('.') != std::string::npos);
    CHECK(d.largest_buffer >= std::size_t{1} << 24);  // what OpenGL 4.3 guarantees
    CHECK(d.group_size >= 1024);
  }
  CHECK(useful > 0);
}

TEST_CASE("every shader compiles on the device", "[gl]") {
  const auto context = device();
  if (!context) return;
  const gl::Session session(*context);
  for (std::size_t n = 0; n < gl::shader_text_count; ++n) {
    INFO(gl::shader_texts[n].name);
    CHECK(session.program(gl::shader_texts[n].name) != 0);
  }
}

TEST_CASE("a shader's errors are told in its own file and line", "[gl]") {
  const auto context = device();
  if (!context) return;
  const gl::Session session(*context);
  // As cmake/ShaderText.cmake puts texts together.
  const std::string text =
      "#version 430\n"
      "layout(local_size_x = 1) in;\n"
      "#line 1 1\n"
      "float good() { return 1.0; }\n"
      "float bad() { return nonsense; }\n"
      "#line 4 0\n"
      "void main() { good(); }\n";
  std::string message = message_of<Error>([&] {
    gl::compile_text(session.gl, text, "outer.comp;inner.inl", "#define ONE\n#define TWO\n");
  });
  INFO(message);
  CHECK(message.find("inner.inl") != std::string::npos);
  CHECK(message.find("inner.inl:2") + message.find("inner.inl(2") != 2 * std::string::npos);
  CHECK(message.find("nonsense") != std::string::npos);

  message = message_of<Error>([&] {
    gl::compile_text(session.gl, "#version 430\nlayout(local_size_x = 1) in;\nvoid main() { x; }\n",
                     "alone.comp", "#define ONE\n#define TWO\n");
  });
  INFO(message);
  CHECK(message.find("alone.comp:3") + message.find("alone.comp(3") != 2 * std::string::npos);
}

TEST_CASE("what does not fit on the device is refused with the limit", "[gl]") {
  const auto context = device();
  if (!context) return;
  const gl::Session session(*context);
  gl::Buffer buffer("labels");
  const std::size_t limit = context->limits().block;
  const std::string message =
      message_of<NotBuiltError>([&] { buffer.reserve(session, limit + 1); });
  INFO(message);
  CHECK(message.find("labels") != std::string::npos);
  CHECK(message.find("GL_MAX_SHADER_STORAGE_BLOCK_SIZE") != std::string::npos);
  CHECK(message.find(std::to_string(limit >> 20) + " MiB") != std::string::npos);
  CHECK(buffer.bytes() == 0);
  gl::Front front;
  CHECK_THROWS_AS(front.start(session, std::size_t{1} << 32, 32, 16, 1, 1), NotBuiltError);
  CHECK_THROWS_AS(front.start(session, limit, 32, 16, 1, 1), NotBuiltError);
  front.release(session);
}

TEST_CASE("twenty million triangles fit the device's numbers, or are refused with the limit",
          "[gl]") {
  const auto context = device();
  if (!context) return;
  // Without making them: what a solve asks for, buffer by buffer, before it allocates any.
  constexpr std::size_t faces = 20'000'000;
  const gl::Session session(*context);
  const std::size_t limit = context->limits().block;
  const auto refused = [&](const char* what, std::size_t bytes) {
    const std::string message =
        message_of<NotBuiltError>([&] { gl::Buffer(what).check(session, bytes); });
    INFO(what << " " << bytes << ": " << message);
    CHECK(message.empty() == (bytes <= limit));
    if (!message.empty()) CHECK(message.find(std::to_string(limit >> 20) + " MiB") != message.npos);
    return !message.empty();
  };
  const bool too_large = refused("triangles", faces * sizeof(TriangleRecord<float>)) ||
                         refused("labels", faces * 32) || refused("distances", faces * 16);
  if (exact(*context)) CHECK(too_large);  // llvmpipe: 128 MiB
  // Where buffers are large enough, 32 bits number every word of them, and every place in a queue.
  constexpr std::size_t words = std::size_t{1} << 32;
  static_assert(faces * sizeof(TriangleRecord<float>) / 4 < words);
  static_assert(faces * sizeof(gl::Cell) / 4 < words && faces * 32 / 4 < words);
  static_assert(3 * (faces + 1) < words);  // three queues, none longer than there are cells
  static_assert(faces < (std::size_t{1} << 28) - 2);  // a triangle and its flags in 32 bits
}

TEST_CASE("a surface too large for the device is refused with the limit", "[gl]") {
  const auto context = device();
  if (!context) return;
  const auto side = static_cast<Index>(std::sqrt(double(context->limits().block) / 64 / 2)) + 2;
  if (side > 1200) {
    WARN("skipped: this device takes more triangles than a test should make");
    return;
  }
  const auto mesh = grid(side, side).mesh<float>();
  const std::string message =
      message_of<NotBuiltError>([&] { (void)solve(GL{}, mesh, PointSource::at(0)); });
  INFO(message);
  CHECK(message.find("triangles") != std::string::npos);
  CHECK(message.find("GL_MAX_SHADER_STORAGE_BLOCK_SIZE") != std::string::npos);
}

TEST_CASE("what context was current stays so, and threads take turns", "[gl]") {
  if (!device()) return;
  const auto mesh = grid(12, 12).mesh<float>();
  const PointSource source = PointSource::at(3);
  const auto expected = solve(Serial{}, mesh, source, by_labels()).distance;
  CHECK(eglGetCurrentContext() == EGL_NO_CONTEXT);
  std::vector<std::thread> threads;
  std::vector<DistanceField<float>> fields(4);
  for (auto& field : fields)
    threads.emplace_back([&] {
      for (int n = 0; n < 5; ++n) field = solve(GL{}, mesh, source);
    });
  for (std::thread& t : threads) t.join();
  for (const auto& field : fields) CHECK(difference(expected, field.distance).max < 1e-5);
  CHECK(eglGetCurrentContext() == EGL_NO_CONTEXT);
  // A context of the program's own.
  const gl::NativeContext own(gl::displays()[0]);
  const gl::MakeCurrent current(own);
  const EGLContext before = eglGetCurrentContext();
  CHECK(before != EGL_NO_CONTEXT);
  CHECK(difference(expected, solve(GL{}, mesh, source).distance).max < 1e-5);
  CHECK(eglGetCurrentContext() == before);
}

// A domain stays on the device for the next solve. Another one that differs from it in a few
// records only must not be taken for it, and neither must what a move or an assignment left behind.

namespace {

template <class Domain>
std::vector<float> on_device(const Domain& domain, Index source, GLWorkspace& workspace,
                             double radius = 1e30) {
  const PointSource at = PointSource::at(source);
  DistanceField<float> field;
  PropagateOptions options;
  options.radius = radius;
  solve(GL{}, domain, std::span<const PointSource>(&at, 1), options, workspace, field);
  return field.distance;
}

}  // namespace

TEST_CASE("wireframes that differ in one length only are told apart on a device", "[gl]") {
  if (!device()) return;
  constexpr Index edges = 20000;  // a chain, one edge of which is longer
  std::vector<std::array<Index, 2>> ends;
  for (Index e = 0; e < edges; ++e) ends.push_back({e, e + 1});
  GLWorkspace workspace;
  for (Index longer = 9000; longer < 9020; ++longer) {
    std::vector<double> lengths(edges, 1);
    lengths[longer] = 3;
    const Wireframe<float> chain(edges + 1, ends, lengths);
    const auto distance = on_device(chain, longer - 5, workspace, 20);
    CAPTURE(longer);
    CHECK(distance[longer] == 5);
    CHECK(distance[longer + 1] == 8);
  }
}

TEST_CASE("surfaces that differ around one vertex only are told apart on a device", "[gl]") {
  if (!device()) return;
  constexpr Index n = 150;
  GLWorkspace workspace;
  for (Index k = 0; k < 12; ++k) {
    Surface s = grid(n, n, n, n);  // unit cells, and one vertex in a row of them is a spike
    const Index spike = (n + 1) * (70 + k) + 40 + 3 * k;
    s.positions[spike][2] = 4;
    const auto distance = on_device(s.mesh<float>(), spike, workspace, 8);
    CAPTURE(spike);
    CHECK(double(distance[spike + 1]) == Approx(std::sqrt(17.)).epsilon(1e-5));
  }
}

TEST_CASE("solids that differ in a few vertices only are told apart on a device", "[gl]") {
  if (!device()) return;
  GLWorkspace workspace;
  Solid s = solid_cube(10);
  const Index corner = s.nearest(1, 1, 1);
  for (int k = 0; k < 6; ++k) {
    s.positions[corner] = {1 + 1e-2 * k, 1, 1};
    const auto distance = on_device(s.mesh<float>(), s.nearest(0, 0, 0), workspace);
    CHECK(double(distance[corner]) ==
          Approx(straight(s, s.positions[s.nearest(0, 0, 0)])[corner]).epsilon(1e-5));
  }
}

TEST_CASE("domains on a device after moves, copies and assignments", "[gl]") {
  if (!device()) return;
  GLWorkspace workspace;
  const auto small = grid(4, 4, 4, 4).mesh<float>(), other = grid(4, 4, 8, 8).mesh<float>();
  CHECK(small.identity() != other.identity());
  TriangleMesh<float> mesh = small;  // the same content, the same identity
  CHECK(mesh.identity() == small.identity());
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(4));
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
  mesh = other;
  CHECK(mesh.identity() == other.identity());
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(8));
  const auto before = mesh.identity();
  TriangleMesh<float> taken = std::move(mesh);
  CHECK(taken.identity() == before);
  CHECK(mesh.identity() != before);  // NOLINT(bugprone-use-after-move): that is the question
  CHECK(double(on_device(taken, 0, workspace)[4]) == Approx(8));
  mesh = small;
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(4));
  taken = std::move(mesh);
  CHECK(taken.identity() == small.identity());
  CHECK(mesh.identity() != small.identity());  // NOLINT(bugprone-use-after-move)
  CHECK(double(on_device(taken, 0, workspace)[4]) == Approx(4));
}

TEST_CASE("a domain that did not fit leaves nothing of itself on a device", "[gl]") {
  const auto context = device();
  if (!context) return;
  const auto side = static_cast<Index>(std::sqrt(double(context->limits().block) / 64 / 2)) + 2;
  if (side > 1200) return;  // this device takes more triangles than a test should make
  GLWorkspace workspace;
  const auto small = grid(4, 4, 4, 4).mesh<float>();
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
  const auto large = grid(side, side).mesh<float>();
  CHECK_THROWS_AS(on_device(large, 0, workspace), NotBuiltError);
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
}

}  // namespace plexway::testing::context_test
