#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace plexway {

/// Workspaces that wait for the next solve. A solve takes one, or a new one where all are taken,
/// and brings it back: as many are held as solves ran at once.
template <class Workspace>
class Workspaces {
 public:
  /// One in use: brought back at the end of its life.
  class Taken {
   public:
    explicit Taken(Workspaces& from) : from_(from) {
      const std::scoped_lock lock(from_.mutex_);
      if (from_.waiting_.empty()) return;
      own_ = std::move(from_.waiting_.back());
      from_.waiting_.pop_back();
    }
    ~Taken() {
      const std::scoped_lock lock(from_.mutex_);
      from_.waiting_.push_back(std::move(own_));
    }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    Workspace& operator*() {
      if (!own_) own_ = std::make_unique<Workspace>();
      return *own_;
    }

   private:
    Workspaces& from_;
    std::unique_ptr<Workspace> own_;
  };

  /// Of those that wait.
  [[nodiscard]] std::size_t bytes() const {
    const std::scoped_lock lock(mutex_);
    std::size_t sum = 0;
    for (const auto& one : waiting_)
      if (one) sum += one->bytes();
    return sum;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> waiting_;
};

}  // namespace plexway
