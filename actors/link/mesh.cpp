#include "castor/actors/link/mesh.hpp"

#include "castor/actors/link/remote_actor.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/store/value_limit.hpp"

#include <caf/detail/sync_request_bouncer.hpp>
#include <caf/make_actor.hpp>

#include <utility>

namespace castor {

namespace {

/// What a message between processes is about.
enum class Subject : std::uint8_t {
  /// For an actor: sender, receiver, CAF's message id, the message.
  message,
  /// The same with an error, which answers a request.
  error,
  /// An actor is to end.
  exit,
  /// An actor has ended.
  ended,
  /// Descriptors of types that later messages refer to.
  types,
};

CASTOR_WIRE_ENUM(Subject, types)

const char* name_of_type(const caf::type_erased_tuple& message) {
  auto* type = message.size() == 1 ? message.type(0).second : nullptr;
  return type ? type->name() : "one of the framework's own";
}

/// How many change events it carries, for working memories or for components.
std::size_t count_events(const caf::type_erased_tuple& message) {
  if (message.match_elements<RoutedEvents>())
    return message.get_as<RoutedEvents>(0).events.size();
  if (message.match_elements<ChangeNotices>())
    return message.get_as<ChangeNotices>(0).notices.size();
  return message.match_elements<ChangeNotice>() ? 1 : 0;
}

/// The lane of what one actor sends to another: these messages keep their order.
Lane lane_of(ActorName sender, std::uint32_t receiver) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
  return sender == 0 ? 0 : ((sender * odd) ^ receiver) | 1;
}

/// What somebody who waits for the outcome of an operation gets instead: as an answer to a request,
/// or in place of an answer. Nothing if it is none that can tell of a failure.
std::optional<caf::message> outcome_of(const caf::type_erased_tuple& x, const Failure& failure) {
  auto outcome = [&]<class T>(Outcome<T> result) { return caf::make_message(std::move(result)); };
  if (x.match_elements<WriteRequest>())
    return outcome(Outcome<Version>{failure});
  if (x.match_elements<BatchRequest>())
    return outcome(Outcome<std::vector<Version>>{failure});
  if (x.match_elements<Subscribe>())
    return outcome(Outcome<Acknowledged>{failure});
  if (x.match_elements<ReadRequest>() || x.match_elements<Outcome<EntryPtr>>())
    return outcome(Outcome<EntryPtr>{failure});
  if (x.match_elements<QueryRequest>() || x.match_elements<Outcome<std::vector<EntryPtr>>>())
    return outcome(Outcome<std::vector<EntryPtr>>{failure});
  return std::nullopt;
}

/// What a message that is too large is about, in words, and the entry if it is about one.
std::pair<std::string, Address> subject_of(const caf::type_erased_tuple& x) {
  auto of_write = [](const WriteRequest& w) {
    return (w.client ? to_string(*w.client) + ": " : std::string{}) + to_string(w.address);
  };
  if (x.match_elements<WriteRequest>()) {
    auto& request = x.get_as<WriteRequest>(0);
    return {of_write(request), request.address};
  }
  if (x.match_elements<BatchRequest>()) {
    auto& request = x.get_as<BatchRequest>(0);
    return {std::to_string(request.writes.size()) + " writes for " + request.subarchitecture,
            {request.subarchitecture, {}}};
  }
  if (x.match_elements<Outcome<EntryPtr>>())
    if (auto& entry = x.get_as<Outcome<EntryPtr>>(0); entry && *entry)
      return {"what was read, " + to_string((*entry)->address), (*entry)->address};
  if (x.match_elements<Pushed>())
    return {"what " + x.get_as<Pushed>(0).provider + " pushes", {}};
  return {std::string{"a message, "} + name_of_type(x), {}};
}

Failure too_large_for_link(const caf::type_erased_tuple& x, std::size_t size, std::size_t largest) {
  auto [what, address] = subject_of(x);
  return {FailureKind::too_large,
          what + " takes " + std::to_string(size) + " bytes or more, but at most " +
            std::to_string(largest) +
            " travel to another process at once. Write it in parts, or have both in one process",
          address};
}

/// Answers a request to an actor that has ended; any other message needs no answer.
void receiver_down(const caf::strong_actor_ptr& sender, caf::message_id id) {
  caf::detail::sync_request_bouncer{caf::make_error(caf::sec::request_receiver_down)}(sender, id);
}

/// CAF takes it for granted that a message has the content of a stream if its id says so, which
/// nobody here sends.
caf::message_id take_message_id(WireReader& in) {
  const caf::message_id result{in.take<std::uint64_t>()};
  if (result.is_stream_message())
    throw DecodeError("a message of a stream");
  return result;
}

} // namespace

