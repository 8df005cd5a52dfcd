#pragma once

#include "castor/tools/cli/foxglove_schemas.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/values/value.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::cli {

/// A message of one of Foxglove's well-known schemas.
struct FoxgloveMessage {
  std::string topic;
  FoxgloveSchema schema;
  nlohmann::ordered_json content;
};

/// Finds displayable records in values by their fields, whatever their types are called:
///
///   picture   width, height, channels, bytes          pixels in rows; 3 channels are B, G, R
///   picture   bytes or data, mime_type or format      encoded; "image/png" and "png" are the same
///   pose      position {x, y, z}, rotation or orientation {w, x, y, z}
///   box       centroid or center {x, y, z}, size {x, y, z}
///   camera    a pose, and width, height, fx, fy, cx, cy, perhaps k1, k2, k3, t1, t2
///
/// All coordinates are metres in one frame, "world"; those of a camera are x right, y down, z
/// forward.
class FoxgloveView {
public:
  /// Messages for an added or overwritten entry with this value, or for a deleted one if the value
  /// is empty. `topic` is that of its type, `id` that of the entry.
  std::vector<FoxgloveMessage> change(const std::string& topic, const std::string& id,
                                      UnixTime time, const Value& value);

  /// Messages for a value that a stand-alone component has pushed or returned.
  std::vector<FoxgloveMessage> handed_out(const std::string& topic, UnixTime time,
                                          const Value& value);

private:
  using Json = nlohmann::ordered_json;

  void add_views(std::vector<FoxgloveMessage>& to, const std::string& topic, UnixTime time,
                 const Value& value, bool repeat_pictures);
  std::vector<FoxgloveMessage> remove(const std::string& topic, const std::string& id,
                                      UnixTime time);
  Json all_poses(const std::string& topic, UnixTime time) const;

  /// By topic and id.
  std::map<std::string, std::map<std::string, Json>> poses_;
  std::map<std::string, std::set<std::string>> entities_;
  /// By topic: checksum of the last picture.
  std::map<std::string, std::uint32_t> last_picture_;
};

} // namespace castor::cli
