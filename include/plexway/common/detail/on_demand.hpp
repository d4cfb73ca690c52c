#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

namespace plexway::detail {

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

}  // namespace plexway::detail
