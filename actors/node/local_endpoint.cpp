#include "castor/actors/node/local_endpoint.hpp"

#include "castor/actors/component/log.hpp"
#include "castor/actors/link/connection.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/node/inspection.hpp"

#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

namespace castor {

namespace {

namespace fs = std::filesystem;
using caf::io::connection_handle;

constexpr std::size_t most_connections = 64;
constexpr std::string_view no_descriptors =
  "{\"error\":\"the system has no file descriptors left; try again later\"}\n";

/// As much of a text as fits into so many bytes, without half a character.
std::string beginning(const std::string& text, std::size_t bytes) {
  auto end = std::min(text.size(), bytes);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end;
  return text.substr(0, end);
}

/// The socket's file, and who has connected.
struct EndpointState {
  static constexpr const char* name = "local_endpoint";

  struct Connection {
    std::string received;
    caf::actor inspection;
    /// Whether something was said that has not been taken, and whether that was the last.
    bool busy = false;
    bool last = false;
  };

  fs::path socket;
  SystemRosterPtr roster;
  std::function<void(SystemOrder)> give_order;
  std::map<connection_handle, Connection> connections;

  ~EndpointState() {
    unlink(socket.c_str());
    for (auto& [handle, connection] : connections)
      caf::anon_send_exit(connection.inspection, caf::exit_reason::user_shutdown);
  }
};

using Self = caf::io::stateful_broker<EndpointState>;

void leave(Self* self, connection_handle handle) {
  auto x = self->state.connections.extract(handle);
  if (!x)
    return;
  caf::anon_send_exit(x.mapped().inspection, caf::exit_reason::user_shutdown);
  self->close(handle);
}

void say(Self* self, connection_handle handle, const std::string& text, bool last) {
  auto i = self->state.connections.find(handle);
  if (i == self->state.connections.end())
    return;
  i->second.last = last;
  if (text.empty()) {
    if (last && !i->second.busy)
      leave(self, handle);
    return;
  }
  i->second.busy = true;
  self->write(handle, text.size(), text.data());
  self->flush(handle);
}

void admit(Self* self, connection_handle handle) {
  // CAF numbers connections by their sockets.
  auto peer = local_peer(static_cast<int>(handle.id()));
  if (!peer || !peer->is_of_this_user()) {
    note(LogLevel::warning, "turned away " + (peer ? to_string(*peer) : "a process") + " from " +
                              self->state.socket.string() + ": it belongs to another user");
    self->close(handle);
    return;
  }
  if (self->state.connections.size() >= most_connections) {
    self->close(handle);
    return;
  }
  self->state.connections[handle];
  self->configure_read(handle, caf::io::receive_policy::at_most(4096));
  self->ack_writes(handle, true);
}

/// The first line of a connection is what it is for.
void ask(Self* self, connection_handle handle, EndpointState::Connection& connection,
         std::string line) {
  if (!connection.inspection) {
    InspectionParts parts;
    parts.connection = static_cast<std::uint64_t>(handle.id());
    parts.endpoint = self;
    parts.roster = self->state.roster;
    parts.give_order = self->state.give_order;
    connection.inspection = self->system().spawn(inspection, std::move(parts));
  }
  caf::anon_send(connection.inspection, InspectionRequest{std::move(line)});
}

void hear(Self* self, const caf::io::new_data_msg& x) {
  auto i = self->state.connections.find(x.handle);
  if (i == self->state.connections.end())
    return;
  auto& received = i->second.received;
  received.append(x.buf.data(), x.buf.size());
  // What came before has no line break.
  auto fresh = received.size() - x.buf.size();
  for (auto end = received.find('\n', fresh); end != std::string::npos; end = received.find('\n')) {
    ask(self, x.handle, i->second, received.substr(0, end));
    received.erase(0, end + 1);
  }
  if (received.size() > longest_request)
    leave(self, x.handle);
}

void written(Self* self, const caf::io::data_transferred_msg& x) {
  auto i = self->state.connections.find(x.handle);
  if (i == self->state.connections.end() || x.remaining > 0)
    return;
  i->second.busy = false;
  if (i->second.last)
    leave(self, x.handle);
  else
    caf::anon_send(i->second.inspection, InspectionTaken{});
}

caf::behavior endpoint(Self* self, fs::path path, int socket,
                       std::function<void(SystemOrder)> give_order) {
  self->state.socket = std::move(path);
  self->state.give_order = std::move(give_order);
  add_acceptor(
    *self,
    {socket, {no_descriptors.begin(), no_descriptors.end()}, [](const DescriptorShortage& x) {
       note(LogLevel::warning, "refused " + std::to_string(x.turned_away) +
                                 " who look on: " + x.problem +
                                 "; `ulimit -n` is how many file descriptors a process may have");
     }});
  return {
    [self](const SystemRosterPtr& x) {
      self->state.roster = x;
      for (auto& [handle, connection] : self->state.connections)
        if (connection.inspection)
          caf::anon_send(connection.inspection, x);
    },
    [self](const InspectionReply& x) {
      say(self, connection_handle::from_int(static_cast<std::int64_t>(x.connection)), x.text,
          x.last);
    },
    [self](const caf::io::new_connection_msg& x) { admit(self, x.handle); },
    [self](const caf::io::new_data_msg& x) { hear(self, x); },
    [self](const caf::io::data_transferred_msg& x) { written(self, x); },
    [self](const caf::io::connection_closed_msg& x) { leave(self, x.handle); },
    [](const caf::io::acceptor_closed_msg&) {},
    [self](const ResumeAccepting& x) { self->trigger(x.acceptor); },
  };
}

} // namespace

fs::path endpoint_of_process(const std::string& system_file) {
  auto folder = runtime_folder();
  auto end = '-' + std::to_string(getpid()) + ".sock";
  auto room = longest_socket_path - folder.string().size() - 1 - end.size();
  return folder / (beginning(fs::path{system_file}.stem().string(), room) + end);
}

caf::actor open_local_endpoint(caf::actor_system& system, const fs::path& socket,
                               std::function<void(SystemOrder)> give_order) {
  // What killed processes have left behind.
  sweep(socket.parent_path());
  const FolderLock lock{socket.parent_path(), std::chrono::seconds{2}};
  auto fd = listen_at_path(socket);
  return system.middleman().spawn_broker(endpoint, socket, fd, std::move(give_order));
}

} // namespace castor
