#include "castor/actors/link/link_end.hpp"

#include "castor/base/at_exit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// How much may be in the connection's own buffer, where nothing can overtake it any more.
constexpr std::size_t buffered = 192 * 1024;

/// How long a peer may want to rest.
constexpr auto longest_promise = 60s;

} // namespace

void LinkEnd::begin() {
  auto now = driver_.now();
  wake(now);
  schedule_tick(now, parts_.options.heartbeat);
  if (parts_.dial)
    dial();
}

void LinkEnd::remind(LinkReminder of) {
  switch (of) {
    case LinkReminder::tick:
      guarded([this] { tick(); });
      break;
    case LinkReminder::dial:
      dial();
      break;
    case LinkReminder::delayed:
      guarded([this] { write_delayed(); });
      break;
  }
}

// -- connections

void LinkEnd::dial() {
  if (is_silent())
    driver_.remind(LinkReminder::dial, 20ms);
  else
    driver_.dial();
}

void LinkEnd::dialled(Connection x) {
  ++attempt_;
  begin_connection(x, std::make_shared<Channel>(parts_.credentials, SecureChannel::Role::dials));
  guarded([this] { write({}); });
}

void LinkEnd::adopt(Connection x, std::shared_ptr<Channel> channel, const Hello& hello,
                    Bytes received) {
  // The peer has given that one up before it made the present one.
  if (is_silent() || (hello.incarnation == incarnation_ && hello.attempt <= attempt_)) {
    driver_.close(x);
    return;
  }
  attempt_ = hello.attempt;
  if (connection_)
    drop_connection();
  begin_connection(x, std::move(channel));
  handshake_input_ = std::move(received);
  guarded([&] {
    write({});
    established(hello);
  });
}

void LinkEnd::begin_connection(Connection x, std::shared_ptr<Channel> channel) {
  connection_ = x;
  channel_ = std::move(channel);
  hello_sent_ = greeted_ = discarding_input_ = false;
  handshake_input_.clear();
  delayed_.clear();
  in_buffer_ = 0;
  last_input_ = driver_.now();
  driver_.listen_to(x);
}

void LinkEnd::drop_connection() {
  auto connection = *std::exchange(connection_, std::nullopt);
  greeted_ = false;
  driver_.close(connection);
}

/// Without a connection for now.
void LinkEnd::disconnected(const std::string& why) {
  bool was_up = greeted_;
  if (connection_)
    drop_connection();
  if (was_up) {
    down_since_ = driver_.now();
    wake(down_since_);
    backoff_ = 20ms;
  }
  if (!has_ended_ && (was_up || why != reason_))
    set_state(LinkState::down, why);
  reason_ = why;
  if (parts_.dial) {
    // With some jitter, so that those who lost each other at once do not meet at once for ever.
    std::uniform_int_distribution<int> jitter{0, static_cast<int>(backoff_.count()) / 2};
    driver_.remind(LinkReminder::dial, backoff_ + Milliseconds{jitter(random_)});
    backoff_ = std::min<Milliseconds>(backoff_ * 2, 1000ms);
  }
}

/// Without a connection for good.
void LinkEnd::lost(const std::string& why) {
  if (std::exchange(has_ended_, true))
    return;
  if (connection_) {
    session_.say_goodbye(why);
    try_flush();
    drop_connection();
  }
  // Whoever waits for an answer learns of the reason first.
  set_state(LinkState::lost, why);
  parts_.mesh->end_process(parts_.peer);
  driver_.quit();
}

void LinkEnd::try_flush() {
  try {
    flush();
  } catch (const SecurityError&) {
    // Then the peer will find out by itself.
  }
}

void LinkEnd::close(const std::string& reason) {
  has_ended_ = true;
  if (greeted_) {
    session_.say_goodbye(reason);
    try_flush();
  }
  if (connection_)
    drop_connection();
  parts_.mesh->end_process(parts_.peer);
  driver_.quit();
}

