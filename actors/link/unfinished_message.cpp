#include "castor/actors/link/unfinished_message.hpp"

#include "castor/actors/link/link_bytes.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace castor {

namespace {

/// Of what is too large to be taken, only a head of at most so many bytes is kept.
constexpr std::size_t largest_head_alone = 64 * 1024;
/// What a peer announces is believed up to here before it has arrived.
constexpr std::size_t reserved_at_most = std::size_t{4} << 20;

constexpr std::uint64_t number_mask = message_word(MessageWord::keep, 0) - 1;

MessageWord kind_of(std::uint64_t word) {
  return static_cast<MessageWord>(word >> 62);
}

} // namespace

void UnfinishedMessage::take(std::span<const std::uint8_t> in, std::size_t largest) {
  if (begun_) {
    take_pieces(in);
    return;
  }
  begin_.insert(begin_.end(), in.begin(), in.end());
  if (!read_words(largest))
    return;
  begun_ = true;
  auto rest = std::exchange(begin_, {});
  take_pieces(
    std::span{rest}.subspan(sizeof(std::uint32_t) + words_.size() * sizeof(std::uint64_t)));
}

bool UnfinishedMessage::complete() const {
  if (too_large_ > 0)
    return missing_ == 0;
  return begun_ && pieces_.size() == lengths_.size() && is_full(pieces_.size() - 1);
}

IncomingMessage UnfinishedMessage::result(ReceivedContents& kept) {
  if (too_large_ > 0)
    return {pieces_.empty() ? Bytes{} : std::move(pieces_.front()), {}, too_large_};
  IncomingMessage result{std::move(pieces_.front()), {}};
  auto next = pieces_.begin() + 1;
  std::optional<ContentNumber> to_keep;
  for (auto word : std::span{words_}.subspan(1)) {
    auto number = word & number_mask;
    switch (kind_of(word)) {
      case MessageWord::length:
        result.contents.push_back(std::make_shared<ReceivedContent>(std::move(*next++)));
        if (auto keep = std::exchange(to_keep, std::nullopt))
          kept.add(*keep, result.contents.back());
        break;
      case MessageWord::keep:
        to_keep = number;
        break;
      case MessageWord::kept:
        result.contents.push_back(kept.find(number));
        break;
      case MessageWord::forget:
        kept.forget(number);
        break;
    }
  }
  return result;
}

bool UnfinishedMessage::read_words(std::size_t largest) {
  if (begin_.size() < sizeof(std::uint32_t))
    return false;
  std::span<const std::uint8_t> in{begin_};
  auto count = link_bytes::take<std::uint32_t>(in);
  if (count == 0 || count > std::min(most_words, largest / sizeof(std::uint64_t)))
    throw LinkError("a message of " + std::to_string(count) + " pieces");
  if (in.size() < count * sizeof(std::uint64_t))
    return false;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    words_.push_back(link_bytes::take<std::uint64_t>(in));
    auto kind = kind_of(words_.back());
    bool is_length_needed = i == 0 || kind_of(words_[i - 1]) == MessageWord::keep;
    if (kind != MessageWord::length) {
      if (is_length_needed || (kind == MessageWord::keep && i + 1 == count))
        throw LinkError("a length is missing in a message");
      continue;
    }
    lengths_.push_back(words_.back());
    if (lengths_.back() > std::numeric_limits<std::uint64_t>::max() - total)
      throw LinkError("the size of a message overflows");
    total += lengths_.back();
  }
  if (total > largest)
    too_large_ = missing_ = total;
  return true;
}

void UnfinishedMessage::skip_pieces(std::span<const std::uint8_t> in) {
  if (in.size() > missing_)
    throw LinkError("a message is longer than its declared size");
  auto arrived = too_large_ - missing_;
  missing_ -= in.size();
  if (lengths_.front() > largest_head_alone || arrived >= lengths_.front())
    return;
  if (pieces_.empty())
    pieces_.emplace_back();
  auto part = in.first(std::min<std::size_t>(in.size(), lengths_.front() - arrived));
  pieces_.front().insert(pieces_.front().end(), part.begin(), part.end());
}

void UnfinishedMessage::take_pieces(std::span<const std::uint8_t> in) {
  if (too_large_ > 0) {
    skip_pieces(in);
    return;
  }
  for (;;) {
    if (pieces_.empty() || is_full(pieces_.size() - 1)) {
      if (pieces_.size() == lengths_.size())
        break;
      auto length = lengths_[pieces_.size()];
      pieces_.emplace_back().reserve(std::min<std::size_t>(length, reserved_at_most));
    }
    auto& piece = pieces_.back();
    auto n = std::min<std::size_t>(in.size(), lengths_[pieces_.size() - 1] - piece.size());
    piece.insert(piece.end(), in.begin(), in.begin() + static_cast<std::ptrdiff_t>(n));
    in = in.subspan(n);
    if (!is_full(pieces_.size() - 1))
      break;
  }
  if (!in.empty())
    throw LinkError("a message is longer than its declared size");
}

} // namespace castor
