#include "castor/actors/system/event_watch.hpp"

#include "castor/actors/system/entry_queries.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <utility>

namespace castor {

namespace {

/// How many events of a working memory may be on their way to whoever looks on; more are merged.
constexpr std::uint32_t event_limit = 1024;

} // namespace

void EventWatch::begin(const Json& request) {
  auto filter = parse_change_filter(request.value("filter", ""));
  what_ = request.value("what", "");
  with_values_ = request.value("values", false);
  max_bytes_ = bytes_shown(request);
  if (request.value("wait", false))
    return subscribe_to(filter);
  context_.with_types([=, this](TypeCatalogue types) {
    auto known = context_.known_names(std::move(types));
    check_names(filter, known);
    if (what_.empty() || is_known_type(what_, known.types))
      return subscribe_to(filter);
    // So it has to be an entry.
    auto& name = *filter.subarchitecture;
    context_.self
      ->request(context_.working_memory(name), inspection_patience,
                QueryRequest{{name, {}, 0, false}, {}})
      .then(
        [=, this](const Outcome<std::vector<EntryPtr>>& found) {
          if (found && select_entries(*found, what_).empty())
            return context_.refuse(nothing_found(name, what_, *found, known.types) +
                                   ". With --wait, `castor events` waits for it");
          subscribe_to(filter);
        },
        [=, this](const caf::error&) { subscribe_to(filter); });
  });
}

void EventWatch::subscribe_to(const ChangeFilter& filter) {
  filter_ = filter;
  update();
}

void EventWatch::update() {
  if (!filter_)
    return;
  for (auto& [name, wm] : context_.parts.roster->working_memories) {
    auto known = watched_.find(name);
    if ((!filter_->subarchitecture->empty() && *filter_->subarchitecture != name) ||
        (known != watched_.end() && known->second.actor == wm))
      continue;
    watched_.insert_or_assign(name, Watched{wm, Receipts{event_limit}, 0});
    for (auto& filter : filters_for(name)) {
      Subscribe x{++last_filter_, filter};
      x.queue_limit = event_limit;
      context_.self->send(wm, std::move(x));
    }
  }
}

std::vector<ChangeFilter> EventWatch::filters_for(const std::string& name) const {
  auto filter = filter_->in(name);
  if (what_.empty())
    return {filter};
  auto by_id = filter;
  by_id.id = what_;
  auto by_type = filter;
  by_type.type = what_;
  return {by_id, by_type};
}

void EventWatch::on_event(const ChangeEventPtr& event) {
  auto& address = event->address;
  auto watched = watched_.find(address.subarchitecture);
  if (watched == watched_.end())
    return;
  if (!with_values_ || event->operation == Operation::remove) {
    ++watched->second.in_flight;
    context_.send(change_as_json(*event, {}, max_bytes_) + '\n');
    return;
  }
  auto tell = [this, event](const Value& value) {
    ++watched_.at(event->address.subarchitecture).in_flight;
    context_.send(change_as_json(*event, value, max_bytes_) + '\n');
  };
  context_.self->request(watched->second.actor, inspection_patience, ReadRequest{address, {}})
    .then([tell](const Outcome<EntryPtr>& x) { tell(x ? (*x)->value : Value{}); },
          [tell](const caf::error&) { tell({}); });
}

void EventWatch::taken() {
  for (auto& [name, x] : watched_) {
    std::uint64_t count = 0;
    for (; x.in_flight > 0; --x.in_flight)
      count += x.receipts.take();
    if (count > 0)
      context_.self->send(x.actor, EventsTaken{EventStream::component, count});
  }
}

} // namespace castor