void LinkEnd::closed(Connection x) {
  if (x == connection_)
    disconnected("the connection was closed");
}

void LinkEnd::transferred(Connection x, std::size_t remaining) {
  if (x != connection_)
    return;
  in_buffer_ = remaining;
  guarded([this] { flush(); });
}

/// Does something with what the peer says, and ends the connection if that cannot be.
template <class F>
void LinkEnd::guarded(F&& f) {
  try {
    f();
  } catch (const BusyPeerError& e) {
    disconnected(e.what());
  } catch (const SecurityError& e) {
    // Once it was the right peer, it is the way to it that is at fault.
    if (incarnation_ != 0)
      disconnected(e.what());
    else
      lost(e.what());
  } catch (const LinkError& e) {
    lost(e.what());
  } catch (const DecodeError& e) {
    lost(std::string{"a message that cannot be read: "} + e.what());
  }
}

// -- injected faults

void LinkEnd::inject(const LinkFault& x) {
  auto now = driver_.now();
  auto until = now + x.duration;
  wake(now);
  awake_until_ = std::max(awake_until_, until);
  switch (x.kind) {
    case LinkFault::Kind::silence:
      silent_until_ = until;
      silence_ticket_ = x.ticket;
      break;
    case LinkFault::Kind::delay:
      delayed_until_ = until;
      delay_ = x.by;
      delay_ticket_ = x.ticket;
      break;
    case LinkFault::Kind::loss:
      lossy_until_ = until;
      loss_ = x.part;
      loss_ticket_ = x.ticket;
      break;
  }
}

/// Whoever asks has something that passes or does not.
bool LinkEnd::is_silent() {
  auto result = driver_.now() < silent_until_;
  if (result)
    report_effect(silence_ticket_);
  return result;
}

/// Whether the next message is one of those that are lost.
bool LinkEnd::loses_next() {
  auto result = driver_.now() < lossy_until_ &&
                std::uniform_int_distribution<std::uint32_t>{1, 1'000'000}(random_) <= loss_;
  if (result)
    report_effect(loss_ticket_);
  return result;
}

void LinkEnd::write_delayed() {
  auto now = driver_.now();
  while (connection_ && !delayed_.empty() && delayed_.front().first <= now) {
    auto bytes = std::move(delayed_.front().second);
    delayed_.pop_front();
    write_now(std::move(bytes));
  }
}

// -- what is said

void LinkEnd::write(std::vector<char> bytes) {
  auto now = driver_.now();
  bool is_late = now < delayed_until_;
  if (!is_late && delayed_.empty()) {
    write_now(std::move(bytes));
    return;
  }
  if (is_late)
    report_effect(delay_ticket_);
  // Never before what is on its way.
  auto due = std::max(is_late ? now + delay_ : now,
                      delayed_.empty() ? Clock::time_point{} : delayed_.back().first);
  in_buffer_ += bytes.size();
  delayed_.emplace_back(due, std::move(bytes));
  auto rest = std::chrono::ceil<Milliseconds>(due - now);
  driver_.remind(LinkReminder::delayed, std::max(rest, 0ms));
}

/// Says it, after the greeting if that is due.
void LinkEnd::write_now(std::vector<char> bytes) {
  if (!hello_sent_ && channel_->is_ready()) {
    hello_sent_ = true;
    auto hello = parts_.self;
    hello.known = incarnation_;
    hello.received = session_.received();
    hello.attempt = attempt_;
    write_greeting(bytes, hello);
  }
  auto& out = driver_.output(*connection_);
  auto before = out.size();
  channel_->write(std::move(bytes), out);
  in_buffer_ += out.size() - before;
  LinkRecord::add(record_->bytes_out, out.size() - before);
  driver_.flush(*connection_);
}

