#include "castor/actors/cast/hosts.hpp"

#include <utility>

namespace castor::cast {

namespace {

constexpr std::string_view localhost_name = "localhost";

} // namespace

HostTable::Outcome HostTable::define(std::string_view name, std::string host) {
  auto [position, inserted] =
    entries_.try_emplace(std::string(name), Entry{std::move(host), false});
  if (inserted)
    return Outcome::defined;
  return position->second.implicit ? Outcome::used_before : Outcome::defined_before;
}

void HostTable::mark_used(std::string_view name) {
  entries_.try_emplace(std::string(name), Entry{localhost(), true});
}

ResolvedHost HostTable::resolve(std::string_view expression) const {
  if (is_localhost(expression))
    return {localhost(), true};
  if (auto name = bracketed_host(expression); !name.empty())
    return look_up(name);
  return {std::string(expression), true};
}

ResolvedHost HostTable::look_up(std::string_view name) const {
  auto found = entries_.find(name);
  if (found == entries_.end())
    return {localhost(), name == localhost_name};
  const auto& entry = found->second;
  return {is_localhost(entry.host) ? localhost() : entry.host, true};
}

ResolvedHost HostTable::use(std::string_view expression) {
  auto result = resolve(expression);
  if (is_localhost(result.host))
    mark_used(localhost_name);
  if (!result.defined)
    mark_used(bracketed_host(expression));
  return result;
}

bool HostTable::is_defined(std::string_view name) const {
  return entries_.find(name) != entries_.end();
}

std::map<std::string, std::string> HostTable::definitions() const {
  std::map<std::string, std::string> result;
  for (const auto& [name, entry] : entries_)
    if (!entry.implicit)
      result.emplace(name, is_localhost(entry.host) ? localhost() : entry.host);
  return result;
}

std::vector<std::string_view> HostTable::names(std::size_t max) const {
  std::vector<std::string_view> result;
  for (auto i = entries_.begin(); i != entries_.end() && result.size() < max; ++i)
    if (!i->second.implicit)
      result.push_back(i->first);
  return result;
}

std::string HostTable::localhost() const {
  auto found = entries_.find(localhost_name);
  return found == entries_.end() ? std::string(localhost_name) : found->second.host;
}

std::string_view bracketed_host(std::string_view expression) noexcept {
  if (expression.size() < 3 || expression.front() != '[' || expression.back() != ']')
    return {};
  return expression.substr(1, expression.size() - 2);
}

bool is_localhost(std::string_view host) noexcept {
  return host == localhost_name || host == "127.0.0.1";
}

} // namespace castor::cast
