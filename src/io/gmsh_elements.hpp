#pragma once

#include <cstdint>
#include <string_view>

namespace plexway::io {

/// A type of element of Gmsh: its nodes, and what its kind is called.
struct GmshElement {
  int type;
  std::uint32_t nodes;
  std::string_view kind;
};

inline constexpr std::string_view gmsh_points = "points", gmsh_lines = "lines",
                                  gmsh_triangles = "triangles",
                                  gmsh_quadrilaterals = "quadrilaterals",
                                  gmsh_tetrahedra = "tetrahedra";

/// The types of a .msh, as Gmsh's reference manual (section "Node ordering") and GmshDefines.h
/// number them. Of each kind the first nodes are its corners.
inline constexpr GmshElement gmsh_elements[] = {
    {15, 1, gmsh_points},
    {1, 2, gmsh_lines},
    {8, 3, gmsh_lines},
    {26, 4, gmsh_lines},
    {27, 5, gmsh_lines},
    {28, 6, gmsh_lines},
    {62, 7, gmsh_lines},
    {63, 8, gmsh_lines},
    {64, 9, gmsh_lines},
    {65, 10, gmsh_lines},
    {66, 11, gmsh_lines},
    {2, 3, gmsh_triangles},
    {9, 6, gmsh_triangles},
    {20, 9, gmsh_triangles},
    {21, 10, gmsh_triangles},
    {22, 12, gmsh_triangles},
    {23, 15, gmsh_triangles},
    {24, 15, gmsh_triangles},
    {25, 21, gmsh_triangles},
    {42, 28, gmsh_triangles},
    {43, 36, gmsh_triangles},
    {44, 45, gmsh_triangles},
    {45, 55, gmsh_triangles},
    {46, 66, gmsh_triangles},
    {3, 4, gmsh_quadrilaterals},
    {10, 9, gmsh_quadrilaterals},
    {16, 8, gmsh_quadrilaterals},
    {36, 16, gmsh_quadrilaterals},
    {37, 25, gmsh_quadrilaterals},
    {38, 36, gmsh_quadrilaterals},
    {47, 49, gmsh_quadrilaterals},
    {48, 64, gmsh_quadrilaterals},
    {49, 81, gmsh_quadrilaterals},
    {50, 100, gmsh_quadrilaterals},
    {51, 121, gmsh_quadrilaterals},
    {4, 4, gmsh_tetrahedra},
    {11, 10, gmsh_tetrahedra},
    {29, 20, gmsh_tetrahedra},
    {30, 35, gmsh_tetrahedra},
    {31, 56, gmsh_tetrahedra},
    {71, 84, gmsh_tetrahedra},
    {72, 120, gmsh_tetrahedra},
    {73, 165, gmsh_tetrahedra},
    {74, 220, gmsh_tetrahedra},
    {75, 286, gmsh_tetrahedra},
    {5, 8, "hexahedra"},
    {12, 27, "hexahedra"},
    {17, 20, "hexahedra"},
    {92, 64, "hexahedra"},
    {93, 125, "hexahedra"},
    {94, 216, "hexahedra"},
    {95, 343, "hexahedra"},
    {96, 512, "hexahedra"},
    {97, 729, "hexahedra"},
    {98, 1000, "hexahedra"},
    {6, 6, "prisms"},
    {13, 18, "prisms"},
    {18, 15, "prisms"},
    {90, 40, "prisms"},
    {91, 75, "prisms"},
    {106, 126, "prisms"},
    {107, 196, "prisms"},
    {108, 288, "prisms"},
    {109, 405, "prisms"},
    {110, 550, "prisms"},
    {7, 5, "pyramids"},
    {14, 14, "pyramids"},
    {19, 13, "pyramids"},
};

inline const GmshElement* find_gmsh_element(std::int64_t type) {
  for (const GmshElement& element : gmsh_elements)
    if (element.type == type) return &element;
  return nullptr;
}

}  // namespace plexway::io
