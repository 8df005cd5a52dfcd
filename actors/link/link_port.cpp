#include "castor/actors/link/link_port.hpp"

#include "castor/actors/link/message_subject.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"

#include <caf/detail/sync_request_bouncer.hpp>

#include <string>
#include <utility>

namespace castor {

namespace {

/// The lane of what one actor sends to another: these messages keep their order.
Lane lane_of(ActorName sender, std::uint32_t receiver) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
  return sender == 0 ? 0 : ((sender * odd) ^ receiver) | 1;
}

} // namespace

void LinkPort::send(ActorName to, caf::mailbox_element& x) {
  try {
    if (auto failure = parts_.messages->check(to, x.content()))
      refuse(to, x, *failure);
    else
      send_checked(to, x);
  } catch (const MessageTooLarge& e) {
    refuse(to, x, parts_.messages->too_large(x.content(), e.size(), parts_.limits.largest_message));
  }
}

void LinkPort::refuse(ActorName to, caf::mailbox_element& x, const Failure& why) {
  auto answer = parts_.messages->failed_outcome(x.content(), why);
  if (!answer)
    answer = caf::make_message(caf::make_error(caf::sec::runtime_error, why.message));
  if (x.mid.is_request()) {
    if (x.sender)
      x.sender->enqueue(nullptr, x.mid.response_id(), *std::move(answer), nullptr);
  } else if (x.mid.is_response()) {
    send_checked(to, *caf::make_mailbox_element(x.sender, x.mid, {}, *std::move(answer)));
  } else {
    log_repeated(LogLevel::warning, "not sent: " + why.message);
    if (!x.sender)
      return;
    if (auto receipt = parts_.messages->receipt_if_dropped(x.content()))
      x.sender->enqueue(parts_.names->actor_of(to), caf::make_message_id(), *std::move(receipt),
                        nullptr);
  }
}

void LinkPort::send_checked(ActorName to, caf::mailbox_element& x) {
  auto& content = x.content();
  WireWriter out{*parts_.names, parts_.limits.largest_message, parts_.limits.shared_content};
  auto sender = parts_.names->name_of(x.sender);
  auto number = static_cast<std::uint32_t>(to);
  bool is_for_clock = number == static_cast<std::uint32_t>(clock_number);
  if (!is_for_clock)
    write_time(out);
  if (content.match_elements<caf::exit_msg>()) {
    out(MessageSubject::exit, number);
  } else if (content.match_elements<caf::error>()) {
    out(MessageSubject::error, sender, number, x.mid.integer_value(),
        plain_words(content.get_as<caf::error>(0), parts_.link.home_system()));
  } else {
    out(MessageSubject::message, sender, number, x.mid.integer_value());
    if (!parts_.messages->table().write(content, out)) {
      log_runtime(LogLevel::error,
                  std::string{"a message that cannot travel to another process: "} +
                    name_of_type(content));
      caf::detail::sync_request_bouncer{caf::make_error(caf::sec::unexpected_message)}(x.sender,
                                                                                       x.mid);
      return;
    }
    out.check_size();
    if (!open_request(sender, x)) {
      reply_receiver_down(x.sender, x.mid);
      return;
    }
  }
  OutgoingMessage message{out.take_head(), out.take_contents(), lane_of(sender, number)};
  message.may_repeat = !message.contents.empty() && parts_.messages->may_repeat(content);
  LinkRecord::add(parts_.record->events_out, parts_.messages->count_events(content));
  if (auto arrived = parts_.messages->on_arrival(parts_.peer, x.sender, content))
    message.arrived = [names = parts_.names, to, arrived = std::move(arrived)] {
      arrived(names->actor_of(to));
    };
  if (!is_for_clock)
    LinkRecord::add(parts_.record->sent, 1);
  hand_over({std::move(message), out.take_types()});
}

void LinkPort::write_time(WireWriter& out) const {
  if (auto* clock = parts_.clock->get()) {
    auto present = clock->present();
    out(MessageSubject::timed, present.round, present.time);
  }
}

bool LinkPort::open_request(ActorName sender, const caf::mailbox_element& x) {
  // Those that are only passed on are answered elsewhere.
  bool is_passed_on = sender != 0 && process_of(sender) != parts_.self;
  if (!x.mid.is_request() || !x.sender || is_passed_on)
    return true;
  return parts_.requests->add(parts_.peer, x.sender, x.mid);
}

void LinkPort::tell_end(ActorName who) {
  WireWriter out{*parts_.names};
  write_time(out);
  out(MessageSubject::ended, static_cast<std::uint32_t>(who));
  LinkRecord::add(parts_.record->sent, 1);
  hand_over({{out.take_head()}, {}});
}

void LinkPort::hand_over(LinkMessage message) {
  caf::anon_send(parts_.link, std::move(message));
}

} // namespace castor
