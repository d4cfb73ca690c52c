#include "shape/warnings/bent_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/complex.hpp>

#include "complexes/mixed/joined_pieces.hpp"
#include "strings/mixed_space.hpp"

namespace plexway {
namespace {

// Between two corners of a simplex, in the domain's unit.
template <class Real>
double edge_of(const TriangleMesh<Real>& surface, Index t, std::size_t a, std::size_t b) {
  // Edge i goes from corner i to the next.
  const std::size_t edge = (a + 1) % 3 == b ? a : b;
  return static_cast<double>(surface.triangles()[t].length[edge]) * surface.unit();
}
template <class Real>
double edge_of(const TetMesh<Real>& solid, Index t, std::size_t a, std::size_t b) {
  const auto& corner = solid.tets()[t].corner;
  const auto points = solid.points();
  return static_cast<double>(norm(points[corner[a]] - points[corner[b]])) * solid.unit();
}

// Do both pieces give a hinge's edges the same lengths? Wires have points in common only.
template <class Real>
bool is_alike(const MixedComplex<Real>& domain, const typename MixedComplex<Real>::Hinge& hinge) {
  constexpr double alike = sizeof(Real) == 4 ? 1e-4 : 1e-6;  // edges of rounded places
  for (std::size_t i = 0; i < hinge.dimension; ++i)
    for (std::size_t k = i + 1; k <= hinge.dimension; ++k) {
      double length[2] = {0, 0};
      for (const std::size_t side : {0, 1}) {
        const auto& member = domain.members()[hinge.begin[side]];
        std::visit(
            [&]<class C>(const C& complex) {
              if constexpr (!std::is_same_v<C, Wireframe<Real>>)
                length[side] = edge_of(complex, member.simplex, member.corner[i], member.corner[k]);
            },
            domain.complex(domain.pieces()[hinge.piece[side]]));
      }
      if (!(std::abs(length[0] - length[1]) <= alike * std::max(length[0], length[1])))
        return false;
    }
  return true;
}

// On a domain whose pieces are joined. Solids of one speed are then one, or bend no ways at edges.
template <class Real>
BentCrossings find(const MixedComplex<Real>& domain) {
  BentCrossings found;
  const auto bends = [&](Index piece) {
    const auto* const solid = std::get_if<TetMesh<Real>>(&domain.complex(domain.pieces()[piece]));
    return solid != nullptr && !solid->reflex_edges().empty();
  };
  std::vector<char> counted(domain.pieces().size(), 0);
  for (const auto& hinge : domain.hinges()) {
    if (!bends(hinge.piece[0]) && !bends(hinge.piece[1])) continue;
    if (is_alike(domain, hinge)) continue;
    ++found.hinges;
    for (const Index piece : hinge.piece) {
      if (counted[piece] || !bends(piece)) continue;
      counted[piece] = 1;
      const auto& solid = std::get<TetMesh<Real>>(domain.complex(domain.pieces()[piece]));
      for (const auto& edge : solid.reflex_edges()) {
        ++found.edges;
        found.cracks += is_crack(edge);
      }
    }
  }
  return found;
}

}  // namespace

template <class Real>
SolidBends solid_bends(const MixedComplex<Real>& complex) {
  SolidBends found;
  if (MixedSpace::of(complex)->media) return found;  // strings find these ways
  const auto joined = complex.joined();
  const MixedComplex<Real>& whole = joined ? joined->domain : complex;
  if (whole.pieces().size() == 1) return found;
  for (const auto& piece : whole.pieces())
    std::visit(
        [&](const auto& part) {
          if constexpr (requires { part.reflex_edges(); })
            for (const auto& edge : part.reflex_edges()) {
              ++found.edges;
              found.cracks += is_crack(edge);
            }
        },
        whole.complex(piece));
  return found;
}

SolidBends solid_bends(const AnyDomain& domain) {
  return with_complex(domain, []<class C>(const C& complex) -> SolidBends {
    if constexpr (C::kind == DomainKind::mixed) return solid_bends(complex);
    return {};
  });
}

template <class Real>
BentCrossings bent_crossings(const MixedComplex<Real>& complex) {
  if (MixedSpace::of(complex)->media) return {};
  const auto joined = complex.joined();
  return find(joined ? joined->domain : complex);
}

template SolidBends solid_bends(const MixedComplex<float>&);
template SolidBends solid_bends(const MixedComplex<double>&);
template BentCrossings bent_crossings(const MixedComplex<float>&);
template BentCrossings bent_crossings(const MixedComplex<double>&);

}  // namespace plexway
