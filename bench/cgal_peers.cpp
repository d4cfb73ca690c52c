// What `peers` has in bench_cgal besides: CGAL's exact shortest paths (Xin and Wang's) and its heat
// method. CGAL is under the GPL: it is a peer here and nothing that is installed touches it.

#ifdef PLEXWAY_HAS_EIGEN
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#endif

#include "cgal_exact.hpp"

namespace bench::cgal {

#ifdef PLEXWAY_HAS_EIGEN
class Heat final : public Peer {
  using Method = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<
      Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay>;

 public:
  explicit Heat(const Surface& surface)
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

const bool added = [] {
#ifdef PLEXWAY_HAS_EIGEN
  peer_kinds().push_back({"CGAL heat, intrinsic Delaunay", false,
                          [](const Surface& surface) { return std::make_unique<Heat>(surface); }});
#endif
  peer_kinds().push_back(
      {"CGAL exact paths", false,
       [](const Surface& surface) { return std::make_unique<ExactPaths>(surface); }, true});
  return true;
}();

}  // namespace bench::cgal