void LinkEnd::established(const Hello& x) {
  if (parts_.peer_name.empty())
    parts_.peer_name = x.node;
  if (x.node != parts_.peer_name)
    throw LinkError("there is a node " + x.node + " where " + parts_.peer_name +
                    " should be; `castor node --name " + parts_.peer_name +
                    "` gives it that name, HOSTNAME " + x.node + " in the file expects its own");
  if (!channel_->proves(x.node))
    throw LinkError("its certificate is not for the name " + x.node);
  if (x.system != parts_.self.system)
    throw LinkError("it takes part in another system");
  if ((incarnation_ != 0 && x.incarnation != incarnation_) ||
      (x.known != 0 && x.known != parts_.self.incarnation))
    throw LinkError("it was started again");
  incarnation_ = x.incarnation;
  session_.resume(x.received);
  greeted_ = true;
  wake(driver_.now());
  backoff_ = 20ms;
  LinkRecord::add(record_->connections, 1);
  set_state(LinkState::up, {});
  read(std::exchange(handshake_input_, {}));
  flush();
}

void LinkEnd::receive(Connection from, std::span<const std::uint8_t> bytes) {
  if (from != connection_)
    return;
  // What was not heard is not made good for but by another connection, and what follows is not to
  // be heard without it.
  discarding_input_ = discarding_input_ || is_silent();
  if (discarding_input_)
    return;
  last_input_ = driver_.now();
  LinkRecord::add(record_->bytes_in, bytes.size());
  guarded([&] {
    auto plain = channel_->receive(bytes);
    write({});
    if (greeted_) {
      read(plain);
    } else {
      handshake_input_.insert(handshake_input_.end(), plain.begin(), plain.end());
      read_hello();
    }
    flush();
  });
}

void LinkEnd::read_hello() {
  auto greeting = read_greeting(handshake_input_);
  if (!greeting)
    return;
  if (auto* refusal = std::get_if<Refusal>(&*greeting)) {
    if (refusal->final)
      lost(refusal->reason);
    else
      disconnected(refusal->reason);
    return;
  }
  established(std::get<Hello>(*greeting));
}

void LinkEnd::read(std::span<const std::uint8_t> bytes) {
  const auto peer_awaited = session_.peer_awaits();
  session_.receive(bytes, [this](IncomingMessage x) {
    wake(last_input_);
    LinkRecord::add(record_->messages_in, 1);
    parts_.mesh->receive(parts_.peer, std::move(x), driver_.context());
  });
  if (!session_.goodbye().empty())
    return lost(session_.goodbye());
  // It relies on what was announced before until it hears something else.
  if (session_.peer_awaits() && !peer_awaited && !is_awake(last_input_)) {
    announce(last_input_);
    schedule_tick(last_input_, rest(last_input_));
  }
}

void LinkEnd::send(LinkMessage x) {
  if (has_ended_)
    return;
  guarded([&] {
    wake(driver_.now());
    std::vector<TypeDescriptorPtr> unknown;
    for (auto& type : x.types)
      if (introduced_types_.insert(type->hash).second)
        unknown.push_back(std::move(type));
    if (!unknown.empty())
      session_.send({.head = parts_.mesh->introduction(unknown), .comes_first = true});
    session_.send(std::move(x.message));
    LinkRecord::add(record_->messages_out, 1);
    if (connection_ && loses_next())
      disconnected("an injected fault has lost a message");
    flush();
  });
}

void LinkEnd::flush() {
  if (!greeted_ || !connection_ || (session_.has_output() && is_silent()))
    return;
  while (in_buffer_ < buffered && session_.has_output()) {
    std::vector<char> bytes;
    session_.produce(bytes, buffered - in_buffer_);
    wrote_since_tick_ = wrote_since_tick_ || !bytes.empty();
    write(std::move(bytes));
  }
  record_->unacknowledged.store(session_.unacknowledged(), std::memory_order_relaxed);
}

// -- signs of life

bool LinkEnd::is_awake(Clock::time_point now) const {
  return !greeted_ || now < awake_until_ || session_.unacknowledged() > 0 || session_.waiting() > 0;
}

