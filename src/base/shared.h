// A value that copies share until one of them is changed: copying is as cheap as a pointer.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace scumble {

template <class T>
class Shared {
 public:
  Shared() : value_(std::make_shared<T>()) {}
  Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }
  operator const T&() const { return *value_; }
  // Keeps the value alive; as long as somebody does, no other one has its address.
  std::shared_ptr<const T> keep() const { return value_; }

  // The value, for this one alone from here on: a copy where others have it too.
  T& own() {
    if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
    // Whoever had it before, on another thread, has let go of it.
    std::atomic_thread_fence(std::memory_order_acquire);
    return *value_;
  }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace scumble
