#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "strings/solid_space.hpp"

/// Media in one space: solids of one speed each, straight wires and flat sheets.
namespace plexway::detail::strings {

/// What a space is made of: simplices of one numbering of points, each with the time that a unit of
/// length takes.
struct Parts {
  std::vector<Point> points;
  std::vector<std::array<Index, 4>> tets;
  std::vector<std::array<Index, 3>> faces;
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> slow_tets, slow_faces, slow_edges;
};

/// Of each face the tetrahedron it is a face of that is as fast, so that no string needs the face;
/// none: there is no such.
[[nodiscard]] std::vector<Index> covered_by(const Parts& parts);

/// A medium is what a leg runs through: solids of one speed that share faces; faces of one speed in
/// one plane, edges of one speed in one line. Each vertex of a medium is a *node*, so that points
/// where media meet have several.
///
/// Strings go from one medium to another at places: *patches* of a plane between two solids, or
/// with a sheet; *rows* of edges where patches end, or wires run; *corners*, which are points.
/// Besides, they bend inside a solid at its own rows. A *door* is a place and the medium that
/// follows.
class MediaSpace {
 public:
  explicit MediaSpace(const Parts& parts);
  /// A solid as one medium, its points numbered and scaled as there.
  explicit MediaSpace(std::shared_ptr<const SolidSpace> solid);
  MediaSpace(const MediaSpace&) = delete;
  MediaSpace& operator=(const MediaSpace&) = delete;

  struct Medium {
    double slowness;
    bool is_solid;
    /// Of a solid; of a sheet that is not convex, of the prism above it; else null.
    std::shared_ptr<const SolidSpace> room;
    std::vector<Index> points;  ///< of its nodes
    Index first_node, first_bend;
    std::vector<Index> begin, neighbours;  ///< of a wire or a sheet
    std::vector<Index> vertex;             ///< of a prism: where nodes are; the bottom
    Point up = {0, 0, 0};                  ///< of a sheet, unit

    [[nodiscard]] Index in_room(Index node) const {
      return is_solid ? node - first_node : vertex[node - first_node];
    }
  };
  /// Is it a solid alone, whose points are the nodes?
  [[nodiscard]] bool is_plain() const { return simplices_.empty(); }
  enum class Kind { bend, patch, row, corner };
  /// A part of a plane.
  struct Patch {
    Point normal;                              ///< to the side `above`
    Index above, below;                        ///< media; none: nothing, or no solid
    std::vector<Index> rows;                   ///< around it; none: where no string can end
    std::vector<std::array<double, 4>> sides;  ///< from (t, u) to (t, u), one a row
  };

  /// Points inside are in this unit, about the middle.
  [[nodiscard]] double unit() const { return unit_; }
  [[nodiscard]] Point outer(const Point& inside) const { return unit_ * inside + middle_; }
  [[nodiscard]] std::size_t points() const { return points_.size(); }
  [[nodiscard]] const Point& point(Index p) const { return points_[p]; }
  [[nodiscard]] std::span<const Index> nodes_at(Index point) const {
    return std::span<const Index>(nodes_).subspan(nodes_begin_[point],
                                                  nodes_begin_[point + 1] - nodes_begin_[point]);
  }
  [[nodiscard]] std::size_t nodes() const { return medium_of_.size(); }
  [[nodiscard]] Index medium_of(Index node) const { return medium_of_[node]; }
  [[nodiscard]] Index point_of(Index node) const {
    const Medium& m = media_[medium_of_[node]];
    return m.points[node - m.first_node];
  }
  /// Of a point in a medium; none: it is not there.
  [[nodiscard]] Index node(Index point, Index medium) const {
    for (const Index n : nodes_at(point))
      if (medium_of_[n] == medium) return n;
    return none;
  }
  [[nodiscard]] const std::vector<Medium>& media() const { return media_; }
  /// Of Parts: tetrahedra, then faces, then edges.
  struct Simplex {
    std::array<Index, 4> corner;  ///< points; none beyond
    Index medium;
  };
  [[nodiscard]] const std::vector<Simplex>& simplices() const { return simplices_; }
  /// Those that a point has that lies between corners of one of them, by one weight a corner.
  [[nodiscard]] std::vector<Index> simplices_around(Index simplex,
                                                    const std::array<double, 4>& weight) const;
  [[nodiscard]] std::span<const Index> simplices_at(Index point) const {
    return std::span<const Index>(around_).subspan(around_begin_[point],
                                                   around_begin_[point + 1] - around_begin_[point]);
  }
  [[nodiscard]] Point at(Index simplex, const std::array<double, 4>& weight) const;
  /// A little inside a medium, off a point of a simplex.
  [[nodiscard]] Point beside(Index simplex, const Point& at) const;
  [[nodiscard]] std::size_t bytes() const;
  /// Numbers inside the medium.
  [[nodiscard]] std::span<const Index> neighbours(Index node) const {
    const Medium& m = media_[medium_of_[node]];
    const Index n = node - m.first_node;
    if (m.is_solid) return m.room->neighbours(n);
    return std::span<const Index>(m.neighbours).subspan(m.begin[n], m.begin[n + 1] - m.begin[n]);
  }
  /// Of a node in a solid: SolidSpace::is_sharp. Those of wires and sheets, and the point that is
  /// attached, are not.
  [[nodiscard]] bool is_sharp(Index node) const {
    if (node == nodes()) return false;
    const Medium& m = media_[medium_of_[node]];
    return m.is_solid && m.room->is_sharp(node - m.first_node);
  }

