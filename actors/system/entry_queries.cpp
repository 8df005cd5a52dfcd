#include "castor/actors/system/entry_queries.hpp"

#include "castor/base/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>

namespace castor {

namespace {

/// Answers that there is nothing if `what` is a type that there may be entries of.
void answer_nothing(const InspectionContextPtr& context, const std::string& name,
                    const std::string& what, const std::vector<EntryPtr>& entries) {
  context->with_types([=](const TypeCatalogue& types) {
    if (!is_known_type(what, types))
      throw InspectionError(nothing_found(name, what, entries, types));
    context->send({}, true);
  });
}

} // namespace

void show_entries(const InspectionContextPtr& context, const Json& request) {
  auto name = request.at("subarchitecture").get<std::string>();
  auto what = request.value("what", "");
  bool with_values = request.value("values", false);
  auto max_bytes = bytes_shown(request);
  context->self
    ->request(context->working_memory(name), inspection_patience,
              QueryRequest{{name, {}, 0, false}, {}})
    .then(
      [=](const Outcome<std::vector<EntryPtr>>& found) {
        if (!found)
          return context->refuse(found.failure().message);
        auto entries = select_entries(*found, what);
        if (entries.empty() && !what.empty())
          return answer_nothing(context, name, what, *found);
        std::string text;
        for (auto& x : entries)
          text += entry_as_json(*x, with_values, max_bytes) + '\n';
        context->send(std::move(text), true);
      },
      [=](const caf::error&) {
        context->refuse("the working memory of " + name + " does not answer");
      });
}

void show_types(const InspectionContextPtr& context, const Json& request) {
  auto name = request.value("type", "");
  context->with_types([=](const TypeCatalogue& types) {
    std::string text;
    if (!name.empty())
      find_type(name, types);
    for (auto& [other, type] : types)
      if (name.empty() || type->is_a(name))
        text += as_line(to_json(*type));
    context->send(std::move(text), true);
  });
}

std::vector<EntryPtr> select_entries(std::vector<EntryPtr> entries, const std::string& what) {
  if (what.empty())
    return entries;
  auto is_it = [&](const EntryPtr& x) { return x->address.id == what; };
  if (auto i = std::find_if(entries.begin(), entries.end(), is_it); i != entries.end())
    return {*i};
  std::erase_if(entries, [&](const EntryPtr& x) { return !x->value.type().is_a(what); });
  return entries;
}

std::string nothing_found(const std::string& subarchitecture, const std::string& what,
                          const std::vector<EntryPtr>& entries, const TypeCatalogue& types) {
  std::vector<std::string_view> candidates;
  std::set<std::string> here;
  for (auto& [type, descriptor] : types)
    candidates.push_back(type);
  for (auto& x : entries) {
    candidates.push_back(x->address.id);
    here.insert(x->type_name());
  }
  // Of an id and a type that are as near, the one that is written like it.
  if (!what.empty() && std::islower(static_cast<unsigned char>(what.front())))
    std::reverse(candidates.begin(), candidates.end());
  auto guess = did_you_mean(what, candidates);
  return "in " + subarchitecture + " there is neither an entry nor a type of the name " + what +
         (!guess.empty() ? "; " + guess
          : here.empty() ? "; it is empty"
                         : "; there are entries of the types" +
                             nearest_known({}, here).substr(sizeof("; there are:") - 1));
}

} // namespace castor
