#include "castor/base/repeated_messages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

namespace {

std::string without_digits(std::string_view x) {
  std::string result;
  std::copy_if(x.begin(), x.end(), std::back_inserter(result),
               [](char c) { return c < '0' || c > '9'; });
  return result;
}

} // namespace

std::optional<std::string> RepeatedMessages::add(std::string_view message, Time now) {
  auto text = shortened(message);
  auto name = without_digits(text);
  if (kinds_.count(name) == 0 && kinds_.size() >= limits_.kinds)
    name.clear();
  auto& kind = kinds_.try_emplace(std::move(name), Kind{now}).first->second;
  if (kind.written < limits_.written) {
    ++kind.written;
    return text;
  }
  ++kind.counted;
  kind.last = std::move(text);
  return std::nullopt;
}

std::vector<std::string> RepeatedMessages::take_due(Time now) {
  std::vector<std::string> result;
  for (auto i = kinds_.begin(); i != kinds_.end();) {
    auto& kind = i->second;
    if (now - kind.since >= limits_.period) {
      if (kind.counted == 0) {
        i = kinds_.erase(i);
        continue;
      }
      result.push_back(summary(kind));
      // That was one; nobody who goes on gets more than one in each period.
      kind = Kind{now, limits_.written};
    }
    ++i;
  }
  return result;
}

std::vector<std::string> RepeatedMessages::take_all() {
  std::vector<std::string> result;
  for (auto& [name, kind] : kinds_)
    if (kind.counted > 0)
      result.push_back(summary(kind));
  kinds_.clear();
  return result;
}

std::string RepeatedMessages::shortened(std::string_view message) const {
  std::string result{message.substr(0, limits_.length)};
  if (message.size() > limits_.length)
    result += " ...";
  return result;
}

std::string RepeatedMessages::summary(const Kind& x) const {
  return std::to_string(x.counted) + " more like it in " + std::to_string(limits_.period.count()) +
         " s, the last: " + x.last;
}

} // namespace castor
