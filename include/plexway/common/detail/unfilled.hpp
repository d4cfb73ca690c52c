#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace plexway::detail {

/// Asks the system for large pages in a new array, if it is large: they cost a fault for each 2
/// MiB, not for each 4 KiB. It need not heed that, and nothing but time depends on it.
void prefer_large_pages(void* start, std::size_t bytes);

/// Leaves new elements as memory has them, so that who fills them is the first to touch it. Plain
/// data needs no more to be there.
template <class T>
struct UnfilledAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  using std::allocator<T>::allocator;
  [[nodiscard]] T* allocate(std::size_t count) {
    T* const start = std::allocator<T>::allocate(count);
    prefer_large_pages(start, count * sizeof(T));
    return start;
  }
  template <class U>
  void construct(U*) {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <class U, class... From>
  void construct(U* place, From&&... from) {
    ::new (static_cast<void*>(place)) U(std::forward<From>(from)...);
  }
};
/// An array whose elements, plain data, are not set when it is made larger.
template <class T>
using Unfilled = std::vector<T, UnfilledAllocator<T>>;

}  // namespace plexway::detail
