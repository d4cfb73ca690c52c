#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <plexway/complex/point_cloud.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/executors/field.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

/// The component `gl`: link plexway::gl.
namespace plexway {

/// OpenGL compute shaders, on a graphics processor or on Mesa's software renderer; no window.
///
/// A context and the shaders it has compiled are made at first use, once a process and device, and
/// then kept (some 0.1 to 1 s). Any thread may call; calls on one device take turns, and what
/// context was current in the thread is so again afterwards.
///
/// Everything here throws NotBuiltError, saying what is missing, where the machine has no EGL, no
/// OpenGL 4.3, or too small a buffer for the domain.
struct GL {
  /// Its number in gl_devices(); -1: the first that is not software, or the first.
  int device = -1;
  /// Room for so many waiting labels at first; 0: chosen by the domain. It grows when needed.
  std::size_t queue = 0;
  /// Bytes on the device that the fields of one launch may take together (`fields`).
  std::size_t batch_bytes = std::size_t{1} << 30;
};

/// What EGL offers on this machine.
struct GLDevice {
  int number = 0;
  std::string vendor, renderer, version;
  bool software = false;           ///< computes on the processor
  std::size_t largest_buffer = 0;  ///< bytes a shader can see of one buffer
  std::size_t group_size = 0;      ///< invocations in a work group
  std::string problem;             ///< why it cannot be used; empty if it can
};

/// All devices, also those that cannot be used. Throws NotBuiltError if there is no EGL at all.
[[nodiscard]] std::vector<GLDevice> gl_devices();

/// The one that `executor` runs on.
[[nodiscard]] GLDevice gl_device(const GL& executor);

/// All that a propagation keeps on the device: the domain, labels, queues. Belongs to one domain
/// and one thread at a time; the domain is copied to the device when it is first met, so that a
/// workspace that is kept makes the second solve cheaper. Movable.
class GLWorkspace {
 public:
  GLWorkspace();
  ~GLWorkspace();
  GLWorkspace(GLWorkspace&&) noexcept;
  GLWorkspace& operator=(GLWorkspace&&) noexcept;

  /// Bytes on the device.
  [[nodiscard]] std::size_t bytes() const;
  /// How often the queues had to grow during the last solve.
  [[nodiscard]] std::size_t growths() const;
  /// Rounds of the last solve: one launch each.
  [[nodiscard]] std::size_t rounds() const;

  struct Implementation;
  [[nodiscard]] Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// What the GL executor takes; everything else it refuses to compile.
template <class Domain>
concept GLDomain =
    std::same_as<Domain, TriangleMesh<float>> || std::same_as<Domain, TetMesh<float>> ||
    std::same_as<Domain, Wireframe<float>> || std::same_as<Domain, PointCloud<float>>;

/// The distance of every vertex from the nearest of `sources`, as by Serial (executors/serial.hpp)
/// with these differences. Many labels are expanded at once, in the rounds of OpenMP
/// (executors/openmp.hpp): the same bits each time, and where the device rounds as the processor
/// does those of OpenMP, up to the order of additions in the vectorised step. They differ from
/// Serial's as those of two schedules of Serial do, 2e-4 to 1e-3 in the mean and 1e-2 at worst, and
/// are as near to the exact ones (docs/DESIGN.md, "Several threads"). On wireframes they are those
/// of Serial to the bit. Numbers are single precision. Only Visibility::saddles, and no
/// Schedule::priority: UsageError, as for more than 2^27 sources. Progress is reported every few
/// rounds. A bounded search costs memory and time for the whole domain.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source
/// Propagation, SGP 2021, section 5.
void propagate(GL, const TriangleMesh<float>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field);

/// The same along the edges of a wireframe; `vectorised` has no meaning here.
void propagate(GL, const Wireframe<float>& wireframe, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field);

/// The same through a solid that has coordinates (executors/serial_solid.hpp); UsageError for one
/// given by lengths alone. Which reflex edges a label hears of from its neighbours depends on the
/// order, on one thread as well: around curved obstacles distances differ by about the rule's own
/// error.
void propagate(GL, const TetMesh<float>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field);

/// On the sheet of a cloud; sources are points by number, as with Serial.
void propagate(GL, const PointCloud<float>& cloud, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field);

/// One field a source: distance[k n + v] is the distance of vertex v of n from source k alone.
/// Many fields are propagated in one launch, as many as batch_bytes hold: what a graphics
/// processor does best. `max_expansions` counts a field on average. Returns false if it ended a
/// launch early. UsageError if `distance` has not n times sources.size() numbers.
bool propagate_each(GL, const TriangleMesh<float>& mesh, std::span<const PointSource> sources,
                    const PropagateOptions& options, GLWorkspace& workspace,
                    std::span<float> distance);
bool propagate_each(GL, const Wireframe<float>& wireframe, std::span<const PointSource> sources,
                    const PropagateOptions& options, GLWorkspace& workspace,
                    std::span<float> distance);
bool propagate_each(GL, const TetMesh<float>& mesh, std::span<const PointSource> sources,
                    const PropagateOptions& options, GLWorkspace& workspace,
                    std::span<float> distance);
bool propagate_each(GL, const PointCloud<float>& cloud, std::span<const PointSource> sources,
                    const PropagateOptions& options, GLWorkspace& workspace,
                    std::span<float> distance);

/// The same with a workspace of its own.
template <GLDomain Domain>
[[nodiscard]] DistanceField<float> propagate(GL executor, const Domain& domain,
                                             std::span<const PointSource> sources,
                                             const PropagateOptions& options = {}) {
  GLWorkspace workspace;
  DistanceField<float> field;
  propagate(executor, domain, sources, options, workspace, field);
  return field;
}

/// From a single source.
template <GLDomain Domain>
[[nodiscard]] DistanceField<float> propagate(GL executor, const Domain& domain,
                                             const PointSource& source,
                                             const PropagateOptions& options = {}) {
  return propagate(executor, domain, std::span<const PointSource>(&source, 1), options);
}

/// Not on the device: double precision, mixed domains, simplices by dimension.
template <class Domain, class... Rest>
requires(!GLDomain<Domain>) void propagate(const GL&, const Domain&, Rest&&...) = delete;
template <class Domain, class... Rest>
requires(!GLDomain<Domain>) void fields(const GL&, const Domain&, Rest&&...) = delete;

/// What needs order needs one thread.
template <class Domain, class Sources>
void propagate(const GL&, const Domain&, const Sources&, const NearestFirst&) = delete;
template <class Domain, class W, class F>
void propagate(const GL&, const Domain&, std::span<const PointSource>, const NearestFirst&, W&,
               F&) = delete;

/// K fields: row k has the distance of every vertex from source k *alone*, all in as few launches
/// as GL::batch_bytes allows (`propagate_each`).
template <GLDomain Domain>
[[nodiscard]] Fields<float> fields(const GL& executor, const Domain& domain,
                                   std::span<const PointSource> sources,
                                   const PropagateOptions& options = {}) {
  Fields<float> fields(sources.size(), detail::field_size(domain));
  GLWorkspace workspace;
  fields.complete = propagate_each(executor, domain, sources, options, workspace, fields.values());
  return fields;
}

}  // namespace plexway
