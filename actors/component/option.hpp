#pragma once

#include "castor/wm/values/reflect.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace castor {

class OptionBase;

/// The options of one component, in the order of their declaration.
class OptionList {
public:
  void add(OptionBase& option) { options_.push_back(&option); }
  const std::vector<OptionBase*>& all() const { return options_; }

  /// Sets an option. Returns the error, with the nearest name or the expected kind of value;
  /// nothing if the value was accepted. `name` is without dashes.
  std::optional<std::string> set(std::string_view name, std::string_view value);

private:
  std::vector<OptionBase*> options_;
};

/// Kind of name that an option takes.
enum class Reference : std::uint8_t { none, component, standalone, subarchitecture };

/// One option on a component's line of a .cast file. Declared as a member, with its name, default
/// and help:
///
///     Option<double> min_area_{this, "min-area", 80, "smallest region kept, pixels"};
///
/// and read like a value of that type from `configure()` on.
class OptionBase {
public:
  OptionBase(OptionList& owner, std::string name, std::string help);
  OptionBase(const OptionBase&) = delete;
  OptionBase& operator=(const OptionBase&) = delete;
  virtual ~OptionBase() = default;

  /// Without dashes.
  const std::string& name() const { return name_; }
  const std::string& help() const { return help_; }

  /// Kind of value that it takes ("number", "text", "left|right").
  virtual std::string kind() const = 0;
  /// The current value, as a user would write it.
  virtual std::string text() const = 0;
  /// Kind of name that the value has to be.
  virtual Reference reference() const { return Reference::none; }
  /// Parses a value as a user wrote it; false if it is not of that kind.
  virtual bool parse(std::string_view text) = 0;

private:
  std::string name_;
  std::string help_;
};

/// Names of components or subarchitectures of the system: `castor check` refuses unknown ones. An
/// option of such a type may be empty.
///
///     Option<StandaloneName> camera_{this, "camera", "camera", "the camera to pull from"};
///
/// A component of any kind.
struct ComponentName : std::string {
  using std::string::string;
  static constexpr auto reference = Reference::component;
};

/// A component outside of the subarchitectures, which provides pulls and pushes.
struct StandaloneName : std::string {
  using std::string::string;
  static constexpr auto reference = Reference::standalone;
};

struct SubarchitectureName : std::string {
  using std::string::string;
  static constexpr auto reference = Reference::subarchitecture;
};

namespace detail {

template <class T>
concept NamesSomething = requires {
  T::reference;
};

bool parse_option(std::string_view text, bool& out);
bool parse_option(std::string_view text, std::int64_t& out);
bool parse_option(std::string_view text, double& out);
/// A number with its unit: 250ms, 10s, 2min.
bool parse_option(std::string_view text, std::chrono::milliseconds& out);
bool parse_option(std::string_view text, std::vector<std::string>& out);
/// "name of a stand-alone component".
std::string kind_of(Reference x);
std::string print_option(double x);
std::string print_option(std::chrono::milliseconds x);
std::string print_option(const std::vector<std::string>& x);

} // namespace detail

/// T is bool, a whole number, double, std::string, std::chrono::milliseconds,
/// std::vector<std::string> (written with commas), an enumeration declared with
/// CASTOR_REFLECT_ENUM, or a name: ComponentName, StandaloneName or SubarchitectureName.
template <class T>
class Option final : public OptionBase {
public:
  /// @param owner a component, which has options()
  template <class Owner>
  Option(Owner* owner, std::string name, T standard, std::string help)
    : OptionBase(owner->options(), std::move(name), std::move(help)), value_(std::move(standard)) {}
  Option(OptionList& owner, std::string name, T standard, std::string help)
    : OptionBase(owner, std::move(name), std::move(help)), value_(std::move(standard)) {}

  const T& get() const { return value_; }
  operator const T&() const { return value_; }
  const T* operator->() const { return &value_; }

  std::string kind() const override {
    if constexpr (std::is_same_v<T, bool>)
      return "true|false";
    else if constexpr (std::is_integral_v<T>)
      return "whole number";
    else if constexpr (std::is_floating_point_v<T>)
      return "number";
    else if constexpr (std::is_same_v<T, std::chrono::milliseconds>)
      return "duration";
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
      return "list,of,names";
    else if constexpr (detail::NamesSomething<T>)
      return detail::kind_of(T::reference);
    else if constexpr (ReflectedEnum<T>) {
      std::string result;
      for (auto& [name, value] : reflection_of<T>().enumerators) {
        if (!result.empty())
          result += '|';
        result += name;
      }
      return result;
    } else
      return "text";
  }

  std::string text() const override {
    if constexpr (std::is_same_v<T, std::string> || detail::NamesSomething<T>)
      return value_;
    else if constexpr (std::is_same_v<T, bool>)
      return value_ ? "true" : "false";
    else if constexpr (std::is_integral_v<T>)
      return std::to_string(value_);
    else if constexpr (ReflectedEnum<T>) {
      for (auto& [name, value] : reflection_of<T>().enumerators)
        if (value == value_)
          return std::string{name};
      return {};
    } else
      return detail::print_option(value_);
  }

  Reference reference() const override {
    if constexpr (detail::NamesSomething<T>)
      return T::reference;
    else
      return Reference::none;
  }

  bool parse(std::string_view text) override {
    if constexpr (std::is_same_v<T, std::string> || detail::NamesSomething<T>) {
      value_.assign(text);
      return true;
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      std::int64_t x = 0;
      if (!detail::parse_option(text, x) || !std::in_range<T>(x))
        return false;
      value_ = static_cast<T>(x);
      return true;
    } else if constexpr (ReflectedEnum<T>) {
      for (auto& [name, value] : reflection_of<T>().enumerators) {
        if (name == text) {
          value_ = value;
          return true;
        }
      }
      return false;
    } else
      return detail::parse_option(text, value_);
  }

private:
  T value_;
};

} // namespace castor
