// Delays every packet of a netfilter queue, for kernels without netem.
//
//   packet_delay QUEUE MILLISECONDS
#include <libnetfilter_queue/libnetfilter_queue.h>

#include <arpa/inet.h>
#include <linux/netfilter.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <utility>

namespace {

using Clock = std::chrono::steady_clock;

/// Packets in the order of their arrival, with the time at which each may go on.
struct Line {
  Clock::duration delay{};
  std::deque<std::pair<Clock::time_point, std::uint32_t>> packets;
};

int take(nfq_q_handle*, nfgenmsg*, nfq_data* packet, void* line) {
  auto& x = *static_cast<Line*>(line);
  x.packets.emplace_back(Clock::now() + x.delay, ntohl(nfq_get_msg_packet_hdr(packet)->packet_id));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: packet_delay QUEUE MILLISECONDS\n");
    return 2;
  }
  Line line;
  line.delay = std::chrono::milliseconds{std::atoi(argv[2])};
  auto* netfilter = nfq_open();
  auto* queue =
    netfilter
      ? nfq_create_queue(netfilter, static_cast<std::uint16_t>(std::atoi(argv[1])), take, &line)
      : nullptr;
  if (!queue || nfq_set_mode(queue, NFQNL_COPY_META, 0) < 0) {
    std::perror("packet_delay");
    return 1;
  }
  std::puts("delays");
  std::fflush(stdout);
  std::array<char, 65536> buffer;
  for (;;) {
    int wait = -1;
    if (!line.packets.empty())
      wait = static_cast<int>(std::max<std::int64_t>(
        0, std::chrono::ceil<std::chrono::milliseconds>(line.packets.front().first - Clock::now())
             .count()));
    pollfd socket{nfq_fd(netfilter), POLLIN, 0};
    if (poll(&socket, 1, wait) > 0) {
      auto size = recv(socket.fd, buffer.data(), buffer.size(), 0);
      if (size > 0)
        nfq_handle_packet(netfilter, buffer.data(), static_cast<int>(size));
      else if (errno != ENOBUFS && errno != EINTR) // too many at once: some are lost
        return 1;
    }
    while (!line.packets.empty() && line.packets.front().first <= Clock::now()) {
      nfq_set_verdict(queue, line.packets.front().second, NF_ACCEPT, 0, nullptr);
      line.packets.pop_front();
    }
  }
}