// -- LinkPort

void LinkPort::send(ActorName to, caf::mailbox_element& x) {
  try {
    if (auto failure = mesh_->refuse_large_value(to, x.content()))
      refuse(to, x, *failure);
    else
      send_checked(to, x);
  } catch (const MessageTooLarge& e) {
    refuse(to, x, too_large_for_link(x.content(), e.size(), largest_message_));
  }
}

void LinkPort::refuse(ActorName to, caf::mailbox_element& x, const Failure& why) {
  auto answer = outcome_of(x.content(), why);
  if (!answer)
    answer = caf::make_message(caf::make_error(caf::sec::runtime_error, why.message));
  if (x.mid.is_request()) {
    if (x.sender)
      x.sender->enqueue(nullptr, x.mid.response_id(), *std::move(answer), nullptr);
  } else if (x.mid.is_response()) {
    send_checked(to, *caf::make_mailbox_element(x.sender, x.mid, {}, *std::move(answer)));
  } else {
    note_repeated(LogLevel::warning, "not sent: " + why.message);
    // It would count as under way for ever.
    if (x.sender && x.content().match_elements<Pushed>())
      x.sender->enqueue(
        mesh_->actor_of(to), caf::make_message_id(),
        caf::make_message(PushesTaken{x.content().get_as<Pushed>(0).value.type_name(), 1}),
        nullptr);
  }
}

void LinkPort::send_checked(ActorName to, caf::mailbox_element& x) {
  auto& content = x.content();
  WireWriter out{*mesh_, largest_message_};
  auto sender = mesh_->name_of(x.sender);
  auto number = static_cast<std::uint32_t>(to);
  if (content.match_elements<caf::exit_msg>()) {
    out(Subject::exit, number);
  } else if (content.match_elements<caf::error>()) {
    out(Subject::error, sender, number, x.mid.integer_value(),
        plain_words(content.get_as<caf::error>(0), mesh_->system()));
  } else {
    out(Subject::message, sender, number, x.mid.integer_value());
    if (!mesh_->table().write(content, out)) {
      log_runtime(LogLevel::error,
                  std::string{"a message that cannot travel to another process: "} +
                    name_of_type(content));
      caf::detail::sync_request_bouncer{caf::make_error(caf::sec::unexpected_message)}(x.sender,
                                                                                       x.mid);
      return;
    }
    out.check_size();
    if (!mesh_->open_request(peer_, x)) {
      receiver_down(x.sender, x.mid);
      return;
    }
  }
  OutgoingMessage message{out.take_head(), out.take_contents(), lane_of(sender, number)};
  auto events = count_events(content);
  LinkRecord::add(record_->events_out, events);
  if (content.match_elements<RoutedEvents>())
    message.arrived = acknowledgement(to, x.sender, events);
  hand_over({std::move(message), out.take_types()});
}

