#pragma once

#include "castor/actors/link/incoming_message.hpp"
#include "castor/actors/link/kept_contents.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace castor {

/// Most words at the beginning of a message.
inline constexpr std::size_t most_words = std::size_t{1} << 20;

/// What a word at the beginning of a message says, in its two highest bits.
enum class MessageWord : std::uint8_t {
  /// The length of the head, or of a content, whose bytes follow.
  length,
  /// The receiver keeps the content whose length is the next word, under this number.
  keep,
  /// The content is the kept one of this number.
  kept,
  /// The kept content of this number is not needed any more.
  forget,
};

/// The other bits are a length or number.
constexpr std::uint64_t message_word(MessageWord kind, std::uint64_t x) {
  return static_cast<std::uint64_t>(kind) << 62 | x;
}

/// A message of which not all has arrived.
class UnfinishedMessage {
public:
  /// Takes bytes of the message, of which at most `largest` are kept. Throws LinkError.
  void take(std::span<const std::uint8_t> in, std::size_t largest);

  bool complete() const;

  /// The message, whose kept contents are found in `kept`, or put there. Throws LinkError. \pre
  /// complete
  IncomingMessage result(ReceivedContents& kept);

private:
  bool read_words(std::size_t largest);
  /// Keeps the head, which says whom to tell, and counts the rest.
  void skip_pieces(std::span<const std::uint8_t> in);
  void take_pieces(std::span<const std::uint8_t> in);
  bool is_full(std::size_t i) const { return pieces_[i].size() == lengths_[i]; }

  /// Until the words are known.
  Bytes begin_;
  bool begun_ = false;
  /// The words after the count.
  std::vector<std::uint64_t> words_;
  /// Of the pieces whose bytes follow: the head and whole contents.
  std::vector<std::uint64_t> lengths_;
  std::vector<Bytes> pieces_;
  /// Of all pieces, if that is more than is taken; otherwise 0.
  std::uint64_t too_large_ = 0;
  /// Of a message that is too large: what has not arrived.
  std::uint64_t missing_ = 0;
};

} // namespace castor
