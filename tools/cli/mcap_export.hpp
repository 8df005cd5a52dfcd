#pragma once

#include "castor/actors/runtime/push_log.hpp"
#include "castor/tools/cli/foxglove.hpp"
#include "castor/tools/cli/mcap.hpp"
#include "castor/wm/journal/journal.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::cli {

/// Message of a recording about a change, as JSON, with the value.
std::string message_of(const std::string& subarchitecture, const JournalRecord& x);

/// Writes recorded changes and values into an MCAP file: a topic of JSON messages for each type of
/// a subarchitecture or of a stand-alone component, and further topics for the parts that Foxglove
/// can display. Throws std::runtime_error if the file cannot be written.
class McapExport {
public:
  explicit McapExport(const std::filesystem::path& file) : writer_(file) {}

  void add(const std::string& subarchitecture, const JournalRecord& x);
  void add(const std::string& provider, const RecordedPush& x);

  /// Writes the index; without it the file is incomplete.
  void close() { writer_.close(); }

private:
  using Id = McapWriter::Id;

  /// Channel of a topic, and the number of its messages so far.
  struct Channel {
    Id id = 0;
    std::uint32_t messages = 0;
  };

  Channel& channel(const std::string& topic, const std::string& schema_name,
                   const std::function<std::string()>& schema, const std::string& metadata_key,
                   const std::string& from);
  void add_views(const std::vector<FoxgloveMessage>& messages, UnixTime time,
                 const std::string& metadata_key, const std::string& from);

  McapWriter writer_;
  FoxgloveView view_;
  /// By name, with a suffix to distinguish schemas of one name.
  std::map<std::string, Id> schemas_;
  /// By topic and schema.
  std::map<std::pair<std::string, Id>, Channel> channels_;
};

} // namespace castor::cli
