#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/store/entry_store.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>

namespace castor::test {

namespace {

using rc::gen::element;

namespace other_crates {

/// The name of another type, with other fields.
struct Crate {
  int weight = 0;
};
CASTOR_REFLECT(Crate, weight)

} // namespace other_crates

/// Long sequences of whatever `step` gives.
template <class Step>
std::vector<Step> steps(const rc::Gen<Step>& step) {
  return *rc::gen::scale(5.0, rc::gen::container<std::vector<Step>>(step));
}

// --- filters ---

rc::Gen<ChangeFilter> any_filter() {
  using Names = std::vector<std::string>;
  return rc::gen::build<ChangeFilter>(
    rc::gen::set(&ChangeFilter::operation,
                 element<std::optional<Operation>>(std::nullopt, std::nullopt, Operation::add,
                                                   Operation::overwrite, Operation::remove)),
    rc::gen::set(&ChangeFilter::type,
                 element<std::string>("", "Box", "PaintedBox", "SignedBox", "Crate", "Point")),
    rc::gen::set(&ChangeFilter::id, element<std::string>("", "", "1", "2")),
    rc::gen::set(&ChangeFilter::source, element<std::string>("", "", "p", "q")),
    rc::gen::set(&ChangeFilter::subarchitecture,
                 element<std::optional<std::string>>("", "", "u", "v", std::nullopt)),
    rc::gen::set(&ChangeFilter::changing,
                 element(Names{}, Names{}, Names{"label"}, Names{"label", "pose"}, Names{"side"},
                         Names{"x"})));
}

rc::Gen<ChangeEvent> any_event() {
  return rc::gen::build<ChangeEvent>(
    rc::gen::set(&ChangeEvent::operation,
                 element(Operation::add, Operation::overwrite, Operation::remove)),
    rc::gen::set(&ChangeEvent::address,
                 element(Address{"u", "1"}, Address{"u", "2"}, Address{"v", "1"}, Address{"v", "2"},
                         Address{"w", "1"})),
    rc::gen::set(&ChangeEvent::source, element<std::string>("p", "q", "r")),
    rc::gen::set(&ChangeEvent::type, element(descriptor_of<Box>(), descriptor_of<PaintedBox>(),
                                             descriptor_of<SignedBox>(), descriptor_of<Crate>(),
                                             descriptor_of<Point>())),
    rc::gen::set(&ChangeEvent::changed, rc::gen::inRange<FieldMask>(0, 32)));
}

struct FilterStep {
  enum { insert, erase, erase_known, match } kind = insert;
  ChangeFilter filter;
  FilterIndex::Key key = 0;
  ChangeEvent event;
  /// Which of the known filters to erase.
  std::size_t pick = 0;
};

std::ostream& operator<<(std::ostream& out, const FilterStep& x) {
  if (x.kind == FilterStep::match)
    return out << "match " << to_string(x.event);
  return out << (x.kind == FilterStep::insert ? "insert " : "erase ") << x.key << ' '
             << to_string(x.filter);
}

rc::Gen<FilterStep> filter_step() {
  return rc::gen::build<FilterStep>(
    rc::gen::set(&FilterStep::kind,
                 element(FilterStep::insert, FilterStep::insert, FilterStep::erase,
                         FilterStep::erase_known, FilterStep::match, FilterStep::match)),
    rc::gen::set(&FilterStep::filter, any_filter()),
    rc::gen::set(&FilterStep::key, rc::gen::inRange<FilterIndex::Key>(0, 4)),
    rc::gen::set(&FilterStep::event, any_event()), rc::gen::set(&FilterStep::pick));
}

// --- entries ---

struct StoreStep {
  Operation operation = Operation::add;
  std::string id;
  Client writer;
  int type = 0;
  /// What the writer says it has seen: nothing, what it really saw, or a guess.
  enum { nothing, truth, guess } seen = nothing;
  Version guessed = 0;
  /// Whether the prepared effect is committed.
  bool commit = true;
  TypeQuery query;
};

std::ostream& operator<<(std::ostream& out, const StoreStep& x) {
  return out << to_string(x.operation) << ' ' << x.id << " type " << x.type << " by "
             << x.writer.component << " seen " << x.seen << ' ' << x.guessed
             << (x.commit ? "" : " dropped") << "; query " << x.query.type << ' ' << x.query.count
             << ' ' << x.query.with_derived;
}

rc::Gen<StoreStep> store_step() {
  return rc::gen::build<StoreStep>(
    rc::gen::set(&StoreStep::operation,
                 element(Operation::add, Operation::add, Operation::overwrite, Operation::overwrite,
                         Operation::overwrite, Operation::remove)),
    rc::gen::set(&StoreStep::id, element<std::string>("a", "b", "c", "d", "e")),
    rc::gen::set(&StoreStep::writer, element(Client{"p", "vision"}, Client{"q", "vision"},
                                             Client{"r", "spatial"}, Client{"s", "planning"})),
    // Boxes above all, so that most overwrites are of the right type.
    rc::gen::set(&StoreStep::type, element(0, 0, 0, 0, 1, 1, 2, 3, 4)),
    rc::gen::set(&StoreStep::seen, element(StoreStep::nothing, StoreStep::truth, StoreStep::truth,
                                           StoreStep::truth, StoreStep::guess)),
    rc::gen::set(&StoreStep::guessed, rc::gen::inRange<Version>(0, 4)),
    rc::gen::set(&StoreStep::commit, element(true, true, true, false)),
    rc::gen::set(&StoreStep::query,
                 rc::gen::build<TypeQuery>(
                   rc::gen::set(&TypeQuery::type,
                                element<std::string>("", "Box", "PaintedBox", "Crate", "Point")),
                   rc::gen::set(&TypeQuery::count, rc::gen::inRange<std::size_t>(0, 4)),
                   rc::gen::set(&TypeQuery::with_derived))));
}

Value value_of_type(int type) {
  switch (type) {
    case 0:
      return Value::of(Box{});
    case 1:
      return Value::of(PaintedBox{});
    case 2:
      return Value::of(SignedBox{});
    case 3:
      return Value::of(Crate{});
    default:
      return Value::of(other_crates::Crate{});
  }
}

/// What an entry store promises, in the plainest terms: every look-up is a search.
class Model {
public:
  explicit Model(std::size_t remembered) : remembered_(remembered) {}

