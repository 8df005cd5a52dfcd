#include "castor/actors/system/local_endpoint.hpp"

#include "castor/actors/link/connection.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/link/send_later.hpp"
#include "castor/actors/system/inspection.hpp"
#include "castor/actors/system/inspection_json.hpp"
#include "castor/actors/system/request_lines.hpp"
#include "castor/base/log.hpp"
#include "castor/base/text.hpp"

#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

namespace castor {

namespace {

/// To an endpoint from itself: a connection should have said what it wants.
struct RequestDue {
  caf::io::connection_handle connection;
  std::uint64_t number = 0;
};

} // namespace

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::RequestDue)

namespace castor {

namespace {

namespace fs = std::filesystem;
using caf::io::connection_handle;

constexpr std::size_t most_connections = 64;
/// How long a connection may take for its request.
constexpr std::chrono::seconds time_for_request{10};
constexpr std::string_view no_descriptors =
  "{\"error\":\"the system has no file descriptors left; try again later\"}\n";

/// The socket's file, and who has connected.
struct EndpointState {
  static constexpr const char* name = "local_endpoint";

  struct Connection {
    RequestLines lines;
    caf::actor inspection;
    /// Tells it from others of the same handle.
    std::uint64_t number = 0;
    /// Whether it was answered that no more is taken.
    bool refused = false;
    /// Whether something was said that has not been taken, and whether that was the last.
    bool busy = false;
    bool last = false;
  };

  fs::path socket;
  SystemRosterPtr roster;
  std::function<void(SystemOrder)> give_order;
  std::shared_ptr<OperationLog> operations;
  std::shared_ptr<ClockControl> clock;
  std::map<connection_handle, Connection> connections;
  std::uint64_t last_number = 0;

  ~EndpointState() {
    unlink(socket.c_str());
    for (auto& [handle, connection] : connections)
      caf::anon_send_exit(connection.inspection, caf::exit_reason::user_shutdown);
  }
};

using EndpointSelf = caf::io::stateful_broker<EndpointState>;

void leave(EndpointSelf* self, connection_handle handle) {
  auto x = self->state.connections.extract(handle);
  if (!x)
    return;
  caf::anon_send_exit(x.mapped().inspection, caf::exit_reason::user_shutdown);
  self->close(handle);
}

void say(EndpointSelf* self, connection_handle handle, const std::string& text, bool last) {
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

/// Answers why it is not heard, and ends the connection.
void refuse(EndpointSelf* self, connection_handle handle, const std::string& why) {
  self->state.connections.at(handle).refused = true;
  say(self, handle, as_line(Json{{"error", why}}), true);
}

void admit(EndpointSelf* self, connection_handle handle) {
  // CAF numbers connections by their sockets.
  auto peer = local_peer(static_cast<int>(handle.id()));
  if (!peer || !peer->is_of_this_user()) {
    log_repeated(LogLevel::warning, "turned away " + (peer ? to_string(*peer) : "a process") +
                                      " from " + self->state.socket.string() +
                                      ": it belongs to another user");
    self->close(handle);
    return;
  }
  bool is_full = self->state.connections.size() >= most_connections;
  auto& connection = self->state.connections[handle];
  connection.number = ++self->state.last_number;
  self->configure_read(handle, caf::io::receive_policy::at_most(4096));
  self->ack_writes(handle, true);
  if (is_full)
    refuse(self, handle,
           std::to_string(most_connections) + " others are connected; try again later");
  else
    send_later(self, time_for_request, RequestDue{handle, connection.number});
}

/// The first line of a connection is what it is for.
void ask(EndpointSelf* self, connection_handle handle, EndpointState::Connection& connection,
         std::string line) {
  if (!connection.inspection) {
    InspectionParts parts;
    parts.connection = static_cast<std::uint64_t>(handle.id());
    parts.endpoint = self;
    parts.roster = self->state.roster;
    parts.give_order = self->state.give_order;
    parts.operations = self->state.operations;
    parts.clock = self->state.clock;
    connection.inspection = self->system().spawn(inspection, std::move(parts));
  }
  caf::anon_send(connection.inspection, InspectionRequest{std::move(line)});
}

void hear(EndpointSelf* self, const caf::io::new_data_msg& x) {
  auto i = self->state.connections.find(x.handle);
  if (i == self->state.connections.end())
    return;
  auto& connection = i->second;
  if (connection.refused)
    return;
  try {
    for (auto& line : connection.lines.take({x.buf.data(), x.buf.size()}))
      ask(self, x.handle, connection, std::move(line));
  } catch (const BadRequest& e) {
    refuse(self, x.handle, e.what());
  }
}

void check_request(EndpointSelf* self, const RequestDue& x) {
  auto i = self->state.connections.find(x.connection);
  if (i != self->state.connections.end() && i->second.number == x.number && !i->second.inspection &&
      !i->second.refused)
    refuse(self, x.connection,
           "there was no request within " + std::to_string(time_for_request.count()) +
             " s; a request is a line, with a line break at its end");
}

void written(EndpointSelf* self, const caf::io::data_transferred_msg& x) {
  auto i = self->state.connections.find(x.handle);
  if (i == self->state.connections.end() || x.remaining > 0)
    return;
  i->second.busy = false;
  if (i->second.last)
    leave(self, x.handle);
  else if (i->second.inspection)
    caf::anon_send(i->second.inspection, InspectionTaken{});
}

caf::behavior endpoint(EndpointSelf* self, fs::path path, int socket,
                       std::function<void(SystemOrder)> give_order,
                       std::shared_ptr<OperationLog> operations,
                       std::shared_ptr<ClockControl> clock) {
  self->state.socket = std::move(path);
  self->state.give_order = std::move(give_order);
  self->state.operations = std::move(operations);
  self->state.clock = std::move(clock);
  add_acceptor(
    *self,
    {socket, {no_descriptors.begin(), no_descriptors.end()}, [](const DescriptorShortage& x) {
       log_repeated(LogLevel::warning,
                    "refused " + std::to_string(x.turned_away) + " connections for inspection: " +
                      x.problem + "; `ulimit -n` is how many file descriptors a process may have");
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
    [self](const RequestDue& x) { check_request(self, x); },
    [self](const ResumeAccepting& x) { self->trigger(x.acceptor); },
  };
}

} // namespace

fs::path endpoint_of_process(const std::string& system_file) {
  auto folder = runtime_folder();
  auto end = '-' + std::to_string(getpid()) + ".sock";
  auto room = longest_socket_path - folder.string().size() - 1 - end.size();
  const auto name = fs::path{system_file}.stem().string();
  return folder / (std::string{whole_characters(name, room)} + end);
}

caf::actor open_local_endpoint(caf::actor_system& system, const fs::path& socket,
                               std::function<void(SystemOrder)> give_order,
                               std::shared_ptr<OperationLog> operations,
                               std::shared_ptr<ClockControl> clock) {
  // What killed processes have left behind.
  sweep(socket.parent_path());
  const FolderLock lock{socket.parent_path(), std::chrono::seconds{2}};
  auto fd = listen_at_path(socket);
  return system.middleman().spawn_broker(endpoint, socket, fd, std::move(give_order),
                                         std::move(operations), std::move(clock));
}

} // namespace castor
