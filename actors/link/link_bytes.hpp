#pragma once

#include "castor/actors/link/link_error.hpp"

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

/// Numbers in the frames of a link, which are little-endian.
namespace castor::link_bytes {

template <class T>
void put(std::vector<char>& out, T x) {
  auto at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &x, sizeof(T));
}

/// Throws LinkError.
template <class T>
T take(std::span<const std::uint8_t>& in) {
  if (in.size() < sizeof(T))
    throw LinkError("a frame ends too early");
  T x;
  std::memcpy(&x, in.data(), sizeof(T));
  in = in.subspan(sizeof(T));
  return x;
}

} // namespace castor::link_bytes
