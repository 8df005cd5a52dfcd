#include "castor/actors/link/mesh.hpp"

#include "castor/actors/link/message_subject.hpp"
#include "castor/actors/link/remote_actor.hpp"
#include "castor/base/at_exit.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/values/descriptor_encoding.hpp"

#include <string>
#include <utility>

namespace castor {

namespace {

/// CAF takes it for granted that a message has the content of a stream if its id says so, which
/// nobody here sends.
caf::message_id take_message_id(WireReader& in) {
  const caf::message_id result{in.take<std::uint64_t>()};
  if (result.is_stream_message())
    throw DecodeError("a message of a stream");
  return result;
}

} // namespace

void Mesh::set_well_known(WellKnownActor number, const caf::strong_actor_ptr& who) {
  names_->set(number, who);
}

void Mesh::set_sink(WellKnownActor number, Sink sink) {
  std::lock_guard guard{mutex_};
  sinks_[static_cast<std::uint32_t>(number)] = std::move(sink);
}

Mesh::Sink Mesh::sink(std::uint32_t number) const {
  if (number > last_well_known_number)
    return nullptr;
  std::lock_guard guard{mutex_};
  auto i = sinks_.find(number);
  return i == sinks_.end() ? nullptr : i->second;
}

caf::strong_actor_ptr Mesh::local(std::uint32_t number) const {
  return names_->actor_of(make_actor_name(self_, number));
}

caf::strong_actor_ptr Mesh::well_known(ProcessNumber process, WellKnownActor number) {
  return names_->actor_of(make_actor_name(process, number));
}

void Mesh::add_link(const caf::actor& link, std::shared_ptr<LinkRecord> record,
                    const SessionLimits& limits) {
  auto peer = record->peer();
  {
    std::lock_guard guard{mutex_};
    records_[peer] = record;
  }
  requests_->add_process(peer);
  names_->add_port(std::make_shared<LinkPort>(LinkPortParts{
    names_, messages_, requests_, self_, peer, link, std::move(record), clock_, limits}));
}

void Mesh::inject(ProcessNumber peer, const LinkFault& x) {
  if (auto port = names_->port(peer))
    caf::anon_send(port->link(), x);
}

std::vector<LinkStatus> Mesh::links() const {
  std::lock_guard guard{mutex_};
  std::vector<LinkStatus> result;
  for (auto& [peer, record] : records_)
    result.push_back(record->status());
  return result;
}

MessageCounts Mesh::message_counts() const {
  std::lock_guard guard{mutex_};
  MessageCounts result;
  for (auto& [peer, record] : records_) {
    result.sent[peer] = record->sent;
    result.received[peer] = record->received;
  }
  return result;
}

void Mesh::end_process(ProcessNumber process) {
  auto representatives = names_->remove_process(process);
  auto unanswered = requests_->remove_process(process);
  messages_->process_ended(process);
  for (auto& x : unanswered)
    reply_receiver_down(x.sender, x.id);
  for (auto& x : representatives)
    end_remote(x, caf::exit_reason::remote_link_unreachable);
}

void Mesh::close() {
  auto processes = names_->close();
  {
    std::lock_guard guard{mutex_};
    sinks_.clear();
  }
  for (auto process : processes)
    end_process(process);
}

Bytes Mesh::introduction(const std::vector<TypeDescriptorPtr>& types) {
  Bytes result;
  Encoder out{result};
  out.put(MessageSubject::types);
  out.put(static_cast<std::uint32_t>(types.size()));
  for (auto& x : types)
    out.put(encode_descriptor(*x));
  return result;
}

/// Of a message that a link did not take, what is known of it is told to whoever waits for it.
void Mesh::drop_too_large(WireReader& in, std::uint64_t size, caf::execution_unit* context) {
  auto why = "a message of " + std::to_string(size) + " bytes is more than a link takes";
  log_repeated(LogLevel::warning, why);
  // Its head was too large, too.
  if (in.at_end())
    return;
  auto subject = in.take<MessageSubject>();
  if (subject != MessageSubject::message && subject != MessageSubject::error)
    return;
  auto sender = in.take<caf::strong_actor_ptr>();
  auto receiver = local(in.take<std::uint32_t>());
  auto id = take_message_id(in);
  auto error = caf::make_error(caf::sec::runtime_error, why);
  if (id.is_request() && sender) {
    sender->enqueue(nullptr, id.response_id(), caf::make_message(std::move(error)), context);
  } else if (id.is_response() && receiver) {
    requests_->remove(receiver, id);
    receiver->enqueue(std::move(sender), id, caf::make_message(std::move(error)), context);
  }
}

void Mesh::receive(ProcessNumber from, IncomingMessage message, caf::execution_unit* context) {
  // From before the receiver becomes ready until the message is counted.
  auto* clock = clock_->get();
  auto hold = clock ? clock->hold() : TimeHold{};
  WireReader in{*names_, message.head, std::move(message.contents)};
  if (message.too_large > 0) {
    drop_too_large(in, message.too_large, context);
    count_received(from);
    return;
  }
  receive_subject(from, in.take<MessageSubject>(), in, context);
}

void Mesh::receive_subject(ProcessNumber from, MessageSubject subject, WireReader& in,
                           caf::execution_unit* context) {
  switch (subject) {
    case MessageSubject::message:
    case MessageSubject::error:
      receive_message(from, subject == MessageSubject::error, in, context);
      return;
    case MessageSubject::exit:
      if (auto receiver = local(in.take<std::uint32_t>()))
        caf::anon_send_exit(receiver, caf::exit_reason::user_shutdown);
      count_received(from);
      return;
    case MessageSubject::ended:
      names_->end_of_remote(make_actor_name(from, in.take<std::uint32_t>()));
      count_received(from);
      return;
    case MessageSubject::timed: {
      ClockAdvance present;
      present.round = in.take<std::uint64_t>();
      present.time = in.take<Timestamp>();
      // Before what was sent after that.
      if (auto* clock = clock_->get())
        clock->advance(present);
      receive_subject(from, in.take<MessageSubject>(), in, context);
      return;
    }
    case MessageSubject::types:
      for (auto n = in.take<std::uint32_t>(); n > 0; --n)
        names_->add_type(decode_descriptor(in.take_bytes()));
      return;
  }
}

void Mesh::count_received(ProcessNumber from) {
  std::lock_guard guard{mutex_};
  if (auto i = records_.find(from); i != records_.end())
    LinkRecord::add(i->second->received, 1);
}

void Mesh::receive_message(ProcessNumber from, bool is_error, WireReader& in,
                           caf::execution_unit* context) {
  auto sender = in.take<caf::strong_actor_ptr>();
  auto number = in.take<std::uint32_t>();
  auto id = take_message_id(in);
  const AtExit counted{[&] {
    if (number != static_cast<std::uint32_t>(clock_number))
      count_received(from);
  }};
  auto content =
    is_error ? caf::make_message(caf::make_error(caf::sec::runtime_error, in.take<std::string>()))
             : messages_->table().read(in);
  if (auto events = messages_->count_events(content)) {
    std::lock_guard guard{mutex_};
    LinkRecord::add(records_.at(from)->events_in, events);
  }
  if (auto take = sink(number)) {
    take(from, content, context);
    return;
  }
  // Who asked is lost, as far as this process knows: there is nobody to answer.
  if (!sender && id.is_request())
    return;
  auto receiver = local(number);
  if (receiver && id.is_response())
    requests_->remove(receiver, id);
  if (receiver)
    receiver->enqueue(std::move(sender), id, std::move(content), context);
  else
    reply_receiver_down(sender, id);
}

} // namespace castor
