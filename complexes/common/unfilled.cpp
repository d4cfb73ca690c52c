#include <plexway/common/detail/unfilled.hpp>

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace plexway::detail {

// Those that lie in the array as a whole, so that no memory is taken beyond it.
void prefer_large_pages([[maybe_unused]] void* start, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  if (bytes < 2 * page) return;
  const auto at = reinterpret_cast<std::uintptr_t>(start);
  const std::uintptr_t first = (at + page - 1) / page * page, last = (at + bytes) / page * page;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace plexway::detail