  /// Why the request must be refused, or nothing.
  std::optional<FailureKind> refusal(const WriteRequest& x) const {
    if (x.client->subarchitecture != "vision" && x.client->subarchitecture != "spatial")
      return FailureKind::not_permitted;
    auto i = find(x.address.id);
    if (x.operation == Operation::add && i != entries_.end())
      return FailureKind::already_exists;
    if (x.operation != Operation::add && i == entries_.end())
      return FailureKind::does_not_exist;
    if (x.operation == Operation::overwrite && x.last_seen != (*i)->version)
      return FailureKind::inconsistent;
    if (x.operation == Operation::remove)
      return x.last_seen && x.last_seen != (*i)->version ? std::optional{FailureKind::inconsistent}
                                                         : std::nullopt;
    for (auto& known : layouts_)
      if (known->name() == x.value.type_name() && known->hash != x.value.type().hash)
        return FailureKind::wrong_type;
    if (x.operation == Operation::overwrite && (*i)->type_name() != x.value.type_name())
      return FailureKind::wrong_type;
    return std::nullopt;
  }

  /// Does what was not refused; gives the entry as the event must describe it.
  EntryPtr apply(const WriteRequest& x) {
    auto& id = x.address.id;
    ++sequence_;
    auto i = find(id);
    if (x.operation == Operation::remove) {
      auto old = *i;
      entries_.erase(i);
      deleted_.emplace_back(id, old->version);
      while (deleted_.size() > remembered_) {
        highest_forgotten_ = std::max(highest_forgotten_.value_or(0), deleted_.front().second);
        deleted_.erase(deleted_.begin());
      }
      return old;
    }
    auto version = x.operation == Operation::overwrite ? (*i)->version + 1 : next_version(id);
    if (x.operation == Operation::overwrite)
      entries_.erase(i);
    else
      std::erase_if(deleted_, [&](auto& d) { return d.first == id; });
    layouts_.push_back(x.value.type_ptr());
    auto entry =
      std::make_shared<const Entry>(Entry{x.address, version, x.value, x.client->component});
    entries_.insert(entries_.begin(), entry);
    return entry;
  }