  [[nodiscard]] Kind kind(Index place) const {
    return place < first_patch_     ? Kind::bend
           : place < first_row_     ? Kind::patch
           : place < places_.size() ? Kind::row
                                    : Kind::corner;
  }
  /// Not a corner.
  [[nodiscard]] const Place& place(Index number) const { return places_[number]; }
  [[nodiscard]] Index corner(Index point) const {
    return static_cast<Index>(places_.size()) + point;
  }
  [[nodiscard]] Index point_of_corner(Index place) const {
    return place - static_cast<Index>(places_.size());
  }
  [[nodiscard]] const Patch& patch(Index place) const { return patches_[place - first_patch_]; }
  /// Ends of a row.
  [[nodiscard]] const std::array<Index, 2>& ends(Index row) const {
    return ends_[row - first_row_];
  }
  /// Patches that end at a row.
  [[nodiscard]] std::span<const Index> patches_at(Index row) const {
    return patches_of_[row - first_row_];
  }
  /// Patches and rows at a point.
  [[nodiscard]] std::span<const Index> places_at(Index point) const {
    return at_.empty() ? std::span<const Index>() : at_[point];
  }

  /// none: that medium is not at the place.
  [[nodiscard]] Index door(Index place, Index medium) const {
    for (Index d = first_door(place); d < last_door(place); ++d)
      if (medium_behind(d) == medium) return d;
    return none;
  }
  [[nodiscard]] Index place_of(Index door) const {
    return door < doors_.size() ? doors_[door].place : corner(point_of(node_behind(door)));
  }
  [[nodiscard]] Index medium_behind(Index door) const {
    return door < doors_.size() ? doors_[door].medium : medium_of(node_behind(door));
  }
  [[nodiscard]] Index first_door(Index place) const {
    if (place < places_.size()) return first_door_[place];
    return static_cast<Index>(doors_.size()) + nodes_begin_[point_of_corner(place)];
  }
  [[nodiscard]] Index last_door(Index place) const {
    if (place < places_.size()) return first_door_[place + 1];
    return static_cast<Index>(doors_.size()) + nodes_begin_[point_of_corner(place) + 1];
  }

  /// Is a point of its plane in a patch, or no further off than `near`?
  [[nodiscard]] bool holds(const Patch& patch, double t, double u, double near) const;
  /// The row where a patch is left on the way from a point to another one outside; the one that is
  /// nearest, if there is none.
  [[nodiscard]] Index leaves(const Patch& patch, const std::array<double, 2>& from,
                             const std::array<double, 2>& to) const;
  /// From a row into a patch that ends there, unit.
  [[nodiscard]] Point inward(Index patch, Index row) const;

  /// Where a leg in a medium ends that comes from `toward` to a place: a little inside.
  [[nodiscard]] Point beside(Index place, Index medium, const Point& at, const Point& toward,
                             const Point& free) const;
  [[nodiscard]] static constexpr double aside() { return Tolerances::aside; }

 private:
  struct Door {
    Index place, medium;
    Index first_wedge = 0, last_wedge = 0;
  };
  struct Builder;
  /// Doors of corners come last, in the order of `nodes_`.
  [[nodiscard]] Index node_behind(Index door) const { return nodes_[door - doors_.size()]; }

  double unit_ = 1;
  Point middle_ = {0, 0, 0};
  std::vector<Point> points_;
  std::vector<Medium> media_;
  std::vector<Simplex> simplices_;
  std::vector<Index> around_, around_begin_;  // simplices at points
  std::vector<Index> medium_of_;
  std::vector<Index> nodes_, nodes_begin_;
  std::vector<Place> places_;  // bends, patches, rows
  Index first_patch_ = 0, first_row_ = 0;
  std::vector<Patch> patches_;
  std::vector<std::array<Index, 2>> ends_;
  std::vector<std::vector<Index>> patches_of_, at_;
  std::vector<Door> doors_;
  std::vector<Index> first_door_;
  std::vector<Boundary::Wedge> wedges_;
};

}  // namespace plexway::detail::strings