void LinkEnd::wake(Clock::time_point now) {
  next_announcement_ = {};
  if (!is_awake(now))
    awake_since_ = now;
  awake_until_ = std::max(awake_until_, now + parts_.options.rest_after);
  if (next_tick_ > now + 2 * parts_.options.heartbeat)
    schedule_tick(now, parts_.options.heartbeat);
}

/// By that of a process, the coordinator notices its loss. The coordinator's own loss is noticed by
/// whoever wants something of it, which wakes the link.
LinkEnd::Milliseconds LinkEnd::resting_heartbeat(bool awaits) const {
  auto& options = parts_.options;
  if (parts_.peer == 0)
    return options.silence / 2;
  bool is_heard_often = awaits || session_.peer_awaits() || parts_.mesh->self() == 0;
  return is_heard_often ? options.awaiting_heartbeat : options.resting_heartbeat;
}

bool LinkEnd::awaits() const {
  return parts_.mesh->awaits(parts_.peer);
}

void LinkEnd::announce(Clock::time_point now) {
  const auto& heartbeat = parts_.options.heartbeat;
  const auto awaited = awaits();
  const auto next = resting_heartbeat(awaited);
  session_.announce(next + heartbeat, awaited);
  flush();
  next_announcement_ = now + next - heartbeat;
}

/// Until a heartbeat is due, or the peer's should have come.
LinkEnd::Milliseconds LinkEnd::rest(Clock::time_point now) const {
  const auto until = std::min(next_announcement_, last_input_ + patience_at_rest());
  return std::chrono::ceil<Milliseconds>(std::max(until - now, Clock::duration{0})) +
         parts_.options.heartbeat;
}

LinkEnd::Milliseconds LinkEnd::patience_at_rest() const {
  auto& options = parts_.options;
  auto promise = std::min<Milliseconds>(session_.peer_promise(), longest_promise);
  return std::max(options.silence, promise + options.silence / 2);
}

void LinkEnd::schedule_tick(Clock::time_point now, Milliseconds after) {
  auto step = Clock::duration{parts_.options.heartbeat};
  auto origin = driver_.origin();
  next_tick_ = origin + (now + after - origin) / step * step;
  if (next_tick_ <= now)
    next_tick_ += step;
  driver_.remind(LinkReminder::tick, std::chrono::ceil<Milliseconds>(next_tick_ - now));
}

bool LinkEnd::misses_peer(Clock::time_point now) const {
  auto& options = parts_.options;
  if (!greeted_)
    return now - last_input_ > options.connecting;
  // A peer that rests is woken by what is sent to it, and answers from then on.
  if (is_awake(now))
    return now - std::max(last_input_, awake_since_) > options.silence;
  return now - last_input_ > patience_at_rest();
}

void LinkEnd::tick() {
  auto now = driver_.now();
  // There are reminders from before the link was woken.
  if (has_ended_ || now + 1ms < next_tick_)
    return;
  auto& options = parts_.options;
  auto awake = is_awake(now);
  const AtExit next{[&] {
    if (!has_ended_)
      schedule_tick(now, is_awake(now) ? options.heartbeat : rest(now));
  }};
  if (connection_ && discarding_input_ && !is_silent())
    disconnected("sent data was not acknowledged");
  if (connection_) {
    if (misses_peer(now)) {
      disconnected("no sign of life");
    } else if (greeted_ && !awake) {
      if (now >= next_announcement_)
        announce(now);
    } else if (greeted_ && !std::exchange(wrote_since_tick_, false)) {
      session_.remind(options.heartbeat);
      flush();
      wrote_since_tick_ = false;
    }
  }
  if (!greeted_ && now - down_since_ > options.patience)
    lost(fmt::format("it could not be reached for {:g} s{}",
                     std::chrono::duration<double>(options.patience).count(),
                     reason_.empty() ? "" : " (" + reason_ + ")"));
}

void LinkEnd::set_state(LinkState state, const std::string& why) {
  LinkNews news{parts_.peer, state, why, parts_.peer_name};
  record_->set_news(news);
  if (parts_.on_news)
    parts_.on_news(news);
}

} // namespace castor
