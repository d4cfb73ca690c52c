#include <plexway/common/detail/identity.hpp>

#include <atomic>
#include <cstdint>

namespace plexway::detail {

std::uint64_t Identity::draw() noexcept {
  // A program and a module that it loads may each have a counter of their own (static libraries):
  // each starts at its own address, so that they do not meet.
  static std::atomic<std::uint64_t> next{0};
  const auto place = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(&next)) >> 12;
  return (place << 28) + next.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace plexway::detail
