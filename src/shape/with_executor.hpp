#pragma once

#include <type_traits>
#include <variant>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// Has this build teams of threads? Where it has none their code is not compiled in either, which
/// is a seventh of the page's module.
#ifdef PLEXWAY_HAS_TEAMS
inline constexpr bool teams_built_in = true;
#else
inline constexpr bool teams_built_in = false;
#endif

/// Has it devices?
#ifdef PLEXWAY_HAS_GL
inline constexpr bool gl_built_in = true;
#else
inline constexpr bool gl_built_in = false;
#endif

/// Calls use(executor) with the one that was chosen, its type known. Throws where it does not go
/// together with `Complex` (UsageError) or is not in this build (NotBuiltError).
template <class Complex, class Use>
void with_executor(const AnyExecutor& executor, const Use& use) {
  std::visit(
      [&](const auto& chosen) {
        using E = std::decay_t<decltype(chosen)>;
        if constexpr (!supports<E, Complex>)
          support(combination<E, Complex>()).require();
        else if constexpr (E::kind == ExecutorKind::openmp && !teams_built_in)
          static_cast<void>(team_size(chosen));  // says that it is not built in
        else if constexpr (E::kind == ExecutorKind::gl && !gl_built_in)
          throw NotBuiltError(
              "the executor GL is not built in; install libegl-dev and build again");
        else
          use(chosen);
      },
      executor);
}

}  // namespace plexway::detail
