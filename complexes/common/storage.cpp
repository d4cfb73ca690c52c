#include <atomic>
#include <cstdint>

#include <plexway/common/detail/storage.hpp>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace plexway::detail {

// Only the large pages that lie in the array as a whole, so that no memory is taken beyond it.
void prefer_large_pages([[maybe_unused]] void* start, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  if (bytes < 2 * page) return;
  const auto at = reinterpret_cast<std::uintptr_t>(start);
  const std::uintptr_t first = (at + page - 1) / page * page, last = (at + bytes) / page * page;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

std::uint64_t Identity::draw() noexcept {
  // A program and a module that it loads may each have a counter of their own (static libraries):
  // each starts at its own address, so that they do not meet.
  static std::atomic<std::uint64_t> next{0};
  const auto place = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(&next)) >> 12;
  return (place << 28) + next.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace plexway::detail
