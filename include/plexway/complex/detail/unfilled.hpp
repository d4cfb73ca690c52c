#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace plexway {

/// Leaves new elements as memory has them, so that who fills them is the first to touch it. Plain
/// data needs no more to be there.
template <class T>
struct UnfilledAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  using std::allocator<T>::allocator;
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

}  // namespace plexway
