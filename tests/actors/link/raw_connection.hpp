#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace castor::test {

/// A TCP connection to a port of 127.0.0.1, for tests that say what they like over it.
class RawConnection {
public:
  explicit RawConnection(std::uint16_t port);
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;
  ~RawConnection();

  /// In one segment, if it is short.
  void send(std::string_view bytes) const;

  /// What comes next; empty if the peer has ended the connection, or says nothing for 10 s.
  std::string receive_some() const;

  /// Everything that comes until the peer ends the connection, or until 10 s have passed.
  std::string receive_all() const;

  /// Whether the peer ends the connection within 10 s; what it says meanwhile is thrown away.
  bool is_ended_by_peer() const;

  /// Ends the connection at once, without regard for what is under way.
  void reset();

private:
  int socket_ = -1;
};

/// How many file descriptors this process has.
std::size_t open_descriptors();

} // namespace castor::test
