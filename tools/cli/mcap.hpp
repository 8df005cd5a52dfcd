#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace castor::cli {

/// Writes a recording in the MCAP format (https://mcap.dev/spec) for Foxglove and Lichtblick:
/// messages as JSON, in uncompressed chunks, with an index and statistics. Throws
/// std::runtime_error if the file cannot be written.
class McapWriter {
public:
  using Id = std::uint16_t;
  using Time = std::chrono::nanoseconds;

  explicit McapWriter(const std::filesystem::path& file);

  /// @param schema as JSON Schema
  Id add_schema(const std::string& name, const std::string& schema);
  Id add_channel(Id schema, const std::string& topic,
                 const std::map<std::string, std::string>& metadata);
  /// @param time since 1970
  void add_message(Id channel, std::uint32_t sequence, Time time, const std::string& json);

  /// Writes the index; without it the file is incomplete.
  void close();

private:
  using Bytes = std::string;

  struct ChunkIndex {
    Time first;
    Time last;
    std::uint64_t start = 0;
    std::uint64_t length = 0;
    std::map<Id, std::uint64_t> message_indices;
    std::uint64_t message_indices_length = 0;
    std::uint64_t size = 0;
  };

  void write(const Bytes& x);
  void end_chunk();
  Bytes statistics() const;

  std::filesystem::path name_;
  std::ofstream file_;
  std::uint64_t position_ = 0;
  std::vector<Bytes> schemas_;
  std::vector<Bytes> channels_;
  std::map<Id, std::uint64_t> message_counts_;
  std::vector<ChunkIndex> chunks_;
  // Of the chunk that is being filled.
  Bytes chunk_;
  Time first_{0};
  Time last_{0};
  std::map<Id, std::vector<std::pair<Time, std::uint64_t>>> message_index_;
};

} // namespace castor::cli
