#include "castor/actors/link/link.hpp"

#include "castor/actors/link/adopt_connection.hpp"
#include "castor/actors/link/connection.hpp"
#include "castor/actors/link/link_end.hpp"
#include "castor/actors/link/send_later.hpp"

#include <caf/blocking_actor.hpp>
#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>

#include <unistd.h>

#include <atomic>
#include <random>
#include <utility>
#include <variant>

namespace castor {

namespace {

/// Most bytes read at once: few, as a buffer is kept for them, until more come.
constexpr std::size_t few_bytes = 4 * 1024;
constexpr std::size_t many_bytes = 128 * 1024;

/// A socket that nobody has taken is closed.
class DialledSocket {
public:
  explicit DialledSocket(int socket) : socket_(socket) {}
  DialledSocket(const DialledSocket&) = delete;
  DialledSocket& operator=(const DialledSocket&) = delete;
  ~DialledSocket() {
    if (socket_ >= 0)
      ::close(socket_);
  }

  int take() { return std::exchange(socket_, -1); }

private:
  int socket_;
};

/// The outcome of dialling: a socket, or nothing and why.
struct Dialled {
  std::shared_ptr<DialledSocket> socket;
  std::string problem;
};

} // namespace

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::Dialled)

namespace castor {

namespace {

struct BrokerState {
  static constexpr const char* name = "link";

  /// Set when the link ends, for threads that dial on its behalf.
  std::shared_ptr<std::atomic<bool>> over = std::make_shared<std::atomic<bool>>(false);

  ~BrokerState() { *over = true; }
};

using Self = caf::io::stateful_broker<BrokerState>;
using caf::io::connection_handle;

/// The end of a link over the network.
class Link : public LinkDriver, public std::enable_shared_from_this<Link> {
public:
  Link(Self* self, LinkParts parts, std::shared_ptr<LinkRecord> record)
    : self_(self), peer_(parts.dial), trust_(parts.trust), connecting_(parts.options.connecting),
      end_(*this, std::move(parts), std::move(record), std::random_device{}()) {}

  caf::behavior begin() {
    end_.begin();
    auto link = shared_from_this();
    return {
      [link](LinkMessage& x) { link->end_.send(std::move(x)); },
      [link](const caf::io::new_data_msg& x) {
        if (x.buf.size() == few_bytes)
          link->read_at_once(x.handle, many_bytes);
        link->end_.receive(x.handle.id(),
                           {reinterpret_cast<const std::uint8_t*>(x.buf.data()), x.buf.size()});
      },
      [link](const caf::io::data_transferred_msg& x) {
        link->end_.transferred(x.handle.id(), x.remaining);
      },
      [link](const caf::io::connection_closed_msg& x) { link->end_.closed(x.handle.id()); },
      [link](LinkReminder x) { link->end_.remind(x); },
      [link](const LinkFault& x) { link->end_.inject(x); },
      [link](const Dialled& x) { link->dialled(x); },
      [link](const AdoptConnection& x) { link->adopt(*x.accepted); },
      [link](const LinkPatience& x) { link->end_.set_patience(x.patience); },
      [link](const CloseLink& x) { link->end_.close(x.reason); },
    };
  }

  // -- for the end

  Clock::time_point now() const override { return Clock::now(); }

  void remind(LinkReminder of, std::chrono::milliseconds after) override {
    send_later(self_, after, of);
  }

  void dial() override {
    self_->system().spawn<caf::detached + caf::hidden>(
      [to = *peer_, trust = trust_, until = connecting_, over = self_->state.over,
       link = caf::actor_cast<caf::actor>(self_)](caf::blocking_actor*) {
        auto result = castor::dial(to, trust, until, [&] { return over->load(); });
        if (auto* socket = std::get_if<int>(&result))
          caf::anon_send(link, Dialled{std::make_shared<DialledSocket>(*socket), {}});
        else
          caf::anon_send(link, Dialled{nullptr, std::get<std::string>(result)});
      });
  }

  void listen_to(Connection x) override {
    auto handle = connection_handle::from_int(x);
    read_at_once(handle, few_bytes);
    self_->ack_writes(handle, true);
    self_->trigger(handle);
  }

  void close(Connection x) override { self_->close(connection_handle::from_int(x)); }

  std::vector<char>& output(Connection x) override {
    return self_->wr_buf(connection_handle::from_int(x));
  }

  void flush(Connection x) override { self_->flush(connection_handle::from_int(x)); }

  void quit() override { self_->quit(); }

  caf::execution_unit* context() override { return self_->context(); }

private:
  void read_at_once(connection_handle from, std::size_t bytes) {
    self_->configure_read(from, caf::io::receive_policy::at_most(bytes));
  }

  void dialled(const Dialled& x) {
    if (!x.socket)
      end_.not_dialled(x.problem);
    else if (end_.is_silent())
      end_.not_dialled("no sign of life");
    else
      end_.dialled(add_connection(*self_, x.socket->take()).id());
  }

  void adopt(AcceptedConnection& x) {
    // It was closed meanwhile, because the link took too long.
    if (!x.connection)
      return;
    auto connection = x.connection->hdl().id();
    self_->move_scribe(std::exchange(x.connection, nullptr));
    end_.adopt(connection, std::move(x.channel), x.hello, std::move(x.received));
  }

  Self* self_;
  const std::optional<Endpoint> peer_;
  const PeerTrust trust_;
  const std::chrono::milliseconds connecting_;
  LinkEnd end_;
};

caf::behavior link(Self* self, LinkParts parts, std::shared_ptr<LinkRecord> record) {
  return std::make_shared<Link>(self, std::move(parts), std::move(record))->begin();
}

} // namespace

void await_ends(caf::actor_system& system, const std::vector<caf::actor>& actors) {
  caf::scoped_actor self{system};
  for (auto& x : actors)
    if (x)
      self->wait_for(x);
}

void secure(LinkParts& parts, const std::optional<Credentials>& credentials, bool insecure) {
  parts.trust = credentials ? PeerTrust::certified
                : insecure  ? PeerTrust::anybody
                            : PeerTrust::same_user;
  if (!parts.dial || !is_socket_path(parts.dial->host))
    parts.credentials = credentials;
}

caf::actor spawn_link(LinkParts parts) {
  auto mesh = parts.mesh;
  auto peer = parts.peer;
  auto record = std::make_shared<LinkRecord>(peer);
  parts.self.receiver = peer;
  auto limits = parts.options.session;
  auto result = mesh->system().middleman().spawn_broker(link, std::move(parts), record);
  mesh->add_link(result, std::move(record), limits);
  return result;
}

} // namespace castor
