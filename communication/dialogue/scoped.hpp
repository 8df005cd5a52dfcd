#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace castor::communication {

/// Binds a nominal while something is evaluated.
class ScopedBinding {
public:
  ScopedBinding(std::map<std::string, std::string>& bound, const std::string& nominal)
    : bound_(bound), nominal_(nominal), before_(bound.extract(nominal)) {}
  ~ScopedBinding() {
    bound_.erase(nominal_);
    if (!before_.empty())
      bound_.insert(std::move(before_));
  }
  ScopedBinding(const ScopedBinding&) = delete;
  ScopedBinding& operator=(const ScopedBinding&) = delete;

  void set(const std::string& id) { bound_[nominal_] = id; }

private:
  std::map<std::string, std::string>& bound_;
  std::string nominal_;
  std::map<std::string, std::string>::node_type before_;
};

/// Gives a variable a value until the end of the scope, however that ends.
template <class T>
class ScopedValue {
public:
  ScopedValue(T& variable, T value)
    : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
  ~ScopedValue() { variable_ = std::move(before_); }
  ScopedValue(const ScopedValue&) = delete;
  ScopedValue& operator=(const ScopedValue&) = delete;

private:
  T& variable_;
  T before_;
};

/// An element of a set until the end of the scope, unless it is one already.
class ScopedElement {
public:
  ScopedElement(std::set<std::string>& set, std::string element) : set_(set) {
    std::tie(place_, is_new_) = set.insert(std::move(element));
  }
  ~ScopedElement() {
    if (is_new_)
      set_.erase(place_);
  }
  ScopedElement(const ScopedElement&) = delete;
  ScopedElement& operator=(const ScopedElement&) = delete;

  bool is_new() const { return is_new_; }

private:
  std::set<std::string>& set_;
  std::set<std::string>::iterator place_;
  bool is_new_ = false;
};

} // namespace castor::communication