std::function<void()> LinkPort::acknowledgement(ActorName route, caf::strong_actor_ptr sender,
                                                std::size_t events) {
  std::shared_ptr<Receipts> receipts;
  {
    std::lock_guard guard{mutex_};
    auto& known = receipts_[sender->id()];
    if (!known)
      known = std::make_shared<Receipts>(route_limit);
    receipts = known;
  }
  return [mesh = mesh_, route, sender = std::move(sender), receipts = std::move(receipts), events] {
    std::uint64_t taken = 0;
    for (std::size_t i = 0; i < events; ++i)
      taken += receipts->take();
    if (taken > 0)
      sender->enqueue(mesh->actor_of(route), caf::make_message_id(),
                      caf::make_message(EventsTaken{EventStream::component, taken}), nullptr);
  };
}

void LinkPort::tell_end(ActorName who) {
  WireWriter out{*mesh_};
  out(Subject::ended, static_cast<std::uint32_t>(who));
  hand_over({{out.take_head()}, {}});
}

void LinkPort::hand_over(LinkMessage message) {
  caf::anon_send(link_, std::move(message));
}

// -- Mesh

void Mesh::set_well_known(WellKnownActor number, const caf::strong_actor_ptr& who) {
  {
    std::lock_guard guard{mutex_};
    numbers_[who->id()] = static_cast<std::uint32_t>(number);
    locals_[static_cast<std::uint32_t>(number)] = who;
  }
  watch(who, make_actor_name(self_, static_cast<std::uint32_t>(number)));
}

void Mesh::set_largest_value(ActorName working_memory, std::string subarchitecture,
                             std::size_t bytes) {
  std::lock_guard guard{mutex_};
  largest_values_[working_memory] = {std::move(subarchitecture), bytes};
}

std::optional<Failure> Mesh::refuse_large_value(ActorName to,
                                                const caf::type_erased_tuple& x) const {
  bool is_write = x.match_elements<WriteRequest>();
  if (!is_write && !x.match_elements<BatchRequest>())
    return std::nullopt;
  std::pair<std::string, std::size_t> limit;
  {
    std::lock_guard guard{mutex_};
    auto i = largest_values_.find(to);
    if (i == largest_values_.end())
      return std::nullopt;
    limit = i->second;
  }
  if (is_write)
    return value_too_large(x.get_as<WriteRequest>(0), limit.first, limit.second);
  for (auto& write : x.get_as<BatchRequest>(0).writes)
    if (auto failure = value_too_large(write, limit.first, limit.second))
      return failure;
  return std::nullopt;
}

void Mesh::set_event_sink(EventSink sink) {
  std::lock_guard guard{mutex_};
  event_sink_ = std::move(sink);
}

void Mesh::add_port(std::shared_ptr<LinkPort> port) {
  std::lock_guard guard{mutex_};
  auto process = port->peer();
  records_[process] = port->record();
  processes_[process].port = std::move(port);
}

void Mesh::inject(ProcessNumber peer, const LinkFault& x) {
  std::lock_guard guard{mutex_};
  if (auto i = processes_.find(peer); i != processes_.end() && i->second.port)
    caf::anon_send(i->second.port->link(), x);
}

std::vector<LinkStatus> Mesh::links() const {
  std::lock_guard guard{mutex_};
  std::vector<LinkStatus> result;
  for (auto& [peer, record] : records_)
    result.push_back(record->status());
  return result;
}

ActorName Mesh::name_of(const caf::strong_actor_ptr& x) {
  if (!x)
    return 0;
  if (auto* remote = as_remote(x))
    return remote->actor();
  std::unique_lock guard{mutex_};
  if (closed_)
    return 0;
  auto [i, is_new] = numbers_.try_emplace(x->id(), 0u);
  if (!is_new)
    return make_actor_name(self_, i->second);
  i->second = ++last_number_;
  auto name = make_actor_name(self_, i->second);
  locals_[i->second] = x;
  guard.unlock();
  watch(x, name);
  return name;
}

void Mesh::watch(const caf::strong_actor_ptr& who, ActorName name) {
  who->get()->attach_functor([mesh = weak_from_this(), name] {
    if (auto self = mesh.lock())
      self->end_of_local(name);
  });
}

