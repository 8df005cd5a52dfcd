#pragma once

#include "castor/wm/entries/change_event_text.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

namespace castor {

/// What a component's own code does: "configure()", or "the callback for " and an event. It refers
/// to texts and to the event instead of copying them: only reports of failures want it as a text.
struct CodeActivity {
  std::string_view what;
  /// What the callback is for, or null.
  const ChangeEvent* event = nullptr;

  /// Calls `f` with the parts of the text, one after the other; allocates nothing.
  template <class F>
  void for_each_part(F&& f) const {
    f(what);
    if (event)
      castor::for_each_part(*event, f);
  }
};

std::string to_string(const CodeActivity& x);

/// The activity of a component, which changes it on its own thread; other threads may ask for its
/// text. A change costs an atomic operation, unless somebody is just asking.
class CurrentActivity {
public:
  CurrentActivity();
  CurrentActivity(const CurrentActivity&) = delete;
  CurrentActivity& operator=(const CurrentActivity&) = delete;

  // -- for the component's own thread, and its signal handlers

  /// What `x` refers to has to outlive the next change.
  void set(const CodeActivity& x);
  /// Keeps the text of the current activity, what it refers to may end.
  void keep();
  const CodeActivity& own() const {
    return *activity_of(current_.load(std::memory_order_relaxed) & ~being_read);
  }

  // -- for any thread

  std::string text() const;

private:
  using Word = std::uintptr_t;

  /// Added to the address while somebody reads, until which the activity must not end.
  static constexpr Word being_read = 1;

  static Word word_of(const CodeActivity& x) { return reinterpret_cast<Word>(&x); }
  static const CodeActivity* activity_of(Word x) {
    return reinterpret_cast<const CodeActivity*>(x);
  }

  mutable std::atomic<Word> current_;
  std::string kept_text_;
  CodeActivity kept_;
};

/// While it lives, the component's own code does that. After an exception the activity stays that
/// of the innermost code that it has left, for the report.
class ActivityScope {
public:
  /// `x`, and what it refers to, have to outlive this object.
  ActivityScope(CurrentActivity& current, const CodeActivity& x)
    : current_(current), outer_(current.own()), own_(x) {
    current_.set(own_);
  }
  ActivityScope(const ActivityScope&) = delete;
  ActivityScope& operator=(const ActivityScope&) = delete;
  ~ActivityScope() {
    if (is_left_)
      current_.set(outer_);
    else if (&current_.own() == &own_)
      current_.keep();
  }

  /// The code has returned.
  void leave() { is_left_ = true; }

private:
  CurrentActivity& current_;
  const CodeActivity& outer_;
  const CodeActivity& own_;
  bool is_left_ = false;
};

} // namespace castor
