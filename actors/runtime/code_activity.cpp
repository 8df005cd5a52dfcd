#include "castor/actors/runtime/code_activity.hpp"

#include "castor/base/at_exit.hpp"

#include <new>
#include <thread>
#include <utility>

namespace castor {

namespace {

constexpr CodeActivity nothing{};

} // namespace

std::string to_string(const CodeActivity& x) {
  std::string result;
  x.for_each_part([&](std::string_view part) { result += part; });
  return result;
}

CurrentActivity::CurrentActivity() : current_(word_of(nothing)) {}

void CurrentActivity::set(const CodeActivity& x) {
  const auto before = word_of(own());
  auto expected = before;
  while (!current_.compare_exchange_weak(expected, word_of(x), std::memory_order_acq_rel,
                                         std::memory_order_relaxed)) {
    if (expected != before)
      std::this_thread::yield();
    expected = before;
  }
}

void CurrentActivity::keep() {
  try {
    auto text = to_string(own());
    // Nobody reads the former text from then on.
    set(nothing);
    kept_text_ = std::move(text);
    kept_ = {kept_text_};
    set(kept_);
  } catch (const std::bad_alloc&) {
    // Called while an exception is on its way.
    set(nothing);
  }
}

std::string CurrentActivity::text() const {
  auto word = current_.load(std::memory_order_relaxed);
  for (;;) {
    word &= ~being_read;
    if (current_.compare_exchange_weak(word, word | being_read, std::memory_order_acquire,
                                       std::memory_order_relaxed))
      break;
    if (word & being_read)
      std::this_thread::yield();
  }
  const AtExit read{[&] { current_.store(word, std::memory_order_release); }};
  return to_string(*activity_of(word));
}

} // namespace castor
