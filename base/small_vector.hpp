#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace castor {

/// A vector of mostly at most `N` elements, which need no memory of their own.
///
/// Elements that are not in use are default-constructed. Growth beyond `N` moves the elements, as
/// growth of a `std::vector` does.
template <class T, std::size_t N>
class SmallVector {
public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  SmallVector() = default;
  SmallVector(std::initializer_list<T> xs) {
    for (auto& x : xs)
      push_back(x);
  }
  SmallVector(const SmallVector& x) { *this = x; }
  SmallVector(SmallVector&& x) noexcept { *this = std::move(x); }

  SmallVector& operator=(const SmallVector& x) {
    if (this == &x)
      return *this;
    few_ = x.few_;
    many_ = x.many_ ? std::make_unique<std::vector<T>>(*x.many_) : nullptr;
    size_ = x.size_;
    return *this;
  }

  /// Leaves `x` empty.
  SmallVector& operator=(SmallVector&& x) noexcept {
    if (this == &x)
      return *this;
    few_ = std::exchange(x.few_, {});
    many_ = std::move(x.many_);
    size_ = std::exchange(x.size_, 0);
    return *this;
  }

  ~SmallVector() = default;

  bool empty() const { return size() == 0; }
  std::size_t size() const { return many_ ? many_->size() : size_; }

  iterator begin() { return many_ ? many_->data() : few_.data(); }
  iterator end() { return begin() + size(); }
  const_iterator begin() const { return many_ ? many_->data() : few_.data(); }
  const_iterator end() const { return begin() + size(); }

  T& operator[](std::size_t i) { return begin()[i]; }
  const T& operator[](std::size_t i) const { return begin()[i]; }
  T& front() { return *begin(); }
  const T& front() const { return *begin(); }
  T& back() { return end()[-1]; }
  const T& back() const { return end()[-1]; }

  void push_back(T x) {
    if (!many_ && size_ < N) {
      few_[size_++] = std::move(x);
      return;
    }
    if (!many_) {
      many_ = std::make_unique<std::vector<T>>();
      many_->reserve(2 * N);
      std::move(few_.begin(), few_.end(), std::back_inserter(*many_));
      few_ = {};
      size_ = 0;
    }
    many_->push_back(std::move(x));
  }

  void erase(iterator first, iterator last) {
    auto rest = std::move(last, end(), first);
    if (many_) {
      many_->resize(static_cast<std::size_t>(rest - begin()));
      return;
    }
    std::fill(rest, end(), T{});
    size_ = static_cast<std::uint32_t>(rest - begin());
  }
  void erase(iterator x) { erase(x, x + 1); }

  void clear() { erase(begin(), end()); }

  friend bool operator==(const SmallVector& a, const SmallVector& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

private:
  std::array<T, N> few_{};
  std::uint32_t size_ = 0;
  /// All elements, once there were more than `N`.
  std::unique_ptr<std::vector<T>> many_;
};

/// Removes the elements for which `f` is true; returns how many there were.
template <class T, std::size_t N, class F>
std::size_t erase_if(SmallVector<T, N>& xs, F&& f) {
  auto rest = std::remove_if(xs.begin(), xs.end(), std::forward<F>(f));
  auto count = static_cast<std::size_t>(xs.end() - rest);
  xs.erase(rest, xs.end());
  return count;
}

/// The same for those equal to `x`.
template <class T, std::size_t N>
std::size_t erase(SmallVector<T, N>& xs, const T& x) {
  return erase_if(xs, [&](const T& y) { return y == x; });
}

} // namespace castor
