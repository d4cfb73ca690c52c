#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/any_domain.hpp>
#include <plexway/domain/domains.hpp>

namespace plexway {

#define PLEXWAY_POINTER(...) , const __VA_ARGS__*
/// What an AnyDomain is made of, for templates that take every kind; never std::monostate, nor
/// null.
using AnyComplex = std::variant<std::monostate PLEXWAY_DOMAINS(PLEXWAY_POINTER)>;
#undef PLEXWAY_POINTER

/// The complex with the vertices and simplices of the shape. Lives as long as the domain. Where a
/// surface is solved on other triangles it is built at the first call. Of a mixed domain
/// vertices and simplices have the numbers of its pieces, and behind a mask simplices those of
/// AnyDomain::open_simplices.
[[nodiscard]] AnyComplex complex_of(const AnyDomain& domain);

/// Calls use(complex) with it.
template <class Use>
decltype(auto) with_complex(const AnyDomain& domain, const Use& use) {
  using Result = decltype(use(std::declval<const TriangleMesh<float>&>()));
  return std::visit(
      [&](const auto& complex) -> Result {
        if constexpr (std::is_same_v<std::decay_t<decltype(complex)>, std::monostate>)
          throw std::bad_variant_access();
        else
          return use(*complex);
      },
      complex_of(domain));
}

/// The same for clouds alone; else nothing is called and the result is empty.
template <class Use>
auto with_cloud(const AnyDomain& domain, const Use& use) {
  using Result = decltype(use(std::declval<const PointCloud<float>&>()));
  if (domain.cloud() == nullptr) return Result();
  return with_complex(domain, [&]<class C>(const C& complex) {
    if constexpr (C::kind == DomainKind::cloud)
      return use(complex);
    else
      return Result();
  });
}

/// As with_complex, where points are chosen (Purpose::samples). Throws UsageError where none are.
template <class Use>
decltype(auto) with_sampled(const AnyDomain& domain, const Use& use) {
  using Result = decltype(use(std::declval<const TriangleMesh<float>&>()));
  return with_complex(domain, [&](const auto& complex) -> Result {
    constexpr DomainKind kind = std::decay_t<decltype(complex)>::kind;
    support(Purpose::samples, complex).require();
    if constexpr (support(Purpose::samples, kind))
      return use(complex);
    else
      throw std::bad_variant_access();  // refused
  });
}

}  // namespace plexway
