#include "castor/wm/filters/content_access.hpp"

#include "castor/wm/filters/predicate_tree.hpp"
#include "castor/wm/values/point_field.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace castor {

namespace {

using Kind = ContentAccess::Kind;
using predicate::Condition;

std::vector<const Condition*> conjuncts(const predicate::Node& x) {
  std::vector<const Condition*> result;
  auto add = [&](const predicate::Node& part) {
    if (auto* condition = std::get_if<Condition>(&part.content))
      result.push_back(condition);
  };
  auto* junction = std::get_if<predicate::Junction>(&x.content);
  if (junction && junction->all)
    for (auto& part : junction->parts)
      add(part);
  else
    add(x);
  return result;
}

long double as_long_double(const FieldValue& number) {
  if (auto* x = std::get_if<std::int64_t>(&number))
    return static_cast<long double>(*x);
  if (auto* x = std::get_if<std::uint64_t>(&number))
    return static_cast<long double>(*x);
  return static_cast<long double>(std::get<double>(number));
}

bool is_less(Comparison op) {
  return op == Comparison::less || op == Comparison::less_equal;
}

bool is_greater(Comparison op) {
  return op == Comparison::greater || op == Comparison::greater_equal;
}

std::optional<ContentAccess> equality(const Condition& x) {
  auto* path = std::get_if<predicate::Path>(&x.left);
  auto* literal = std::get_if<FieldValue>(&x.right);
  if (!path || !literal || x.op != Comparison::equal)
    return std::nullopt;
  ContentAccess result;
  result.kind = Kind::equal;
  result.path = path->text;
  result.literal = *literal;
  return result;
}

std::optional<ContentAccess> neighbourhood(const Condition& x) {
  auto* distance = std::get_if<predicate::Distance>(&x.left);
  auto* literal = std::get_if<FieldValue>(&x.right);
  if (!distance || !literal || !(is_less(x.op) || x.op == Comparison::equal))
    return std::nullopt;
  bool from_path = std::holds_alternative<predicate::Path>(distance->from);
  auto& path = from_path ? distance->from : distance->to;
  auto& centre = from_path ? distance->to : distance->from;
  auto* point = std::get_if<predicate::Point>(&centre);
  // A little more, for the rounding in the computation of a distance.
  auto radius = as_double(*literal) * (1 + 1e-12);
  if (!point || !std::isfinite(radius))
    return std::nullopt;
  ContentAccess result;
  result.kind = Kind::region;
  result.path = std::get<predicate::Path>(path).text;
  for (auto x_i : *point) {
    if (!std::isfinite(x_i - radius) || !std::isfinite(x_i + radius))
      return std::nullopt;
    result.region.push_back({x_i - radius, x_i + radius});
  }
  return result;
}

std::optional<ContentAccess> one_end(const Condition& x) {
  auto* path = std::get_if<predicate::Path>(&x.left);
  auto* literal = std::get_if<FieldValue>(&x.right);
  if (!path || !literal || std::isnan(as_double(*literal)) || !(is_less(x.op) || is_greater(x.op)))
    return std::nullopt;
  ContentAccess result;
  result.kind = is_less(x.op) ? Kind::below : Kind::above;
  result.path = path->text;
  result.threshold = as_long_double(*literal);
  result.inclusive = x.op == Comparison::less_equal || x.op == Comparison::greater_equal;
  return result;
}

std::optional<ContentAccess> two_ends(std::span<const ContentAccess> ends) {
  for (auto& low : ends) {
    for (auto& high : ends) {
      if (low.kind != Kind::above || high.kind != Kind::below || low.path != high.path)
        continue;
      Interval interval{static_cast<double>(low.threshold), static_cast<double>(high.threshold)};
      if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
        continue;
      ContentAccess result;
      result.kind = Kind::region;
      result.path = low.path;
      result.region.push_back(interval);
      return result;
    }
  }
  return std::nullopt;
}

} // namespace

ContentAccess content_access(const Predicate& x) {
  if (x.empty())
    return {};
  auto parts = conjuncts(*x.tree());
  for (auto* part : parts)
    if (auto result = equality(*part))
      return *std::move(result);
  for (auto* part : parts)
    if (auto result = neighbourhood(*part))
      return *std::move(result);
  std::vector<ContentAccess> ends;
  for (auto* part : parts)
    if (auto end = one_end(*part))
      ends.push_back(*std::move(end));
  if (auto result = two_ends(ends))
    return *std::move(result);
  return ends.empty() ? ContentAccess{} : std::move(ends.front());
}

} // namespace castor