  std::optional<Version> version(const std::string& id) const {
    if (auto i = find(id); i != entries_.end())
      return (*i)->version;
    for (auto& [deleted_id, version] : deleted_)
      if (deleted_id == id)
        return version;
    return std::nullopt;
  }

  std::vector<EntryPtr> read_by_type(const TypeQuery& query) const {
    std::vector<EntryPtr> result;
    for (auto& entry : entries_) {
      bool wanted = query.type.empty() || entry->type_name() == query.type ||
                    (query.with_derived && entry->value.type().is_a(query.type));
      if (wanted && (query.count == 0 || result.size() < query.count))
        result.push_back(entry);
    }
    return result;
  }

  std::uint64_t sequence() const { return sequence_; }

private:
  using Entries = std::vector<EntryPtr>;

  Entries::const_iterator find(const std::string& id) const {
    return std::find_if(entries_.begin(), entries_.end(),
                        [&](auto& x) { return x->address.id == id; });
  }

  Version next_version(const std::string& id) const {
    if (auto last = version(id))
      return *last + 1;
    return highest_forgotten_ ? *highest_forgotten_ + 1 : 0;
  }

  std::size_t remembered_;
  /// The most recently written first.
  Entries entries_;
  /// The longest deleted first.
  std::vector<std::pair<std::string, Version>> deleted_;
  std::optional<Version> highest_forgotten_;
  std::vector<TypeDescriptorPtr> layouts_;
  std::uint64_t sequence_ = 0;
};

void assert_same(const EntryPtr& a, const EntryPtr& b) {
  RC_ASSERT(a->address == b->address);
  RC_ASSERT(a->version == b->version);
  RC_ASSERT(a->writer == b->writer);
  RC_ASSERT(a->value == b->value);
}

void assert_same(const std::vector<EntryPtr>& a, const std::vector<EntryPtr>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    assert_same(a[i], b[i]);
}

void assert_same(const EntryStore& store, const Model& model, const TypeQuery& query) {
  auto all = model.read_by_type({});
  RC_ASSERT(store.sequence() == model.sequence());
  RC_ASSERT(store.size() == all.size());
  assert_same(store.read_by_type({}), all);
  assert_same(store.read_by_type(query), model.read_by_type(query));
  for (auto id : {"a", "b", "c", "d", "e", "f"}) {
    auto version = store.version(id);
    RC_ASSERT((version ? std::optional(*version) : std::nullopt) == model.version(id));
    auto i = std::find_if(all.begin(), all.end(), [&](auto& x) { return x->address.id == id; });
    auto read = store.read(id);
    RC_ASSERT(read.ok() == (i != all.end()));
    RC_ASSERT(store.exists(id) == read.ok());
    if (read)
      assert_same(*read, *i);
    else
      RC_ASSERT(read.failure().kind == FailureKind::does_not_exist);
  }
}

} // namespace

RC_GTEST_PROP(FilterIndexProperties, FindsWhatANaiveSearchFinds, ()) {
  FilterIndex index;
  std::vector<std::pair<FilterIndex::Key, ChangeFilter>> model;
  std::size_t hits = 0;
  auto erase = [&](FilterIndex::Key key, const ChangeFilter& filter) {
    auto i = std::find(model.begin(), model.end(), std::pair(key, filter));
    RC_ASSERT(index.erase(key, filter) == (i != model.end()));
    if (i != model.end())
      model.erase(i);
  };
  for (auto& step : steps(filter_step())) {
    switch (step.kind) {
      case FilterStep::insert:
        index.insert(step.key, step.filter);
        model.emplace_back(step.key, step.filter);
        break;
      case FilterStep::erase:
        erase(step.key, step.filter);
        break;
      case FilterStep::erase_known:
        if (!model.empty()) {
          auto known = model[step.pick % model.size()];
          erase(known.first, known.second);
        }
        break;
      case FilterStep::match: {
        std::vector<FilterIndex::Key> found;
        index.match(step.event, Value{}, found);
        std::vector<FilterIndex::Key> expected;
        for (auto& [key, filter] : model)
          if (matches(filter, step.event, Value{}))
            expected.push_back(key);
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        RC_ASSERT(found == expected);
        hits += found.size();
      }
    }
    RC_ASSERT(index.size() == model.size());
  }
  RC_CLASSIFY(hits > 0, "with hits");
}

RC_GTEST_PROP(EntryStoreProperties, DoesWhatANaiveStoreDoes, ()) {
  auto remembered = *rc::gen::inRange<std::size_t>(0, 4);
  EntryStore store{"vision", {.remembered_deletions = remembered}};
  store.access().allow("spatial");
  Model model{remembered};
  std::map<std::pair<std::string, std::string>, Version> seen;
  std::size_t refused = 0;
  std::size_t time = 0;
  for (auto& step : steps(store_step())) {
    WriteRequest request{
      step.operation, {"vision", step.id}, {}, {}, std::make_shared<const Client>(step.writer)};
    if (step.operation != Operation::remove)
      request.value = value_of_type(step.type);
    auto known = seen.find({step.writer.component, step.id});
    if (step.seen == StoreStep::guess)
      request.last_seen = step.guessed;
    else if (step.seen == StoreStep::truth && known != seen.end())
      request.last_seen = known->second;

    auto effect = store.prepare(request);
    assert_same(store, model, step.query);
    auto refusal = model.refusal(request);
    RC_ASSERT(effect.ok() == !refusal.has_value());
    if (refusal) {
      ++refused;
      RC_ASSERT(effect.failure().kind == *refusal);
      RC_ASSERT(effect.failure().address == request.address);
      RC_ASSERT(effect.failure().message.find(to_string(request.address)) != std::string::npos);
      // As components do: whoever is told that it is out of date reads again.
      if (*refusal == FailureKind::inconsistent)
        seen[{step.writer.component, step.id}] = *model.version(step.id);
      continue;
    }
    if (!step.commit)
      continue;
    auto event = store.commit(*effect, Timestamp{++time});
    auto entry = model.apply(request);
    RC_ASSERT(event->operation == request.operation);
    RC_ASSERT(event->address == request.address);
    RC_ASSERT(event->source == step.writer.component);
    RC_ASSERT(*event->type == entry->value.type());
    RC_ASSERT(event->version == entry->version);
    RC_ASSERT(event->sequence == model.sequence());
    RC_ASSERT(event->time == Timestamp{time});
    assert_same(store, model, step.query);
    if (step.operation != Operation::remove)
      seen[{step.writer.component, step.id}] = entry->version;
  }
  RC_CLASSIFY(refused > 0, "with refusals");
}

RC_GTEST_PROP(EntryStoreProperties, NeverGivesAVersionOfAnIdTwice, ()) {
  EntryStore store{"vision", {.remembered_deletions = *rc::gen::inRange<std::size_t>(0, 4)}};
  std::map<std::string, std::set<Version>> given;
  std::uint64_t sequence = 0;
  for (auto& step : steps(store_step())) {
    WriteRequest request{step.operation,
                         {"vision", step.id},
                         Value::of(Box{}),
                         {},
                         std::make_shared<const Client>(Client{"p", "vision"})};
    if (auto entry = store.read(step.id))
      request.last_seen = (*entry)->version;
    auto effect = store.prepare(request);
    if (!effect)
      continue;
    auto event = store.commit(*effect, {});
    RC_ASSERT(event->sequence == ++sequence);
    auto& versions = given[step.id];
    if (step.operation == Operation::remove) {
      RC_ASSERT(event->version == *versions.rbegin());
    } else if (!versions.empty()) {
      RC_ASSERT(event->version > *versions.rbegin());
    }
    versions.insert(event->version);
  }
}

} // namespace castor::test
