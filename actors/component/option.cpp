#include "castor/actors/component/option.hpp"

#include "castor/base/duration.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace castor {

OptionBase::OptionBase(OptionList& owner, std::string name, std::string help)
  : name_(std::move(name)), help_(std::move(help)) {
  owner.add(*this);
}

namespace detail {

namespace {

template <class T>
bool parse_number(std::string_view text, T& out) {
  T x{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc{} || end != text.data() + text.size())
    return false;
  out = x;
  return true;
}

} // namespace

bool parse_option(std::string_view text, bool& out) {
  auto x = parse_truth(text);
  out = x.value_or(out);
  return x.has_value();
}

bool parse_option(std::string_view text, std::int64_t& out) {
  return parse_number(text, out);
}

bool parse_option(std::string_view text, double& out) {
  return parse_number(text, out) && std::isfinite(out);
}

bool parse_option(std::string_view text, std::chrono::milliseconds& out) {
  auto x = parse_duration(text);
  out = x.value_or(out);
  return x.has_value();
}

bool parse_option(std::string_view text, std::vector<std::string>& out) {
  out.clear();
  while (!text.empty()) {
    auto comma = std::min(text.find(','), text.size());
    if (comma > 0)
      out.emplace_back(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return true;
}

std::string kind_of(Reference x) {
  switch (x) {
    case Reference::component:
      return "name of a component";
    case Reference::standalone:
      return "name of a stand-alone component";
    case Reference::subarchitecture:
      return "name of a subarchitecture";
    case Reference::none:
      break;
  }
  return "text";
}

std::string print_option(double x) {
  char buffer[32];
  auto [end, error] = std::to_chars(buffer, buffer + sizeof(buffer), x);
  return {buffer, end};
}

std::string print_option(std::chrono::milliseconds x) {
  return to_string(x);
}

std::string print_option(const std::vector<std::string>& x) {
  std::string result;
  for (auto& item : x)
    result += (result.empty() ? "" : ",") + item;
  return result;
}

} // namespace detail

std::optional<std::string> OptionList::set(std::string_view name, std::string_view value) {
  std::vector<std::string_view> names;
  for (auto* option : options_) {
    if (option->name() != name) {
      names.push_back(option->name());
      continue;
    }
    if (option->parse(value))
      return std::nullopt;
    return "--" + option->name() + " takes a " + option->kind() + ", not \"" + std::string{value} +
           "\"";
  }
  auto guess = did_you_mean(name, names);
  return "there is no option --" + std::string{name} + "; " +
         (guess.empty() ? "`castor components` lists them" : guess);
}

} // namespace castor
