// A growing array of plain values.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "base/after_allocation.h"
#include "base/blocks.h"

namespace scarp {

/// Like std::vector for trivially copyable T, with two differences that matter for millions of triangles. New elements
/// are not cleared. Growth uses realloc, which moves pages instead of copying them, so the memory in use never doubles
/// during growth. Freed blocks of other arrays (blocks.h) are reused before new blocks are allocated.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Array() = default;
  Array(Array&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  Array& operator=(Array&& other) noexcept {
    Array taken(std::move(other));
    std::swap(data_, taken.data_);
    std::swap(size_, taken.size_);
    std::swap(capacity_, taken.capacity_);
    return *this;
  }
  ~Array() { leave_block({data_, capacity_bytes()}); }
  /// Clears the array and returns its memory to the system.
  void release() {
    std::free(std::exchange(data_, nullptr));
    size_ = capacity_ = 0;
  }

  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& back() { return data_[size_ - 1]; }

  void push_back(T value) {
    if (size_ == capacity_) grow(size_ + 1);
    data_[size_++] = value;
  }
  void pop_back() { --size_; }
  /// New elements are not initialised.
  void resize(std::size_t size) {
    if (size > capacity_) grow(size);
    size_ = size;
  }

 private:
  std::size_t capacity_bytes() const { return capacity_ * sizeof(T); }
  void grow(std::size_t least) {
    std::size_t capacity = capacity_ + capacity_ / 2 + 16;
    if (capacity < least) capacity = least;
    if (const Block kept = take_block(capacity * sizeof(T)); kept.data != nullptr) {
      if (size_ > 0) std::memcpy(kept.data, data_, size_ * sizeof(T));
      leave_block({data_, capacity_bytes()});
      data_ = static_cast<T*>(kept.data);
      capacity_ = kept.bytes / sizeof(T);
      return;
    }
    void* moved = std::realloc(static_cast<void*>(data_), capacity * sizeof(T));
    if (moved == nullptr) throw std::bad_alloc();
    if (after_allocation != nullptr) after_allocation(moved, capacity * sizeof(T));
    data_ = static_cast<T*>(moved);
    capacity_ = capacity;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace scarp
