// Prepared files, with a checksum that is right: what gets past it must be sound, and solved.

#include <cstring>
#include <memory>
#include <vector>

#include "complexes/common/kept_archive.hpp"
#include "fuzz_solve.hpp"

namespace plexway::fuzz_kept {
using namespace detail;

namespace {

template <class Complex>
void solve_one(KeptIn in) {
  const auto complex = KeptParts::open<Complex>(in);
  PropagateOptions options;
  options.accuracy = Accuracy::fast();
  try {
    const auto field = solve(Serial{}, complex, PointSource::at(0), options);
    fuzz::require(field.distance.size() == complex.vertex_count(), "one distance a vertex");
  } catch (const EndlessError&) {  // lengths that no metric has
  }
}

void solve_delaunay(KeptIn in) {
  const auto mesh = KeptParts::open<TriangleMesh<float>>(in);
  const auto delaunay = KeptParts::open_delaunay(in, mesh.face_count(), mesh.vertex_count());
  const auto there = delaunay.to_intrinsic(PointSource::in(0, {0.25, 0.25, 0.5}));
  fuzz::require(there.simplex < mesh.face_count(), "a point is in a triangle");
  (void)delaunay.to_input(there);
  (void)delaunay.line_to_input(0, {1, 0, 0}, {0, 0.5, 0.5});
}

}  // namespace

PLEXWAY_FUZZER(kept)(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t kind = data[0] % 6, bytes = (size - 1) / 64 * 64;
  struct alignas(64) Block {
    std::byte at[64];
  };
  const auto blocks = std::make_shared<std::vector<Block>>(bytes / 64);
  if (bytes > 0) std::memcpy(blocks->data(), data + 1, bytes);
  const std::span<std::byte> file(reinterpret_cast<std::byte*>(blocks->data()), bytes);
  seal(file);
  try {
    const KeptIn in(file, blocks, "input");
    switch (kind) {
      case 0:
        solve_one<TriangleMesh<float>>(in);
        break;
      case 1:
        solve_one<TetMesh<float>>(in);
        break;
      case 2:
        solve_one<Wireframe<double>>(in);
        break;
      case 3:
        solve_one<PointCloud<float>>(in);
        break;
      case 4:
        solve_one<TriangleMesh<double>>(in);
        break;
      default:
        solve_delaunay(in);
    }
  } catch (const Error& error) {
    fuzz::require_line(error.what());
  }
  return 0;
}

}  // namespace plexway::fuzz_kept