caf::strong_actor_ptr Mesh::actor_of(ActorName name) {
  if (name == 0)
    return nullptr;
  auto number = static_cast<std::uint32_t>(name);
  std::lock_guard guard{mutex_};
  if (process_of(name) == self_) {
    auto i = locals_.find(number);
    return i == locals_.end() ? nullptr : i->second;
  }
  auto process = processes_.find(process_of(name));
  if (process == processes_.end() || !process->second.port)
    return nullptr;
  auto& representative = process->second.representatives[number];
  if (!representative) {
    caf::actor_config config;
    representative = caf::make_actor<RemoteActor, caf::strong_actor_ptr>(
      system_.next_actor_id(), system_.node(), &system_, config, process->second.port, name);
    if (process->second.ended.count(number) > 0)
      static_cast<RemoteActor*>(representative->get())
        ->kill_proxy(nullptr, caf::exit_reason::unknown);
  }
  return representative;
}

caf::strong_actor_ptr Mesh::well_known(ProcessNumber process, WellKnownActor number) {
  return actor_of(make_actor_name(process, static_cast<std::uint32_t>(number)));
}

TypeDescriptorPtr Mesh::type_of(std::uint64_t hash) {
  std::lock_guard guard{mutex_};
  auto i = types_.find(hash);
  return i == types_.end() ? nullptr : i->second;
}

bool Mesh::open_request(ProcessNumber to, const caf::mailbox_element& x) {
  // Those that are only passed on are answered elsewhere.
  if (!x.mid.is_request() || !x.sender || as_remote(x.sender))
    return true;
  std::lock_guard guard{mutex_};
  if (processes_.count(to) == 0)
    return false;
  open_requests_[{x.sender->id(), x.mid.response_id().integer_value()}] = {x.sender, x.mid, to};
  return true;
}

void Mesh::close_request(const caf::strong_actor_ptr& sender, caf::message_id response) {
  std::lock_guard guard{mutex_};
  open_requests_.erase({sender->id(), response.integer_value()});
}

Bytes Mesh::introduction(const std::vector<TypeDescriptorPtr>& types) {
  Bytes result;
  Encoder out{result};
  out.put(Subject::types);
  out.put(static_cast<std::uint32_t>(types.size()));
  for (auto& x : types)
    out.put(encode_descriptor(*x));
  return result;
}

void Mesh::introduce(TypeDescriptorPtr type) {
  std::lock_guard guard{mutex_};
  auto hash = type->hash;
  types_.emplace(hash, std::move(type));
}

void Mesh::end_of_local(ActorName name) {
  std::vector<std::shared_ptr<LinkPort>> ports;
  {
    std::lock_guard guard{mutex_};
    auto local = locals_.extract(static_cast<std::uint32_t>(name));
    if (!local)
      return;
    numbers_.erase(local.mapped()->id());
    for (auto& [number, process] : processes_)
      if (process.port)
        ports.push_back(process.port);
  }
  for (auto& port : ports)
    port->tell_end(name);
}

void Mesh::end_of_remote(ProcessNumber process, std::uint32_t number) {
  caf::strong_actor_ptr representative;
  {
    std::lock_guard guard{mutex_};
    auto i = processes_.find(process);
    if (i == processes_.end())
      return;
    i->second.ended.insert(number);
    largest_values_.erase(make_actor_name(process, number));
    if (auto known = i->second.representatives.find(number);
        known != i->second.representatives.end())
      representative = known->second;
  }
  if (representative)
    static_cast<RemoteActor*>(representative->get())
      ->kill_proxy(nullptr, caf::exit_reason::unknown);
}

