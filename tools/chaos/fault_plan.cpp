#include "castor/tools/chaos/fault_plan.hpp"

#include "castor/base/text.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

namespace castor::faults {

namespace {

struct TriggerPrinter {
  std::string operator()(const At& x) const { return "at " + to_text(x.time); }
  std::string operator()(const Every& x) const { return "every " + to_text(x.period); }
  std::string operator()(const AtRandom& x) const { return "rate " + to_text(x.rate); }
  std::string operator()(const After& x) const {
    std::string result = x.repeated ? "after every " : "after ";
    if (x.repeated || x.count != 1)
      result += std::to_string(x.count) + " ";
    return result + change_filter_text(x.filter) + ":";
  }
};

} // namespace

std::vector<ChangeFilter> watched_by(const FaultPlan& x) {
  std::vector<ChangeFilter> result;
  for (auto& statement : x.statements)
    if (auto after = std::get_if<After>(&statement.trigger))
      result.push_back(after->filter);
  return result;
}

std::string to_string(const Trigger& x) {
  return std::visit(TriggerPrinter{}, x);
}

std::string to_string(const Statement& x) {
  auto result = to_string(x.trigger);
  std::string_view separator = " ";
  for (auto& fault : x.faults) {
    result.append(separator).append(to_string(fault));
    separator = " or ";
  }
  return result;
}

std::string to_string(const FaultPlan& x) {
  std::string result;
  if (x.seed)
    result += "seed " + std::to_string(*x.seed) + "\n";
  for (auto& statement : x.statements)
    result += to_string(statement) + "\n";
  return result;
}

} // namespace castor::faults
