#pragma once

#include <plexway/domain/concept.hpp>
#include <plexway/error.hpp>

/// @file
/// Why a combination is not supported, and what domains themselves are checked for.
// The lowest part of the one table of what goes with what; support.hpp and shape/support.hpp are
// the others.
namespace plexway {

/// Why not, each in one sentence that says what to do instead. `X(name, sentence)`.
#define PLEXWAY_REFUSALS(X)                                                                        \
  X(gl_domain,                                                                                     \
    "the executor GL takes surfaces, solids, wireframes and clouds: use the executor Serial")      \
  X(gl_double, "the executor GL computes in single precision: make the domain of float")           \
  X(gl_refraction,                                                                                 \
    "the executor GL does not refract paths: use the executor Serial, or build the surface with "  \
    "one length an edge")                                                                          \
  X(gl_visibility, "the executor GL knows Visibility::saddles only: use another executor")         \
  X(order,                                                                                         \
    "the schedule priority needs one thread that takes the nearest label: use the executor "       \
    "Serial, or the schedules dual_queue or fifo")                                                 \
  X(mixed_visibility, "mixed domains know the default visibility only")                            \
  X(mixed_order, "mixed domains are not propagated nearest first: use the dual queue")             \
  X(table,                                                                                         \
    "the tuned policy is a table for triangles: use saddles, centroid or upper_bound on other "    \
    "domains")                                                                                     \
  X(refraction_visibility,                                                                         \
    "paths are refracted under Visibility::saddles only: use that, or build the surface with one " \
    "length an edge")                                                                              \
  X(paths_simplices,                                                                               \
    "paths are traced on surfaces, solids, wireframes, clouds and mixed domains: make a complex "  \
    "of simplices of dimension 1 to 3 one of these")                                               \
  X(read_out_labels,                                                                               \
    "distances inside simplices need the labels of the policy saddles, by Serial or OpenMP")       \
  X(read_out_simplices,                                                                            \
    "in complexes of simplices distances are read linearly: ask for ReadOut::linear")              \
  X(read_out_cloud, "a cloud has distances at its points only: take them from the field")          \
  X(directions_domain,                                                                             \
    "directions are those in triangles, tetrahedra and simplices: make a surface of the cloud, "   \
    "and along edges compare the ends")                                                            \
  X(directions_lengths,                                                                            \
    "directions in tetrahedra need their coordinates: build the solid with them, or trace paths")  \
  X(directions_refraction,                                                                         \
    "directions are not known where paths are refracted: build the surface with one length an "    \
    "edge, "                                                                                       \
    "or trace paths")                                                                              \
  X(simplex_labels_gl,                                                                             \
    "the executor GL leaves no labels in simplices: use the executor Serial or OpenMP")            \
  X(simplex_labels_domain,                                                                         \
    "triangles of surfaces and tetrahedra have labels: elsewhere ask those of the vertices")       \
  X(search_domain,                                                                                 \
    "searches that end early are for surfaces: solve other domains, with a radius where one is "   \
    "known")                                                                                       \
  X(search_refraction,                                                                             \
    "searches that end early, and samples, are not refracted: build the surface with one length "  \
    "an edge")                                                                                     \
  X(search_visibility, "searches that end early know the default visibility only: saddles")        \
  X(samples_domain, "points are chosen on surfaces, solids and clouds: make one of these")         \
  X(samples_lengths,                                                                               \
    "points are chosen in solids that have coordinates: build the solid with them")                \
  X(isolines_domain,                                                                               \
    "isolines are drawn on surfaces, clouds and mixed domains: solids have isosurfaces")           \
  X(arcs_domain,                                                                                   \
    "fields are known inside of triangles on surfaces: elsewhere draw straight isolines")          \
  X(isosurfaces_domain, "isosurfaces are those of solids: other domains have isolines, or none")   \
  X(pictures_domain, "pictures are of surfaces, solids, wireframes, clouds and mixed domains")     \
  X(masks_domain,                                                                                  \
    "masks are for surfaces, solids, wireframes and simplices: leave out what is closed when a "   \
    "cloud or a mixed domain is made")                                                             \
  X(metrics_domain,                                                                                \
    "metrics measure surfaces, solids, wireframes and mixed domains: give simplices their "        \
    "lengths, and make a surface of a cloud")                                                      \
  X(metrics_speeds, "mixed domains are measured by speeds only: give one a simplex")               \
  X(regions_domain,                                                                                \
    "regions are those of surfaces, solids, wireframes and mixed domains: other domains have "     \
    "none")                                                                                        \
  X(triangulations_domain,                                                                         \
    "only a surface has triangles to flip: leave the triangulation of other domains as it is")     \
  X(kept_domain,                                                                                   \
    "prepared files are for surfaces, solids, wireframes and clouds: other domains are built "     \
    "each time")                                                                                   \
  X(parts_domain,                                                                                  \
    "surfaces, solids and clouds are written in parts: write other domains to one file")           \
  X(volumes_domain, "only the field of a solid fits a .vdb: take another format")                  \
  X(conversions_domain,                                                                            \
    "surfaces, solids, wireframes and clouds are converted: take mixed domains and simplices as "  \
    "they are")                                                                                    \
  X(boundaries_domain,                                                                             \
    "boundaries are those of surfaces, solids and wireframes: name the vertices of other domains") \
  X(margins_domain,                                                                                \
    "margins are for paths on surfaces and clouds: leave the margin out, other paths have none")   \
  X(margins_refraction,                                                                            \
    "refracted paths are pulled taut and not searched for: leave the margin out")                  \
  X(duals_domain,                                                                                  \
    "only cells on a surface have a dual triangulation: take the cells of other domains as they "  \
    "are")                                                                                         \
  X(error_classes_domain,                                                                          \
    "errors are split by place and shape on surfaces and in solids: elsewhere take their "         \
    "mean")                                                                                        \
  X(rows_gl,                                                                                       \
    "rows are solved one a thread, and what is near is looked for by threads: use the executor "   \
    "OpenMP or Serial")                                                                            \
  X(cloud_point, "a place on a cloud is a point by number, not a place in a triangle")             \
  X(point_of_five,                                                                                 \
    "a source in four dimensions must be a vertex: a point of a 4-simplex has five coordinates")   \
  X(shapes,                                                                                        \
    "curves and simplices as sources are for surfaces and wireframes: name points or vertices "    \
    "here")                                                                                        \
  X(shapes_gl,                                                                                     \
    "the executor GL starts from points and sets of vertices: use the executor Serial for curves " \
    "and simplices")                                                                               \
  X(shapes_float,                                                                                  \
    "labels start from curves and triangles in double precision, since their virtual sources are " \
    "far away: make the domain of double, or ask for windows (accurate)")                          \
  X(shapes_threads,                                                                                \
    "labels start from curves and triangles on the executor Serial: use that, or ask for windows " \
    "(accurate)")                                                                                  \
  X(shapes_visibility,                                                                             \
    "curves and triangles as sources need labels with limits: use the policy saddles")             \
  X(windows_domain,                                                                                \
    "accuracies other than fast are for surfaces, clouds and solids: other domains have one, ask " \
    "for fast")                                                                                    \
  X(strings_gl,                                                                                    \
    "the executor GL solves solids by the accuracy fast: use that, or another executor")           \
  X(strings_lengths,                                                                               \
    "a solid without coordinates has no straight lines in space to measure: use the accuracy "     \
    "fast")                                                                                        \
  X(strings_visibility,                                                                            \
    "a visibility other than saddles is for the accuracy fast: leave it out, or use that")         \
  X(strings_exact, "solids have no accuracy exact: ask for accurate")                              \
  X(windows_gl,                                                                                    \
    "the executor GL keeps one label a triangle: use the executor Serial, or the accuracy fast")   \
  X(windows_refraction, "only the accuracy fast refracts paths where speeds jump")                 \
  X(windows_visibility,                                                                            \
    "a visibility other than saddles is for the accuracy fast: leave it out, or use that "         \
    "accuracy")                                                                                    \
  X(windows_labels,                                                                                \
    "the step of the dual queue and `vectorised` are of labels: leave them as they are, or use "   \
    "the accuracy fast")                                                                           \
  X(windows_float,                                                                                 \
    "exact distances need double precision: make the domain of double, or ask for accurate")       \
  X(pieces_domain,                                                                                 \
    "a mixed domain is made of surfaces, solids and wireframes: make others one of these")         \
  X(pieces_lengths,                                                                                \
    "a solid in a mixed domain needs coordinates, not only lengths: build the solid with them")    \
  X(sides_solid,                                                                                   \
    "tetrahedra keep no lengths of their own for an edge that they share: take Sides::mean, or a " \
    "mixed domain of a solid for each speed, as AnyShape::measure does")                           \
  X(positions, "the vertices have no positions in space: give them, or name vertices by number")   \
  X(drawn_lengths,                                                                                 \
    "a domain of intrinsic lengths can be solved, but has no directions and cannot be drawn: "     \
    "give "                                                                                        \
    "its "                                                                                         \
    "vertices positions in space, or take its distances as .csv, .npy or .gii")                    \
  X(pieces_positions,                                                                              \
    "files are joined where their vertices lie in space: give the vertices positions")             \
  X(metrics_lengths,                                                                               \
    "a metric is measured between positions, and there are only lengths: measure them by it "      \
    "before")                                                                                      \
  X(darts_cloud,                                                                                   \
    "darts on a cloud are its points, so none is thrown into simplices: leave the order uniform")  \
  X(points_alone,                                                                                  \
    "paths, samples, cells and distances in parts start from points: name each vertex or point "   \
    "as a source of its own")                                                                      \
  X(search_accuracy,                                                                               \
    "searches that end early keep one label a triangle: ask for the accuracy fast")                \
  X(search_order,                                                                                  \
    "a search for a path takes simplices in an order of its own: leave out any other executor, "   \
    "schedule or step than the default")                                                           \
  X(search_triangulation,                                                                          \
    "searches that end early are on the triangles of the shape: leave its triangulation as it is") \
  X(shapes_triangulation,                                                                          \
    "curves and triangles lie in the triangles of the shape: leave its triangulation as it is")    \
  X(ranks_executor, "ranks share the pieces of a team: use the executor OpenMP")                   \
  X(in_parts_domain,                                                                               \
    "in parts over processes, of which none has the whole, are surfaces: let each process have "   \
    "all of another domain")                                                                       \
  X(in_parts_order,                                                                                \
    "in parts over processes windows go in their own order: leave the schedule dual_queue, or "    \
    "use the accuracy fast")                                                                       \
  X(in_parts_whole,                                                                                \
    "this takes the whole, which in parts no process has: leave it out, or let each have all")     \
  X(kept_metric,                                                                                   \
    "a domain measured by a metric cannot be kept: its shape does not have the lengths")           \
  X(kept_mask, "a domain with a mask cannot be kept: keep it without, and mask it then")           \
  X(taken_as,                                                                                      \
    "a surface is taken as a solid, a wireframe or a cloud, a solid as a wireframe, a level set "  \
    "as a surface, cells of several dimensions as a mixed domain: take the rest as it is")         \
  X(prepared, "it is prepared already: this goes with the file that it was made of")               \
  X(several_files,                                                                                 \
    "several files are parts of a mixed domain, each as its file has it: what is made of "         \
    "surfaces, level sets and points goes with one")                                               \
  X(connecting_domain,                                                                             \
    "neighbours need a cloud: give points, or a surface to be taken as a cloud")                   \
  X(filling_domain,                                                                                \
    "tetrahedra need a surface to fill: give one to be taken as a solid, or a .poly or .smesh")    \
  X(repair_domain,                                                                                 \
    "a repair needs a surface, and gives a surface, a solid or a wireframe: leave it out")         \
  X(voxel_domain,                                                                                  \
    "voxels are those of clouds, of repairs, and of a .vdb to read or to write: leave them out")   \
  X(merging_domain,                                                                                \
    "vertices are merged of surfaces, solids and wireframes with positions, as a file has them: "  \
    "leave it out for points and lengths, and where a surface is filled or repaired")              \
  X(grid_domain, "only a .vdb has grids: leave the grid out")                                      \
  X(copied_points,                                                                                 \
    "points are copied as they are: leave out what fills, repairs, cuts and connects")

#define PLEXWAY_NAME(name, sentence) name,
/// The reasons of PLEXWAY_REFUSALS by name; `nothing` is none.
enum class Refusal { nothing, PLEXWAY_REFUSALS(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// Yes, or the reason why not.
class Support {
 public:
  /// Yes, unless there is a reason.
  constexpr Support(Refusal refusal = Refusal::nothing) : refusal_(refusal) {}

  /// Does it go together?
  [[nodiscard]] constexpr explicit operator bool() const { return refusal_ == Refusal::nothing; }
  /// The reason by name.
  [[nodiscard]] constexpr Refusal refusal() const { return refusal_; }
  /// One sentence; empty for yes.
  [[nodiscard]] constexpr const char* sentence() const {
    switch (refusal_) {
      case Refusal::nothing:
        break;
#define PLEXWAY_CASE(name, sentence) \
  case Refusal::name:                \
    return sentence;
        PLEXWAY_REFUSALS(PLEXWAY_CASE)
#undef PLEXWAY_CASE
    }
    return "";
  }
  /// Throws UsageError with the sentence unless it is yes.
  void require() const {
    if (!*this) throw UsageError(sentence());
  }

 private:
  Refusal refusal_;
};

/// May a domain be a piece of a mixed one (MixedComplex::add)?
constexpr Support support_of_piece(DomainKind domain, MetricKind metric) {
  using enum DomainKind;
  if (domain != surface && domain != solid && domain != wireframe) return Refusal::pieces_domain;
  if (domain == solid && metric != MetricKind::embedded) return Refusal::pieces_lengths;
  return Support();
}

/// May simplices of a domain measure an edge that they share each for itself (metric::Sides)?
constexpr Support support_of_own_sides(DomainKind domain) {
  return domain == DomainKind::solid ? Refusal::sides_solid : Refusal::nothing;
}

}  // namespace plexway
