#include "castor/actors/system/operator_requests.hpp"

#include "castor/actors/system/operator_client.hpp"
#include "castor/actors/system/value_from_json.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

namespace castor {

namespace {

/// What is known of an entry once it is written.
Json written(const WriteRequest& x, const std::string& type, Version version) {
  return {{"subarchitecture", x.address.subarchitecture},
          {"id", x.address.id},
          {"type", type},
          {"version", version},
          {"writer", x.client->component}};
}

/// How often it is looked whether what a request waits for is there.
constexpr std::chrono::milliseconds time_between_looks{100};

/// How often another id is tried where the made one is taken, by an entry from an earlier run.
constexpr int most_ids = 1000;

void write(const InspectionContextPtr& context, WriteRequest request, std::string type,
           int other_ids = 0) {
  auto wm = context->working_memory(request.address.subarchitecture);
  context->ask<Version>(
    wm, request.client, request,
    [=](const Outcome<Version>& x) {
      if (x)
        return context->answer(written(request, type, *x));
      if (other_ids > 0 && x.failure().kind == FailureKind::already_exists) {
        auto again = request;
        again.address.id = "operator:" + std::to_string(next_operator_number());
        return context->guarded([&] { write(context, std::move(again), type, other_ids - 1); });
      }
      context->refuse(x.failure().message);
    },
    [=] {
      context->refuse("the working memory of " + request.address.subarchitecture +
                      " does not answer; whether it has written is not known");
    });
}

Address address_in(const Json& request) {
  return {request.at("subarchitecture").get<std::string>(), request.at("id").get<std::string>()};
}

/// The version that the one who asks counts on, if it says so.
std::optional<Version> expected_version(const Json& request) {
  if (!request.contains("version"))
    return std::nullopt;
  return request.at("version").get<Version>();
}

/// Calls `f` with the entry at the address.
template <class F>
void with_entry(const InspectionContextPtr& context, const Address& address,
                const ClientPtr& client, F f) {
  ReadRequest read{address, {client, 1, Timestamp{0}}};
  context->ask<EntryPtr>(
    context->working_memory(address.subarchitecture), client, read,
    [=](const Outcome<EntryPtr>& x) {
      if (!x)
        return context->refuse(x.failure().message);
      context->guarded([&] { f(*x); });
    },
    [=] {
      context->refuse("the working memory of " + address.subarchitecture + " does not answer");
    });
}

/// The type of that name. Throws std::runtime_error.
TypeDescriptorPtr wanted_type(const std::string& name, const TypeCatalogue& types) {
  auto type = find_type(name, types);
  if (!type)
    throw std::runtime_error("of the type " + name +
                             " only those that derive from it are known here");
  return type;
}

} // namespace

void add_entry(const InspectionContextPtr& context, const Json& request) {
  auto name = request.at("type").get<std::string>();
  bool wait = request.value("wait", false);
  WriteRequest write_request;
  write_request.operation = Operation::add;
  write_request.address.subarchitecture = request.at("subarchitecture").get<std::string>();
  write_request.address.id = request.value("id", "");
  write_request.client = new_operator_client();
  auto subarchitecture = write_request.address.subarchitecture;
  if (!wait)
    context->working_memory(subarchitecture);
  int other_ids = 0;
  if (write_request.address.id.empty()) {
    other_ids = most_ids;
    write_request.address.id = "operator:" + std::to_string(next_operator_number());
  }
  context->with_types([=, value = request.at("value")](const TypeCatalogue& types) {
    bool is_there = context->parts.roster->working_memories.count(subarchitecture) > 0 &&
                    is_known_type(name, types);
    if (wait && !is_there) {
      auto again = [=] { context->guarded([&] { add_entry(context, request); }); };
      context->self->delayed_send(context->self, time_between_looks, InspectionTimeout{again});
      return;
    }
    auto complete = write_request;
    complete.value = value_from_json(wanted_type(name, types), value);
    write(context, std::move(complete), name, other_ids);
  });
}

void overwrite_entry(const InspectionContextPtr& context, const Json& request) {
  auto address = address_in(request);
  auto client = new_operator_client();
  bool merge = request.value("merge", false);
  auto version = expected_version(request);
  with_entry(context, address, client, [=, value = request.at("value")](const EntryPtr& entry) {
    WriteRequest write_request;
    write_request.operation = Operation::overwrite;
    write_request.address = address;
    write_request.client = client;
    write_request.last_seen = version.value_or(entry->version);
    write_request.value =
      value_from_json(entry->value.type_ptr(), value, merge ? &entry->value : nullptr);
    write(context, std::move(write_request), entry->type_name());
  });
}

void delete_entry(const InspectionContextPtr& context, const Json& request) {
  auto address = address_in(request);
  auto client = new_operator_client();
  with_entry(context, address, client,
             [=, version = expected_version(request)](const EntryPtr& entry) {
               WriteRequest write_request;
               write_request.operation = Operation::remove;
               write_request.address = address;
               write_request.client = client;
               write_request.last_seen = version;
               write(context, std::move(write_request), entry->type_name());
             });
}

} // namespace castor