void Mesh::end_process(ProcessNumber process) {
  Process lost;
  std::vector<OpenRequest> unanswered;
  {
    std::lock_guard guard{mutex_};
    if (auto x = processes_.extract(process))
      lost = std::move(x.mapped());
    std::erase_if(largest_values_, [&](auto& x) { return process_of(x.first) == process; });
    std::erase_if(open_requests_, [&](auto& x) {
      if (x.second.process != process)
        return false;
      unanswered.push_back(x.second);
      return true;
    });
  }
  for (auto& x : unanswered)
    receiver_down(x.sender, x.id);
  for (auto& [number, representative] : lost.representatives)
    static_cast<RemoteActor*>(representative->get())
      ->kill_proxy(nullptr, caf::exit_reason::remote_link_unreachable);
}

void Mesh::close() {
  std::vector<ProcessNumber> all;
  std::unordered_map<std::uint32_t, caf::strong_actor_ptr> locals;
  {
    std::lock_guard guard{mutex_};
    closed_ = true;
    for (auto& [number, process] : processes_)
      all.push_back(number);
    locals = std::move(locals_);
    numbers_.clear();
    event_sink_ = nullptr;
  }
  for (auto process : all)
    end_process(process);
}

/// Of a message that a link did not take, what is known of it is told to whoever waits for it.
void Mesh::drop_too_large(WireReader& in, std::uint64_t size, caf::execution_unit* context) {
  auto why = "a message of " + std::to_string(size) + " bytes is more than a link takes";
  note_repeated(LogLevel::warning, why);
  // Its head was too large, too.
  if (in.at_end())
    return;
  auto subject = in.take<Subject>();
  if (subject != Subject::message && subject != Subject::error)
    return;
  auto sender = in.take<caf::strong_actor_ptr>();
  auto receiver = actor_of(make_actor_name(self_, in.take<std::uint32_t>()));
  auto id = take_message_id(in);
  auto error = caf::make_error(caf::sec::runtime_error, why);
  if (id.is_request() && sender) {
    sender->enqueue(nullptr, id.response_id(), caf::make_message(std::move(error)), context);
  } else if (id.is_response() && receiver) {
    close_request(receiver, id);
    receiver->enqueue(std::move(sender), id, caf::make_message(std::move(error)), context);
  }
}

void Mesh::receive(ProcessNumber from, IncomingMessage message, caf::execution_unit* context) {
  WireReader in{*this, message.head, std::move(message.contents)};
  auto local = [&](std::uint32_t number) { return actor_of(make_actor_name(self_, number)); };
  if (message.too_large > 0) {
    drop_too_large(in, message.too_large, context);
    return;
  }
  auto subject = in.take<Subject>();
  switch (subject) {
    case Subject::message:
    case Subject::error: {
      auto sender = in.take<caf::strong_actor_ptr>();
      auto number = in.take<std::uint32_t>();
      auto id = take_message_id(in);
      auto content =
        subject == Subject::message
          ? table_.read(in)
          : caf::make_message(caf::make_error(caf::sec::runtime_error, in.take<std::string>()));
      if (auto events = count_events(content)) {
        std::lock_guard guard{mutex_};
        LinkRecord::add(records_.at(from)->events_in, events);
      }
      if (number == static_cast<std::uint32_t>(WellKnownActor::events)) {
        EventSink sink;
        {
          std::lock_guard guard{mutex_};
          sink = event_sink_;
        }
        if (sink)
          sink(content, context);
        return;
      }
      // Who asked is lost, as far as this process knows: there is nobody to answer.
      if (!sender && id.is_request())
        return;
      auto receiver = local(number);
      if (receiver && id.is_response())
        close_request(receiver, id);
      if (receiver)
        receiver->enqueue(std::move(sender), id, std::move(content), context);
      else
        receiver_down(sender, id);
      return;
    }
    case Subject::exit:
      if (auto receiver = local(in.take<std::uint32_t>()))
        caf::anon_send_exit(receiver, caf::exit_reason::user_shutdown);
      return;
    case Subject::ended:
      end_of_remote(from, in.take<std::uint32_t>());
      return;
    case Subject::types:
      for (auto n = in.take<std::uint32_t>(); n > 0; --n)
        introduce(decode_descriptor(in.take_bytes()));
      return;
  }
}

} // namespace castor
