#include "castor/tools/cli/mcap.hpp"

#include "castor/wm/values/crc32.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace castor::cli {

namespace {

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

/// What readers load at once.
constexpr std::size_t chunk_size = std::size_t{1} << 20;

enum class Opcode : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  data_end = 15,
};

/// The content of a record, piece by piece; numbers are little-endian.
class Content {
public:
  template <class T>
  Content& number(T x) requires std::is_unsigned_v<T> {
    bytes_.append(reinterpret_cast<const char*>(&x), sizeof(x));
    return *this;
  }
  Content& time(McapWriter::Time x) { return number(static_cast<std::uint64_t>(x.count())); }
  Content& raw(std::string_view x) {
    bytes_ += x;
    return *this;
  }
  Content& text(std::string_view x) { return number(static_cast<std::uint32_t>(x.size())).raw(x); }
  /// A list, a map: its length in bytes, then what stands in it.
  Content& list(const Content& x) { return text(x.bytes_); }

  std::string record(Opcode opcode) const {
    Content result;
    result.number(static_cast<std::uint8_t>(opcode)).number(std::uint64_t{bytes_.size()});
    return result.bytes_ + bytes_;
  }

private:
  std::string bytes_;
};

std::uint32_t crc(std::string_view x) {
  Crc32 result;
  result.add(x.data(), x.size());
  return result.value();
}

} // namespace

McapWriter::McapWriter(const std::filesystem::path& file)
  : name_(file), file_(file, std::ios::binary) {
  write(std::string{magic});
  write(Content{}.text("").text("castor " CASTOR_VERSION).record(Opcode::header));
}

McapWriter::Id McapWriter::add_schema(const std::string& name, const std::string& schema) {
  // 0 is no schema.
  auto id = static_cast<Id>(schemas_.size() + 1);
  schemas_.push_back(
    Content{}.number(id).text(name).text("jsonschema").text(schema).record(Opcode::schema));
  chunk_ += schemas_.back();
  return id;
}

McapWriter::Id McapWriter::add_channel(Id schema, const std::string& topic,
                                       const std::map<std::string, std::string>& metadata) {
  auto id = static_cast<Id>(channels_.size());
  Content pairs;
  for (auto& [key, value] : metadata)
    pairs.text(key).text(value);
  channels_.push_back(
    Content{}.number(id).number(schema).text(topic).text("json").list(pairs).record(
      Opcode::channel));
  chunk_ += channels_.back();
  return id;
}

void McapWriter::add_message(Id channel, std::uint32_t sequence, Time time,
                             const std::string& json) {
  if (message_index_.empty())
    first_ = last_ = time;
  first_ = std::min(first_, time);
  last_ = std::max(last_, time);
  message_index_[channel].emplace_back(time, chunk_.size());
  ++message_counts_[channel];
  chunk_ += Content{}.number(channel).number(sequence).time(time).time(time).raw(json).record(
    Opcode::message);
  if (chunk_.size() >= chunk_size)
    end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.empty())
    return;
  ChunkIndex index;
  index.first = first_;
  index.last = last_;
  index.start = position_;
  index.size = chunk_.size();
  write(Content{}
          .time(first_)
          .time(last_)
          .number(std::uint64_t{chunk_.size()})
          .number(crc(chunk_))
          .text("")
          .number(std::uint64_t{chunk_.size()})
          .raw(chunk_)
          .record(Opcode::chunk));
  index.length = position_ - index.start;
  auto indices = position_;
  for (auto& [channel, messages] : message_index_) {
    index.message_indices[channel] = position_;
    Content list;
    for (auto& [time, offset] : messages)
      list.time(time).number(offset);
    write(Content{}.number(channel).list(list).record(Opcode::message_index));
  }
  index.message_indices_length = position_ - indices;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  message_index_.clear();
  first_ = last_ = Time{0};
}

std::string McapWriter::statistics() const {
  std::uint64_t messages = 0;
  Content counts;
  for (auto& [channel, count] : message_counts_) {
    messages += count;
    counts.number(channel).number(count);
  }
  Time first{0};
  Time last{0};
  for (auto& x : chunks_) {
    first = &x == &chunks_.front() ? x.first : std::min(first, x.first);
    last = std::max(last, x.last);
  }
  return Content{}
    .number(messages)
    .number(static_cast<std::uint16_t>(schemas_.size()))
    .number(static_cast<std::uint32_t>(channels_.size()))
    .number(std::uint32_t{0})
    .number(std::uint32_t{0})
    .number(static_cast<std::uint32_t>(chunks_.size()))
    .time(first)
    .time(last)
    .list(counts)
    .record(Opcode::statistics);
}

void McapWriter::close() {
  end_chunk();
  // 0: no checksum of everything, for each chunk has its own.
  write(Content{}.number(std::uint32_t{0}).record(Opcode::data_end));
  auto start = position_;
  std::string summary;
  for (auto& x : schemas_)
    summary += x;
  for (auto& x : channels_)
    summary += x;
  for (auto& x : chunks_) {
    Content offsets;
    for (auto& [channel, offset] : x.message_indices)
      offsets.number(channel).number(offset);
    summary += Content{}
                 .time(x.first)
                 .time(x.last)
                 .number(x.start)
                 .number(x.length)
                 .list(offsets)
                 .number(x.message_indices_length)
                 .text("")
                 .number(x.size)
                 .number(x.size)
                 .record(Opcode::chunk_index);
  }
  summary += statistics();
  // The checksum of the summary includes the footer up to itself.
  auto footer = Content{}
                  .number(start)
                  .number(std::uint64_t{0})
                  .number(std::uint32_t{0})
                  .record(Opcode::footer);
  footer.resize(footer.size() - sizeof(std::uint32_t));
  summary += footer;
  write(summary);
  auto sum = crc(summary);
  write(std::string{reinterpret_cast<const char*>(&sum), sizeof(sum)});
  write(std::string{magic});
  file_.close();
  if (!file_)
    throw std::runtime_error("cannot write " + name_.string());
}

void McapWriter::write(const std::string& x) {
  file_.write(x.data(), static_cast<std::streamsize>(x.size()));
  if (!file_)
    throw std::runtime_error("cannot write " + name_.string());
  position_ += x.size();
}

} // namespace castor::cli
