#include "castor/wm/filters/filter_index.hpp"

#include "castor/tests/wm/filters/random_predicates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace castor::test {

namespace {

ChangeFilter random_filter(Random& random) {
  ChangeFilter result;
  result.subarchitecture = random() % 2 == 0 ? "" : "vision";
  if (random() % 3 == 0)
    result.operation = random() % 2 == 0 ? Operation::add : Operation::overwrite;
  if (random() % 2 == 0)
    result.type = random() % 2 == 0 ? "Thing" : "SpecialThing";
  if (random() % 4 == 0)
    result.id = "1";
  if (random() % 3 == 0)
    result = result.changing_any(random() % 2 == 0
                                   ? std::vector<std::string>{"name"}
                                   : std::vector<std::string>{"number", "place", "speciality"});
  if (random() % 4 != 0)
    result = result.where(random_predicate(random, between(random, 0, 2)).text);
  if (random() % 8 == 0)
    result = result.where("speciality == \"tea\"");
  return result;
}

Value random_content(Random& random) {
  Value result;
  switch (random() % 4) {
    case 0:
      result = Value::of(signed_box());
      break;
    case 1: {
      SpecialThing x;
      static_cast<Thing&>(x) = random_thing(random);
      x.speciality = random() % 2 == 0 ? "tea" : "coffee";
      result = Value::of(x);
      break;
    }
    default:
      result = Value::of(random_thing(random));
  }
  return random() % 3 == 0 ? Value::from_bytes(result.type_ptr(), result.bytes()) : result;
}

ChangeEvent random_event(const Value& content, Random& random) {
  ChangeEvent result;
  result.operation = static_cast<Operation>(between(random, 0, 2));
  result.address = {random() % 2 == 0 ? "vision" : "spatial", random() % 2 == 0 ? "1" : "2"};
  result.type = content.type_ptr();
  if (result.operation == Operation::overwrite)
    result.changed = random() & all_fields(*result.type);
  return result;
}

} // namespace

RC_GTEST_PROP(FilterIndexProperties, FindsByContentWhatASearchWouldFind, ()) {
  Random random{*rc::gen::arbitrary<std::uint64_t>()};
  FilterIndex index;
  std::vector<std::pair<FilterIndex::Key, ChangeFilter>> model;
  for (int i = 0; i < 150; ++i) {
    if (model.empty() || random() % 3 != 0) {
      model.emplace_back(random() % 4, random_filter(random));
      index.insert(model.back().first, model.back().second);
    } else {
      auto at = model.begin() + static_cast<std::ptrdiff_t>(random() % model.size());
      RC_ASSERT(index.erase(at->first, at->second));
      model.erase(at);
    }
    RC_ASSERT(index.size() == model.size());
    auto content = random_content(random);
    auto event = random_event(content, random);
    std::vector<FilterIndex::Key> found;
    std::vector<FilterIndex::Key> expected;
    index.match(event, content, found);
    bool asks = false;
    for (auto& [key, filter] : model) {
      if (matches(filter, event, content))
        expected.push_back(key);
      asks = asks || (!filter.changing.empty() && event.operation == Operation::overwrite &&
                      matches_envelope(filter, event));
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    RC_ASSERT(found == expected);
    RC_ASSERT(index.wants_changed_fields(event) == asks);
  }
  for (auto& [key, filter] : model)
    RC_ASSERT(index.erase(key, filter));
  RC_ASSERT(index.size() == 0u);
}

} // namespace castor::test
