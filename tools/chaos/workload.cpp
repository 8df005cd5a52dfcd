#include "castor/tools/chaos/workload.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

namespace castor::faults {

namespace {

/// Words that stand behind the name of a thing.
bool is_joint(std::string_view word) {
  return word == "to" || word == "at" || word == "or";
}

std::string text_of_thing(const std::string& thing) {
  std::string_view rest = thing;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest))
    if (is_joint(word) || name_in_plan(std::string{word}).front() == '"')
      return quoted_in_plan(thing);
  return thing;
}

std::string name_in_workload(const std::string& name) {
  return is_joint(name) ? quoted_in_plan(name) : name_in_plan(name);
}

std::string names_in_workload(const std::vector<std::string>& names) {
  std::string result;
  for (auto& x : names)
    result += (result.empty() ? "" : ", ") + name_in_workload(x);
  return result;
}

struct ActionPrinter {
  std::string operator()(const Say& x) const { return "say " + quoted_in_plan(x.sentence); }
  std::string operator()(const WriteEntry& x) const {
    auto where = x.id.empty() ? x.subarchitecture : x.subarchitecture + '/' + x.id;
    return "write " + name_in_workload(x.type) + ' ' + x.value + " to " + name_in_workload(where);
  }
  std::string operator()(const MoveThing& x) const {
    return "move " + text_of_thing(x.thing) + " to " + x.x + ' ' + x.y;
  }
  std::string operator()(const AddThing& x) const {
    return "add " + text_of_thing(x.thing) + " at " + x.place;
  }
  std::string operator()(const RemoveThing& x) const { return "remove " + text_of_thing(x.thing); }
};

std::string to_string(const SameEntries& x) {
  return "same " + names_in_workload(x.types) +
         (x.but_for.empty() ? "" : " but for " + names_in_workload(x.but_for));
}

} // namespace

bool changes_scene(const Action& x) {
  return !std::holds_alternative<Say>(x) && !std::holds_alternative<WriteEntry>(x);
}

std::string to_string(const Action& x) {
  return std::visit(ActionPrinter{}, x);
}

std::string to_string(const WorkloadStatement& x) {
  auto result = to_string(x.trigger);
  std::string_view separator = " ";
  for (auto& action : x.actions) {
    result.append(separator).append(to_string(action));
    separator = " or ";
  }
  return result;
}

std::string to_string(const Workload& x) {
  std::string result;
  if (x.seed)
    result += "seed " + std::to_string(*x.seed) + "\n";
  for (auto& statement : x.statements)
    result += to_string(statement) + "\n";
  if (x.answer_within)
    result += "expect answer within " + to_text(*x.answer_within) + "\n";
  if (x.rest_within)
    result += "expect rest within " + to_text(*x.rest_within) + "\n";
  if (x.growth_within)
    result += "expect growth within " + std::to_string(*x.growth_within / 1'000'000) + "MB\n";
  if (x.same)
    result += to_string(*x.same) + "\n";
  for (auto& forbidden : x.never)
    result += "never " + change_filter_text(forbidden.filter) + "\n";
  for (auto& expected : x.each)
    result += "each " + change_filter_text(expected.begin) + " becomes " +
              change_filter_text(expected.end) + " within " + to_text(expected.within) + "\n";
  return result;
}

} // namespace castor::faults
