#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <span>
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

/// Tells contents apart, at once and exactly: what is kept elsewhere about an object (a copy on a
/// graphics processor) is still right while its identity is the same.
///
/// A member of what it identifies. Whatever is built, emptied by a move or `renewed` gets a number
/// that nothing else in the process has had; a copy has the same content, and so the same number.
/// Any thread may draw.
class Identity {
 public:
  Identity() : value_(draw()) {}
  Identity(const Identity&) = default;
  Identity& operator=(const Identity&) = default;
  Identity(Identity&& other) noexcept : value_(other.value_) { other.renew(); }
  Identity& operator=(Identity&& other) noexcept {
    value_ = other.value_;
    other.renew();
    return *this;
  }
  ~Identity() = default;

  /// For whoever changes the content. Never throws.
  void renew() noexcept { value_ = draw(); }
  /// Never 0.
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  static std::uint64_t draw() noexcept;

  std::uint64_t value_;
};

/// Something that follows from a complex, made when it is first wanted. Copies of the complex share
/// it, and any number of threads may want it at once.
class OnDemand {
 public:
  OnDemand() = default;
  OnDemand(const OnDemand&) = default;
  OnDemand& operator=(const OnDemand&) = default;
  ~OnDemand() {}  // clang 14 emits no defaulted one for wasm, and then wants it

  /// What make(), a shared pointer to a T that knows its bytes(), gives; it is called once.
  template <class T, class Make>
  std::shared_ptr<const T> get(const Make& make) const {
    std::call_once(state_->once, [&] {
      std::shared_ptr<const T> made = make();
      state_->bytes = made->bytes();
      state_->made = std::move(made);
    });
    return std::static_pointer_cast<const T>(state_->made);
  }
  /// 0 before.
  [[nodiscard]] std::size_t bytes() const { return state_ ? state_->bytes.load() : 0; }

 private:
  struct State {
    std::once_flag once;
    std::shared_ptr<const void> made;
    std::atomic<std::size_t> bytes{0};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

/// An array that is its own, or lies in memory that something else keeps, such as a file that is
/// mapped. It is read as a std::vector is, and may be changed while it is its own.
template <class T, class Own = std::vector<T>>
class Rows {
 public:
  using value_type = T;

  Rows() = default;
  Rows(Own own) : own_(std::move(own)) {}
  /// What `keeper` keeps where it is.
  Rows(std::span<const T> lent, std::shared_ptr<const void> keeper)
      : lent_(lent), keeper_(std::move(keeper)) {}

  /// To change it; of one that is lent a copy, from then on.
  [[nodiscard]] Own& own() {
    if (keeper_) {
      own_.assign(lent_.begin(), lent_.end());
      keeper_.reset();
    }
    return own_;
  }

  [[nodiscard]] const T* data() const { return keeper_ ? lent_.data() : own_.data(); }
  [[nodiscard]] std::size_t size() const { return keeper_ ? lent_.size() : own_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }
  [[nodiscard]] std::size_t capacity() const { return keeper_ ? lent_.size() : own_.capacity(); }

 private:
  Own own_;
  std::span<const T> lent_;
  std::shared_ptr<const void> keeper_;
};

}  // namespace plexway::detail
