// The table of peers with CGAL's in it: its exact shortest paths (Xin and Wang's) and its heat
// method. CGAL is under the GPL: it is a peer here and nothing that is installed touches it.

#ifdef PLEXWAY_HAS_EIGEN
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>

#include <memory>
#include <vector>

#include "cgal_exact.hpp"
#include "compare.hpp"

namespace {

using bench::Index;
using bench::cgal::ExactPaths;
using bench::cgal::make_mesh;
using bench::cgal::Mesh;

#ifdef PLEXWAY_HAS_EIGEN

class Heat final : public bench::Peer {
  using Method = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<
      Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay>;

 public:
  explicit Heat(const bench::Surface& surface)
      : mesh_(make_mesh(surface)),
        found_(mesh_.add_property_map<Mesh::Vertex_index, double>("v:distance", 0).first),
        method_(mesh_) {}  // factorises its matrices

  void solve(Index source) override {
    method_.clear_sources();
    method_.add_source(Mesh::Vertex_index(source));
    method_.estimate_geodesic_distances(found_);
  }
  [[nodiscard]] std::vector<double> distance() const override {
    return {found_.begin(), found_.end()};
  }

 private:
  Mesh mesh_;
  Mesh::Property_map<Mesh::Vertex_index, double> found_;
  Method method_;
};

#endif

}  // namespace

int main(int argc, char** argv) {
  auto kinds = bench::common_peers();
#ifdef PLEXWAY_HAS_EIGEN
  kinds.push_back({"CGAL heat, intrinsic Delaunay", false,
                   [](const bench::Surface& surface) { return std::make_unique<Heat>(surface); }});
#endif
  kinds.push_back(
      {"CGAL exact paths", false,
       [](const bench::Surface& surface) { return std::make_unique<ExactPaths>(surface); }, true});
  return bench::compare_peers(argc, argv, kinds);
}
